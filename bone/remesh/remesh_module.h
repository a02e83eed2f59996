// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "bone/remesh/remesh_request.h"
#include "core/plugin/loader.h"

namespace kerf::bone {

/// A plugin's library, opened to call its strategies: in `kerf-remesh` and in tests, never in a process that runs a
/// loop.
class RemeshModule {
public:
    /// Opens a library. Null on failure; then `error` has the reason.   [main]
    static std::unique_ptr<RemeshModule> open(const std::string& path, std::string& error);

    [[nodiscard]] const kerf_entry& entry() const noexcept { return plugin_->entry(); }
    /// Returns a strategy by its id without the plugin's id; null if the plugin has no such strategy.
    [[nodiscard]] const kerf_component* find(const std::string& strategy) const noexcept;

private:
    explicit RemeshModule(std::shared_ptr<Plugin> plugin) : plugin_(std::move(plugin)) {}
    std::shared_ptr<Plugin> plugin_;
};

/// Calls a strategy with its own arenas and its default parameters.   [main, worker]
[[nodiscard]] RemeshResult remesh_here(const kerf_component& strategy, const RemeshRequest& request,
                                       void* cache = nullptr);

}  // namespace kerf::bone
