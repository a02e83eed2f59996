// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/field/grid/kernel/block_kernel.h"
#include "kerf/math.hpp"

/// Poses as matrices with an offset. For many points they are cheaper than quaternions, and they can scale.
namespace kerf {

[[nodiscard]] inline Frame frame_of(const Pose& a_from_b) noexcept {
    const Quat& q = a_from_b.rotation;
    return {rotate(q, {1, 0, 0}), rotate(q, {0, 1, 0}), rotate(q, {0, 0, 1}), a_from_b.position};
}

/// Returns the point in frame a: a_from_b * point_in_b. Block queries add in the same order, so they give the same
/// bits.
[[nodiscard]] constexpr Vec3 operator*(const Frame& f, Vec3 p) noexcept {
    return {((f.x.x * p.x + f.y.x * p.y) + f.z.x * p.z) + f.origin.x,
            ((f.x.y * p.x + f.y.y * p.y) + f.z.y * p.z) + f.origin.y,
            ((f.x.z * p.x + f.y.z * p.y) + f.z.z * p.z) + f.origin.z};
}

/// Rotates a direction from frame b to a (`turned`), or from a to b (`turned_back`). Pre: the frame does not scale.
[[nodiscard]] constexpr Vec3 turned(const Frame& a_from_b, Vec3 v) noexcept {
    return v.x * a_from_b.x + v.y * a_from_b.y + v.z * a_from_b.z;
}
[[nodiscard]] constexpr Vec3 turned_back(const Frame& a_from_b, Vec3 v) noexcept {
    return {dot(a_from_b.x, v), dot(a_from_b.y, v), dot(a_from_b.z, v)};
}

[[nodiscard]] inline SingleFrame single(const Frame& f) noexcept {
    const auto of = [](double v) { return static_cast<float>(v); };
    return {{{of(f.x.x), of(f.x.y), of(f.x.z)}, {of(f.y.x), of(f.y.y), of(f.y.z)}, {of(f.z.x), of(f.z.y), of(f.z.z)}},
            {of(f.origin.x), of(f.origin.y), of(f.origin.z)}};
}

/// Returns the frame that maps a point p to scale (f * p − from).
[[nodiscard]] constexpr Frame scaled_from(const Frame& f, Vec3 from, double scale) noexcept {
    return {scale * f.x, scale * f.y, scale * f.z, scale * (f.origin - from)};
}

}  // namespace kerf
