// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/math.hpp"

/// The slot the blade stands in, as it has cut it itself.
namespace kerf::sawing {

/// The middle plane of the slot, seen from the blade:  y = offset + along_x x + along_z z.
///
/// Points of the bone go backwards past the blade as it moves; what the teeth cut anew lies where the blade is. So the
/// slot is the blade's own plane over about the last two voxels it has cut, without the noise that sampled walls have:
/// binding is judged from it there, and from the bone farther back (B5). Small tilts.
struct OwnSlot {
    double offset = 0.0;   ///< [m]
    double along_x = 0.0;  ///< [–]
    double along_z = 0.0;  ///< [–]
    double depth = 0.0;    ///< [m] that the blade has cut since its teeth last were in air

    /// The blade has moved by `rate` for `dt` [s]; while it cut, its front went `advance` ≥ 0 [m] into bone, and the
    /// slot forgets over `memory` [m].   [any] pure but for itself.
    void move(const Vec6& rate, double dt, double advance, double memory) noexcept {
        const Vec3 v = linear(rate), w = angular(rate);
        offset += (along_x * v.x + along_z * v.z - v.y) * dt;
        along_x -= w.z * dt;
        along_z += w.x * dt;
        const double kept = advance < memory ? 1.0 - advance / memory : 0.0;
        offset *= kept;
        along_x *= kept;
        along_z *= kept;
        depth += advance;
    }
    /// Where its middle is at a place of the blade [m].
    [[nodiscard]] double middle(double x, double z) const noexcept { return offset + along_x * x + along_z * z; }
};

}  // namespace kerf::sawing
