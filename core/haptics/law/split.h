// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/math.hpp"

namespace kerf {

/// One value for directions across the tool's shaft and one along it. For rotations: one about lines across the shaft
/// and one about the shaft itself.
struct Split {
    double across = 0.0, along = 0.0;

    constexpr Split() = default;
    constexpr Split(double both)
        : across(both), along(both) {}  // NOLINT(google-explicit-constructor): a number applies to all directions
    constexpr Split(double is_across, double is_along) : across(is_across), along(is_along) {}
};

[[nodiscard]] constexpr Split operator*(double s, Split v) noexcept { return {s * v.across, s * v.along}; }
[[nodiscard]] constexpr Split operator+(Split a, Split b) noexcept { return {a.across + b.across, a.along + b.along}; }
[[nodiscard]] constexpr Split operator/(Split a, Split b) noexcept { return {a.across / b.across, a.along / b.along}; }

/// Returns a tool-frame vector with its parts across and along the shaft multiplied by the two values.
[[nodiscard]] constexpr Vec3 operator*(Split s, Vec3 v) noexcept {
    return {s.across * v.x, s.across * v.y, s.along * v.z};
}
/// Returns `v`, shortened to the length `limit` if it is longer.   [any] pure.
[[nodiscard]] inline Vec3 clamped(Vec3 v, double limit) noexcept {
    const double size = length(v);
    return size > limit ? (limit / size) * v : v;
}
/// Returns `v`, tool frame, with its parts across and along the shaft clamped separately. So the clamped force of a
/// damper that differs across and along is still the gradient of a function. Clamped by its length it would not be.
/// [any] pure.
[[nodiscard]] inline Vec3 clamped(Vec3 v, Split limit) noexcept {
    const Vec3 across = clamped(Vec3{v.x, v.y, 0.0}, limit.across);
    return {across.x, across.y, v.z > limit.along ? limit.along : v.z < -limit.along ? -limit.along : v.z};
}

}  // namespace kerf
