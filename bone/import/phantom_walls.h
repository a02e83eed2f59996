// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "bone/surface/thickness.h"
#include "core/field/grid/grid.h"

namespace kerf {

/// How thick the bone of a phantom is under its surface, straight inwards, looked at once a sample of the grid;
/// thicknesses beyond `most` [m] count as infinite. Left out is a crest, as `measure_walls` does.
/// @param distance   body frame [m] → [m], negative inside, never steeper than 1   [main] pure.
[[nodiscard]] std::vector<WallSample> phantom_walls(const Grid& grid, const std::function<double(Vec3)>& distance,
                                                    double most);

}  // namespace kerf
