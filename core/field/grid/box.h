// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <limits>

#include "kerf/math.hpp"

namespace kerf {

/// A box along the axes of a frame. Its user defines unit and frame.
struct Box {
    Vec3 low{}, high{};
};
/// A box that contains no point. `joined` with another one gives the other.
inline constexpr Box empty_box{Vec3{1, 1, 1} * std::numeric_limits<double>::infinity(),
                               Vec3{-1, -1, -1} * std::numeric_limits<double>::infinity()};
/// Returns the smallest box that contains both.   [any] pure.
[[nodiscard]] inline Box joined(const Box& a, const Box& b) noexcept {
    return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y), std::min(a.low.z, b.low.z)},
            {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y), std::max(a.high.z, b.high.z)}};
}
[[nodiscard]] inline Box joined(const Box& box, Vec3 p) noexcept { return joined(box, Box{p, p}); }
/// Returns the box grown by `margin` on every side.   [any] pure.
[[nodiscard]] inline Box grown(const Box& box, double margin) noexcept {
    const Vec3 around{margin, margin, margin};
    return {box.low - around, box.high + around};
}
/// Returns whether two boxes have a point in common.   [any] pure.
[[nodiscard]] inline bool meet(const Box& a, const Box& b) noexcept {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
           a.low.z <= b.high.z && b.low.z <= a.high.z;
}

}  // namespace kerf
