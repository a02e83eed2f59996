// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "hole_before.h"
#include "kerf/plugin.hpp"
#include "screw_parameters.h"
#include "screw_thread.h"
#include "thread_track.h"

namespace kerf::implant {

/// A thread's places and what bone there is at them, prepared once and sampled in each tick.
struct ThreadPlaces {
    int count = 0;
    std::array<Vec3, most_pieces> way{};      ///< from the axis to each [–], and its z [m]
    std::array<double, most_pieces> outer{};  ///< [m] radius over its crest
    std::array<double, most_pieces> core{};   ///< [m] radius of the core there
    std::array<double, most_pieces> grip{};   ///< [m] along the shaft

    double piece = 0.0;  ///< [m] along the shaft from place to place

    ThreadPlaces() = default;
    explicit ThreadPlaces(const ScrewThread& thread) noexcept;
    /// How far the places are moved along their helix, so that they stay where they are in the bone while the tool
    /// turns in its thread [m]: less than half of a piece.
    [[nodiscard]] double moved_in(const ThreadTrack& track) const noexcept;
};

/// What the bone around a thread does to it.
struct BoneThread {
    double rubbing = 0.0;        ///< [N·m] torque of the bone that presses on it
    double strength = 0.0;       ///< [N] along the shaft before it slips, as far as it has not slipped yet
    double stiffness = 0.0;      ///< [N/m] along the shaft
    double engaged = 0.0;        ///< [m] of thread in bone
    double front = 0.0;          ///< [–] resistance of the bone at the flutes, in dense bone
    double leading = 0.0;        ///< [m] of z, the end towards the tip of what is in bone
    double last = 0.0;           ///< [m] of z, its other end
    double front_in_bone = 0.0;  ///< [–] of the quarter of a turn behind that
    double left = 1.0;           ///< [–] of its strength
    double blocked = 0.0;        ///< [N] along the shaft at which crests are pushed through bone without a groove
    double pressed = 0.0;        ///< [N] across the shaft at which it presses its way through bone
    double middle = 0.0;         ///< [m] of z, the middle of what grips
    double spread = 0.0;         ///< [m] of what grips about there, root of the mean square
    std::int32_t body = -1;      ///< whose bone it is in

    BoneThread(const ThreadPlaces& places, const ScrewThread& thread, const ThreadTrack& track, const HoleBefore& hole,
               const ScrewParameters& law, const BoneQuery& bone) noexcept;
};

}  // namespace kerf::implant
