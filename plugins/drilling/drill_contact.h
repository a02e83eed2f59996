// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "drill_cutting.h"
#include "hole_line.h"
#include "kerf/contact_points.hpp"

/// Where the drill touches without cutting: the shank always, the tip as far as it does not cut.
namespace kerf::drilling {

/// Where the drill may touch, while it takes bone or as it is else.   [haptic, nonblocking]
[[nodiscard]] ContactPoints touching_points(const TwistDrill& drill, const DrillParameters& law, const BoneQuery& bone,
                                            bool removes) noexcept;

/// What contact carried in a tick [N].
struct Carried {
    double by_shank = 0.0;  ///< across it, all around together
    double by_tip = 0.0;    ///< that stood

    Carried() = default;
    explicit Carried(const Advance& advance) noexcept;
};

/// As many contact channels as the law has room for; friction along the shaft for what the shank carried in the last
/// law, and across it for what the tip did. Whether the drill no longer fits into its hole: so bent that only the
/// hole's line may know where its wall is.
///
/// The tool is smooth, so it pushes along its own normal: a ledge in the wall of a hole cannot hold a round shank back.
/// [haptic, nonblocking]
bool add_contact(const TwistDrill& drill, const ContactPoints& points, const DrillParameters& law,
                 const BoneQuery& bone, const Turning& turning, const HoleLine& hole, const Carried& last,
                 Channels& channels) noexcept;

}  // namespace kerf::drilling
