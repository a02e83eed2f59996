// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "kerf/math.hpp"

/// Squared distances of a point to boxes, segments and triangles [m²].   [any] pure.
namespace kerf::bone {

[[nodiscard]] inline double squared(Vec3 v) noexcept { return dot(v, v); }

[[nodiscard]] inline double squared_to_box(Vec3 p, Vec3 low, Vec3 high) noexcept {
    const auto beyond = [](double a, double from, double to) { return std::max(0.0, std::max(from - a, a - to)); };
    return squared({beyond(p.x, low.x, high.x), beyond(p.y, low.y, high.y), beyond(p.z, low.z, high.z)});
}

[[nodiscard]] inline double squared_to_segment(Vec3 p, Vec3 a, Vec3 b) noexcept {
    const Vec3 along = b - a;
    const double size = squared(along);
    const double share = size > 0.0 ? std::clamp(dot(p - a, along) / size, 0.0, 1.0) : 0.0;
    return squared(p - a - share * along);
}

/// The nearest feature follows from the region of the triangle's plane that contains the point: corner, side or inside.
[[nodiscard]] inline double squared_to_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c) noexcept {
    const Vec3 ab = b - a, ac = c - a, ap = p - a;
    const double ab_ab = dot(ab, ab), ab_ac = dot(ab, ac), ac_ac = dot(ac, ac);
    const double size = ab_ab * ac_ac - ab_ac * ab_ac;  // (2 × area)²
    // The plane of a needle is rounding noise. Its sides are sufficient.
    if (!(size > 1e-12 * ab_ab * ac_ac))
        return std::min({squared_to_segment(p, a, b), squared_to_segment(p, b, c), squared_to_segment(p, c, a)});
    const double ap_ab = dot(ap, ab), ap_ac = dot(ap, ac);
    const double u = ap_ab * ac_ac - ap_ac * ab_ac, v = ap_ac * ab_ab - ap_ab * ab_ac;  // along ab and ac, × size
    if (u >= 0.0 && v >= 0.0 && u + v <= size) return squared(ap - (u / size) * ab - (v / size) * ac);
    // Outside, the nearest point lies on a side that separates it from the triangle, or on a corner of two such sides.
    double least = HUGE_VAL;
    if (v < 0.0) least = squared_to_segment(p, a, b);
    if (u < 0.0) least = std::min(least, squared_to_segment(p, a, c));
    if (u + v > size) least = std::min(least, squared_to_segment(p, b, c));
    return least;
}

/// Returns the distance of a point to a triangle [m].
[[nodiscard]] inline double distance_to_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c) noexcept {
    return std::sqrt(squared_to_triangle(p, a, b, c));
}

}  // namespace kerf::bone
