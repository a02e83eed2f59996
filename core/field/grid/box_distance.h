// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "core/field/grid/box.h"

namespace kerf {

/// Returns the distance from a point to a box; 0 inside.   [any] pure.
[[nodiscard]] inline double distance_to(const Box& box, Vec3 p) noexcept {
    return length(Vec3{std::max({box.low.x - p.x, p.x - box.high.x, 0.0}),
                       std::max({box.low.y - p.y, p.y - box.high.y, 0.0}),
                       std::max({box.low.z - p.z, p.z - box.high.z, 0.0})});
}

}  // namespace kerf
