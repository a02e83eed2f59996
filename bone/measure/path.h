// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "documents/solids.h"
#include "kerf/math.hpp"

namespace kerf::bone {

/// A part of a bone's border: the surface near the line from landmark to landmark.
struct Path {
    std::vector<Vec3> along;  ///< [m] at least two
    double within = 0.0;      ///< [m] largest distance from the line
};

/// Returns the distance of a point from the path's line [m].   [any] pure.
[[nodiscard]] double distance_to(const Path& path, Vec3 p) noexcept;
/// Returns the box around the region, widened by `margin` [m].   [any] pure.
[[nodiscard]] Box bounds_of(const Path& path, double margin = 0.0) noexcept;

}  // namespace kerf::bone
