// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace kerf {

/// The owner of each zone and step of a procedure: the body with which it moves.
struct Owners {
    std::vector<std::size_t> zone;  ///< for each of the anatomy's zones
    std::vector<std::size_t> step;  ///< for the frame of each step
};

}  // namespace kerf
