// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "bone/surface/thickness.h"
#include "core/field/grid/distance_source.h"
#include "core/field/grid/grid.h"
#include "core/field/grid/level_set.h"

namespace kerf::bone {

/// Returns the thickness of a phantom's bone under its surface, straight inwards, once for each grid sample at the
/// surface; thicknesses beyond `limit` [m] count as infinite. Crests are left out, as in `measure_walls`. Where the
/// field shows that the bone is thick, the exact distance is not sampled.
/// Pre: `field` was built of `distance`; `limit` is at most its clamp.   [main]
[[nodiscard]] std::vector<WallSample> phantom_walls(const LevelSet& field, DistanceSource& distance, double limit);

/// The same for a function. @param distance  body frame [m] → [m], negative inside, never steeper than 1   [main]
[[nodiscard]] inline std::vector<WallSample> phantom_walls(const Grid& grid, std::function<double(Vec3)> distance,
                                                           double limit) {
    FunctionDistance source(std::move(distance));
    return phantom_walls(LevelSet::build(grid, source), source, limit);
}

}  // namespace kerf::bone
