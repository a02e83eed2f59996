// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/math.hpp"

/// The slot that the blade has cut for itself.
namespace kerf::sawing {

/// The middle plane of the slot in the blade's frame: y = offset + along_x x + along_z z.
///
/// Points of the bone move backwards past the blade as it moves. The slot that the teeth cut anew lies at the blade's
/// present plane. So the slot is the average plane of the blade over about the last two voxels of its cut, without the
/// noise of sampled walls. Binding uses this plane there, and the bone farther back. Tilts are small.
struct OwnSlot {
    double offset = 0.0;   ///< [m]
    double along_x = 0.0;  ///< [–]
    double along_z = 0.0;  ///< [–]
    double depth = 0.0;    ///< [m] cut by the blade since its teeth were last in air

    /// Updates the slot after the blade has moved at `rate` for `dt` [s]. While it cut, its front advanced `advance` ≥
    /// 0 [m] in bone. The average extends over `memory` [m].   [any]
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
    /// Returns the middle of the slot at a point of the blade [m].
    [[nodiscard]] double middle(double x, double z) const noexcept { return offset + along_x * x + along_z * z; }
};

}  // namespace kerf::sawing
