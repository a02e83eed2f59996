// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "kerf/math.hpp"

namespace kerf {

/// The box in which a body can be cut, body frame [m]. Outside, bone continues as at the nearest point of the box, and
/// cannot be cut. A region without bounds contains everything; then the grid contains all of the bone.
struct Region {
    static constexpr double nowhere = std::numeric_limits<double>::infinity();
    Vec3 low{-nowhere, -nowhere, -nowhere}, high{nowhere, nowhere, nowhere};

    [[nodiscard]] bool is_bounded() const noexcept { return is_finite(low) && is_finite(high); }
    [[nodiscard]] bool is_everywhere() const noexcept {
        return low == Vec3{-nowhere, -nowhere, -nowhere} && high == Vec3{nowhere, nowhere, nowhere};
    }
    /// Returns whether a point is strictly inside. Points on a face are not: they cannot be cut.
    [[nodiscard]] bool contains(Vec3 p) const noexcept {
        return p.x > low.x && p.y > low.y && p.z > low.z && p.x < high.x && p.y < high.y && p.z < high.z;
    }
    /// Returns whether a box and the region have a point in common.
    [[nodiscard]] bool meets(Vec3 box_low, Vec3 box_high) const noexcept {
        return box_high.x >= low.x && box_high.y >= low.y && box_high.z >= low.z && box_low.x <= high.x &&
               box_low.y <= high.y && box_low.z <= high.z;
    }
    /// Returns the nearest point of the region. NaN stays NaN.   [any] pure, nonblocking.
    [[nodiscard]] Vec3 nearest(Vec3 p) const noexcept {
        return {std::clamp(p.x, low.x, high.x), std::clamp(p.y, low.y, high.y), std::clamp(p.z, low.z, high.z)};
    }
    /// Returns the distance of a point to the region [m]; 0 inside, and for NaN, so that NaN causes no force.
    /// [any] pure, nonblocking.
    [[nodiscard]] double distance_outside(Vec3 p) const noexcept {
        // In this order of arguments NaN counts as 0.
        const auto beyond = [](double a, double from, double to) { return std::max(std::max(0.0, from - a), a - to); };
        return length({beyond(p.x, low.x, high.x), beyond(p.y, low.y, high.y), beyond(p.z, low.z, high.z)});
    }
};

}  // namespace kerf
