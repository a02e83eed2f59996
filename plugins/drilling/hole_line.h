// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/math.hpp"

/// The middle line of a hole, for a shank that has left it.
namespace kerf::drilling {

/// The hole's middle line in the tool frame: (x + along_x z, y + along_y z) [m], [–]. It is the tool's own axis when
/// the shank last fitted, and then stays fixed in the bone. Tilts are small.
struct HoleLine {
    double x = 0.0, y = 0.0, along_x = 0.0, along_y = 0.0;

    /// Updates the line after the tool has moved at `rate` [m/s, rad/s] for `dt` [s].   [any]
    void move(const Vec6& rate, double dt) noexcept {
        const double turn = rate[5] * dt;
        const HoleLine before = *this;
        x += (before.along_x * rate[2] - rate[0]) * dt + turn * before.y;
        y += (before.along_y * rate[2] - rate[1]) * dt - turn * before.x;
        along_x += turn * before.along_y - rate[4] * dt;
        along_y += rate[3] * dt - turn * before.along_x;
    }
    /// Returns the distance [m] of a point of the tool from the line, along the unit vector `outwards`.
    [[nodiscard]] double offset(Vec3 at, Vec3 outwards) const noexcept {
        return -((x + along_x * at.z) * outwards.x + (y + along_y * at.z) * outwards.y);
    }
};

}  // namespace kerf::drilling
