// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>

#include "kerf/force.hpp"
#include "straight_blade.h"

/// Torque that twists a straight blade about its long axis, and its warning.
namespace kerf::sawing {

/// Returns the torque of the bone on the blade about its long axis, midway between its edges [N·m], along +x:
///
///     τ = Σ_i ((p_i − c) × f_i)_x = τ_tip,x + c_z F_y,    c = (0, 0, −height/2)
///
/// summed over all forces of cutting edge, sides and back edge. A force across the blade at its long axis pushes it
/// aside and does not twist it.   [haptic, nonblocking]
///
/// Source: the arm of each contact times its force, cutting edge and back edge together, as [mandibular-angle]
/// equations (4) to (6). These use the part of the forces in the plane of the blade, whose moment has no component
/// along the blade. Ours is the moment about the long axis, which twists the blade.
[[nodiscard]] inline double blade_torque(const Advance& advance, const StraightBlade& blade) noexcept {
    double side_force = advance.following[1], about_tip = advance.following[3];
    for (std::size_t c = 0; c < advance.channel.size(); ++c) {
        side_force -= advance.channel[c].d[1] * advance.lambda[c];
        about_tip -= advance.channel[c].d[3] * advance.lambda[c];
    }
    return about_tip + blade.middle_z() * side_force;
}

/// Watches the torque's threshold and measures how long it is exceeded.
struct TwistWatch {
    static constexpr double armed_below = 0.8;  ///< [–] of the threshold; below it the warning re-arms

    bool is_armed = true;
    double in_bone = 0.0;  ///< [s] in bone
    double above = 0.0;    ///< [s] in bone with more than the threshold

    /// Advances by `dt` [s]. Returns whether to warn: once each time that the torque rises above the threshold.
    bool step(double torque, double threshold, bool is_in_bone, double dt) noexcept {
        const double size = std::abs(torque);
        if (is_in_bone) {
            in_bone += dt;
            above += size > threshold ? dt : 0.0;
        }
        if (size < armed_below * threshold) is_armed = true;
        if (!is_armed || !(size > threshold)) return false;
        is_armed = false;
        return true;
    }
    [[nodiscard]] double exceedance() const noexcept { return in_bone > 0.0 ? above / in_bone : 0.0; }  ///< [–] 0 … 1
};

}  // namespace kerf::sawing
