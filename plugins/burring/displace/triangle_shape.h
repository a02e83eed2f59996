// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "half_edges.h"

namespace kerf::burring::displacement {

using Corners = std::array<Vec3, 3>;  ///< of a triangle [m]

[[nodiscard]] inline Corners corners_of(const HalfEdges& mesh, HalfEdges::FaceHandle face) {
    Corners c{};
    std::size_t n = 0;
    for (const auto v : mesh.fv_range(face)) c[n++] = position(mesh, v);
    return c;
}

/// Returns the unit normal; zero if the triangle has no area.
[[nodiscard]] inline Vec3 normal_of(const Corners& c) noexcept { return normalized(cross(c[1] - c[0], c[2] - c[0])); }

/// Returns the cotangent of the smallest angle; infinite if the triangle has no area.
[[nodiscard]] inline double worst_cotangent(const Corners& c) noexcept {
    const double twice_area = length(cross(c[1] - c[0], c[2] - c[0]));
    if (!(twice_area > 0.0)) return HUGE_VAL;
    double most = -HUGE_VAL;
    for (std::size_t i = 0; i < 3; ++i)
        most = std::max(most, dot(c[(i + 1) % 3] - c[i], c[(i + 2) % 3] - c[i]) / twice_area);
    return most;
}

/// Returns the height over the longest side [m].
[[nodiscard]] inline double height_of(const Corners& c) noexcept {
    return length(cross(c[1] - c[0], c[2] - c[0])) /
           std::max({length(c[1] - c[0]), length(c[2] - c[1]), length(c[0] - c[2])});
}

}  // namespace kerf::burring::displacement
