// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "bone/surface/thickness.h"
#include "core/field/grid/grid.h"

namespace kerf::bone {

/// Returns the thickness of a phantom's bone under its surface, straight inwards, once for each grid sample at the
/// surface; thicknesses beyond `most` [m] count as infinite. Crests are left out, as in `measure_walls`.
/// @param distance  body frame [m] → [m], negative inside, never steeper than 1   [main] pure.
[[nodiscard]] std::vector<WallSample> phantom_walls(const Grid& grid, const std::function<double(Vec3)>& distance,
                                                    double most);

}  // namespace kerf::bone
