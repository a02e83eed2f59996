// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/loader.h"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

#include "core/plugin/core_instruments.h"
#include "core/plugin/loading_note.h"

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
    {"kerf_feature", &kerf_layout::feature},
    {"kerf_need", &kerf_layout::need},
};

std::string differs(const std::string& path, const std::string& what, std::uint64_t got, std::uint64_t wanted) {
    return "plugin " + std::filesystem::path(path).filename().string() + " (" + path + "): " + what + " is " +
           std::to_string(got) + ", need " + std::to_string(wanted) + ": rebuild it against this Kerf.";
}

/// Whether an event is told under its plugin's own name, so that nobody takes it for the core's or another plugin's.
bool is_own_name(std::string_view event, std::string_view plugin) noexcept {
    const auto is_under = [&](std::string_view name) {
        return event.size() > name.size() + 1 && event.starts_with(name) && event[name.size()] == '.';
    };
    return is_under(plugin) || is_under(plugin.substr(plugin.rfind('.') + 1));
}

/// What is wrong with one component's own tables; empty when nothing.
std::string fault_of(const kerf_component& c, const std::string& plugin_id) {
    if (c.id == nullptr || c.id[0] == '\0') return "a component without an id";
    const std::string name = std::string("component `") + c.id + "` ";
    if (c.kind != KERF_KIND_TOOL && c.kind != KERF_KIND_FORCE) return name + "is of no known kind (tool 1, force 2)";
    if (c.kind == KERF_KIND_TOOL && (c.tool == nullptr || c.tool->shape == nullptr)) return name + "has no tool table";
    if (c.kind == KERF_KIND_TOOL && c.tool->drive_count > KERF_MAX_DRIVES) return name + "has too many drives";
    for (std::uint32_t i = 0; c.kind == KERF_KIND_TOOL && i < c.tool->drive_count; ++i)
        if (const kerf_drive& d = c.tool->drives[i];
            !(d.least >= 0.0 && d.least <= std::max(std::abs(d.min), std::abs(d.max))))
            return name + "drive `" + (d.id != nullptr ? d.id : "") +
                   "` takes no bone at any value of its range: `least` is outside it";
    if (c.kind == KERF_KIND_FORCE &&
        (c.force == nullptr || c.force->resist == nullptr || c.force->commit == nullptr || c.force->begin == nullptr))
        return name + "has no complete force table (begin, resist, commit)";
    if (c.kind == KERF_KIND_FORCE && c.force->signal_count > KERF_MAX_SIGNALS) return name + "has too many signals";
    if (c.kind == KERF_KIND_FORCE && c.force->event_count > 0 && c.force->events == nullptr)
        return name + "has no table of its events";
    for (std::uint32_t i = 0; c.kind == KERF_KIND_FORCE && i < c.force->event_count; ++i) {
        const kerf_event& e = c.force->events[i];
        if (e.id == nullptr || e.help == nullptr) return name + "has an event without id or help";
        if (!is_own_name(e.id, plugin_id))
            return name + "event `" + e.id + "` is not under its plugin's name: it needs `" +
                   plugin_id.substr(plugin_id.rfind('.') + 1) + ".` before it";
    }
    for (std::uint32_t i = 0; i < c.param_count; ++i) {
        const kerf_param& p = c.params[i];
        if (p.id == nullptr || p.help == nullptr || p.source == nullptr || p.display_unit == nullptr)
            return name + "has a parameter without id, help, unit or source";
        if (!(p.min <= p.def && p.def <= p.max && std::isfinite(p.min) && std::isfinite(p.max)))
            return name + "parameter `" + p.id + "` has a default outside its range";
    }
    if (c.feature_count > 0 && c.features == nullptr) return name + "has no table of its features";
    for (std::uint32_t i = 0; i < c.feature_count; ++i) {
        const kerf_feature& f = c.features[i];
        if (f.id == nullptr || f.help == nullptr ||
            (f.kind != KERF_FEATURE_EFFECT && f.kind != KERF_FEATURE_RESOLUTION))
            return name + "has a feature without id, help or kind (effect 1, resolution 2)";
        if (f.param >= c.param_count || !(f.off >= c.params[f.param].min && f.off <= c.params[f.param].max))
            return name + "feature `" + f.id + "` sets no parameter, or one outside its range";
    }
    return {};
}

/// By its first bytes: "\x7fELF".
bool is_shared_library(const std::string& path) {
    std::array<char, 4> head{};
    std::ifstream(path, std::ios::binary).read(head.data(), head.size());
    return head == std::array<char, 4>{'\x7f', 'E', 'L', 'F'};
}

template <class D>
ParameterInfo parameter_info(const D& d, const char* source) {
    return {d.id, d.help, d.dimension, d.display_unit, d.min, d.max, d.def, source, 0.0};
}

}  // namespace

std::string refusal_of(const kerf_entry& entry, const std::string& path) {
    if (entry.magic != KERF_MAGIC) return differs(path, "magic", entry.magic, KERF_MAGIC);
    if (entry.abi != KERF_ABI_VERSION) return differs(path, "ABI", entry.abi, KERF_ABI_VERSION);
    if (entry.size != sizeof(kerf_entry)) return differs(path, "size of kerf_entry", entry.size, sizeof(kerf_entry));
    const kerf_layout wanted = KERF_LAYOUT_INIT;
    for (const auto& field : layout_fields)
        if (entry.layout.*field.size != wanted.*field.size)
            return differs(path, std::string("size of ") + field.name, entry.layout.*field.size, wanted.*field.size);
    const std::string name = "plugin " + std::filesystem::path(path).filename().string() + " (" + path + "): ";
    if (entry.plugin_id == nullptr || entry.plugin_version == nullptr || entry.components == nullptr ||
        entry.component_count == 0)
        return name + "its entry names no id, version or components: fill in kerf_entry.";
    for (std::uint32_t i = 0; i < entry.component_count; ++i)
        if (const std::string fault = fault_of(entry.components[i], entry.plugin_id); !fault.empty())
            return name + fault + ": mend its table.";
    return {};
}

Plugin::~Plugin() { dlclose(handle_); }

PluginLoad load_plugin(const std::string& path) {
    const auto refused = [&](const std::string& why) {
        return PluginLoad{nullptr,
                          "plugin " + std::filesystem::path(path).filename().string() + " (" + path + "): " + why};
    };
    // Opening a pipe could keep us waiting for ever.
    std::error_code error;
    if (!std::filesystem::exists(path, error)) return refused("there is no such file.");
    if (!std::filesystem::is_regular_file(path, error))
        return refused("is not a file, so it is no Kerf plugin. Remove it from the folder.");
    if (!is_shared_library(path))
        return refused(
            "is not a shared library, so it is no Kerf plugin. Remove it from the folder, or build it again.");

    const LoadingNote note(path);
    dlerror();
    void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) {
        const char* reason = dlerror();
        std::string why = reason != nullptr ? reason : "unknown reason";
        if (why.starts_with(path + ": ")) why.erase(0, path.size() + 2);
        return refused("cannot be loaded: " + why + ". Build it again on this system, and against this Kerf.");
    }
    const auto* entry = static_cast<const kerf_entry*>(dlsym(handle, KERF_ENTRY_SYMBOL));
    PluginLoad load = entry == nullptr ? refused("exports no `" KERF_ENTRY_SYMBOL
                                                 "`, so it is no Kerf plugin. Remove it from the folder.")
                                       : PluginLoad{nullptr, refusal_of(*entry, path)};
    if (!load.refusal.empty()) {
        dlclose(handle);
        return load;
    }
    return {std::shared_ptr<Plugin>(new Plugin(handle, entry, path)), {}};
}

ComponentInfo describe(const std::string& plugin_id, const kerf_component& c) {
    ComponentInfo info;
    info.plugin = plugin_id;
    info.id = c.id;
    info.kind = c.kind;
    info.help = c.help != nullptr ? c.help : "";
    for (std::uint32_t i = 0; i < c.param_count; ++i)
        info.parameters.push_back(parameter_info(c.params[i], c.params[i].source));
    for (std::uint32_t i = 0; i < c.feature_count; ++i) {
        const kerf_feature& f = c.features[i];
        info.features.push_back({f.id, f.help, f.kind, f.param, f.off});
    }
    if (c.kind == KERF_KIND_TOOL)
        for (std::uint32_t i = 0; i < c.tool->drive_count; ++i) {
            info.drives.push_back(parameter_info(c.tool->drives[i], ""));
            info.drives.back().least = c.tool->drives[i].least;
        }
    if (c.kind == KERF_KIND_FORCE)
        for (std::uint32_t i = 0; i < c.force->signal_count; ++i) {
            const kerf_signal& s = c.force->signals[i];
            info.signals.push_back({s.id, s.help, s.dimension, s.display_unit});
        }
    if (c.kind == KERF_KIND_FORCE)
        for (std::uint32_t i = 0; i < c.force->event_count; ++i)
            info.events.push_back({c.force->events[i].id, c.force->events[i].help});
    if (c.kind == KERF_KIND_FORCE) {
        info.tools.assign(c.force->tools, c.force->tools + c.force->tool_count);
        for (std::uint32_t i = 0; i < c.force->need_count; ++i) {
            const kerf_need& n = c.force->needs[i];
            info.needs.push_back({n.id, n.help, n.dimension, n.kind});
        }
    }
    return info;
}

PluginRegistry::PluginRegistry() { list(core_instruments()); }

void PluginRegistry::list(const kerf_entry& entry) {
    for (std::uint32_t i = 0; i < entry.component_count; ++i)
        catalog_.push_back(describe(entry.plugin_id, entry.components[i]));
    entries_.push_back(&entry);
}

void PluginRegistry::scan(const std::vector<std::string>& folders) {
    for (const auto& folder : folders) {
        std::vector<std::string> files;
        std::error_code error;
        for (const auto& file : std::filesystem::directory_iterator(folder, error))
            if (file.path().extension() == ".so") files.push_back(file.path().string());
        std::sort(files.begin(), files.end());
        for (const auto& file : files) {
            PluginLoad load = load_plugin(file);
            if (load.plugin == nullptr) {
                refusals_.push_back(load.refusal);
                continue;
            }
            const std::string id = load.plugin->entry().plugin_id;
            if (id == core_instruments().plugin_id) {
                refusals_.push_back("plugin " + file + ": calls itself " + id +
                                    ", which is Kerf's own. Give it another id.");
                continue;
            }
            const auto twin = std::find_if(plugins_.begin(), plugins_.end(),
                                           [&](const auto& p) { return id == p->entry().plugin_id; });
            if (twin != plugins_.end()) {
                refusals_.push_back("plugin " + id + " is found twice: " + (*twin)->path() + " (used) and " + file +
                                    ". Remove one.");
                continue;
            }
            list(load.plugin->entry());
            plugins_.push_back(std::move(load.plugin));
        }
    }
}

const kerf_component* PluginRegistry::find(const std::string& plugin, std::uint32_t kind,
                                           const std::string& id) const noexcept {
    for (const kerf_entry* entry : entries_) {
        if (plugin != entry->plugin_id) continue;
        for (std::uint32_t i = 0; i < entry->component_count; ++i) {
            const kerf_component& c = entry->components[i];
            if (c.kind == kind && id == c.id) return &c;
        }
    }
    return nullptr;
}

}  // namespace kerf
