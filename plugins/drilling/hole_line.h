// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/math.hpp"

/// Where the hole of a shank is that has been pulled out of its middle.
namespace kerf::drilling {

/// The middle line of the hole, seen from the tool:  (x + along_x z, y + along_y z)  [m], [–]. It is the tool's own
/// axis when the shank last fitted into it, and stays where it is in the bone. Small tilts.
struct HoleLine {
    double x = 0.0, y = 0.0, along_x = 0.0, along_y = 0.0;

    /// The tool has moved by `rate` for `dt` [s].   [any] pure but for itself.
    void move(const Vec6& rate, double dt) noexcept {
        const double turn = rate[5] * dt;
        const HoleLine before = *this;
        x += (before.along_x * rate[2] - rate[0]) * dt + turn * before.y;
        y += (before.along_y * rate[2] - rate[1]) * dt - turn * before.x;
        along_x += turn * before.along_y - rate[4] * dt;
        along_y += rate[3] * dt - turn * before.along_x;
    }
    /// How far a place of the tool has come from the line along `outwards` [m].
    [[nodiscard]] double gone(Vec3 at, Vec3 outwards) const noexcept {
        return -((x + along_x * at.z) * outwards.x + (y + along_y * at.z) * outwards.y);
    }
};

}  // namespace kerf::drilling
