// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace kerf {

/// The owners of a procedure's zones and steps: indices of the bodies with which they move.
struct Owners {
    std::vector<std::size_t> zone;  ///< one for each zone of the anatomy
    std::vector<std::size_t> step;  ///< one for the frame of each step
};

}  // namespace kerf
