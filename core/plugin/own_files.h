// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/plugin/process_state.h"

namespace kerf {

/// Descriptors that the host has open for its own and watches: a plugin that closes or replaces one breaks a file of
/// the host. The files count from `watch` to `release`.   [main]
class OwnFiles {
public:
    OwnFiles() = default;
    ~OwnFiles() { release(); }
    OwnFiles(const OwnFiles&) = delete;
    OwnFiles& operator=(const OwnFiles&) = delete;

    /// Watches the descriptors that this process has open now on these files.
    void watch(const std::vector<std::string>& paths);
    /// Stops watching. Call it before the files are closed.
    void release() noexcept;
};

/// Returns the first watched descriptor that was closed or replaced.   [any]
[[nodiscard]] StateChange change_of_own_files() noexcept;

}  // namespace kerf
