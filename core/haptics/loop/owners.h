// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace kerf {

/// The body that each thing of the anatomy belongs to and moves with.
struct Owners {
    std::vector<std::size_t> zone;  ///< of each of the anatomy's zones
    std::vector<std::size_t> step;  ///< of the frame of each step
};

}  // namespace kerf
