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
    std::string refusal;             ///< message: plugin, path, field, value, expected value, remedy
    std::string plugin_id;           ///< id of its entry; empty if it could not be read
};

/// Loads shared libraries. Returns one result for each path, in their order. Files that are not libraries for this
/// machine, or are cut short, are refused by their headers. The others are loaded in a child process first
/// (loading_trial.h): a crash, exit, exception or hang of their code ends only the child, and the plugin is refused. If
/// this process has several threads, there is no child. Then `LoadingNote` prints the name of a plugin that ends the
/// process.   [main]
[[nodiscard]] std::vector<PluginLoad> load_plugins(const std::vector<std::string>& paths);
[[nodiscard]] PluginLoad load_plugin(const std::string& path);

/// Loads a library without the check of its headers and without a child process. A crash of its code ends this process.
/// [main]
[[nodiscard]] PluginLoad load_tried_plugin(const std::string& path);

/// The reason why a file was refused.
struct PluginRefusal {
    std::string path, plugin_id;  ///< path of the file; id of its entry, empty if it could not be read
    std::string why;              ///< the reason, without the plugin's name and path
};

/// A plugin as its entry describes it.
struct PluginText {
    std::string id, version, licence;
};

/// All plugins of some folders, and `kerf.core`. A library with strategies alone is described and closed: strategies
/// run in another process.   [main]
class PluginRegistry {
public:
    PluginRegistry();
    /// Loads every `*.so` in the folders: folder by folder, in the order of file names. Refused files and duplicate ids
    /// are left out and listed in `refusals`.
    void scan(const std::vector<std::string>& folders);

    [[nodiscard]] const ComponentCatalog& catalog() const noexcept { return catalog_; }
    [[nodiscard]] const std::vector<std::string>& refusals() const noexcept { return refusals_; }
    /// Returns the plugins that stay loaded: they have tools, laws or devices.
    [[nodiscard]] const std::vector<std::shared_ptr<Plugin>>& plugins() const noexcept { return plugins_; }
    /// Returns one line of text for each component of an unknown kind, which was left out.
    [[nodiscard]] const std::vector<std::string>& notes() const noexcept { return notes_; }
    /// Returns the refusal of this plugin's file, or null. It is found by the plugin's id. If that could not be read,
    /// it is found by a file name that contains the last word of `plugin_id`.
    [[nodiscard]] const PluginRefusal* refusal_for(const std::string& plugin_id) const;
    /// Returns all plugins, the core's own first.
    [[nodiscard]] const std::vector<PluginText>& listed() const noexcept { return listed_; }
    /// Returns the table of a tool, law or device (`kind`) of a plugin, or null if there is none.
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

/// Returns what the bits of `kerf_force::does_not` name, as verbs: "resist sideways".   [any]
[[nodiscard]] std::vector<std::string> words_of_does_not(std::uint32_t bits);

/// Returns the self-description of a component as plain values.   [any]
[[nodiscard]] ComponentInfo describe(const std::string& plugin_id, const kerf_component& component);

}  // namespace kerf
