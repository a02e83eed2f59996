// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/math.hpp"

/// Lines and planes, in the frame of the points that define them: LPS [m].
namespace kerf::bone {

struct Line {
    Vec3 point{};      ///< [m] on the line
    Vec3 direction{};  ///< unit
};

struct Plane {
    Vec3 point{};   ///< [m] in the plane
    Vec3 normal{};  ///< unit
};

/// Returns the point of a line nearest to `p`.   [any] pure.
[[nodiscard]] inline Vec3 nearest_on(const Line& line, Vec3 p) noexcept {
    return line.point + dot(p - line.point, line.direction) * line.direction;
}
/// Returns the point of a plane nearest to `p`.   [any] pure.
[[nodiscard]] inline Vec3 nearest_on(const Plane& plane, Vec3 p) noexcept {
    return p - dot(p - plane.point, plane.normal) * plane.normal;
}

}  // namespace kerf::bone
