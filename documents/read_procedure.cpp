// SPDX-License-Identifier: Apache-2.0
#include "documents/read_procedure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <set>
#include <string_view>
#include <type_traits>
#include <utility>

#include "documents/patch.h"
#include "documents/read_anatomy.h"
#include "documents/read_implants.h"
#include "documents/read_measures.h"
#include "documents/shapes.h"
#include "documents/signal_need.h"
#include "documents/waypoint_nodes.h"
#include "documents/yaml/correct_keys.h"
#include "documents/yaml/read_map.h"
#include "kerf/units.hpp"
#include "text/look_alike.h"
#include "text/printable.h"

namespace kerf {
namespace {

constexpr std::size_t max_variants = 32;
constexpr const char* midline = "midline";

std::string quoted_id(const std::string& id) { return "`" + id + "`"; }

bool contains(const std::vector<std::string>& words, const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

// ---- metadata, needs, anatomy ---------------------------------------------------------------------------------

bool is_version(std::string_view text) {
    int dots = 0;
    char before = '.';
    for (const char c : text) {
        if (c == '.' && before == '.') return false;
        if (c == '.')
            ++dots;
        else if (c < '0' || c > '9')
            return false;
        before = c;
    }
    return dots == 2 && before != '.' && text.size() <= 32;
}

void read_metadata(const Node& node, Procedure& procedure, Report& report) {
    MapReader map(node, shapes::metadata, "metadata", report);
    procedure.id = map.id("id");
    procedure.title = map.text("title");
    if (const Node* version = map.find("version")) {
        procedure.version = read_text(*version, "metadata.version", report).value_or("");
        if (!procedure.version.empty() && !is_version(procedure.version))
            report.error(Code::malformed_word, version->span,
                         "metadata.version is no version: got `" + excerpt(procedure.version, 40) +
                             "`, expected three numbers, as in `0.1.0`. Write three.",
                         {});
    }
    procedure.status = map.word("status");
    if (const Node* authors = map.find("authors"))
        for (const Node& author : read_list(*authors, "metadata.authors", report))
            procedure.authors.push_back(read_text(author, "An author", report).value_or(""));
    map.finish();
}

void read_needs(const Node& node, Procedure& procedure, Report& report) {
    MapReader map(node, shapes::needs, "needs", report);
    procedure.needs_landmarks = map.ids("landmarks");
    procedure.needs_zones = map.ids("zones");
    procedure.needs_tissues = map.ids("tissues");
    map.finish();
}

/// Inside the document's folder, so that a procedure can be handed on, and cannot reach for other files.
void read_anatomy_file(const Node& node, const std::string& document_file, Procedure& procedure, Report& report) {
    procedure.anatomy_name = read_path(node, node.key, "the document's own folder", report);
    if (procedure.anatomy_name.empty()) return;
    procedure.anatomy_file =
        (std::filesystem::path(document_file).parent_path() / procedure.anatomy_name).generic_string();
}

// ---- instruments -------------------------------------------------------------------------------------------------

/// The force law of an instrument; null if it is unknown, which is reported where the instrument is.
const ComponentInfo* law_of(const Instrument& instrument, const ComponentCatalog& catalog) {
    const auto found = std::find_if(catalog.begin(), catalog.end(), [&](const ComponentInfo& c) {
        return c.kind == KERF_KIND_FORCE && c.plugin == instrument.force_plugin && c.id == instrument.force;
    });
    return found != catalog.end() ? &*found : nullptr;
}

/// The instrument of a step; null where it is unknown, which is reported there.
const Instrument* instrument_of(const Step& step, const std::vector<Instrument>& instruments) {
    const auto found = std::find_if(instruments.begin(), instruments.end(),
                                    [&](const Instrument& i) { return i.id == step.instrument; });
    return found != instruments.end() ? &*found : nullptr;
}

class InstrumentReader {
public:
    InstrumentReader(const ComponentCatalog& catalog, Report& report) : catalog_(catalog), report_(report) {}

    Instrument read(const Node& node) {
        MapReader map(node, shapes::instrument, node.key, report_);
        Instrument instrument;
        instrument.id = node.key;
        Node key;
        key.text = node.key;
        key.span = node.key_span;
        read_id(key, "An instrument's name", report_);

        const Node* plugin = map.find("plugin");
        const Node* tool_node = map.find("tool");
        const Node* force_node = map.find("force");
        const Node* force_plugin = map.find("force_plugin");
        const ComponentInfo* tool = nullptr;
        const ComponentInfo* force = nullptr;
        if (plugin && find_plugin(*plugin, instrument.plugin)) {
            tool = find_component(tool_node, instrument.plugin, KERF_KIND_TOOL, instrument.tool);
            instrument.force_plugin = instrument.plugin;
        }
        if (force_plugin ? find_plugin(*force_plugin, instrument.force_plugin) : !instrument.force_plugin.empty())
            force = find_component(force_node, instrument.force_plugin, KERF_KIND_FORCE, instrument.force);
        if (tool && force) check_fit(*force_node, *tool, *force);
        if (tool) instrument.tool_parameters = defaults(tool->parameters);
        if (tool) instrument.drives = defaults(tool->drives);
        if (force) {
            instrument.force_parameters = defaults(force->parameters);
            std::copy_if(force->events.begin(), force->events.end(), std::back_inserter(instrument.damages),
                         [](const EventInfo& event) { return event.is_damage; });
        }

        const std::string hands = map.word("hands");
        instrument.hands = hands == "one" ? 1 : hands == "two" ? 2 : 0;
        if (const Node* guide = map.find("guide")) instrument.guide = read_guide(*guide);
        const Node* remeshing = map.find("remeshing");
        const int errors = report_.errors();
        const ComponentInfo* strategy = remeshing != nullptr ? read_remeshing(*remeshing, tool, instrument) : nullptr;
        if (const Node* set = map.find("remeshing_parameters"); set != nullptr && report_.errors() == errors)
            read_remeshing_parameters(*set, strategy, instrument);
        const Node* parameters = map.find("parameters");
        const Node* drives = map.find("drives");
        if (parameters) read_parameters(*parameters, tool, force, instrument);
        if (drives && tool) read_drives(*drives, *tool, instrument);
        map.finish();
        return instrument;
    }

    /// The events of an instrument's force; nothing where the force is unknown.
    [[nodiscard]] std::optional<std::vector<std::string>> events_of(const Instrument& instrument) const {
        const ComponentInfo* force = law_of(instrument, catalog_);
        if (force == nullptr) return std::nullopt;
        std::vector<std::string> ids;
        for (const EventInfo& event : force->events) ids.push_back(event.id);
        return ids;
    }

    /// What a waypoint sets: drives of an instrument that has been read.
    std::vector<HandInput> read_inputs(const Node& node, const Instrument& instrument) {
        const auto tool = std::find_if(catalog_.begin(), catalog_.end(), [&](const ComponentInfo& c) {
            return c.plugin == instrument.plugin && c.kind == KERF_KIND_TOOL && c.id == instrument.tool;
        });
        std::vector<HandInput> inputs;
        if (tool == catalog_.end()) return inputs;
        Instrument set = instrument;
        for (double& value : set.drives) value = std::nan("");
        read_drives(node, *tool, set);
        for (std::size_t i = 0; i < set.drives.size(); ++i)
            if (std::isfinite(set.drives[i]))
                inputs.push_back({HandInput::Kind::drive, tool->drives[i].id, set.drives[i]});
        return inputs;
    }

private:
    /// A word of the core, or a strategy: by its full id, or by the last words of it where only one plugin has them.
    /// Returns the strategy if it is installed.
    const ComponentInfo* read_remeshing(const Node& node, const ComponentInfo* tool, Instrument& instrument) {
        const std::string word = read_text(node, "remeshing", report_).value_or("");
        if (word.empty() || word == "isosurface") return nullptr;
        if (word == "insert") {
            instrument.is_inserted = true;
            return nullptr;
        }
        std::vector<const ComponentInfo*> meant;
        std::vector<std::string> known{"isosurface", "insert"};
        for (const ComponentInfo& component : catalog_) {
            if (component.kind != KERF_KIND_REMESHER) continue;
            known.push_back(component.full_id());
            if (component.matches_id(word)) meant.push_back(&component);
        }
        if (meant.size() == 1) {
            instrument.remeshing = meant.front()->full_id();
            return meant.front();
        }
        if (meant.size() > 1) {
            std::vector<std::string> owners;
            for (const ComponentInfo* one : meant) owners.push_back(one->full_id());
            report_.error(Code::unknown_strategy, node.span,
                          "The strategy `" + excerpt(word, 40) + "` has " + std::to_string(owners.size()) +
                              " owners: expected one of " + listed(owners) + ". Write its full id.");
            return nullptr;
        }
        // The tool's own plugin names it, so it exists, and only its module is missing: the run does without it.
        if (tool != nullptr)
            for (const std::string& suited : tool->strategies)
                if (suited == word || suited.ends_with("." + word)) {
                    instrument.remeshing = suited;
                    return nullptr;
                }
        // Neither does a run need a full id of a plugin that is not there, unless it looks like another one.
        if (std::count(word.begin(), word.end(), '.') > 1 && is_of_no_plugin(word.substr(0, word.rfind('.'))) &&
            suggestion(word, known).empty()) {
            instrument.remeshing = word;
            return nullptr;
        }
        const std::string closest_one = closest(word, known, report_);
        report_.error(Code::unknown_strategy, node.span,
                      "The strategy `" + excerpt(word, 60) + "` is unknown: expected " + listed(known) + "." +
                          or_choose(closest_one, "Write one of these, or install the plugin that has it."),
                      closest_one);
        return nullptr;
    }

    [[nodiscard]] bool is_of_no_plugin(const std::string& id) const {
        return std::none_of(catalog_.begin(), catalog_.end(),
                            [&](const ComponentInfo& one) { return one.plugin == id; });
    }

    /// @param strategy   null: it is unknown or not installed, and no parameter is refused
    void read_remeshing_parameters(const Node& node, const ComponentInfo* strategy, Instrument& instrument) {
        if (!is_kind(node, Node::Kind::map, instrument.id + ".remeshing_parameters", report_)) return;
        if (instrument.remeshing.empty())
            return report_.error(Code::unknown_parameter, node.key_span,
                                 "`remeshing_parameters` are set, and `remeshing` names no strategy. Name one, or "
                                 "remove them.");
        if (strategy == nullptr) return;
        const std::vector<std::string> known = ids_of(strategy->parameters);
        std::vector<double> values = defaults(strategy->parameters);
        for (const Node& child : node.children) {
            if (set(child, instrument.id, *strategy, strategy->parameters, values)) {
                const auto at = std::find(known.begin(), known.end(), child.key) - known.begin();
                instrument.remeshing_parameters.push_back({child.key, values[static_cast<std::size_t>(at)]});
                continue;
            }
            const std::string meant = suggestion(child.key, known);
            report_.error(Code::unknown_parameter, child.key_span,
                          "The parameter `" + excerpt(child.key, 40) + "` is unknown: " +
                              (known.empty() ? strategy->full_id() + " has none. Remove it."
                                             : "expected " + listed(known) + " of " + strategy->full_id() + "." +
                                                   or_choose(meant)),
                          meant);
        }
    }

    Sleeve read_guide(const Node& node) {
        MapReader map(node, shapes::guide, "guide", report_);
        Sleeve sleeve{.bore = map.quantity("bore"), .length = 30e-3, .gap = 1e-3};
        map.quantity("length", sleeve.length);
        map.quantity("gap", sleeve.gap);
        map.finish();
        return sleeve;
    }

    static std::vector<double> defaults(const std::vector<ParameterInfo>& parameters) {
        std::vector<double> values;
        for (const ParameterInfo& parameter : parameters) values.push_back(parameter.def);
        return values;
    }

    static std::vector<std::string> ids_of(const std::vector<ParameterInfo>& parameters) {
        std::vector<std::string> ids;
        for (const ParameterInfo& parameter : parameters) ids.push_back(parameter.id);
        return ids;
    }

    bool find_plugin(const Node& node, std::string& id) {
        id = read_text(node, "plugin", report_).value_or("");
        if (id.empty()) return false;
        std::vector<std::string> known;
        for (const ComponentInfo& component : catalog_)
            if (component.kind != KERF_KIND_REMESHER && !contains(known, component.plugin))
                known.push_back(component.plugin);
        if (contains(known, id)) return true;
        const std::string meant = closest(id, known, report_);
        report_.error(
            Code::unknown_plugin, node.span,
            "The plugin `" + excerpt(id, 40) +
                "` is unknown: " + (known.empty() ? "no plugin was found." : "expected " + listed(known) + ".") +
                or_choose(meant, known.empty() ? "Name the folder that holds it in KERF_PLUGIN_PATH."
                                               : "Write one of these, or name its folder in KERF_PLUGIN_PATH."),
            meant);
        return false;
    }

    const ComponentInfo* find_component(const Node* node, const std::string& plugin, uint32_t kind, std::string& id) {
        if (!node) return nullptr;
        const bool is_tool = kind == KERF_KIND_TOOL;
        id = read_text(*node, is_tool ? "tool" : "force", report_).value_or("");
        if (id.empty()) return nullptr;
        std::vector<std::string> known;
        for (const ComponentInfo& component : catalog_) {
            if (component.plugin != plugin || component.kind != kind) continue;
            if (component.id == id) return &component;
            known.push_back(component.id);
        }
        const std::string meant = closest(id, known, report_);
        report_.error(is_tool ? Code::unknown_tool : Code::unknown_force, node->span,
                      std::string("The ") + (is_tool ? "tool" : "force") + " `" + excerpt(id, 40) + "` is unknown: " +
                          (known.empty() ? plugin + " has none. Choose another plugin."
                                         : "expected " + listed(known) + " of " + plugin + "." + or_choose(meant)),
                      meant);
        return nullptr;
    }

    /// Whether the force takes the tool: one that it lists, or one that has all it needs.
    void check_fit(const Node& node, const ComponentInfo& tool, const ComponentInfo& force) {
        if (!force.tools.empty() && (tool.plugin != force.plugin || !contains(force.tools, tool.id)))
            return report_.error(Code::unknown_force, node.span,
                                 "The force `" + force.id + "` does not take the tool `" + tool.id + "` of " +
                                     tool.plugin + ": expected " + listed(force.tools) + " of " + force.plugin +
                                     ". Choose another force.");
        for (const NeedInfo& need : force.needs) {
            const bool is_drive = need.kind == KERF_NEED_DRIVE;
            const auto& among = is_drive ? tool.drives : tool.parameters;
            if (std::none_of(among.begin(), among.end(),
                             [&](const ParameterInfo& p) { return p.id == need.id && p.dimension == need.dimension; }))
                report_.error(Code::unknown_force, node.span,
                              "The force `" + force.id + "` needs a tool with the " +
                                  (is_drive ? "drive" : "parameter") + " `" + need.id + "`: `" + tool.id +
                                  "` has none of that dimension. Choose another tool or force.");
        }
    }

    /// Sets the one of `values` that `node` names. False if it names none.
    bool set(const Node& node, const std::string& instrument, const ComponentInfo& component,
             const std::vector<ParameterInfo>& parameters, std::vector<double>& values) {
        const auto found = std::find_if(parameters.begin(), parameters.end(),
                                        [&](const ParameterInfo& p) { return p.id == node.key; });
        if (found == parameters.end()) return false;
        const QuantityNeed need{found->dimension, found->display_unit, found->min, found->max};
        SourcePosition where;
        where.file = component.plugin + "/" + component.id;
        Reason declared{std::move(where),
                        found->id + " is declared from " + quantity_text(need.min, need.unit) + " to " +
                            quantity_text(need.max, need.unit) + ", default " + quantity_text(found->def, need.unit) +
                            ".",
                        {}};
        if (const std::optional<double> value =
                read_quantity(node, instrument + "." + found->id, need, report_, std::move(declared)))
            values[static_cast<std::size_t>(found - parameters.begin())] = *value;
        return true;
    }

    /// Of an unknown component (null) no parameter is known, and none is refused.
    void read_parameters(const Node& node, const ComponentInfo* tool, const ComponentInfo* force,
                         Instrument& instrument) {
        if (!is_kind(node, Node::Kind::map, instrument.id + ".parameters", report_)) return;
        std::vector<std::string> known;
        for (const ComponentInfo* component : {tool, force})
            if (component != nullptr)
                for (const std::string& id : ids_of(component->parameters))
                    if (!contains(known, id)) known.push_back(id);
        for (const Node& child : node.children) {
            // The same quantity may matter to both, as a diameter does.
            const bool is_of_tool =
                tool != nullptr && set(child, instrument.id, *tool, tool->parameters, instrument.tool_parameters);
            const bool is_of_force =
                force != nullptr && set(child, instrument.id, *force, force->parameters, instrument.force_parameters);
            if (is_of_tool || is_of_force || tool == nullptr || force == nullptr) continue;
            const std::string meant = suggestion(child.key, known);
            report_.error(Code::unknown_parameter, child.key_span,
                          "The parameter `" + excerpt(child.key, 40) + "` is unknown: " +
                              (known.empty() ? tool->id + " and " + force->id + " have none. Remove it."
                                             : "expected " + listed(known) + " of " + tool->id + " or " + force->id +
                                                   "." + or_choose(meant)),
                          meant);
        }
    }

    void read_drives(const Node& node, const ComponentInfo& tool, Instrument& instrument) {
        if (!is_kind(node, Node::Kind::map, instrument.id + ".drives", report_)) return;
        const std::vector<std::string> known = ids_of(tool.drives);
        for (const Node& child : node.children)
            if (set(child, instrument.id, tool, tool.drives, instrument.drives)) {
                warn_if_too_slow(child, tool, instrument);
            } else {
                const std::string meant = suggestion(child.key, known);
                report_.error(
                    Code::unknown_drive, child.key_span,
                    "The drive `" + excerpt(child.key, 40) + "` is unknown: " +
                        (known.empty() ? tool.id + " has none. Remove it."
                                       : "expected " + listed(known) + " of " + tool.id + "." + or_choose(meant)),
                    meant);
            }
    }

    void warn_if_too_slow(const Node& node, const ComponentInfo& tool, const Instrument& instrument) {
        for (std::size_t i = 0; i < tool.drives.size(); ++i) {
            const ParameterInfo& drive = tool.drives[i];
            const double value = std::abs(instrument.drives[i]);
            if (drive.id != node.key || !(value > 0.0 && value < drive.least)) continue;
            const std::string least = quantity_text(drive.least, drive.display_unit);
            report_.warning(Code::too_slow_to_cut, node.span,
                            found_drive(drive.id) + " is too slow to cut: got " +
                                quantity_text(value, drive.display_unit) + ", expected " + least +
                                " or more. Write such a value, or 0 to switch it off.");
        }
    }

    static std::string found_drive(const std::string& id) { return "The drive `" + id + "`"; }

    std::string suggestion(const std::string& key, const std::vector<std::string>& known) const {
        const std::string meant = closest(key, known, report_);
        return meant.empty() ? meant : meant + ":";
    }

    const ComponentCatalog& catalog_;
    Report& report_;
};

// ---- steps -------------------------------------------------------------------------------------------------------

/// `{at_least: …, at_most: …}`, whichever the shape has; of both, one or both. `need_of` gives what the value under a
/// key must be; nothing if that is unknown.
template <class NeedOf>
void read_bound_values(MapReader& map, const Shape& shape, const std::string& name, NeedOf&& need_of, Bound& bound,
                       Report& report) {
    bool is_bounded = shape.find("at_least") == nullptr || shape.find("at_most") == nullptr;
    const auto read_end = [&](const char* key, std::optional<double>& value) {
        const KeyShape* end = shape.find(key);
        const Node* node = end != nullptr ? map.find(key) : nullptr;
        if (node)
            if (const std::optional<QuantityNeed> need = need_of(key))
                value = read_quantity(*node, name + "." + key, *need, report);
        is_bounded |= node != nullptr || (end != nullptr && end->presence == Presence::required);
    };
    read_end("at_least", bound.at_least);
    read_end("at_most", bound.at_most);
    if (!is_bounded && map.is_map())
        report.error(Code::empty_bound, map.span(), name + " has no bound. Add `at_least` or `at_most`.");
    if (bound.at_least && bound.at_most && *bound.at_least > *bound.at_most)
        report.error(Code::empty_bound, map.span(),
                     name + " has `at_least` above `at_most`, so no value fits. Exchange the two.");
}

/// The same with the units and ranges of the shape.
void read_own_bound(MapReader& map, const Shape& shape, const std::string& name, Bound& bound, Report& report) {
    read_bound_values(
        map, shape, name, [&](const char* key) { return std::optional(map.need_of(key)); }, bound, report);
}

/// The signal that `node` names; null and reported if the law declares none of this name.
const SignalInfo* find_signal(const Node& node, const std::string& id, const ComponentInfo& law, Report& report) {
    std::vector<std::string> known;
    for (const SignalInfo& signal : law.signals) {
        if (signal.id == id) return &signal;
        known.push_back(signal.id);
    }
    const std::string meant = closest(straightened(id), known, report);
    report.error(Code::unknown_signal, node.span,
                 "The signal " + quoted_id(excerpt(id, 40)) + " is unknown: " +
                     (known.empty() ? "the law " + quoted_id(law.id) + " declares none. Use another quantity."
                                    : "expected " + listed(known) + " of " + law.id + "." + or_choose(meant)),
                 meant);
    return nullptr;
}

/// `{id: clamp, at_least: 100 N}`. Without a known signal its bounds have no unit, and are not read.
void read_signal(MapReader& map, const ComponentInfo* law, NamedSignal& signal, Bound& bound, Report& report) {
    const SignalInfo* declared = nullptr;
    if (const Node* node = map.find("id")) {
        const std::string id = read_id(*node, "signal.id", report).value_or("");
        if (!id.empty() && law) declared = find_signal(*node, id, *law, report);
        if (declared || !law) signal.id = id;
    }
    if (declared) {
        signal.index = static_cast<std::size_t>(declared - law->signals.data());
        signal.unit = declared->display_unit;
    }
    read_bound_values(
        map, shapes::signal_bound, signal.id.empty() ? "signal" : signal.id,
        [&](const char*) { return declared ? std::optional(need_of(*declared)) : std::nullopt; }, bound, report);
}

/// `{of: gonial_angle_left, at_least: 120 deg}`. Without a known measure its bounds have no unit, and are not read.
void read_measure_bound(MapReader& map, const Procedure& procedure, const Document& document, std::string& measure,
                        Bound& bound, Report& report) {
    const Measure* declared = nullptr;
    if (const Node* node = map.find("of")) {
        measure = read_id(*node, "measure.of", report).value_or("");
        std::vector<std::string> known;
        for (const Measure& one : procedure.measures) {
            known.push_back(one.id);
            if (one.id == measure) declared = &one;
        }
        const Node* place = document.root.find("measures");
        const bool is_refused_there = place != nullptr && (place->kind != Node::Kind::map || known.empty());
        if (!measure.empty() && declared == nullptr && !is_refused_there) {
            const std::string meant = closest(straightened(measure), known, report);
            report.error(Code::unknown_measure, node->span,
                         "The measure " + quoted_id(excerpt(measure, 40)) + " is unknown: " +
                             (known.empty() ? "the procedure has none. Add it under `measures:`."
                                            : "expected " + listed(known) + "." + or_choose(meant)),
                         meant);
        }
    }
    read_bound_values(
        map, shapes::measure_bound, measure.empty() ? "measure" : measure,
        [&](const char*) -> std::optional<QuantityNeed> {
            if (declared == nullptr) return std::nullopt;
            if (!declared->is_angle()) return shapes::length_of_measure;
            return declared->kind == Measure::Kind::difference ? shapes::angle_of_difference : shapes::angle_of_measure;
        },
        bound, report);
}

Goal read_goal(const Node& item, const ComponentInfo* law, const Procedure& procedure, const Document& document,
               Report& report) {
    MapReader map(item, shapes::goal, "goal", report);
    Goal goal;
    if (const Node* quantity = map.one_of()) {
        goal.quantity = quantity->key;
        goal.place = document.place(quantity->key_span);
        const Shape& shape = *shapes::goal.find(quantity->key)->value.shape;
        MapReader bound(*quantity, shape, quantity->key, report);
        if (goal.quantity == "signal")
            read_signal(bound, law, goal.signal, goal.bound, report);
        else if (goal.quantity == "measure")
            read_measure_bound(bound, procedure, document, goal.measure, goal.bound, report);
        else if (!shape.keys.empty())
            read_own_bound(bound, shape, quantity->key, goal.bound, report);
        if (goal.quantity == "depth" && goal.bound.at_most && *goal.bound.at_most < 0.0)
            report.error(Code::empty_bound, quantity->find("at_most")->span,
                         "No depth fits this goal: got at most " + quantity->find("at_most")->text +
                             ", but a depth in bone is never below 0 mm. Remove `at_most`: a step ends with the tool "
                             "outside again.");
        bound.finish();
    }
    map.finish();
    return goal;
}

/// Whether a list of the document holds this text, even if it was refused there.
bool is_written(const Node* list, const std::string& text) {
    return list != nullptr && std::any_of(list->children.begin(), list->children.end(),
                                          [&](const Node& item) { return item.text == text || item.key == text; });
}

/// Refuses a name of a step or limit that is not under `needs`. Says nothing if that list is itself at fault.
void refuse_undeclared(Code code, const Node& name, const std::string& what, const std::vector<std::string>& declared,
                       const Document& document, Report& report) {
    const std::string list = what + "s", meant = closest(straightened(name.text), declared, report);
    const Node* needs = document.root.find("needs");
    const Node* place = needs ? needs->find(list) : nullptr;
    const bool is_list = place == nullptr || place->kind == Node::Kind::list;
    if (needs == nullptr || needs->kind != Node::Kind::map || !is_list || is_written(place, name.text)) return;
    report.error(
        code, name.span,
        "The " + what + " `" + name.text + "` is not declared: expected one of `needs." + list + "`" +
            (declared.empty() ? std::string() : ", " + listed(declared)) + "." + or_choose(meant, "Add it there."),
        meant,
        place ? std::optional(report.because(place->key_span, "the procedure lists its needs here.")) : std::nullopt);
}

void refuse_instrument(const Node& name, const std::vector<std::string>& instruments, const Document& document,
                       Report& report) {
    const std::string meant = closest(straightened(name.text), instruments, report);
    const Node* place = document.root.find("instruments");
    if (place == nullptr || place->kind != Node::Kind::map || place->children.empty()) return;  // reported there
    report.error(
        Code::unknown_instrument, name.span,
        "The instrument `" + name.text + "` is unknown: expected " + listed(instruments) + "." + or_choose(meant),
        meant, report.because(place->key_span, "the instruments are here."));
}

Limit read_limit(const Node& item, const ComponentInfo* law, const Procedure& procedure, const Document& document,
                 Report& report) {
    MapReader map(item, shapes::limit, "limit", report);
    Limit limit;
    if (const Node* quantity = map.one_of()) {
        limit.quantity = quantity->key;
        limit.place = document.place(quantity->key_span);
        const bool is_clearance = quantity->key == "clearance";
        const Shape& shape = *shapes::limit.find(quantity->key)->value.shape;
        MapReader bound(*quantity, shape, quantity->key, report);
        if (const Node* zone = is_clearance ? bound.find("zone") : nullptr) {
            limit.zone = read_id(*zone, "clearance.zone", report).value_or("");
            if (!limit.zone.empty() && !contains(procedure.needs_zones, limit.zone))
                refuse_undeclared(Code::undeclared_zone, *zone, "zone", procedure.needs_zones, document, report);
        }
        if (quantity->key == "breach") limit.diameter = bound.quantity("diameter");
        const auto landmark = [&](const char* key) {
            const Node* name = bound.find(key);
            const std::string id = name ? read_id(*name, bound.name_of(key), report).value_or("") : "";
            if (!id.empty() && !contains(procedure.needs_landmarks, id))
                refuse_undeclared(Code::undeclared_landmark, *name, "landmark", procedure.needs_landmarks, document,
                                  report);
            return id;
        };
        if (quantity->key == "tip_apex") {
            limit.landmark = landmark("apex");
            limit.other = landmark("neck");
        }
        if (quantity->key == "axes_angle") {
            limit.landmark = landmark("of");
            limit.other = landmark("to");
        }
        if (limit.quantity == "signal")
            read_signal(bound, law, limit.signal, limit.bound, report);
        else if (limit.quantity == "measure")
            read_measure_bound(bound, procedure, document, limit.measure, limit.bound, report);
        else
            read_own_bound(bound, shape, quantity->key, limit.bound, report);
        bound.finish();
    }
    limit.reason = map.text("reason");
    map.finish();
    return limit;
}

/// A goal or limit of a step, and its place. What is refused already has no node.
struct PlacedBound {
    const Bound* bound = nullptr;
    const Node* node = nullptr;
    std::string quantity, name;
    bool is_goal = false;
};

template <class T>
void place_bounds(const std::vector<T>& things, const Node* list, bool is_goal, std::vector<PlacedBound>& bounds) {
    for (std::size_t i = 0; list && i < things.size() && i < list->children.size(); ++i) {
        const Node* node = list->children[i].find(things[i].quantity);
        if (!node) continue;
        bounds.push_back({&things[i].bound, node, things[i].quantity, things[i].name(), is_goal});
    }
}

/// A depth is the deepest that the tip has been: it never becomes less from one goal to the next.
void refuse_goals_apart(const std::vector<PlacedBound>& bounds, Report& report) {
    for (std::size_t later = 0; later < bounds.size(); ++later)
        for (std::size_t earlier = 0; earlier < later; ++earlier) {
            const PlacedBound &first = bounds[earlier], &then = bounds[later];
            if (!first.is_goal || !then.is_goal || first.name != "depth" || then.name != "depth") continue;
            if (!first.bound->at_least || !then.bound->at_most || *first.bound->at_least <= *then.bound->at_most)
                continue;
            const Node *least = first.node->find("at_least"), *most = then.node->find("at_most");
            if (!least || !most) continue;
            report.error(Code::contradiction, most->span,
                         "The goals exclude each other: got a depth of at most " + most->text +
                             " after one of at least " + least->text +
                             ", but a depth never decreases within a step. Change one of the two.",
                         {}, report.because(least->span, "the earlier goal is here."));
        }
}

/// Refuses goals that break a limit of their step, and limits that exclude each other.
void refuse_contradictions(const Step& step, const Node& item, Report& report) {
    std::vector<PlacedBound> bounds;
    place_bounds(step.goals, item.find("goals"), true, bounds);
    place_bounds(step.limits, item.find("limits"), false, bounds);
    refuse_goals_apart(bounds, report);
    const auto refuse = [&](const PlacedBound& one, const char* end, const PlacedBound& limit, const char* other_end) {
        const Node *value = one.node->find(end), *limit_value = limit.node->find(other_end);
        if (!value || !limit_value) return;
        const auto words = [](const Node& bound, const char* key) {
            return std::string(key == std::string_view("at_least") ? "at least " : "at most ") + bound.text;
        };
        const std::string got = quoted_id(one.name) + " " + words(*value, end),
                          allowed = words(*limit_value, other_end);
        report.error(Code::contradiction, value->span,
                     one.is_goal ? "The goal breaks a limit of its step: got " + got + ", expected " + allowed +
                                       ". Write a goal within the limit, or move the limit."
                                 : "The limits exclude each other: got " + got + ", expected " + allowed +
                                       ". Change one of the two.",
                     {}, report.because(limit_value->span, "the limit is here."));
    };
    for (std::size_t l = 0; l < bounds.size(); ++l) {
        const PlacedBound& limit = bounds[l];
        for (std::size_t b = 0; b < bounds.size() && !limit.is_goal; ++b) {
            const PlacedBound& one = bounds[b];
            if (one.quantity != limit.quantity || one.name != limit.name || (!one.is_goal && b <= l)) continue;
            if (one.bound->at_least && limit.bound->at_most && *one.bound->at_least > *limit.bound->at_most)
                refuse(one, "at_least", limit, "at_most");
            if (one.bound->at_most && limit.bound->at_least && *one.bound->at_most < *limit.bound->at_least)
                refuse(one, "at_most", limit, "at_least");
        }
    }
}

/// `allow:` names events that the step's instrument reports as damage.
std::vector<std::string> read_allowed(const Node& node, const Instrument& instrument, Report& report) {
    std::vector<std::string> known, allowed;
    for (const EventInfo& event : instrument.damages) known.push_back(event.id);
    for (const Node& item : read_list(node, "allow", report)) {
        const std::string id = read_id(item, "allow", report).value_or("");
        if (id.empty()) continue;
        allowed.push_back(id);
        if (contains(known, id)) continue;
        const std::string meant = closest(straightened(id), known, report);
        report.error(Code::unknown_event, item.span,
                     "The event `" + excerpt(id, 60) + "` cannot be allowed: " +
                         (known.empty() ? "nothing that `" + instrument.id + "` reports fails a step. Remove it."
                                        : "expected " + listed(known) + "." + or_choose(meant)),
                     meant);
    }
    return allowed;
}

/// What spoils the tool fails the step, unless the step allows it.
void add_damage_limits(const Instrument& instrument, SourcePosition place, Step& step) {
    for (const EventInfo& event : instrument.damages) {
        if (contains(step.allowed, event.id)) continue;
        Limit& limit = step.limits.emplace_back();
        limit.quantity = "damage";
        limit.event = event.id;
        limit.reason = event.help;
        limit.place = place;
    }
}

Step read_step(const Node& item, const Procedure& procedure, const std::vector<std::string>& instrument_ids,
               const ComponentCatalog& catalog, const Document& document, Report& report) {
    MapReader map(item, shapes::step, item_name(item, "step"), report);
    Step step;
    step.id = map.id("id");
    step.title = map.text("title");
    if (const Node* instrument = map.find("instrument")) {
        step.instrument = read_id(*instrument, "instrument", report).value_or("");
        if (!step.instrument.empty() && !contains(instrument_ids, step.instrument))
            refuse_instrument(*instrument, instrument_ids, document, report);
    }
    if (const Node* axis = map.find("axis")) {
        step.axis = read_id(*axis, "axis", report).value_or("");
        const auto hole = named_hole(step.axis, procedure.implants);
        if (contains(procedure.needs_landmarks, step.axis) || step.axis.empty()) {
            // A landmark has precedence over a hole of the same name.
        } else if (hole) {
            check_named_hole(*axis, *hole, *document.root.find("implants"), report);
        } else {
            refuse_undeclared(Code::undeclared_landmark, *axis, "landmark", procedure.needs_landmarks, document,
                              report);
        }
    }
    if (const Node* plane = map.find("plane")) {
        step.plane = read_id(*plane, "plane", report).value_or("");
        if (!step.plane.empty() && !contains(procedure.needs_landmarks, step.plane))
            refuse_undeclared(Code::undeclared_landmark, *plane, "landmark", procedure.needs_landmarks, document,
                              report);
    }
    map.quantity("feed", step.feed);
    const Instrument* used = instrument_of(step, procedure.instruments);
    const ComponentInfo* law = used != nullptr ? law_of(*used, catalog) : nullptr;
    if (const Node* goals = map.find("goals"))
        for (const Node& goal : read_list(*goals, "goals", report))
            step.goals.push_back(read_goal(goal, law, procedure, document, report));
    if (const Node* limits = map.find("limits"))
        for (const Node& limit : read_list(*limits, "limits", report))
            step.limits.push_back(read_limit(limit, law, procedure, document, report));
    refuse_contradictions(step, item, report);
    const Node* allow = map.find("allow");
    if (used != nullptr) {
        if (allow) step.allowed = read_allowed(*allow, *used, report);
        const Node* written = item.find("instrument");
        add_damage_limits(*used, document.place(written ? written->span : item.span), step);
    }
    map.finish();
    return step;
}

// ---- rehearsals --------------------------------------------------------------------------------------------------

/// The names by which a rehearsal can expect a limit to break: the zone, the signal, or else the quantity.
struct LimitNames {
    std::vector<std::string> known;
    std::set<std::string> refused;  ///< of limits that are reported already

    [[nodiscard]] bool has(const std::string& name) const { return contains(known, name); }
};

LimitNames limit_names(const Procedure& procedure, const Document& document) {
    LimitNames names;
    const auto is_declared = [&](const std::string& measure) {
        return std::any_of(procedure.measures.begin(), procedure.measures.end(),
                           [&](const Measure& one) { return one.id == measure; });
    };
    for (const Step& step : procedure.steps)
        for (const Limit& limit : step.limits) {
            const bool is_sound = !limit.quantity.empty() && (limit.quantity != "clearance" || !limit.zone.empty()) &&
                                  (limit.quantity != "signal" || !limit.signal.id.empty()) &&
                                  (limit.quantity != "measure" || is_declared(limit.measure)) &&
                                  (limit.zone.empty() || contains(procedure.needs_zones, limit.zone));
            if (is_sound && !names.has(limit.name())) names.known.push_back(limit.name());
        }
    const Node* steps = document.root.find("steps");
    for (const Node& step : steps != nullptr ? steps->children : std::vector<Node>{})
        if (const Node* limits = step.find("limits"))
            for (const Node& limit : limits->children)
                for (const Node& quantity : limit.children) {
                    const Node *zone = quantity.find("zone"), *signal = quantity.find("id"),
                               *measure = quantity.key == "measure" ? quantity.find("of") : nullptr;
                    names.refused.insert(zone != nullptr      ? zone->text
                                         : signal != nullptr  ? signal->text
                                         : measure != nullptr ? measure->text
                                                              : quantity.key);
                }
    return names;
}

void refuse_limit(const Node& name, const LimitNames& limits, Report& report) {
    if (limits.refused.contains(name.text)) return;
    const std::string meant = closest(straightened(name.text), limits.known, report);
    report.error(Code::unknown_limit, name.span,
                 "The limit `" + name.text + "` is unknown: " +
                     (limits.known.empty() ? "no step has a limit. Add one to a step."
                                           : "expected " + listed(limits.known) + "." + or_choose(meant)),
                 meant);
}

void refuse_step(const Node& name, const Procedure& procedure, const Document& document, Report& report) {
    std::vector<std::string> known;
    for (const Step& step : procedure.steps)
        if (!step.id.empty() && !contains(known, step.id)) known.push_back(step.id);
    const Node* steps = document.root.find("steps");
    for (const Node& step : steps != nullptr ? steps->children : std::vector<Node>{})
        if (const Node* id = step.find("id"); id != nullptr && id->text == name.text) return;  // refused there
    if (known.empty()) return;
    const std::string meant = closest(straightened(name.text), known, report);
    report.error(Code::unknown_step, name.span,
                 "The step `" + name.text + "` is unknown: expected " + listed(known) + "." + or_choose(meant), meant);
}

/// A limit that breaks in a step must be a limit of that step.
void refuse_other_step(const Node& name, const Step& step, const std::string& limit, Report& report) {
    if (std::any_of(step.limits.begin(), step.limits.end(), [&](const Limit& l) { return l.name() == limit; })) return;
    report.error(Code::unknown_limit, name.span,
                 "The step " + quoted_id(step.id) + " has no limit " + quoted_id(limit) +
                     ". Name a step that has it, or add the limit.");
}

/// `expect: pass`, `expect: incomplete`, or `expect: {fail: canal, step: drill}`.
void read_expectation(const Node& node, const LimitNames& limits, const Procedure& procedure, const Document& document,
                      Rehearsal& rehearsal, Report& report) {
    if (node.kind == Node::Kind::map) {
        MapReader map(node, shapes::expectation, "expect", report);
        rehearsal.expect = "fail";
        if (const Node* limit = map.find("fail")) {
            rehearsal.expect_limit = read_id(*limit, "expect.fail", report).value_or("");
            if (!rehearsal.expect_limit.empty() && !limits.has(rehearsal.expect_limit))
                refuse_limit(*limit, limits, report);
        }
        rehearsal.expects_others = map.yes_no("others");
        if (const Node* step = map.find("step")) {
            rehearsal.expect_step = read_id(*step, "expect.step", report).value_or("");
            const auto is_it = [&](const Step& s) { return s.id == rehearsal.expect_step; };
            const auto found = std::find_if(procedure.steps.begin(), procedure.steps.end(), is_it);
            if (!rehearsal.expect_step.empty() && found == procedure.steps.end())
                refuse_step(*step, procedure, document, report);
            else if (found != procedure.steps.end() && limits.has(rehearsal.expect_limit))
                refuse_other_step(*step, *found, rehearsal.expect_limit, report);
        }
        map.finish();
        return;
    }
    const std::optional<std::string> text = read_text(node, "expect", report);
    if (!text) return;
    rehearsal.expect = *text;
    if (*text != "pass" && *text != "incomplete")
        report.error(Code::unknown_word, node.span,
                     "expect is unknown: got `" + excerpt(*text, 40) +
                         "`, expected `pass`, `incomplete`, or `{fail: …}` with the limit that breaks. Write one of "
                         "these.");
}

/// The axes along which implants are planned.
void check_place_axes(const Node& implants, const Procedure& procedure, const Document& document, Report& report) {
    for (const Implant& implant : procedure.implants) {
        const Node* node = implants.find(implant.id);
        const Node* place = node != nullptr ? node->find("place") : nullptr;
        const Node* axis = place != nullptr ? place->find("axis") : nullptr;
        if (!implant.place || axis == nullptr || implant.place->axis.empty()) continue;
        if (!contains(procedure.needs_landmarks, implant.place->axis))
            refuse_undeclared(Code::undeclared_landmark, *axis, "landmark", procedure.needs_landmarks, document,
                              report);
    }
}

void refuse_implant(const Node& name, const std::vector<Implant>& implants, Report& report) {
    std::vector<std::string> known;
    for (const Implant& implant : implants) known.push_back(implant.id);
    const std::string meant = closest(straightened(name.text), known, report);
    report.error(Code::unknown_implant, name.span,
                 "The implant `" + name.text + "` is unknown: " +
                     (known.empty() ? "the procedure has none. Add one under `implants:`."
                                    : "expected " + listed(known) + "." + or_choose(meant)),
                 meant);
}

/// `insert: plate` or `place: plate`.
void read_implant_name(const Node& node, const Procedure& procedure, Waypoint& at, Report& report) {
    const std::string id = read_id(node, "waypoint." + node.key, report).value_or("");
    if (id.empty()) return;
    const bool is_placed = node.key == "place";
    at.inputs.push_back({is_placed ? HandInput::Kind::place : HandInput::Kind::insert, id});
    const auto implant = std::find_if(procedure.implants.begin(), procedure.implants.end(),
                                      [&](const Implant& i) { return i.id == id; });
    if (implant == procedure.implants.end())
        refuse_implant(node, procedure.implants, report);
    else if (is_placed && !implant->place)
        report.error(Code::missing_key, node.span,
                     "The implant " + quoted_id(id) +
                         " has no planned pose. Add `place: {axis: …, up: 0 0 1}` to it, or write `insert: " + id +
                         "`, which puts it at the tool.");
}

/// `until: {torque: 2 N*m}` or `until: {event: implant.head_contact}`; null: the instrument is unknown.
void read_until(const Node& node, const Instrument* instrument, const InstrumentReader& instruments, Waypoint& at,
                Report& report) {
    MapReader map(node, shapes::until, "waypoint.turn.until", report);
    const Node* chosen = map.one_of();
    if (chosen != nullptr && chosen->key == "torque") at.until_torque = map.quantity("torque");
    if (chosen != nullptr && chosen->key == "event") at.until_event = map.id("event");
    map.finish();
    if (at.until_event.empty() || instrument == nullptr) return;
    const std::optional<std::vector<std::string>> known = instruments.events_of(*instrument);
    if (!known || contains(*known, at.until_event)) return;
    const std::string meant = closest(straightened(at.until_event), *known, report);
    report.error(
        Code::unknown_event, chosen->span,
        "The event `" + excerpt(at.until_event, 60) + "` is unknown: " +
            (known->empty() ? "the force of `" + instrument->id + "` reports none. Write `until: {torque: 2 N*m}`."
                            : "expected " + listed(*known) + " of `" + instrument->id + "`." + or_choose(meant)),
        meant);
}

/// `step` is that of the waypoint before.
Waypoint read_waypoint(const Node& point, std::size_t step, const Procedure& procedure, const Document& document,
                       InstrumentReader& instruments, Report& report) {
    const std::vector<Step>& steps = procedure.steps;
    MapReader waypoint(point, shapes::waypoint, "waypoint", report);
    Waypoint at;
    at.step = step;
    if (const Node* name = waypoint.find("step"))
        if (const std::string id = read_id(*name, "waypoint.step", report).value_or(""); !id.empty()) {
            const auto found = std::find_if(steps.begin(), steps.end(), [&](const Step& s) { return s.id == id; });
            if (found != steps.end())
                at.step = static_cast<std::size_t>(found - steps.begin());
            else
                refuse_step(*name, procedure, document, report);
        }
    at.depth = waypoint.quantity("depth");
    waypoint.quantity("medial", at.medial);
    waypoint.quantity("medial_angle", at.medial_angle);
    waypoint.quantity("cranial_angle", at.cranial_angle);
    at.is_across_surface = waypoint.word("direction") == "surface";
    at.is_displaced = waypoint.yes_no("displaced");
    if (waypoint.find("speed")) at.speed = waypoint.quantity("speed");
    if (waypoint.find("push")) at.push = waypoint.quantity("push");
    if (const Node* stop = waypoint.find("stop")) {
        MapReader map(*stop, shapes::stop, "waypoint.stop", report);
        at.skip_distance = map.quantity("aside");
        map.finish();
    }
    if (const Node* turn = waypoint.find("turn")) {
        MapReader map(*turn, shapes::turn, "waypoint.turn", report);
        at.turn = map.quantity("by");
        map.quantity("speed", at.turning);
        if (map.find("torque")) at.turn_torque = map.quantity("torque");
        map.quantity("regrip", at.regrip);
        if (const Node* until = map.find("until")) {
            const Instrument* instrument =
                at.step < steps.size() ? instrument_of(steps[at.step], procedure.instruments) : nullptr;
            read_until(*until, instrument, instruments, at, report);
        }
        map.finish();
    }
    waypoint.quantity("aside", at.aside);
    waypoint.quantity("tilt", at.tilt);
    if (const Node* drives = waypoint.find("drives"); drives && at.step < steps.size()) {
        const auto instrument = std::find_if(procedure.instruments.begin(), procedure.instruments.end(),
                                             [&](const Instrument& i) { return i.id == steps[at.step].instrument; });
        if (instrument != procedure.instruments.end()) at.inputs = instruments.read_inputs(*drives, *instrument);
    }
    if (const Node* implant = waypoint.find("insert")) read_implant_name(*implant, procedure, at, report);
    if (const Node* implant = waypoint.find("place")) read_implant_name(*implant, procedure, at, report);
    if (const auto input = hand_input(waypoint.word("do"))) at.inputs.push_back(*input);
    waypoint.finish();
    return at;
}

/// The waypoints of rehearsals, and of the paths that they follow.
class PathReader {
public:
    PathReader(const Procedure& procedure, const Document& document, InstrumentReader& instruments, Report& report)
        : procedure_(procedure), document_(document), instruments_(instruments), report_(report) {}

    /// Reads `paths` by themselves: each error is reported, even in a path that no rehearsal follows.
    void read_paths(const Node& paths) {
        if (!is_kind(paths, Node::Kind::map, "paths", report_)) return;
        for (const Node& path : paths.children) {
            Node key;
            key.text = path.key;
            key.span = path.key_span;
            if (read_id(key, "A path's name", report_)) names_.push_back(path.key);
            // The step before is that of whoever follows; without one, no drive is checked here.
            std::size_t step = procedure_.steps.size();
            for (const Node& point : read_list(path, path.key, report_)) {
                if (const Node* name = point.find("follow"))
                    report_.error(Code::unknown_key, name->key_span,
                                  "The path " + quoted_id(excerpt(path.key, 40)) +
                                      " follows another, expected waypoints. Write them here, or follow both paths in "
                                      "the rehearsal.");
                else
                    step = read_waypoint(point, step, procedure_, document_, instruments_, report_).step;
            }
        }
        place_ = &paths;
    }

    std::vector<Waypoint> read(const Node& path) {
        std::size_t own = 0;
        bool is_known = true;
        for (const Node& item : read_list(path, "path", report_))
            if (item.find("follow") != nullptr)
                is_known &= check_name(item);
            else
                ++own;
        std::vector<Waypoint> waypoints;
        if (followed_ >= max_followed) return waypoints;  // reported already
        const std::vector<const Node*> nodes = waypoint_nodes(document_, &path);
        followed_ += nodes.size() - own;
        if (followed_ >= max_followed) {
            report_.error(Code::out_of_range, path.key_span,
                          "The rehearsals follow too many waypoints: got " + std::to_string(max_followed) +
                              " or more up to here, expected fewer. Write shorter paths, or follow them less often.");
            return waypoints;
        }
        for (const Node* node : nodes)
            waypoints.push_back(read_waypoint(*node, waypoints.empty() ? 0 : waypoints.back().step, procedure_,
                                              document_, instruments_, report_));
        if (!is_known) waypoints.clear();  // what is left of it leads elsewhere: nothing more is said of it
        return waypoints;
    }

    void warn_of_unused() {
        if (!std::all_of(used_.begin(), used_.end(), [&](const std::string& id) { return contains(names_, id); }))
            return;  // one of these may be meant
        for (const Node& path : place_ != nullptr ? place_->children : std::vector<Node>{})
            if (contains(names_, path.key) && !used_.contains(path.key))
                report_.warning(Code::unused_path, path.key_span,
                                "The path " + quoted_id(excerpt(path.key, 40)) +
                                    " is not followed by any rehearsal. Remove it, or follow it in one.");
    }

private:
    /// `{follow: NAME}`. Returns whether there is such a path.
    bool check_name(const Node& item) {
        MapReader map(item, shapes::follow, "waypoint", report_);
        const Node* name = map.find("follow");
        const std::string id = read_id(*name, "waypoint.follow", report_).value_or("");
        map.finish();
        used_.insert(id);
        const Node* paths = document_.root.find("paths");
        if (contains(names_, id)) return true;
        if (id.empty() || (paths != nullptr && place_ == nullptr)) return false;
        const std::string meant = closest(straightened(id), names_, report_);
        report_.error(Code::unknown_path, name->span,
                      "The path " + quoted_id(id) + " is unknown: " +
                          (names_.empty() ? "the procedure has none. Add it under `paths:`."
                                          : "expected " + listed(names_) + "." + or_choose(meant)),
                      meant,
                      place_ ? std::optional(report_.because(place_->key_span, "the paths are here.")) : std::nullopt);
        return false;
    }

    const Procedure& procedure_;
    const Document& document_;
    InstrumentReader& instruments_;
    Report& report_;
    const Node* place_ = nullptr;  ///< of `paths`; null: there are none
    std::vector<std::string> names_;
    std::set<std::string> used_;
    std::size_t followed_ = 0;  ///< waypoints of `paths`, in all rehearsals
};

Rehearsal read_rehearsal(const Node& item, const LimitNames& limits, const Procedure& procedure,
                         const Document& document, PathReader& paths, Report& report) {
    MapReader map(item, shapes::rehearsal, item_name(item, "rehearsal"), report);
    Rehearsal rehearsal;
    rehearsal.id = map.id("id");
    rehearsal.title = map.text("title");
    if (const Node* expect = map.find("expect"))
        read_expectation(*expect, limits, procedure, document, rehearsal, report);
    if (const Node* node = map.find("hand")) {
        MapReader hand(*node, shapes::hand, "hand", report);
        hand.quantity("feed", rehearsal.feed);
        hand.quantity("approach", rehearsal.approach);
        hand.quantity("push", rehearsal.push);
        hand.quantity("reaction", rehearsal.reaction);
        hand.finish();
    }
    if (const Node* path = map.find("path")) rehearsal.path = paths.read(*path);
    map.finish();
    return rehearsal;
}

// ---- the whole ---------------------------------------------------------------------------------------------------

/// Things stay in the order of the document, so that an index leads to the same item in both.
template <class T>
void add_unique(T thing, const Node& item, UniqueIds& ids, std::vector<T>& things, Report& report) {
    if (const Node* id = item.find("id"); id != nullptr && !thing.id.empty()) ids.add(thing.id, id->span, report);
    things.push_back(std::move(thing));
}

void warn_of_unused(const Node& instruments, const std::vector<Step>& steps, Report& report) {
    std::set<std::string> used;
    for (const Step& step : steps) used.insert(step.instrument);
    const auto is_known = [&](const std::string& id) { return instruments.find(id) != nullptr; };
    if (!std::all_of(used.begin(), used.end(), is_known)) return;  // one of these may be meant
    for (const Node& child : instruments.children)
        if (!used.contains(child.key))
            report.warning(Code::unused_instrument, child.key_span,
                           "The instrument `" + excerpt(child.key, 40) +
                               "` is not used by any step. Remove it, or name it in a step.");
}

/// The patches themselves are checked where one is applied.
std::vector<Variant> read_variants(const Node& node, Report& report) {
    std::vector<Variant> variants;
    if (!is_kind(node, Node::Kind::map, "variants", report)) return variants;
    if (node.children.size() > max_variants)  // each is read and checked like a procedure
        report.error(Code::out_of_range, node.children[max_variants].key_span,
                     "There are too many variants: got " + std::to_string(node.children.size()) +
                         ", expected at most " + std::to_string(max_variants) +
                         ". Move some into a procedure of their own.");
    for (const Node& child : node.children) {
        Node key;
        key.text = child.key;
        key.span = child.key_span;
        read_id(key, "A variant's name", report);
        MapReader map(child, shapes::variant, child.key, report);
        const std::string title = map.text("title");
        if (const Node* patch = map.find("patch")) is_kind(*patch, Node::Kind::map, child.key + ".patch", report);
        map.finish();
        variants.push_back({child.key, title});
    }
    return variants;
}

/// Applies the variant and the settings to the tree, the variant first.
void apply(const ProcedureChanges& changes, Document& document, Diagnostics& found) {
    if (!changes.variant.empty()) {
        Report report(document, found);
        const Node* variants = document.root.find("variants");
        const Node* chosen = variants ? variants->find(changes.variant) : nullptr;
        const Node* patch = chosen ? chosen->find("patch") : nullptr;
        if (!chosen) {
            std::vector<std::string> known;
            if (variants)
                for (const Node& variant : variants->children) known.push_back(variant.key);
            const std::string meant = closest(changes.variant, known);
            report.error(Code::unknown_variant, variants ? variants->key_span : TextSpan{},
                         "The variant `" + excerpt(changes.variant, 40) + "` is unknown: " +
                             (known.empty() ? "the procedure has none. Run it without."
                                            : "expected " + listed(known) + "." + or_choose(meant)),
                         meant);
        } else if (patch && patch->kind == Node::Kind::map) {
            const Node changed = *patch;  // the tree that holds it changes
            apply_patch(document, document.root, changed, report);
        }
    }
    for (const std::string& setting : changes.settings) apply_setting(document, setting, found);
}

void read_body(MapReader& map, const Document& document, const ComponentCatalog& catalog, Report& report,
               ProcedureDraft& draft) {
    Procedure& procedure = draft.procedure;
    procedure.file = document.file();
    procedure.text = document.text();
    if (const Node* node = map.find("metadata")) read_metadata(*node, procedure, report);
    if (const Node* node = map.find("needs")) read_needs(*node, procedure, report);
    if (const Node* node = map.find("anatomy")) read_anatomy_file(*node, document.file(), procedure, report);
    const int errors_before_accuracy = report.errors();
    if (const Node* node = map.find("accuracy")) {
        MapReader accuracy(*node, shapes::accuracy, "accuracy", report);
        accuracy.quantity("spacing", procedure.spacing);
        accuracy.quantity("force", procedure.accuracy.force);
        accuracy.quantity("volume", procedure.accuracy.volume);
        accuracy.finish();
    }
    draft.has_spacing = report.errors() == errors_before_accuracy;
    if (const Node* node = map.find("budget")) {
        MapReader budget(*node, shapes::budget, "budget", report);
        budget.quantity("tick", procedure.budget.tick);
        procedure.budget.is_given = budget.find("tick") != nullptr;
        budget.finish();
    }
    if (const Node* node = map.find("haptics")) {
        MapReader haptics(*node, shapes::haptics, "haptics", report);
        procedure.device = haptics.id("device");
        procedure.is_direct = haptics.word("coupling") == "direct";
        if (const Node* force_scale = haptics.find("force_scale"))
            procedure.force_scale =
                read_quantity(*force_scale, "haptics.force_scale", haptics.need_of("force_scale"), report);
        if (const Node* force = haptics.find("working_force"))
            procedure.working_force =
                read_quantity(*force, "haptics.working_force", haptics.need_of("working_force"), report);
        haptics.finish();
    }
    map.quantity("time_limit", procedure.time_limit);

    std::vector<std::string> instrument_ids;
    const Node* instruments = map.find("instruments");
    InstrumentReader reader(catalog, report);
    if (instruments && is_kind(*instruments, Node::Kind::map, "instruments", report)) {
        if (instruments->children.empty())
            report.error(Code::empty_value, instruments->span, "The list of instruments is empty. Add one.");
        for (const Node& child : instruments->children) {
            const int errors_before = report.errors();
            procedure.instruments.push_back(reader.read(child));
            draft.sound_instruments.push_back(report.errors() == errors_before);
            instrument_ids.push_back(child.key);
        }
    }
    if (const Node* implants = map.find("implants")) {
        procedure.implants = read_implants(*implants, report);
        check_place_axes(*implants, procedure, document, report);
    }
    if (const Node* node = map.find("constructions"))
        procedure.constructions = read_constructions(*node, procedure.needs_landmarks, report);
    if (const Node* node = map.find("measures"))
        procedure.measures = read_measures(*node, procedure.needs_landmarks, procedure.constructions, report);
    const Node* steps = map.find("steps");
    UniqueIds step_ids, rehearsal_ids;
    if (steps)
        for (const Node& item : read_list(*steps, "steps", report))
            add_unique(read_step(item, procedure, instrument_ids, catalog, document, report), item, step_ids,
                       procedure.steps, report);
    if (instruments && !procedure.steps.empty()) warn_of_unused(*instruments, procedure.steps, report);
    PathReader paths(procedure, document, reader, report);
    if (const Node* node = map.find("paths")) paths.read_paths(*node);
    if (const Node* node = map.find("rehearsals")) {
        const LimitNames limits = limit_names(procedure, document);
        for (const Node& item : read_list(*node, "rehearsals", report))
            add_unique(read_rehearsal(item, limits, procedure, document, paths, report), item, rehearsal_ids,
                       procedure.rehearsals, report);
        paths.warn_of_unused();
    }
    if (const Node* node = map.find("variants")) procedure.variants = read_variants(*node, report);
    map.finish();
}

// ---- what the procedure needs of the anatomy -----------------------------------------------------------------------

template <class T>
void append_ids(const std::vector<T>& things, std::vector<std::string>& ids) {
    for (const T& thing : things) ids.push_back(thing.id);
}

/// The place of `text` in `list`, or of the whole document if it is not there.
TextSpan span_of_text(const Node* list, const std::string& text) {
    for (const Node& item : list != nullptr ? list->children : std::vector<Node>{})
        if (item.text == text) return item.span;
    return {};
}

void check_list(const std::vector<std::string>& needed, const std::vector<std::string>& present, const Node* list,
                Code code, const std::string& what, const Anatomy& anatomy, Report& report) {
    for (const std::string& name : needed) {
        if (contains(present, name)) continue;
        const std::string meant = closest(name, present, report);
        report.error(code, span_of_text(list, name),
                     "The anatomy has no " + what + " " + quoted_id(name) +
                         (present.empty() ? "." : ": expected " + listed(present) + ".") +
                         or_choose(meant, "Add it there, or choose another anatomy."),
                     meant,
                     report.is_full()
                         ? std::nullopt
                         : std::optional(in_anatomy(anatomy, {what + "s"}, "its " + what + "s are here.")));
    }
}

template <class T>
const T& find_by_id(const std::vector<T>& things, const std::string& id) {
    return *std::find_if(things.begin(), things.end(), [&](const T& thing) { return thing.id == id; });
}

/// A blade that is fed along the axis would leave the plane.
void check_lies_in(const LandmarkAxis& axis, const LandmarkPlane& plane, TextSpan span, const Anatomy& anatomy,
                   Report& report) {
    using namespace literals;
    constexpr double max_angle = 3.0_deg;
    const double angle = std::asin(std::clamp(std::abs(dot(normalized(axis.to - axis.from), plane.normal)), 0.0, 1.0));
    const double off = std::abs(dot(0.5 * (axis.from + axis.to) - plane.at, plane.normal)),
                 max_off = axis.tolerance + plane.tolerance;
    const auto rounded = [](double value, double step, const char* unit) {
        return quantity_text(std::round(value / step) * step, unit);
    };
    const Reason here = in_anatomy(anatomy, {"landmarks", "axes", axis.id}, "the axis is here.");
    if (angle > max_angle)
        report.error(Code::axis_off_plane, span,
                     "The axis " + quoted_id(axis.id) + " leaves the plane " + quoted_id(plane.id) +
                         ": got an angle of " + rounded(angle, 0.1_deg, "deg") +
                         ", expected at most 3 deg, or the blade binds. Turn one of the two.",
                     {}, here);
    else if (off > max_off + 1e-9)
        report.error(Code::axis_off_plane, span,
                     "The axis " + quoted_id(axis.id) + " is not in the plane " + quoted_id(plane.id) +
                         ": got a distance of " + rounded(off, 0.1_mm, "mm") + ", expected at most " +
                         rounded(max_off, 0.1_mm, "mm") + ", the sum of their tolerances. Move one of the two.",
                     {}, here);
}

/// What is measured in the plane of a step needs one. `step` may be null.
void refuse_without_plane(const Node& what, const std::string& step_id, const Node* step, Report& report) {
    report.error(Code::needs_plane, what.key_span,
                 quoted_id(what.key) + " needs a plane, and the step " + quoted_id(step_id) +
                     " has none. Give the step a `plane:`, or remove " + quoted_id(what.key) + ".",
                 {}, step ? std::optional(report.because(step->span, "the step is here.")) : std::nullopt);
}

void check_planes(const Procedure& procedure, const Document& document, Report& report) {
    const auto item = [](const Node* list, std::size_t i) {
        return list && i < list->children.size() ? &list->children[i] : nullptr;
    };
    const Node* steps = document.root.find("steps");
    for (std::size_t s = 0; s < procedure.steps.size(); ++s) {
        const Node* step = item(steps, s);
        const Node* limits = step ? step->find("limits") : nullptr;
        for (std::size_t l = 0; l < procedure.steps[s].limits.size(); ++l) {
            const Limit& limit = procedure.steps[s].limits[l];
            const Node* written = item(limits, l);
            const Node* node = written ? written->find(limit.quantity) : nullptr;
            if (node && limit.is_of_wall() && step->find("plane") == nullptr)
                refuse_without_plane(*node, procedure.steps[s].id, step, report);
        }
    }
    for (std::size_t r = 0; r < procedure.rehearsals.size(); ++r) {
        const std::vector<const Node*> nodes = waypoint_nodes(document, r);
        for (std::size_t w = 0; w < procedure.rehearsals[r].path.size(); ++w) {
            const std::size_t s = procedure.rehearsals[r].path[w].step;
            const Node* waypoint = w < nodes.size() ? nodes[w] : nullptr;
            if (!waypoint || s >= procedure.steps.size() || !procedure.steps[s].plane.empty()) continue;
            if (const Node* step = item(steps, s); step != nullptr && step->find("plane") != nullptr) continue;
            for (const char* key : {"aside", "tilt"})
                if (const Node* node = waypoint->find(key))
                    refuse_without_plane(*node, procedure.steps[s].id, item(steps, s), report);
        }
    }
}

/// Refuses a point or a plane of the anatomy where an axis is needed.
void refuse_for_an_axis(TextSpan span, const std::string& id, bool is_point, const Anatomy& anatomy,
                        const std::vector<std::string>& axes, Report& report) {
    const std::string meant = closest(id, axes, report);
    report.error(Code::axis_is_a_point, span,
                 "The landmark " + quoted_id(id) + " is of the wrong kind: got a " + (is_point ? "point" : "plane") +
                     ", expected an axis." + or_choose(meant, "Name an axis, or give the anatomy one."),
                 meant,
                 in_anatomy(anatomy, {"landmarks", is_point ? "points" : "planes", id},
                            is_point ? "it is a point here." : "it is a plane here."));
}

/// Implants are planned along axes, and x needs a direction across them.
void check_planned_implants(const Procedure& procedure, const Anatomy& anatomy, const Document& document,
                            Report& report) {
    const Node* implants = document.root.find("implants");
    std::vector<std::string> axes, points, planes;
    append_ids(anatomy.axes, axes);
    append_ids(anatomy.points, points);
    append_ids(anatomy.planes, planes);
    for (const Implant& implant : procedure.implants) {
        const Node* node = implants ? implants->find(implant.id) : nullptr;
        const Node* place = node ? node->find("place") : nullptr;
        const Node* name = place ? place->find("axis") : nullptr;
        if (!implant.place || !name || !contains(procedure.needs_landmarks, implant.place->axis)) continue;
        const std::string& id = implant.place->axis;
        if (contains(axes, id)) {
            const LandmarkAxis& axis = find_by_id(anatomy.axes, id);
            if (length(cross(normalized(axis.to - axis.from), implant.place->up)) >= std::sin(min_angle_of_up))
                continue;
            const Node* up = place->find("up");
            report.error(Code::degenerate, up ? up->span : name->span,
                         "The place of " + quoted_id(implant.id) +
                             " has no direction for its x: `up` points along the "
                             "axis " +
                             quoted_id(id) + ", expected across it. Write another `up`, across it.",
                         {}, in_anatomy(anatomy, {"landmarks", "axes", id}, "the axis is here."));
        } else if (contains(points, id) || contains(planes, id)) {
            refuse_for_an_axis(name->span, id, contains(points, id), anatomy, axes, report);
        }
    }
}

/// What is held or moved must have come apart before: in an earlier step, or by an earlier goal of the same.
/// What is of a fracture needs one, and a landmark of the sort that a limit measures.
void check_places(const Procedure& procedure, const Anatomy& anatomy, const std::vector<std::string>& axes,
                  const std::vector<std::string>& points, const Document& document, Report& report) {
    const Node* steps = document.root.find("steps");
    const auto refuse_whole_bone = [&](TextSpan span, const std::string& what) {
        report.error(Code::missing_fracture, span,
                     "The anatomy has no fracture, which " + what + " needs. Add `fracture:` there, or remove this.",
                     {}, in_anatomy(anatomy, {"metadata"}, "the anatomy is here."));
    };
    for (std::size_t s = 0; s < procedure.steps.size(); ++s)
        for (std::size_t l = 0; l < procedure.steps[s].limits.size(); ++l) {
            const Limit& limit = procedure.steps[s].limits[l];
            if (!limit.is_of_places()) continue;
            const Node* step = steps && s < steps->children.size() ? &steps->children[s] : nullptr;
            const Node* limits = step ? step->find("limits") : nullptr;
            const Node* node =
                limits && l < limits->children.size() ? limits->children[l].find(limit.quantity) : nullptr;
            const auto span_of = [&](const char* key) {
                const Node* value = node ? node->find(key) : nullptr;
                return value ? value->span : TextSpan{};
            };
            const auto need = [&](const char* key, const std::string& id, const std::vector<std::string>& sort,
                                  const std::string& what) {
                if (contains(procedure.needs_landmarks, id) && !contains(sort, id))  // else it was refused already
                    report.error(Code::other_landmark, span_of(key),
                                 "The landmark `" + id + "` is no " + what + " of the anatomy; its landmarks" +
                                     " of this sort are " + listed(sort) + ". Name one of them.");
            };
            if (limit.quantity == "axes_angle") {
                need("of", limit.landmark, axes, "axis");
                need("to", limit.other, axes, "axis");
            } else if (limit.quantity == "tip_apex") {
                need("apex", limit.landmark, points, "point");
                need("neck", limit.other, axes, "axis");
            } else if (!anatomy.fracture) {
                refuse_whole_bone(node ? node->key_span : TextSpan{}, "the limit `" + limit.quantity + "`");
            }
        }
    if (anatomy.fracture) return;
    for (std::size_t r = 0; r < procedure.rehearsals.size(); ++r) {
        const std::vector<Waypoint>& path = procedure.rehearsals[r].path;
        const auto displaced = std::find_if(path.begin(), path.end(), [](const Waypoint& w) { return w.is_displaced; });
        if (displaced == path.end()) continue;
        const std::vector<const Node*> nodes = waypoint_nodes(document, r);
        const auto index = static_cast<std::size_t>(displaced - path.begin());
        refuse_whole_bone(index < nodes.size() ? nodes[index]->span : TextSpan{}, "`displaced`");
    }
}

void check_pieces(const Procedure& procedure, const Document& document, Report& report) {
    const Node* steps = document.root.find("steps");
    for (std::size_t s = 0; s < procedure.steps.size(); ++s)
        for (std::size_t g = 0; g < procedure.steps[s].goals.size(); ++g) {
            const std::string& quantity = procedure.steps[s].goals[g].quantity;
            if (quantity == "separated") return;
            if (quantity != "held" && quantity != "moved") continue;
            const Node* step = steps && s < steps->children.size() ? &steps->children[s] : nullptr;
            const Node* goals = step ? step->find("goals") : nullptr;
            const Node* goal = goals && g < goals->children.size() ? goals->children[g].find(quantity) : nullptr;
            report.error(Code::needs_piece, goal ? goal->key_span : TextSpan{},
                         "The step " + quoted_id(procedure.steps[s].id) +
                             " takes a piece of a bone that is still whole: no step before it has the goal "
                             "`separated`. Add it to the step that parts the bone.");
            return;
        }
}

}  // namespace

namespace {

std::optional<ProcedureDraft> draft_of_text(const std::string& file, std::string text, const ComponentCatalog& catalog,
                                            Diagnostics& diagnostics, const ProcedureChanges& changes) {
    Diagnostics found;
    std::optional<ProcedureDraft> draft;
    if (std::optional<Document> parsed = parse_document(file, std::move(text), found)) {
        const auto document = std::make_shared<Document>(std::move(*parsed));
        const auto correct = [&] {
            const Node* kind = document->root.find("kind");
            Report report(*document, found);
            if (kind == nullptr || kind->text == "Procedure") correct_keys(document->root, shapes::procedure, report);
        };
        correct();
        if (document->root.kind == Node::Kind::map) apply(changes, *document, found);
        if (changes.any()) correct();
        Report report(*document, found);
        MapReader map(document->root, shapes::procedure, "", report);
        if (read_header(map, "Procedure", report)) {
            draft.emplace();
            read_body(map, *document, catalog, report, *draft);
            draft->procedure.document = document;
            draft->procedure.variant = changes.variant;
            if (changes.any()) draft->procedure.text = emitted(*document, false);
            draft->is_sound = !has_error(found);
        }
    }
    diagnostics.insert(diagnostics.end(), found.begin(), found.end());
    return draft;
}

std::optional<Procedure> sound(std::optional<ProcedureDraft> draft) {
    return draft && draft->is_sound ? std::optional(std::move(draft->procedure)) : std::nullopt;
}

}  // namespace

std::optional<ProcedureDraft> read_procedure_draft(const std::string& file, const ComponentCatalog& catalog,
                                                   Diagnostics& diagnostics, const ProcedureChanges& changes) {
    std::optional<std::string> text = read_text_file(file, diagnostics);
    return text ? draft_of_text(file, std::move(*text), catalog, diagnostics, changes) : std::nullopt;
}

std::optional<Procedure> read_procedure(const std::string& file, const ComponentCatalog& catalog,
                                        Diagnostics& diagnostics, const ProcedureChanges& changes) {
    return sound(read_procedure_draft(file, catalog, diagnostics, changes));
}

std::optional<Procedure> read_procedure_text(const std::string& file, std::string text, const ComponentCatalog& catalog,
                                             Diagnostics& diagnostics, const ProcedureChanges& changes) {
    return sound(draft_of_text(file, std::move(text), catalog, diagnostics, changes));
}

std::shared_ptr<const Document> document_of(const Procedure& procedure) {
    return procedure.document ? procedure.document
                              : std::make_shared<const Document>(read_again(procedure.file, procedure.text));
}

void check_names(const Procedure& procedure, const Anatomy& anatomy, Diagnostics& diagnostics) {
    const auto document = document_of(procedure);
    Report report(*document, diagnostics);
    const Node* needs = document->root.find("needs");
    const auto list = [&](const char* key) { return needs ? needs->find(key) : nullptr; };
    std::vector<std::string> landmarks, zones, tissues;
    append_ids(anatomy.axes, landmarks);
    append_ids(anatomy.points, landmarks);
    append_ids(anatomy.planes, landmarks);
    append_ids(anatomy.zones, zones);
    append_ids(anatomy.tissues, tissues);
    check_list(procedure.needs_landmarks, landmarks, list("landmarks"), Code::missing_landmark, "landmark", anatomy,
               report);
    check_list(procedure.needs_zones, zones, list("zones"), Code::missing_zone, "zone", anatomy, report);
    check_list(procedure.needs_tissues, tissues, list("tissues"), Code::missing_tissue, "tissue", anatomy, report);
}

void check_axes_in_planes(const Procedure& procedure, const Anatomy& anatomy, Diagnostics& diagnostics) {
    const auto document = document_of(procedure);
    Report report(*document, diagnostics);
    std::vector<std::string> axes, planes;
    append_ids(anatomy.axes, axes);
    append_ids(anatomy.planes, planes);
    const Node* steps = document->root.find("steps");
    for (std::size_t i = 0; i < procedure.steps.size(); ++i) {
        const Step& step = procedure.steps[i];
        if (!contains(axes, step.axis) || !contains(planes, step.plane)) continue;
        const Node* node = steps && i < steps->children.size() ? steps->children[i].find("plane") : nullptr;
        check_lies_in(find_by_id(anatomy.axes, step.axis), find_by_id(anatomy.planes, step.plane),
                      node ? node->span : TextSpan{}, anatomy, report);
    }
}

void check_needs(const Procedure& procedure, const Anatomy& anatomy, Diagnostics& diagnostics) {
    check_names(procedure, anatomy, diagnostics);
    const auto read = document_of(procedure);
    const Document& document = *read;
    Report report(document, diagnostics);
    std::vector<std::string> axes, points, planes, landmarks;
    append_ids(anatomy.axes, axes);
    append_ids(anatomy.points, points);
    append_ids(anatomy.planes, planes);
    for (const auto* some : {&axes, &points, &planes}) landmarks.insert(landmarks.end(), some->begin(), some->end());

    // A name that is not declared was refused when the procedure was read.
    const auto is_declared = [&](const std::string& name) { return contains(procedure.needs_landmarks, name); };
    const Node* steps = document.root.find("steps");
    for (std::size_t i = 0; i < procedure.steps.size(); ++i) {
        const std::string& axis = procedure.steps[i].axis;
        const std::string& plane = procedure.steps[i].plane;
        const Node* step = steps && i < steps->children.size() ? &steps->children[i] : nullptr;
        const Node* node = step ? step->find("axis") : nullptr;
        if (const bool is_point = contains(points, axis);
            (is_point || contains(planes, axis)) && !contains(axes, axis) && is_declared(axis)) {
            refuse_for_an_axis(node ? node->span : TextSpan{}, axis, is_point, anatomy, axes, report);
        }
        if (plane.empty() || !contains(landmarks, plane) || !is_declared(plane)) continue;
        const Node* plane_node = step ? step->find("plane") : nullptr;
        if (!contains(planes, plane)) {
            const bool is_point = contains(points, plane);
            const std::string meant = closest(plane, planes, report);
            report.error(Code::not_a_plane, plane_node ? plane_node->span : TextSpan{},
                         "The landmark " + quoted_id(plane) + " is of the wrong kind: got " +
                             (is_point ? "a point" : "an axis") + ", expected a plane." +
                             or_choose(meant, "Name a plane, or give the anatomy one."),
                         meant,
                         in_anatomy(anatomy, {"landmarks", is_point ? "points" : "axes", plane},
                                    is_point ? "it is a point here." : "it is an axis here."));
        } else if (contains(axes, axis) && !find_by_id(anatomy.axes, axis).fit) {
            check_lies_in(find_by_id(anatomy.axes, axis), find_by_id(anatomy.planes, plane),
                          plane_node ? plane_node->span : TextSpan{}, anatomy, report);
        }
    }

    check_planned_implants(procedure, anatomy, document, report);
    check_planes(procedure, document, report);
    if (!anatomy.fracture) check_pieces(procedure, document, report);
    check_places(procedure, anatomy, axes, points, document, report);
    check_sorts(procedure.constructions, procedure.measures, anatomy, document, report);

    if (contains(points, midline)) return;
    for (std::size_t i = 0; i < procedure.rehearsals.size(); ++i) {
        const std::vector<Waypoint>& path = procedure.rehearsals[i].path;
        const auto shifted = std::find_if(path.begin(), path.end(),
                                          [](const Waypoint& w) { return w.medial != 0.0 || w.medial_angle != 0.0; });
        if (shifted == path.end()) continue;
        const std::vector<const Node*> nodes = waypoint_nodes(document, i);
        const auto index = static_cast<std::size_t>(shifted - path.begin());
        report.error(
            Code::missing_midline, index < nodes.size() ? nodes[index]->span : TextSpan{},
            "The anatomy has no point `midline`, which the rehearsal moves towards. Add it there, or remove `" +
                std::string(shifted->medial != 0.0 ? "medial" : "medial_angle") + "`.",
            {}, in_anatomy(anatomy, {"landmarks", "points"}, "its landmarks are here."));
    }
}

}  // namespace kerf
