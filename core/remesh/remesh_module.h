// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "core/remesh/remesh_request.h"

namespace kerf {

/// A module with remeshing strategies. Opened in `kerf-remesh`, and in tests; never in a process that runs a loop.
class RemeshModule {
public:
    /// Null: why not is in `error`.   [main]
    static std::unique_ptr<RemeshModule> open(const std::string& path, std::string& error);
    ~RemeshModule();
    RemeshModule(const RemeshModule&) = delete;
    RemeshModule& operator=(const RemeshModule&) = delete;

    [[nodiscard]] const kerf_remesh_module& entry() const noexcept { return *entry_; }
    /// Null: it has no such strategy.
    [[nodiscard]] const kerf_remesher* find(const std::string& strategy) const noexcept;

private:
    RemeshModule(void* handle, const kerf_remesh_module* entry) : handle_(handle), entry_(entry) {}
    void* handle_;
    const kerf_remesh_module* entry_;
};

/// Calls a strategy on arenas of its own.   [main, worker]
[[nodiscard]] RemeshResult remesh_here(const kerf_remesher& remesher, const RemeshRequest& request,
                                       void* cache = nullptr);

}  // namespace kerf
