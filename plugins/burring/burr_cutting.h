// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "burr_edges.h"
#include "kerf/powered_cutter.hpp"

/// The cutting channels of a burr's law.
namespace kerf::burring {

enum ChannelId : std::uint32_t { id_cut = 1, id_rub = 16, id_stick = 17, id_contact = 32 };
static_assert(id_cut + sector_count <= id_rub);

/// How the burr turns and has moved, as the law takes it.
struct Turning {
    double blade_rate;     ///< [1/s] blades that pass: never below those of the slowest speed that cuts
    double sense;          ///< [–] 1 clockwise as the hand sees it, −1 in reverse
    CuttingState cutting;  ///< how far the blades cut
    Vec6 rate;             ///< [m/s, rad/s] of the tool over the last ticks
};

/// One channel for each sector of the head that is in bone: its blades resist a motion along their mean normal.
///
///     F = Σ b (K_e (1 − e^(−t/t_e)) + K_c t),    t = v·n / (blades · speed)
///
/// over the points of the sector, b the width of blade at each, in the tissue there. What goes with it is the force
/// against the turn, at each point by the chip that it takes: it pulls the burr aside and turns it back.   [haptic,
/// nonblocking]
///
/// Source: edge and chip form after [altintas-2012], averaged over the turn; docs/models/burr.md.
void add_cutting(const EdgePoints& points, const EdgesInBone& in_bone, const BurrParameters& law,
                 const Turning& turning, Channels& channels) noexcept;

/// The torque of the bone against the turn [N·m], of all cutting channels together.   [haptic, nonblocking]
[[nodiscard]] double cutting_torque(const Advance& advance, double sense) noexcept;

}  // namespace kerf::burring
