// SPDX-License-Identifier: Apache-2.0
#include "bone/measure/distance.h"

#include <cmath>

namespace kerf::bone {

double distance_between(Vec3 one, Vec3 other) noexcept { return length(other - one); }

double distance_between(Vec3 point, const Line& line) noexcept { return length(point - nearest_on(line, point)); }

double distance_between(Vec3 point, const Plane& plane) noexcept {
    return std::abs(dot(point - plane.point, plane.normal));
}

double distance_between(const Line& one, const Line& other) noexcept {
    constexpr double min_sine = 1e-9;
    const Vec3 across = cross(one.direction, other.direction);
    const double sine = length(across);
    if (!(sine > min_sine)) return distance_between(other.point, one);
    return std::abs(dot(other.point - one.point, across)) / sine;
}

}  // namespace kerf::bone
