// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "kerf/math.hpp"

/// Distances to superellipses and superellipsoids.
namespace kerf::documents {

/// A function of points that is 1 on a curve or surface, and in proportion to the distance from the middle.
struct Level {
    double value = 0.0;  ///< [–]
    Vec3 gradient{};     ///< [1/m]
};

/// x^e for x ≥ 0.
[[nodiscard]] inline double power(double x, double e) noexcept {
    return e == 2.0 ? x * x : x > 0.0 ? std::pow(x, e) : 0.0;
}

/// |x/a|^e + |y/b|^e = 1 in the plane z = 0.
struct Superellipse {
    double half_width, half_height;  ///< [m] a, where y = 0, and b
    double exponent;                 ///< [–] e
    double taper = 0.0;              ///< [–] a is smaller by this part at y = b, and larger at y = −b

    /// Pre: z = 0.   [any] pure
    [[nodiscard]] Level at(Vec3 p) const noexcept {
        constexpr double narrowest = 0.1;  // [–] of a: a tapered width ends above the curve
        const double tapered = 1.0 - taper * p.y / half_height, width = half_width * std::max(tapered, narrowest);
        const double x = std::abs(p.x) / width, y = std::abs(p.y) / half_height, larger = std::max(x, y);
        if (larger <= 0.0) return {};
        // In units of the larger one, so that one power is 1.
        const double u = x / larger, v = y / larger;
        const double pu = u < 1.0 ? power(u, exponent) : 1.0, pv = v < 1.0 ? power(v, exponent) : 1.0, sum = pu + pv;
        const double level = exponent == 2.0 ? std::sqrt(sum) : std::pow(sum, 1.0 / exponent);
        const double rest = level / sum;  // level^(1 − e)
        const double gx = u > 0.0 ? std::copysign(rest * pu / u / width, p.x) : 0.0;
        const double gy = v > 0.0 ? std::copysign(rest * pv / v / half_height, p.y) : 0.0;
        const double by_taper =
            tapered > narrowest ? larger * rest * pu * taper * half_width / (half_height * width) : 0.0;
        return {larger * level, {gx, gy + by_taper, 0.0}};
    }
    [[nodiscard]] double smallest() const noexcept { return std::min(half_width, half_height); }
    [[nodiscard]] double largest() const noexcept { return std::max(half_width, half_height); }
    /// The smallest half axis, towards the side of a point.
    [[nodiscard]] Vec3 across(Vec3 p) const noexcept {
        return half_width < half_height ? Vec3{std::copysign(half_width, p.x), 0, 0}
                                        : Vec3{0, std::copysign(half_height, p.y), 0};
    }
};

/// |x/a|^e + |y/b|^e + |z/c|^e = 1.
struct Superellipsoid {
    Vec3 half{};  ///< [m] a, b and c
    double exponent = 2.0;

    [[nodiscard]] Level at(Vec3 p) const noexcept {
        const Vec3 q{std::abs(p.x) / half.x, std::abs(p.y) / half.y, std::abs(p.z) / half.z};
        const Vec3 powers{power(q.x, exponent), power(q.y, exponent), power(q.z, exponent)};
        const double sum = powers.x + powers.y + powers.z;
        if (sum <= 0.0) return {};
        const double level = exponent == 2.0 ? std::sqrt(sum) : std::pow(sum, 1.0 / exponent);
        const double rest = level / sum;
        const auto slope = [&](double power_of_one, double one, double half_axis, double coordinate) {
            return one > 0.0 ? std::copysign(rest * power_of_one / one / half_axis, coordinate) : 0.0;
        };
        return {
            level,
            {slope(powers.x, q.x, half.x, p.x), slope(powers.y, q.y, half.y, p.y), slope(powers.z, q.z, half.z, p.z)}};
    }
    [[nodiscard]] double smallest() const noexcept { return std::min({half.x, half.y, half.z}); }
    [[nodiscard]] double largest() const noexcept { return std::max({half.x, half.y, half.z}); }
    [[nodiscard]] Vec3 across(Vec3 p) const noexcept {
        const double r = smallest();
        return half.x <= r   ? Vec3{std::copysign(r, p.x), 0, 0}
               : half.y <= r ? Vec3{0, std::copysign(r, p.y), 0}
                             : Vec3{0, 0, std::copysign(r, p.z)};
    }
};

/// A point of a curve or surface near a point.
struct NearestOn {
    Vec3 at{}, normal{};
    double distance = 0.0;  ///< [m] signed, negative inside
};

/// Returns the point of a superquadric near `p`, found from `start`: by steps along gradients onto the surface, and
/// along the surface until the line to `p` is at right angles to it. `distance` is not signed.   [any] pure
template <class Quadric>
[[nodiscard]] NearestOn foot_on(const Quadric& quadric, Vec3 p, Vec3 start, Level here) noexcept {
    constexpr int slides = 2;
    Vec3 at = start, last_slide{}, normal{};
    for (int step = 0; step <= slides + 1; ++step) {
        if (step > 0) here = quadric.at(at);
        const double steepness = length(here.gradient);
        if (steepness <= 0.0) break;
        normal = (1.0 / steepness) * here.gradient;
        const Vec3 landed = ((1.0 - here.value) / steepness) * normal;
        const Vec3 to = p - at, beside = to - dot(to, normal) * normal;
        constexpr double upright = 0.1;  // [–] sine of an angle to the normal that changes the distance by 0.5 %
        const bool is_upright = step > 0 && dot(beside, beside) <= upright * upright * dot(to, to);
        if (is_upright) return {at + landed, normal, length(p - at - landed)};
        if (step == 0 || step > slides) {
            at = at + landed;
            continue;
        }
        // A slide errs by the curvature. What is left of the first gives the length of the second.
        const double square = dot(last_slide, last_slide);
        const double left = square > 0.0 ? std::clamp(dot(beside, last_slide) / square, -4.0, 0.9) : 0.0;
        last_slide = beside;
        at = at + landed + (1.0 / (1.0 - left)) * beside;
    }
    return {at, normal, length(p - at)};
}

/// Returns the point of a superquadric that is nearest to `p`. In the middle itself the distance is minus the smallest
/// half axis. Farther than `limit` away, the distance may be too small, but not smaller than `limit` [m].   [any] pure
template <class Quadric>
[[nodiscard]] NearestOn nearest_on(const Quadric& quadric, Vec3 p, double limit) noexcept {
    const Level here = quadric.at(p);
    const double steepness = length(here.gradient);
    if (steepness <= 0.0) return {p, {0, 0, 1}, -quadric.smallest()};
    // Lower bounds, as the level is a convex function and in proportion to the distance from the middle.
    const double bound = here.value >= 1.0 ? (here.value - 1.0) / steepness : (here.value - 1.0) * quadric.smallest();
    if (std::abs(bound) > limit) return {p, (1.0 / steepness) * here.gradient, bound};
    NearestOn nearest = foot_on(quadric, p, p, here);
    if (here.value >= 1.0) return nearest;
    // Deeper than the smallest radius of curvature, the gradient may lead along the body although its wall across is
    // nearer.
    if (nearest.distance > 0.3 * quadric.smallest() * quadric.smallest() / quadric.largest()) {
        const Vec3 start = p + quadric.across(p);
        const NearestOn other = foot_on(quadric, p, start, quadric.at(start));
        if (other.distance < nearest.distance) nearest = other;
    }
    nearest.distance = -nearest.distance;
    return nearest;
}

}  // namespace kerf::documents
