// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drill_cutting.h"
#include "hole_line.h"
#include "kerf/contact_points.hpp"

/// Contact without cutting: the shank always, and the tip while it does not cut.
namespace kerf::drilling {

/// Returns the points at which the drill may touch bone. `removes` is true while the tip removes or crushes bone.
/// [haptic, nonblocking]
[[nodiscard]] ContactPoints touching_points(const TwistDrill& drill, const DrillParameters& law, const BoneQuery& bone,
                                            bool removes) noexcept;

/// Contact forces in a tick [N].
struct Carried {
    double by_shank = 0.0;  ///< normal force on the shank, summed around it
    double by_tip = 0.0;    ///< on the still tip

    Carried() = default;
    explicit Carried(const Advance& advance) noexcept;
};

/// Adds contact channels, as many as fit, and friction: along the shaft for the force on the shank in the last law, and
/// across it for the force on the tip.
///
/// The tool is smooth and pushes along its own normal, so a ledge in a hole's wall cannot stop a round shank.
/// @return true if the shank no longer fits into its hole, so that only the hole's line defines where the wall is
/// [haptic, nonblocking]
bool add_contact(const TwistDrill& drill, const ContactPoints& points, const DrillParameters& law,
                 const BoneQuery& bone, const Turning& turning, const HoleLine& hole, const Carried& last,
                 Channels& channels) noexcept;

}  // namespace kerf::drilling
