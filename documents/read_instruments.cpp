// SPDX-License-Identifier: Apache-2.0
#include "documents/read_instruments.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <utility>

#include "documents/names.h"
#include "documents/shapes/shapes.h"
#include "kerf/units.hpp"
#include "text/codes.h"
#include "text/printable.h"

namespace kerf::documents {
namespace {

bool is_instrument(std::uint32_t kind) noexcept { return kind == KERF_KIND_TOOL || kind == KERF_KIND_FORCE; }

class InstrumentReader {
public:
    InstrumentReader(const ComponentCatalog& catalog, Report& report) : catalog_(catalog), report_(report) {}

    Instrument read(const Node& node) {
        MapReader map(node, shapes::instrument, node.key, report_);
        Instrument instrument;
        instrument.id = node.key;
        read_key(node, "An instrument's name", report_);

        const Node* plugin = map.find("plugin");
        const Node* tool_node = map.find("tool");
        const Node* force_node = map.find("force");
        const Node* force_plugin = map.find("force_plugin");
        const ComponentInfo* tool = nullptr;
        const ComponentInfo* force = nullptr;
        const bool is_plugin_known = plugin && find_plugin(*plugin, instrument.plugin);
        if (is_plugin_known && tool_node && force_node && !force_plugin)
            correct_plugin(*plugin, tool_node->text, force_node->text, instrument.plugin);
        if (is_plugin_known) {
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

        shapes::instrument.fill(map, instrument);
        const Node* remeshing = map.find("remeshing");
        const int errors = report_.errors();
        const ComponentInfo* strategy = remeshing != nullptr ? read_remeshing(*remeshing, tool, instrument) : nullptr;
        if (const Node* set = map.find("remeshing_parameters"); set != nullptr && report_.errors() == errors)
            read_remeshing_parameters(*set, strategy, instrument);
        const Node* parameters = map.find("parameters");
        const Node* drives = map.find("drives");
        if (parameters) read_parameters(*parameters, tool, force, instrument);
        if (drives && tool) read_drives(*drives, *tool, instrument);
        if (tool) map.expect_under("parameters", ids_of(tool->parameters));
        if (force) map.expect_under("parameters", ids_of(force->parameters));
        if (tool) map.expect_under("drives", ids_of(tool->drives));
        map.finish();
        return instrument;
    }

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
    /// Reads a word of the core, or the name of a strategy: its full id, or the last words of it if only one plugin has
    /// them. Returns the strategy if it is installed.
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
            report_.error(text::Code::unknown_strategy, node.span,
                          "The strategy `" + text::excerpt(word, 40) + "` has " + std::to_string(owners.size()) +
                              " owners: expected one of " + listed(owners) + ". Write its full id.");
            return nullptr;
        }
        // The tool's own plugin names it, so it exists. Only its module is missing, and a run does not need it.
        if (tool != nullptr)
            for (const std::string& suited : tool->strategies)
                if (suited == word || suited.ends_with("." + word)) {
                    instrument.remeshing = suited;
                    return nullptr;
                }
        // A run does not need the strategy of a plugin that is not installed. But an id close to a known one is a
        // mistake.
        if (std::count(word.begin(), word.end(), '.') > 1 && is_of_no_plugin(word.substr(0, word.rfind('.'))) &&
            !is_near_any(word, known)) {
            instrument.remeshing = word;
            return nullptr;
        }
        const std::string closest_one = closest(word, known, report_);
        report_.error(text::Code::unknown_strategy, node.span,
                      "The strategy `" + text::excerpt(word, 60) + "` is unknown: expected " + listed(known, word) +
                          "." + or_choose(closest_one, "Write one of these, or install the plugin that has it."),
                      closest_one);
        return nullptr;
    }

    [[nodiscard]] bool is_of_no_plugin(const std::string& id) const {
        return std::none_of(catalog_.begin(), catalog_.end(),
                            [&](const ComponentInfo& one) { return one.plugin == id; });
    }

    /// @param strategy   null: it is unknown or not installed, so no parameter is refused
    void read_remeshing_parameters(const Node& node, const ComponentInfo* strategy, Instrument& instrument) {
        if (!is_kind(node, Node::Kind::map, instrument.id + ".remeshing_parameters", report_)) return;
        if (instrument.remeshing.empty())
            return report_.error(text::Code::unknown_parameter, node.key_span,
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
            refuse_key_of(child, "parameter", text::Code::unknown_parameter, known,
                          strategy->full_id() + " has none. Remove it.", strategy->full_id());
        }
    }

    static std::vector<double> defaults(const std::vector<ParameterInfo>& parameters) {
        std::vector<double> values;
        for (const ParameterInfo& parameter : parameters) values.push_back(parameter.def);
        return values;
    }

    bool find_plugin(const Node& node, std::string& id) {
        id = read_text(node, "plugin", report_).value_or("");
        if (id.empty()) return false;
        std::vector<std::string> known;
        for (const ComponentInfo& component : catalog_)
            if (is_instrument(component.kind) && !contains(known, component.plugin)) known.push_back(component.plugin);
        if (contains(known, id)) return true;
        const std::string meant = closest(id, known, report_);
        report_.error(
            text::Code::unknown_plugin, node.span,
            "The plugin `" + text::excerpt(id, 40) +
                "` is unknown: " + (known.empty() ? "no plugin was found." : "expected " + listed(known, id) + ".") +
                or_choose(meant, known.empty() ? "Name the folder that holds it in KERF_PLUGIN_PATH."
                                               : "Write one of these, or name its folder in KERF_PLUGIN_PATH."),
            meant);
        return false;
    }

    [[nodiscard]] bool has(const std::string& plugin, std::uint32_t kind, const std::string& id) const {
        return std::any_of(catalog_.begin(), catalog_.end(), [&](const ComponentInfo& one) {
            return one.plugin == plugin && one.kind == kind && one.id == id;
        });
    }

    /// Returns the plugins that have a component of this kind and id.
    [[nodiscard]] std::vector<std::string> owners_of(std::uint32_t kind, const std::string& id) const {
        std::vector<std::string> owners;
        for (const ComponentInfo& one : catalog_)
            if (one.kind == kind && one.id == id) owners.push_back(one.plugin);
        return owners;
    }

    /// Reports a plugin that has neither the tool nor the force, and corrects it, if a single other one has both.
    void correct_plugin(const Node& node, const std::string& tool, const std::string& force, std::string& plugin) {
        if (has(plugin, KERF_KIND_TOOL, tool) || has(plugin, KERF_KIND_FORCE, force)) return;
        std::vector<std::string> owners = owners_of(KERF_KIND_TOOL, tool);
        std::erase_if(owners, [&](const std::string& owner) { return !has(owner, KERF_KIND_FORCE, force); });
        if (owners.size() != 1) return;
        report_.error(text::Code::unknown_tool, node.span,
                      "The tool " + quoted_id(text::excerpt(tool, 40)) + " and the force " +
                          quoted_id(text::excerpt(force, 40)) + " are not of this plugin: got " + quoted_id(plugin) +
                          ", expected " + quoted_id(owners.front()) + ".",
                      owners.front());
        plugin = owners.front();
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
        const std::vector<std::string> owners = owners_of(kind, id);
        refuse_unknown(
            {.code = is_tool ? text::Code::unknown_tool : text::Code::unknown_force,
             .span = node->span,
             .subject = std::string("The ") + (is_tool ? "tool" : "force") + " " + quoted_id(text::excerpt(id, 40)),
             .word = id,
             .known = known,
             .if_none = plugin + " has none. Choose another plugin.",
             .of = " of " + plugin,
             .advice = owners.empty() ? "Write one of these."
                                      : std::string("Write one of these, or `") +
                                            (is_tool ? "plugin: " : "force_plugin: ") + owners.front() + "`."},
            report_);
        return nullptr;
    }

    /// Checks that the force takes the tool: the force lists it, or the tool has all that the force needs.
    void check_fit(const Node& node, const ComponentInfo& tool, const ComponentInfo& force) {
        if (!force.tools.empty() && (tool.plugin != force.plugin || !contains(force.tools, tool.id)))
            return report_.error(text::Code::unknown_force, node.span,
                                 "The force `" + force.id + "` does not take the tool `" + tool.id + "` of " +
                                     tool.plugin + ": expected " + listed(force.tools, tool.id) + " of " +
                                     force.plugin + ". Choose another force.");
        for (const NeedInfo& need : force.needs) {
            const bool is_drive = need.kind == KERF_NEED_DRIVE;
            const auto& among = is_drive ? tool.drives : tool.parameters;
            if (std::none_of(among.begin(), among.end(),
                             [&](const ParameterInfo& p) { return p.id == need.id && p.dimension == need.dimension; }))
                report_.error(text::Code::unknown_force, node.span,
                              "The force `" + force.id + "` needs a tool with the " +
                                  (is_drive ? "drive" : "parameter") + " `" + need.id + "`: `" + tool.id +
                                  "` has none of that dimension. Choose another tool or force.");
        }
    }

    /// Sets the value that `node` names. Returns false if it names none.
    bool set(const Node& node, const std::string& instrument, const ComponentInfo& component,
             const std::vector<ParameterInfo>& parameters, std::vector<double>& values) {
        const auto found = std::find_if(parameters.begin(), parameters.end(),
                                        [&](const ParameterInfo& p) { return p.id == node.key; });
        if (found == parameters.end()) return false;
        const text::QuantityNeed need{found->dimension, found->display_unit, found->min, found->max};
        text::SourcePosition where;
        where.file = component.plugin + "/" + component.id;
        text::Reason declared{std::move(where),
                              found->id + " is declared from " + text::quantity_text(need.min, need.unit) + " to " +
                                  text::quantity_text(need.max, need.unit) + ", default " +
                                  text::quantity_text(found->def, need.unit) + ".",
                              {}};
        if (const std::optional<double> value =
                read_quantity(node, instrument + "." + found->id, need, report_, std::move(declared)))
            values[static_cast<std::size_t>(found - parameters.begin())] = *value;
        return true;
    }

    /// If a component is unknown (null), no parameter is refused.
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
            refuse_key_of(child, "parameter", text::Code::unknown_parameter, known,
                          tool->id + " and " + force->id + " have none. Remove it.", tool->id + " or " + force->id);
        }
    }

    void read_drives(const Node& node, const ComponentInfo& tool, Instrument& instrument) {
        if (!is_kind(node, Node::Kind::map, instrument.id + ".drives", report_)) return;
        const std::vector<std::string> known = ids_of(tool.drives);
        for (const Node& child : node.children)
            if (set(child, instrument.id, tool, tool.drives, instrument.drives)) {
                warn_if_too_slow(child, tool, instrument);
            } else {
                refuse_key_of(child, "drive", text::Code::unknown_drive, known, tool.id + " has none. Remove it.",
                              tool.id);
            }
    }

    /// @param of   whose keys `known` are
    void refuse_key_of(const Node& child, const char* what, text::Code code, const std::vector<std::string>& known,
                       std::string if_none, const std::string& of) {
        refuse_unknown({.code = code,
                        .span = child.key_span,
                        .subject = std::string("The ") + what + " " + quoted_id(text::excerpt(child.key, 40)),
                        .word = child.key,
                        .known = known,
                        .if_none = std::move(if_none),
                        .of = " of " + of,
                        .is_key = true},
                       report_);
    }

    void warn_if_too_slow(const Node& node, const ComponentInfo& tool, const Instrument& instrument) {
        for (std::size_t i = 0; i < tool.drives.size(); ++i) {
            const ParameterInfo& drive = tool.drives[i];
            const double value = std::abs(instrument.drives[i]);
            if (drive.id != node.key || !(value > 0.0 && value < drive.least)) continue;
            const std::string least = text::quantity_text(drive.least, drive.display_unit);
            report_.warning(text::Code::too_slow_to_cut, node.span,
                            "The drive " + quoted_id(drive.id) + " is too slow to cut: got " +
                                text::quantity_text(value, drive.display_unit) + ", expected " + least +
                                " or more. Write such a value, or 0 to switch it off.");
        }
    }

    const ComponentCatalog& catalog_;
    Report& report_;
};

}  // namespace

Instrument read_instrument(const Node& node, const ComponentCatalog& catalog, Report& report) {
    return InstrumentReader(catalog, report).read(node);
}

std::vector<HandInput> read_inputs(const Node& node, const Instrument& instrument, const ComponentCatalog& catalog,
                                   Report& report) {
    return InstrumentReader(catalog, report).read_inputs(node, instrument);
}

namespace {

const ComponentInfo* component_in(const ComponentCatalog& catalog, std::uint32_t kind, const std::string& plugin,
                                  const std::string& id) {
    const auto found = std::find_if(catalog.begin(), catalog.end(), [&](const ComponentInfo& c) {
        return c.kind == kind && c.plugin == plugin && c.id == id;
    });
    return found != catalog.end() ? &*found : nullptr;
}

}  // namespace

const ComponentInfo* law_of(const Instrument& instrument, const ComponentCatalog& catalog) {
    return component_in(catalog, KERF_KIND_FORCE, instrument.force_plugin, instrument.force);
}

const ComponentInfo* tool_of(const Instrument& instrument, const ComponentCatalog& catalog) {
    return component_in(catalog, KERF_KIND_TOOL, instrument.plugin, instrument.tool);
}

}  // namespace kerf::documents
