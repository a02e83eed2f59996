// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "kerf/math.hpp"

/// The hole that a land has cut for itself.
namespace kerf::drilling {

/// Offset of a land from the middle of its hole, across the shaft; tool frame [m]. Within its play the land moves
/// freely. Beyond it the land cuts, and the middle follows. The hole that it cuts anew farther ahead is centred on it.
struct OwnHole {
    double x = 0.0, y = 0.0;

    /// Updates the offset after the tool has moved at `rate` for `dt` [s], while its front advanced `advance` ≥ 0 [m]
    /// in bone.
    /// @param z       [m] height of the land
    /// @param length  [m] of the land, > 0
    /// @param play    [m] between the land and its hole   [any]
    void move(const Vec6& rate, double dt, double advance, double z, double length, double play) noexcept {
        const double aside_x = rate[0] + rate[4] * z + rate[5] * y, aside_y = rate[1] - rate[3] * z - rate[5] * x;
        const double kept = std::max(0.0, 1.0 - advance / length);
        x = kept * (x + aside_x * dt);
        y = kept * (y + aside_y * dt);
        const double away = std::sqrt(x * x + y * y);
        if (away <= play) return;
        x *= play / away;
        y *= play / away;
    }
    /// Returns the offset [m] along a unit vector across the shaft. It is the used part of the play.
    [[nodiscard]] double along(Vec3 direction) const noexcept { return x * direction.x + y * direction.y; }
};

}  // namespace kerf::drilling
