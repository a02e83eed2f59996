// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "kerf/math.hpp"

/// The hole that a land stands in, as it has cut it itself.
namespace kerf::drilling {

/// How far the land is from the middle of its hole, across the shaft; tool frame [m]. In its play it goes free; beyond
/// it it cuts, and the middle comes along. What it cuts anew, farther ahead, lies where it is.
struct OwnHole {
    double x = 0.0, y = 0.0;

    /// The tool has moved by `rate` for `dt` [s]; meanwhile its front went `advance` ≥ 0 [m] into bone.
    /// @param z, length, play  of the land [m]: where it is, how long, how far inside its hole; length > 0   [any] pure
    /// but for itself.
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
    /// How far it has gone along `way`, a unit vector across the shaft [m]: so much less is left of its play there.
    [[nodiscard]] double along(Vec3 way) const noexcept { return x * way.x + y * way.y; }
};

}  // namespace kerf::drilling
