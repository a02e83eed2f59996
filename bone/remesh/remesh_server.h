// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace kerf::bone {

/// Runs `kerf-remesh`: opens a module and answers requests on the descriptors of `remesh_channel` until its parent
/// exits. Returns the exit status.   [main]
/// @param before, after  called around each call of the strategy
int serve_remeshing(const std::string& module, const std::string& strategy, void (*before)() noexcept,
                    void (*after)() noexcept);

}  // namespace kerf::bone
