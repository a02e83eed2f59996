// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/math.hpp"

namespace kerf {

/// A box along the axes of a frame. Its user defines unit and frame.
struct Box {
    Vec3 low{}, high{};
};
/// Returns whether two boxes have a point in common.   [any] pure.
[[nodiscard]] inline bool meet(const Box& a, const Box& b) noexcept {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
           a.low.z <= b.high.z && b.low.z <= a.high.z;
}

}  // namespace kerf
