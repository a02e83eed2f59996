// SPDX-License-Identifier: Apache-2.0
#include "bone/measure/angle.h"

#include <cmath>

namespace kerf::bone {
namespace {

constexpr double min_sine = 1e-6;  // below it two directions are parallel

}  // namespace

// The arctangent is exact near 0 and π, unlike the arccosine of a rounded product.
double angle_between(const Line& one, const Line& other) noexcept {
    return std::atan2(length(cross(one.direction, other.direction)), dot(one.direction, other.direction));
}

double angle_between(const Line& line, const Plane& plane) noexcept {
    return std::atan2(std::abs(dot(line.direction, plane.normal)), length(cross(line.direction, plane.normal)));
}

double angle_between(const Plane& one, const Plane& other) noexcept {
    return std::atan2(length(cross(one.normal, other.normal)), std::abs(dot(one.normal, other.normal)));
}

std::optional<Line> projected_onto(const Plane& view, const Line& line) noexcept {
    const Vec3 in_view = line.direction - dot(line.direction, view.normal) * view.normal;
    if (!(length(in_view) > min_sine)) return std::nullopt;
    return Line{nearest_on(view, line.point), normalized(in_view)};
}

std::optional<Line> projected_onto(const Plane& view, const Plane& plane) noexcept {
    const Vec3 trace = cross(view.normal, plane.normal);
    const double sine = length(trace);
    if (!(sine > min_sine)) return std::nullopt;
    // From the plane's point to the view, along the plane's steepest direction.
    const Vec3 down = normalized(cross(plane.normal, trace));
    const double per_length = dot(down, view.normal);
    return Line{plane.point - dot(plane.point - view.point, view.normal) / per_length * down, trace / sine};
}

}  // namespace kerf::bone
