// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/check_tables.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "core/plugin/number_text.h"
#include "core/plugin/plain_text.h"
#include "core/plugin/unit.h"
#include "kerf/device.h"
#include "kerf/remesh.h"
#include "kerf/units.hpp"

namespace kerf {

namespace {

struct LayoutField {
    const char* name;
    std::uint32_t kerf_layout::*size;
};
constexpr LayoutField layout_fields[] = {
    {"kerf_param", &kerf_layout::param},
    {"kerf_drive", &kerf_layout::drive},
    {"kerf_signal", &kerf_layout::signal},
    {"kerf_event", &kerf_layout::event},
    {"kerf_solid", &kerf_layout::solid},
    {"kerf_tool_shape", &kerf_layout::tool_shape},
    {"kerf_tool", &kerf_layout::tool},
    {"kerf_bone_sample", &kerf_layout::bone_sample},
    {"kerf_surface_point", &kerf_layout::surface_point},
    {"kerf_bone_query", &kerf_layout::bone_query},
    {"kerf_channel", &kerf_layout::channel},
    {"kerf_law", &kerf_layout::law},
    {"kerf_tick_in", &kerf_layout::tick_in},
    {"kerf_advance", &kerf_layout::advance},
    {"kerf_action", &kerf_layout::action},
    {"kerf_commit_out", &kerf_layout::commit_out},
    {"kerf_force", &kerf_layout::force},
    {"kerf_component", &kerf_layout::component},
    {"kerf_thread", &kerf_layout::thread},
    {"kerf_feature", &kerf_layout::feature},
    {"kerf_need", &kerf_layout::need},
    {"kerf_host", &kerf_layout::host},
    {"kerf_log", &kerf_layout::log},
};

constexpr std::size_t max_id = 64, max_sentence = 2000;  // [bytes]

std::string number_text(double value) { return kerf::number_text(value, 10); }

/// Returns a value, given in SI, as text in its display unit; in SI, without a unit, if the display unit is unknown.
std::string value_text(double value, const char* display_unit) {
    const std::optional<Unit> unit = parse_unit(display_unit);
    const std::string name = unit ? display_unit : "";
    return number_text(unit ? value / unit->factor : value) + (name.empty() ? "" : " " + name);
}

std::string got(const std::string& field, const std::string& value, const std::string& expected,
                const std::string& remedy) {
    return "`" + field + "` is " + value + ", expected " + expected + ". " + remedy;
}

// ---- texts and counts ---------------------------------------------------------------------------------------------

std::string fault_of_text(const std::string& field, const char* text, std::size_t maximum, bool may_be_empty) {
    if (text == nullptr)
        return got(field, "null", may_be_empty ? "a text, which may be empty" : "a text", "Fill it in.");
    const std::size_t size = strnlen(text, maximum + 1);
    if (size > maximum)
        return got(field, "over " + std::to_string(maximum) + " bytes", "at most that many", "Shorten it.");
    if (size == 0 && !may_be_empty) return got(field, "empty", "a text", "Fill it in.");
    const std::string_view view(text, size);
    if (!is_utf8(view))
        return got(field, quoted_plain(view), "UTF-8",
                   "Save the source file as UTF-8, or write the character's escape.");
    if (!is_plain(view))
        return got(field, quoted_plain(view), "printable characters on one line", "Take the control characters out.");
    return {};
}

std::string fault_of_id(const std::string& field, const char* id) {
    if (std::string fault = fault_of_text(field, id, max_id, false); !fault.empty()) return fault;
    const auto is_allowed = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
               c == '.';
    };
    if (!std::all_of(id, id + std::strlen(id), is_allowed))
        return got(field, quoted_plain(id), "letters, digits, `_`, `-` and `.`",
                   "Write it in snake_case, as in `feed_rate`.");
    return {};
}

std::string fault_of_help(const char* help) { return fault_of_text("help", help, max_sentence, false); }

std::string fault_of_count(const std::string& field, std::uint32_t count, std::uint32_t maximum, const void* table) {
    if (count > maximum)
        return got(field, std::to_string(count), "at most " + std::to_string(maximum),
                   "Give the number of rows in the table, as in `std::size(table)`.");
    if (count > 0 && table == nullptr)
        return got(field, std::to_string(count) + " with a null table", "a table of as many rows",
                   "Point to the table, or write 0.");
    return {};
}

std::string fault_of_reserved(std::uint32_t reserved) {
    return reserved == 0 ? "" : got("reserved", std::to_string(reserved), "0", "Write 0: a later Kerf may use it.");
}

std::string fault_of_size(const char* structure, std::uint32_t size, std::size_t wanted) {
    if (size == wanted) return {};
    return got("size", std::to_string(size), std::to_string(wanted),
               "Write `sizeof(" + std::string(structure) + ")`, and build against this Kerf.");
}

/// Returns the fault of the first id that two rows have in common, or an empty text.
template <class Row>
std::string fault_of_duplicates(const Row* rows, std::uint32_t count) {
    for (std::uint32_t i = 0; i < count; ++i)
        for (std::uint32_t j = 0; j < i; ++j)
            if (std::strcmp(rows[i].id, rows[j].id) == 0)
                return got(
                    "id",
                    "`" + std::string(rows[i].id) + "` in rows " + std::to_string(j) + " and " + std::to_string(i),
                    "each id once", "Rename one of them.");
    return {};
}

// ---- units and ranges of parameters, drives and signals -----------------------------------------------------------

std::string fault_of_unit(const char* display_unit, const kerf_dimension& dimension) {
    if (std::string fault = fault_of_text("display_unit", display_unit, max_id, true); !fault.empty()) return fault;
    if (*display_unit == '\0' && dimension == dimension::none) return {};
    const std::optional<Unit> unit = parse_unit(display_unit);
    if (!unit)
        return got("display_unit", quoted_plain(display_unit), "a unit that Kerf knows, as `mm`, `N/mm` or `rpm`",
                   "Write one, or `\"\"` for a plain number.");
    if (!(unit->dimension == dimension))
        return got("display_unit", quoted_plain(display_unit) + ", which is not of the row's `dimension`",
                   "a unit of that dimension", "Correct the one that is wrong.");
    return {};
}

template <class Row>
std::string fault_of_range(const Row& row) {
    const auto text = [&](double value) { return value_text(value, row.display_unit); };
    if (!(std::isfinite(row.min) && std::isfinite(row.max) && row.min <= row.max))
        return got("min … max", text(row.min) + " … " + text(row.max), "two finite numbers, the smaller first",
                   "Correct them.");
    if (!(row.min <= row.def && row.def <= row.max))
        return got("def", text(row.def) + ", outside its range", text(row.min) + " … " + text(row.max),
                   "Set it within, in SI.");
    return {};
}

// ---- rows of the tables -------------------------------------------------------------------------------------------

std::string fault_of_row(const kerf_param& row) {
    if (std::string fault = fault_of_help(row.help); !fault.empty()) return fault;
    if (std::string fault = fault_of_unit(row.display_unit, row.dimension); !fault.empty()) return fault;
    if (std::string fault = fault_of_text("source", row.source, max_sentence, false); !fault.empty()) return fault;
    return fault_of_range(row);
}

std::string fault_of_row(const kerf_drive& row) {
    if (std::string fault = fault_of_help(row.help); !fault.empty()) return fault;
    if (std::string fault = fault_of_unit(row.display_unit, row.dimension); !fault.empty()) return fault;
    if (std::string fault = fault_of_range(row); !fault.empty()) return fault;
    const double maximum = std::max(std::abs(row.min), std::abs(row.max));
    if (!(row.least >= 0.0 && row.least <= maximum))
        return got("least", value_text(row.least, row.display_unit),
                   value_text(0.0, row.display_unit) + " … " + value_text(maximum, row.display_unit),
                   "Set it within, or the tool takes no bone at any value.");
    return {};
}

std::string fault_of_row(const kerf_signal& row) {
    if (std::string fault = fault_of_help(row.help); !fault.empty()) return fault;
    return fault_of_unit(row.display_unit, row.dimension);
}

std::string fault_of_row(const kerf_event& row) {
    if (row.effect != KERF_EVENT_NOTE && row.effect != KERF_EVENT_DAMAGE)
        return got("effect", std::to_string(row.effect), "0 (note) or 1 (damage)", "Write one of them.");
    if (std::string fault = fault_of_reserved(row.reserved); !fault.empty()) return fault;
    return fault_of_help(row.help);
}

/// Checks a table whose rows have ids: its count, each row, and that each id occurs once.
template <class Row>
std::string fault_of_table(const char* table, const char* one, const Row* rows, std::uint32_t count,
                           std::uint32_t maximum) {
    if (std::string fault = fault_of_count(std::string(table) + " count", count, maximum, rows); !fault.empty())
        return fault;
    for (std::uint32_t i = 0; i < count; ++i) {
        std::string name = std::string(one) + " " + std::to_string(i) + ": ";
        if (std::string fault = fault_of_id("id", rows[i].id); !fault.empty()) return name + fault;
        name = std::string(one) + " `" + rows[i].id + "`: ";
        if (std::string fault = fault_of_row(rows[i]); !fault.empty()) return name + fault;
    }
    if (std::string fault = fault_of_duplicates(rows, count); !fault.empty()) return std::string(table) + ": " + fault;
    return {};
}

std::string fault_of_features(const kerf_component& c) {
    if (std::string fault = fault_of_count("feature_count", c.feature_count, max_table_rows, c.features);
        !fault.empty())
        return fault;
    for (std::uint32_t i = 0; i < c.feature_count; ++i) {
        const kerf_feature& row = c.features[i];
        std::string name = "feature " + std::to_string(i) + ": ";
        if (std::string fault = fault_of_id("id", row.id); !fault.empty()) return name + fault;
        name = "feature `" + std::string(row.id) + "`: ";
        if (std::string fault = fault_of_help(row.help); !fault.empty()) return name + fault;
        if (row.kind != KERF_FEATURE_EFFECT && row.kind != KERF_FEATURE_RESOLUTION)
            return name + got("kind", std::to_string(row.kind), "1 (effect) or 2 (resolution)", "Write one of them.");
        if (row.param >= c.param_count)
            return name + got("param", std::to_string(row.param),
                              "an index below " + std::to_string(c.param_count) + ", the component's parameters",
                              "Correct it.");
        const kerf_param& set = c.params[row.param];
        if (!(row.off >= set.min && row.off <= set.max))
            return name + got("off", value_text(row.off, set.display_unit) + ", outside the range of `" + set.id + "`",
                              value_text(set.min, set.display_unit) + " … " + value_text(set.max, set.display_unit),
                              "Set it within, in SI.");
    }
    return {};
}

/// Returns whether an event's id begins with its plugin's name, so that it cannot collide with events of the core or of
/// other plugins.
bool is_own_name(std::string_view event, std::string_view plugin) noexcept {
    const auto is_under = [&](std::string_view name) {
        return event.size() > name.size() + 1 && event.starts_with(name) && event[name.size()] == '.';
    };
    return is_under(plugin) || is_under(plugin.substr(plugin.rfind('.') + 1));
}

std::string fault_of_event_names(const kerf_force& force, std::string_view plugin_id) {
    const std::string own(plugin_id.substr(plugin_id.rfind('.') + 1));
    for (std::uint32_t i = 0; i < force.event_count; ++i)
        if (const std::string id = force.events[i].id; !is_own_name(id, plugin_id))
            return "event `" + id + "`: " +
                   got("id", "`" + id + "`", "its plugin's name before it",
                       "Write `" + own + "." + id.substr(id.rfind('.') + 1) + "`.");
    return {};
}

// ---- components ---------------------------------------------------------------------------------------------------

std::string fault_of_strategies(const kerf_tool& tool) {
    if (std::string fault = fault_of_count("strategy_count", tool.strategy_count, max_table_rows, tool.strategies);
        !fault.empty())
        return fault;
    for (std::uint32_t i = 0; i < tool.strategy_count; ++i) {
        const std::string name = "strategy " + std::to_string(i) + ": ";
        if (std::string fault = fault_of_id("id", tool.strategies[i]); !fault.empty()) return name + fault;
        if (std::strchr(tool.strategies[i], '.') == nullptr)
            return name + got("id", quoted_plain(tool.strategies[i]), "its plugin's id before it, and a dot",
                              "Write it in full, as `example.burring.groove`.");
        for (std::uint32_t j = 0; j < i; ++j)
            if (std::strcmp(tool.strategies[i], tool.strategies[j]) == 0)
                return name + got("id", "`" + std::string(tool.strategies[i]) + "` again", "each strategy once",
                                  "Remove one of them.");
    }
    return {};
}

std::string fault_of_tool(const kerf_tool* tool) {
    if (tool == nullptr) return got("tool", "null", "the tool's table", "Point to it.");
    if (std::string fault = fault_of_size("kerf_tool", tool->size, sizeof *tool); !fault.empty())
        return "tool: " + fault;
    if (tool->shape == nullptr) return got("tool.shape", "null", "a function", "Point to it.");
    if (tool->feed > KERF_FEED_TURN)
        return got("tool.feed", std::to_string(tool->feed), "0 (axis), 1 (side) or 2 (turn)", "Write one of them.");
    if (std::string fault = fault_of_strategies(*tool); !fault.empty()) return fault;
    return fault_of_table("drive", "drive", tool->drives, tool->drive_count, KERF_MAX_DRIVES);
}

std::string fault_of_state(const kerf_force& force) {
    if (force.state_size > max_state_size)
        return got("state_size", std::to_string(force.state_size) + " bytes",
                   "at most " + std::to_string(max_state_size) + " bytes",
                   "Keep less: the host copies the state, and large tables belong into static data.");
    if (force.state_align == 0 || (force.state_align & (force.state_align - 1)) != 0 ||
        force.state_align > max_state_align)
        return got("state_align", std::to_string(force.state_align),
                   "a power of two from 1 to " + std::to_string(max_state_align), "Write `alignof(State)`.");
    return {};
}

std::string fault_of_needs(const kerf_force& force) {
    if (std::string fault = fault_of_count("need_count", force.need_count, max_table_rows, force.needs); !fault.empty())
        return fault;
    for (std::uint32_t i = 0; i < force.need_count; ++i) {
        const kerf_need& row = force.needs[i];
        const std::string name = "need " + std::to_string(i) + ": ";
        if (row.id == nullptr) return name + got("id", "null", "the id of a parameter or a drive", "Write it.");
        if (std::string fault = fault_of_help(row.help); !fault.empty()) return name + fault;
        if (row.kind != KERF_NEED_PARAM && row.kind != KERF_NEED_DRIVE)
            return name + got("kind", std::to_string(row.kind), "1 (parameter) or 2 (drive)", "Write one of them.");
    }
    return {};
}

/// Checks that the tools that a law takes are tools of its own plugin.
std::string fault_of_own_tools(const kerf_force& force, const kerf_entry& entry) {
    if (std::string fault = fault_of_count("tool_count", force.tool_count, max_table_rows, force.tools); !fault.empty())
        return fault;
    if (force.tool_count > 0 && force.need_count > 0)
        return got("need_count", std::to_string(force.need_count), "0 for a law that lists `tools`",
                   "Drop one of them.");
    for (std::uint32_t i = 0; i < force.tool_count; ++i) {
        const char* id = force.tools[i];
        const std::string name = "tool " + std::to_string(i) + " of its law: ";
        if (id == nullptr) return name + got("id", "null", "the id of a tool of this plugin", "Write it.");
        const auto* const end = entry.components + entry.component_count;
        if (std::none_of(entry.components, end, [&](const kerf_component& c) {
                return c.kind == KERF_KIND_TOOL && c.id != nullptr && std::string_view(c.id) == id;
            }))
            return name + got("id", "`" + std::string(id) + "`", "the id of a tool of this plugin", "List the tool.");
    }
    return {};
}

/// Checks that strategies of its own plugin that a tool names exist. Strategies of other plugins need not be installed.
std::string fault_of_own_strategies(const kerf_tool& tool, const kerf_entry& entry) {
    const std::string own = std::string(entry.plugin_id) + ".";
    for (std::uint32_t i = 0; i < tool.strategy_count; ++i) {
        const std::string_view id = tool.strategies[i];
        if (!id.starts_with(own) || id.find('.', own.size()) != std::string_view::npos) continue;
        const auto* const end = entry.components + entry.component_count;
        if (std::none_of(entry.components, end, [&](const kerf_component& c) {
                return c.kind == KERF_KIND_REMESHER && c.id != nullptr && id.substr(own.size()) == c.id;
            }))
            return "strategy " + std::to_string(i) + ": " +
                   got("id", "`" + std::string(id) + "`", "the id of a strategy of this plugin",
                       "List the strategy among the plugin's components.");
    }
    return {};
}

std::string fault_of_law(const kerf_force* force, std::string_view plugin_id) {
    if (force == nullptr) return got("force", "null", "the law's table", "Point to it.");
    if (std::string fault = fault_of_size("kerf_force", force->size, sizeof *force); !fault.empty())
        return "force: " + fault;
    if (force->begin == nullptr) return got("force.begin", "null", "a function", "Point to it.");
    if (force->resist == nullptr) return got("force.resist", "null", "a function", "Point to it.");
    if (force->commit == nullptr) return got("force.commit", "null", "a function", "Point to it.");
    if (std::string fault = fault_of_state(*force); !fault.empty()) return fault;
    if (std::string fault = fault_of_table("signal", "signal", force->signals, force->signal_count, KERF_MAX_SIGNALS);
        !fault.empty())
        return fault;
    if (std::string fault = fault_of_table("event", "event", force->events, force->event_count, max_table_rows);
        !fault.empty())
        return fault;
    if (std::string fault = fault_of_needs(*force); !fault.empty()) return fault;
    if (force->does_not > KERF_DOES_NOT_ALL)
        return got("force.does_not", std::to_string(force->does_not),
                   "a sum of KERF_DOES_NOT_…, 0 to " + std::to_string(KERF_DOES_NOT_ALL),
                   "Write what the law leaves out.");
    return fault_of_event_names(*force, plugin_id);
}

std::string fault_of_undotted_id(const kerf_component& c) {
    if (std::strchr(c.id, '.') == nullptr) return {};
    return got("id", quoted_plain(c.id), "an id without a dot",
               "Write it without: users put the plugin's id and a dot before it.");
}

std::string fault_of_remesher(const kerf_component& c) {
    const kerf_remesher* remesher = c.remesher;
    if (remesher == nullptr) return got("remesher", "null", "the strategy's table", "Point to it.");
    if (std::string fault = fault_of_size("kerf_remesher", remesher->size, sizeof *remesher); !fault.empty())
        return "remesher: " + fault;
    constexpr kerf_remesh_layout wanted = KERF_REMESH_LAYOUT_INIT;
    if (std::memcmp(&remesher->layout, &wanted, sizeof wanted) != 0)
        return "the structs of its requests have other sizes than this Kerf's. Build it against this Kerf.";
    if (remesher->scope != KERF_REMESH_PATCH && remesher->scope != KERF_REMESH_WHOLE)
        return got("scope", std::to_string(remesher->scope), "1 (patch) or 2 (whole mesh)", "Write one of them.");
    if (std::string fault = fault_of_reserved(remesher->reserved); !fault.empty()) return fault;
    if (remesher->remesh == nullptr) return got("remesh", "null", "a function", "Point to it.");
    if (std::string fault = fault_of_undotted_id(c); !fault.empty()) return fault;
    return fault_of_text("kernel", remesher->kernel, max_sentence, true);
}

std::string fault_of_device(const kerf_component& c) {
    const kerf_device* device = c.device;
    if (device == nullptr) return got("device", "null", "the driver's table", "Point to it.");
    if (std::string fault = fault_of_size("kerf_device", device->size, sizeof *device); !fault.empty())
        return "device: " + fault;
    constexpr kerf_device_layout wanted = KERF_DEVICE_LAYOUT_INIT;
    if (std::memcmp(&device->layout, &wanted, sizeof wanted) != 0)
        return "the structs of its calls have other sizes than this Kerf's. Build it against this Kerf.";
    if (std::string fault = fault_of_reserved(device->reserved); !fault.empty()) return fault;
    if (device->find == nullptr) return got("find", "null", "a function", "Point to it.");
    if (device->open == nullptr) return got("open", "null", "a function", "Point to it.");
    if (device->read == nullptr) return got("read", "null", "a function", "Point to it.");
    if (device->write == nullptr) return got("write", "null", "a function", "Point to it.");
    if (device->close == nullptr) return got("close", "null", "a function", "Point to it.");
    if (device->problem == nullptr) return got("problem", "null", "a function", "Point to it.");
    return fault_of_undotted_id(c);
}

/// A kind of components that this host knows.
struct KnownKind {
    const char* name;
    std::uint32_t version;
};
const KnownKind* known_kind(std::uint32_t kind) noexcept {
    static constexpr KnownKind known[] = {{"tool", KERF_TOOL_VERSION},
                                          {"force", KERF_FORCE_VERSION},
                                          {"strategy", KERF_REMESHER_VERSION},
                                          {"device", KERF_DEVICE_VERSION}};
    return kind >= 1 && kind <= std::size(known) ? &known[kind - 1] : nullptr;
}

std::string fault_of_component(const kerf_component& c, std::string_view plugin_id) {
    if (std::string fault = fault_of_size("kerf_component", c.size, sizeof c); !fault.empty()) return fault;
    const KnownKind* kind = known_kind(c.kind);
    if (kind == nullptr) return {};  // this host skips it
    if (c.version != kind->version)
        return got("version", std::to_string(c.version),
                   std::to_string(kind->version) + ", that of a " + kind->name + " of this Kerf",
                   "Build it against this Kerf.");
    if (std::string fault = fault_of_reserved(c.reserved); !fault.empty()) return fault;
    if (std::string fault = fault_of_help(c.help); !fault.empty()) return fault;
    if (std::string fault = fault_of_table("parameter", "parameter", c.params, c.param_count, max_table_rows);
        !fault.empty())
        return fault;
    if (std::string fault = fault_of_features(c); !fault.empty()) return fault;
    return c.kind == KERF_KIND_TOOL       ? fault_of_tool(c.tool)
           : c.kind == KERF_KIND_FORCE    ? fault_of_law(c.force, plugin_id)
           : c.kind == KERF_KIND_REMESHER ? fault_of_remesher(c)
                                          : fault_of_device(c);
}

std::string fault_of_components(const kerf_entry& entry) {
    const std::uint32_t count = entry.component_count;
    if (count == 0) return got("component_count", "0", "at least 1", "List the plugin's components.");
    if (std::string fault = fault_of_count("component_count", count, max_table_rows, entry.components); !fault.empty())
        return fault;
    for (std::uint32_t i = 0; i < count; ++i) {
        const kerf_component& c = entry.components[i];
        if (std::string fault = fault_of_id("id", c.id); !fault.empty())
            return "component " + std::to_string(i) + ": " + fault;
        if (std::string fault = fault_of_component(c, entry.plugin_id); !fault.empty())
            return std::string("component `") + c.id + "`: " + fault;
        if (c.kind == KERF_KIND_FORCE)
            if (std::string fault = fault_of_own_tools(*c.force, entry); !fault.empty())
                return std::string("component `") + c.id + "`: " + fault;
        if (c.kind == KERF_KIND_TOOL)
            if (std::string fault = fault_of_own_strategies(*c.tool, entry); !fault.empty())
                return std::string("component `") + c.id + "`: " + fault;
        for (std::uint32_t j = 0; j < i; ++j)
            if (c.kind == entry.components[j].kind && std::strcmp(c.id, entry.components[j].id) == 0)
                return got(
                    "id",
                    "`" + std::string(c.id) + "` in components " + std::to_string(j) + " and " + std::to_string(i),
                    "each id once among the components of a kind", "Rename one of them.");
    }
    return {};
}

std::string fault_of_entry_texts(const kerf_entry& entry) {
    if (std::string fault = fault_of_id("plugin_id", entry.plugin_id); !fault.empty()) return fault;
    if (std::string fault = fault_of_text("plugin_version", entry.plugin_version, max_id, false); !fault.empty())
        return fault;
    if (std::string fault = fault_of_text("licence", entry.licence, max_sentence, false); !fault.empty()) return fault;
    return fault_of_text("toolchain", entry.toolchain, max_sentence, false);
}

/// Returns why an entry is not of this ABI; empty if it is. With such a fault, nothing else in the entry may be read.
std::string fault_of_layout(const kerf_entry& entry) {
    const auto differs = [](const std::string& what, std::uint64_t is, std::uint64_t wanted) {
        return what + " is " + std::to_string(is) + ", need " + std::to_string(wanted) +
               ": rebuild it against this Kerf.";
    };
    if (entry.magic != KERF_MAGIC) return differs("magic", entry.magic, KERF_MAGIC);
    if (entry.abi != KERF_ABI_VERSION) return differs("ABI", entry.abi, KERF_ABI_VERSION);
    if (entry.size != sizeof(kerf_entry)) return differs("size of kerf_entry", entry.size, sizeof(kerf_entry));
    const kerf_layout wanted = KERF_LAYOUT_INIT;
    for (const auto& field : layout_fields)
        if (entry.layout.*field.size != wanted.*field.size)
            return differs(std::string("size of ") + field.name, entry.layout.*field.size, wanted.*field.size);
    return {};
}

}  // namespace

std::string named_plugin(const std::string& path) {
    return "plugin " + plain(std::filesystem::path(path).filename().string()) + " (" + plain(path) + "): ";
}

std::string fault_of(const kerf_entry& entry) {
    std::string fault = fault_of_layout(entry);
    if (fault.empty()) fault = fault_of_entry_texts(entry);
    if (fault.empty()) fault = fault_of_components(entry);
    return fault;
}

std::string refusal_of(const kerf_entry& entry, const std::string& path) {
    const std::string fault = fault_of(entry);
    return fault.empty() ? fault : named_plugin(path) + fault;
}

bool is_known_kind(std::uint32_t kind) noexcept { return known_kind(kind) != nullptr; }

std::string plugin_id_of(const kerf_entry& entry) {
    if (!fault_of_layout(entry).empty() || !fault_of_id("plugin_id", entry.plugin_id).empty()) return {};
    return entry.plugin_id;
}

}  // namespace kerf
