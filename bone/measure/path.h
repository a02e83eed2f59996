// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "documents/solids.h"
#include "kerf/math.hpp"

namespace kerf {

/// A stretch of a bone's border: what lies near the way from landmark to landmark.
struct Path {
    std::vector<Vec3> along;  ///< [m] at least two
    double within = 0.0;      ///< [m] of the way
};

/// Returns the distance of a point from the way [m].   [any] pure.
[[nodiscard]] double distance_to(const Path& path, Vec3 p) noexcept;
/// Returns the box around all that is within `margin` [m] of the region.   [any] pure.
[[nodiscard]] Box bounds_of(const Path& path, double margin = 0.0) noexcept;

}  // namespace kerf
