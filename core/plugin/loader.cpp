// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/loader.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <system_error>
#include <utility>

#include "core/plugin/core_instruments.h"
#include "core/plugin/elf_file.h"
#include "core/plugin/floating_point.h"
#include "core/plugin/loading_note.h"
#include "core/plugin/loading_trial.h"
#include "core/plugin/plain_text.h"
#include "core/plugin/plugin_call.h"
#include "core/plugin/plugin_host.h"
#include "core/plugin/reserved_names.h"
#include "kerf/remesh.h"

namespace kerf {

namespace {

/// An open library and the entry that it exports.
struct OpenLibrary {
    void* handle = nullptr;
    const kerf_entry* entry = nullptr;
    std::string fault;
};

/// Returns the begin of a refusal, with the plugin's id if that is known.
std::string named_plugin(const std::string& path, const std::string& plugin_id) {
    return plugin_id.empty() ? kerf::named_plugin(path) : "plugin " + plain(plugin_id) + " (" + plain(path) + "): ";
}

/// Returns the dynamic linker's last error without the path, which the refusal names already.
std::string linker_error(const std::string& path) {
    const char* reason = dlerror();
    std::string why = reason != nullptr ? reason : "unknown reason";
    if (why.starts_with(path + ": ")) why.erase(0, path.size() + 2);
    return plain(why);
}

OpenLibrary open_library(const std::string& path) {
    OpenLibrary opened;
    dlerror();
    const FloatingPoint before = floating_point();
    opened.handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    const bool has_other_rounding = floating_point() != before;
    set_floating_point(before);
    if (opened.handle == nullptr) {
        opened.fault =
            "cannot be loaded: " + linker_error(path) + ". Build it again on this system, and against this Kerf.";
        return opened;
    }
    opened.entry = static_cast<const kerf_entry*>(dlsym(opened.handle, KERF_ENTRY_SYMBOL));
    if (has_other_rounding)
        opened.fault =
            "changes the rounding of numbers, or other control words of the floating-point unit, while it is loaded. "
            "Its static constructors may not; `-ffast-math` of some compilers does so too: build it without.";
    else if (opened.entry == nullptr)
        opened.fault =
            "exports no `" KERF_ENTRY_SYMBOL
            "`. In a plugin, declare it visible: `extern \"C\" __attribute__((visibility(\"default\"))) const "
            "kerf_entry " KERF_ENTRY_SYMBOL ";`. If it is none, remove it from the folder.";
    return opened;
}

/// Runs in the child: loads a plugin, reads its tables and unloads it. Returns the fault, or an empty text.
std::string run_trial(const std::string& path, const TrialReport& report) {
    report.does("while it was loaded");
    OpenLibrary opened = open_library(path);
    if (opened.fault.empty()) {
        report.does("while its tables were read");
        if (const std::string id = plugin_id_of(*opened.entry); !id.empty()) report.is_named(id);
        opened.fault = fault_of(*opened.entry);
    }
    if (opened.fault.empty())
        for (std::uint32_t i = 0; i < opened.entry->component_count; ++i)
            if (is_known_kind(opened.entry->components[i].kind))
                static_cast<void>(describe(opened.entry->plugin_id, opened.entry->components[i]));
    if (opened.fault.empty()) {
        report.does("while it was opened");
        opened.fault = PluginHost(opened.entry->plugin_id).open(*opened.entry);
    }
    report.does("while it was unloaded");
    if (opened.handle != nullptr) dlclose(opened.handle);
    return opened.fault;
}

template <class D>
ParameterInfo parameter_info(const D& d, const char* source) {
    return {d.id, d.help, d.dimension, d.display_unit, d.min, d.max, d.def, source, 0.0};
}

}  // namespace

Plugin::Plugin(void* handle, const kerf_entry* entry, std::string path, std::unique_ptr<PluginHost> host)
    : handle_(handle), entry_(entry), path_(std::move(path)), host_(std::move(host)) {}

Plugin::~Plugin() {
    unregister_components(entry_);
    dlclose(handle_);
}

PluginLoad load_tried_plugin(const std::string& path) {
    const LoadingNote note(path);
    OpenLibrary opened = open_library(path);
    PluginLoad load;
    if (opened.fault.empty()) {
        load.plugin_id = plugin_id_of(*opened.entry);
        opened.fault = fault_of(*opened.entry);
    }
    if (!opened.fault.empty()) {
        load.refusal = named_plugin(path, load.plugin_id) + opened.fault;
        if (opened.handle != nullptr) dlclose(opened.handle);
        return load;
    }
    auto host = std::make_unique<PluginHost>(load.plugin_id);
    if (const std::string fault = host->open(*opened.entry); !fault.empty()) {
        load.refusal = named_plugin(path, load.plugin_id) + fault;
        dlclose(opened.handle);
        return load;
    }
    register_components(*opened.entry, path);
    load.plugin = std::shared_ptr<Plugin>(new Plugin(opened.handle, opened.entry, path, std::move(host)));
    return load;
}

std::vector<PluginLoad> load_plugins(const std::vector<std::string>& paths) {
    std::vector<PluginLoad> loads(paths.size());
    std::vector<std::string> to_try;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        const std::string fault = refusal_of_file(paths[i]);
        if (fault.empty())
            to_try.push_back(paths[i]);
        else
            loads[i].refusal = named_plugin(paths[i]) + fault;
    }
    const std::vector<Trial> trials = can_try() ? try_in_child(to_try, &run_trial) : std::vector<Trial>(to_try.size());
    std::size_t tried = 0;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        if (!loads[i].refusal.empty()) continue;
        const Trial& trial = trials[tried++];
        if (trial.refusal.empty())
            loads[i] = load_tried_plugin(paths[i]);
        else
            loads[i] = {nullptr, named_plugin(paths[i], trial.plugin_id) + trial.refusal, trial.plugin_id};
    }
    return loads;
}

PluginLoad load_plugin(const std::string& path) { return load_plugins({path}).front(); }

std::vector<std::string> words_of_does_not(std::uint32_t bits) {
    std::vector<std::string> words;
    if ((bits & KERF_DOES_NOT_RESIST_SIDEWAYS) != 0) words.emplace_back("resist sideways");
    if ((bits & KERF_DOES_NOT_DEPEND_ON_DENSITY) != 0) words.emplace_back("depend on density");
    if ((bits & KERF_DOES_NOT_BRAKE_TURNING) != 0) words.emplace_back("brake turning");
    if ((bits & KERF_DOES_NOT_REST_ON_BONE) != 0) words.emplace_back("rest on bone");
    return words;
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
    if (c.kind == KERF_KIND_TOOL) info.feed = c.tool->feed;
    if (c.kind == KERF_KIND_TOOL)
        info.strategies.assign(c.tool->strategies, c.tool->strategies + c.tool->strategy_count);
    if (c.kind == KERF_KIND_REMESHER) {
        info.scope = c.remesher->scope;
        info.kernel = c.remesher->kernel;
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
            info.events.push_back(
                {c.force->events[i].id, c.force->events[i].help, c.force->events[i].effect == KERF_EVENT_DAMAGE});
    if (c.kind == KERF_KIND_FORCE) {
        info.tools.assign(c.force->tools, c.force->tools + c.force->tool_count);
        for (std::uint32_t i = 0; i < c.force->need_count; ++i) {
            const kerf_need& n = c.force->needs[i];
            info.needs.push_back({n.id, n.help, n.dimension, n.kind});
        }
        info.does_not = words_of_does_not(c.force->does_not);
    }
    return info;
}

PluginRegistry::PluginRegistry() { list(core_instruments(), ""); }

void PluginRegistry::list(const kerf_entry& entry, const std::string& module) {
    for (std::uint32_t i = 0; i < entry.component_count; ++i) {
        if (!is_known_kind(entry.components[i].kind)) {
            notes_.push_back("plugin " + std::string(entry.plugin_id) + ": its component `" + entry.components[i].id +
                             "` is of kind " + std::to_string(entry.components[i].kind) +
                             ", which this Kerf does not know. It is left out.");
            continue;
        }
        catalog_.push_back(describe(entry.plugin_id, entry.components[i]));
        catalog_.back().module = module;
    }
    listed_.push_back({entry.plugin_id, entry.plugin_version, entry.licence});
}

void PluginRegistry::scan(const std::vector<std::string>& folders) {
    std::vector<std::string> files;
    for (const auto& folder : folders) {
        const std::size_t first = files.size();
        std::error_code error;
        for (std::filesystem::directory_iterator file(folder, error), end; !error && file != end; file.increment(error))
            if (file->path().extension() == ".so") files.push_back(file->path().string());
        std::sort(files.begin() + static_cast<std::ptrdiff_t>(first), files.end());
    }
    std::vector<PluginLoad> loads = load_plugins(files);
    for (std::size_t i = 0; i < files.size(); ++i) take(files[i], std::move(loads[i]));
}

void PluginRegistry::take(const std::string& file, PluginLoad load) {
    const auto refuse = [&](const std::string& why) {
        refusals_.push_back(why);
        const std::string named = named_plugin(file, load.plugin_id);
        refused_.push_back({file, load.plugin_id, why.starts_with(named) ? why.substr(named.size()) : why});
    };
    if (load.plugin == nullptr) return refuse(load.refusal);
    const std::string id = load.plugin_id = load.plugin->entry().plugin_id;
    if (id == core_instruments().plugin_id)
        return refuse(named_plugin(file, id) + "its id is `" + id + "`, which is Kerf's own. Give it another id.");
    const auto twin =
        std::find_if(catalog_.begin(), catalog_.end(), [&](const ComponentInfo& c) { return id == c.plugin; });
    if (twin != catalog_.end())
        return refuse("plugin " + id + " is found twice: " + plain(twin->module) + " (used) and " + plain(file) +
                      ". Remove one.");
    if (const std::string why = refusal_of_name(id, file); !why.empty()) return refuse(named_plugin(file, id) + why);
    const kerf_entry& entry = load.plugin->entry();
    list(entry, file);
    // Strategies run in another process. A library with strategies alone is closed in this one.
    const auto* const end = entry.components + entry.component_count;
    if (std::any_of(entry.components, end,
                    [](const kerf_component& c) { return c.kind != KERF_KIND_REMESHER && is_known_kind(c.kind); }))
        plugins_.push_back(std::move(load.plugin));
}

const PluginRefusal* PluginRegistry::refusal_for(const std::string& plugin_id) const {
    const std::string name = plugin_id.substr(plugin_id.rfind('.') + 1);
    const PluginRefusal* by_name = nullptr;
    for (const PluginRefusal& refused : refused_) {
        if (refused.plugin_id == plugin_id) return &refused;
        const std::string stem = std::filesystem::path(refused.path).stem().string();
        if (refused.plugin_id.empty() && by_name == nullptr && !name.empty() && stem.find(name) != std::string::npos)
            by_name = &refused;
    }
    return by_name;
}

const kerf_component* PluginRegistry::find(const std::string& plugin, std::uint32_t kind,
                                           const std::string& id) const noexcept {
    const auto find_in = [&](const kerf_entry& entry) -> const kerf_component* {
        if (plugin != entry.plugin_id) return nullptr;
        for (std::uint32_t i = 0; i < entry.component_count; ++i) {
            const kerf_component& c = entry.components[i];
            if (c.kind == kind && id == c.id) return &c;
        }
        return nullptr;
    };
    const kerf_component* found = find_in(core_instruments());
    for (auto one = plugins_.begin(); found == nullptr && one != plugins_.end(); ++one)
        found = find_in((*one)->entry());
    return found;
}

}  // namespace kerf
