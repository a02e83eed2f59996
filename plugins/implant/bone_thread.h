// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "kerf/plugin.hpp"
#include "screw_parameters.h"
#include "screw_thread.h"

namespace kerf::implant {

/// A thread's places and what bone there is at them, prepared once and sampled in each tick.
struct ThreadPlaces {
    int count = 0;
    std::array<Vec3, 2 * most_pieces> place;   ///< in the middle of the flanks, then beside the core
    std::array<double, most_pieces> on_flank;  ///< [m²] of each, on which bone presses
    std::array<double, most_pieces> on_core;   ///< the same of the core
    std::array<double, most_pieces> radius;    ///< [m] in the middle of its flank
    std::array<double, most_pieces> sheared;   ///< [m²] of each, that shears when it strips
    std::array<double, most_pieces> grip;      ///< [m] along the shaft

    ThreadPlaces() = default;
    explicit ThreadPlaces(const ScrewThread& thread) noexcept;
};

/// What the bone around a thread does to it.
struct BoneThread {
    double rubbing = 0.0;    ///< [N·m] torque of the bone that presses on it
    double strength = 0.0;   ///< [N] along the shaft before it slips, at its full strength
    double stiffness = 0.0;  ///< [N/m] along the shaft
    double engaged = 0.0;    ///< [m] of thread in bone
    double front = 0.0;      ///< [–] resistance of the bone at the flutes, in dense bone

    BoneThread(const ThreadPlaces& places, const ScrewThread& thread, const ScrewParameters& law,
               const BoneQuery& bone) noexcept;
};

}  // namespace kerf::implant
