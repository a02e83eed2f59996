// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/plugin/check_tables.h"
#include "core/plugin/component_info.h"

/// Finds and loads plugins, checks that they are of this ABI, and reports the reason of each refusal.
namespace kerf {

struct PluginLoad;
class PluginHost;

/// One loaded plugin; its library stays loaded as long as this object exists.
class Plugin {
public:
    ~Plugin();
    Plugin(const Plugin&) = delete;
    Plugin& operator=(const Plugin&) = delete;

    [[nodiscard]] const kerf_entry& entry() const noexcept { return *entry_; }
    [[nodiscard]] const std::string& path() const noexcept { return path_; }

private:
    friend PluginLoad load_tried_plugin(const std::string& path);
    Plugin(void* handle, const kerf_entry* entry, std::string path, std::unique_ptr<PluginHost> host);
    void* handle_;
    const kerf_entry* entry_;
    std::string path_;
    std::unique_ptr<PluginHost> host_;
};

struct PluginLoad {
    std::shared_ptr<Plugin> plugin;  ///< empty when refused
    std::string refusal;             ///< plugin, path, field, got, wanted, remedy
    std::string plugin_id;           ///< id of its entry; empty if it could not be read
};

/// Loads shared libraries. Returns one result for each path. Files that are not libraries for this machine, or are cut
/// short, are refused by their headers. The others are loaded in a child process first (loading_trial.h), in which
/// their static constructors may crash, exit, throw or hang. If this process has several threads, there is no child;
/// then `LoadingNote` alone names the plugin that ends the process.   [main]
[[nodiscard]] std::vector<PluginLoad> load_plugins(const std::vector<std::string>& paths);
[[nodiscard]] PluginLoad load_plugin(const std::string& path);

/// Loads a library without that trial, for a process that may end with the library.   [main]
[[nodiscard]] PluginLoad load_tried_plugin(const std::string& path);

/// The reason why a file was refused.
struct PluginRefusal {
    std::string path, plugin_id;  ///< id of its entry; empty if it could not be read
    std::string why;              ///< without file and path
};

/// A plugin as its entry describes it.
struct PluginText {
    std::string id, version, licence;
};

/// All plugins of some folders, by id, and the core's own. Libraries with strategies alone are described and closed.
/// [main]
class PluginRegistry {
public:
    PluginRegistry();
    /// Loads every `*.so` in the folders, in the order of names. Refusals and duplicate ids are reported and not fatal.
    void scan(const std::vector<std::string>& folders);

    [[nodiscard]] const ComponentCatalog& catalog() const noexcept { return catalog_; }
    [[nodiscard]] const std::vector<std::string>& refusals() const noexcept { return refusals_; }
    /// Returns the plugins that stay loaded: they have tools or laws.
    [[nodiscard]] const std::vector<std::shared_ptr<Plugin>>& plugins() const noexcept { return plugins_; }
    /// Returns notes for people on components that were skipped.
    [[nodiscard]] const std::vector<std::string>& notes() const noexcept { return notes_; }
    /// Returns the refusal of the file of this plugin: found by its id, or by the file's name if the id could not be
    /// read. Null: no such file was refused.
    [[nodiscard]] const PluginRefusal* refusal_for(const std::string& plugin_id) const;
    /// Returns all plugins, the core's own first.
    [[nodiscard]] const std::vector<PluginText>& listed() const noexcept { return listed_; }
    /// Returns a tool or a law, or null.
    [[nodiscard]] const kerf_component* find(const std::string& plugin, std::uint32_t kind,
                                             const std::string& id) const noexcept;

private:
    void list(const kerf_entry& entry, const std::string& module);
    void take(const std::string& file, PluginLoad load);

    std::vector<std::shared_ptr<Plugin>> plugins_;
    std::vector<PluginText> listed_;
    ComponentCatalog catalog_;
    std::vector<std::string> refusals_, notes_;
    std::vector<PluginRefusal> refused_;  ///< one for each text in refusals_
};

/// Returns the self-description of a component as plain values.   [any]
[[nodiscard]] ComponentInfo describe(const std::string& plugin_id, const kerf_component& component);

}  // namespace kerf
