// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "kerf/math.hpp"
#include "kerf/newest.hpp"

namespace kerf::run {

/// What a mouse and its keys have done, as totals since the viewer was started: a total that its reader misses is in
/// the next one.
struct MouseTotals {
    Vec3 moved{};               ///< [m] by which the aim was moved, world frame
    double along = 0.0;         ///< [m] along the tool's axis, positive into the bone
    Vec3 tilted{};              ///< [rad] sum of small rotations about the tip, world frame
    double turned = 0.0;        ///< [rad] about the tool's z axis, right-handed
    std::uint32_t actions = 0;  ///< requests of the step's next action
    std::uint32_t undos = 0;    ///< requests of an undo
    bool is_driving = false;    ///< the drive button is held or latched
    bool is_loose = false;      ///< the hand releases a screw or tap about its shaft
    bool is_paused = false;     ///< no tick runs, and no time passes
};

/// The newest totals: one thread puts them, at any rate; the haptic thread gets them.
using MouseBox = Newest<MouseTotals>;

}  // namespace kerf::run
