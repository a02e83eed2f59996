// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "hole_before.h"
#include "kerf/plugin.hpp"
#include "screw_parameters.h"
#include "screw_thread.h"
#include "thread_track.h"

namespace kerf::implant {

/// The sample points of a thread, prepared once and sampled in each tick.
struct ThreadPoints {
    int count = 0;
    std::array<Vec3, max_pieces> direction{};  ///< unit direction from the axis [–], and z [m]
    std::array<double, max_pieces> outer{};    ///< [m] radius over the crest
    std::array<double, max_pieces> core{};     ///< [m] radius of the core
    std::array<double, max_pieces> grip{};     ///< [m] length along the shaft

    double piece = 0.0;  ///< [m] spacing along the shaft

    ThreadPoints() = default;
    explicit ThreadPoints(const ScrewThread& thread) noexcept;
    /// Returns the shift of the points along their helix [m], less than half of a piece. With it the points stay fixed
    /// in the bone while the tool turns in its thread.
    [[nodiscard]] double moved_in(const ThreadTrack& track) const noexcept;
};

/// Forces and stiffness of the bone around a thread.
struct BoneThread {
    double rubbing = 0.0;        ///< [N·m] friction torque of the bone that presses on the thread
    double strength = 0.0;       ///< [N] along the shaft at which it slips, reduced by earlier slip
    double stiffness = 0.0;      ///< [N/m] along the shaft
    double engaged = 0.0;        ///< [m] of thread in bone
    double front = 0.0;          ///< [–] resistance of the bone at the flutes, relative to dense bone
    double leading = 0.0;        ///< [m] of z, end of the engaged part towards the tip
    double last = 0.0;           ///< [m] of z, its end towards the head
    double front_in_bone = 0.0;  ///< [–] bone fraction in the quarter turn behind `leading`
    double left = 1.0;           ///< [–] remaining fraction of its strength
    double lost = 0.0;           ///< [m] slip of the bone that carries it, averaged by strength
    double bite = 0.0;           ///< [–] depth of its crests in bone, relative to the full one, averaged by strength
    double blocked = 0.0;        ///< [N] along the shaft that pushes crests through bone without a groove
    double pressed = 0.0;        ///< [N] across the shaft that crushes the bone
    double middle = 0.0;         ///< [m] of z, stiffness-weighted middle of the engaged part
    double spread = 0.0;         ///< [m] of the engaged part about `middle`, root mean square
    std::int32_t body = -1;      ///< number of the bone's body

    BoneThread(const ThreadPoints& thread_points, const ScrewThread& thread, const ThreadTrack& track,
               const HoleBefore& hole, const ScrewParameters& law, const BoneQuery& bone) noexcept;
};

}  // namespace kerf::implant
