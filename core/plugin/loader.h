// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/plugin/component_info.h"

/// Finding plugins, checking that they speak this ABI, and saying precisely why not.
namespace kerf {

struct PluginLoad;

/// One loaded plugin; stays mapped as long as this lives.
class Plugin {
public:
    ~Plugin();
    Plugin(const Plugin&) = delete;
    Plugin& operator=(const Plugin&) = delete;

    [[nodiscard]] const kerf_entry& entry() const noexcept { return *entry_; }
    [[nodiscard]] const std::string& path() const noexcept { return path_; }

private:
    friend PluginLoad load_plugin(const std::string& path);
    Plugin(void* handle, const kerf_entry* entry, std::string path)
        : handle_(handle), entry_(entry), path_(std::move(path)) {}
    void* handle_;
    const kerf_entry* entry_;
    std::string path_;
};

struct PluginLoad {
    std::shared_ptr<Plugin> plugin;  ///< empty when refused
    std::string refusal;             ///< plugin, path, field, got, wanted, remedy
};

/// Loads one shared library. That runs its static constructors; see `LoadingNote` for what happens when they end the
/// process.   [main]
[[nodiscard]] PluginLoad load_plugin(const std::string& path);

/// Why an entry cannot be used by this host; empty when it can.   [any]
[[nodiscard]] std::string refusal_of(const kerf_entry& entry, const std::string& path);

/// All plugins of some folders, by id, and what needs none.   [main]
class PluginRegistry {
public:
    PluginRegistry();
    /// Loads every `*.so` in the folders, in name order. Refusals and duplicate ids are reported, not fatal.
    void scan(const std::vector<std::string>& folders);

    [[nodiscard]] const ComponentCatalog& catalog() const noexcept { return catalog_; }
    [[nodiscard]] const std::vector<std::string>& refusals() const noexcept { return refusals_; }
    [[nodiscard]] const std::vector<std::shared_ptr<Plugin>>& plugins() const noexcept { return plugins_; }
    /// Core's own first.
    [[nodiscard]] const std::vector<const kerf_entry*>& entries() const noexcept { return entries_; }
    [[nodiscard]] const kerf_component* find(const std::string& plugin, std::uint32_t kind,
                                             const std::string& id) const noexcept;

private:
    void list(const kerf_entry& entry);

    std::vector<std::shared_ptr<Plugin>> plugins_;
    std::vector<const kerf_entry*> entries_;
    ComponentCatalog catalog_;
    std::vector<std::string> refusals_;
};

/// The self-description of a component as plain values.   [any]
[[nodiscard]] ComponentInfo describe(const std::string& plugin_id, const kerf_component& component);

}  // namespace kerf
