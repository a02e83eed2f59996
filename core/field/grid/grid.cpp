// SPDX-License-Identifier: Apache-2.0
#include "core/field/grid/grid.h"

#include <cmath>

#include "kerf/assert.hpp"

namespace kerf {

Grid Grid::covering(Vec3 low, Vec3 high, double spacing) {
    KERF_ASSERT(spacing > 0.0, "give a spacing in metres");
    const auto bricks_for = [&](double extent) {
        return static_cast<int>(std::ceil(extent / (spacing * brick_edge))) + 1;
    };
    return {.bricks = {bricks_for(high.x - low.x), bricks_for(high.y - low.y), bricks_for(high.z - low.z)},
            .spacing = spacing,
            .origin = low};
}

}  // namespace kerf
