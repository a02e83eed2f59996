// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "burr_edges.h"
#include "kerf/powered_cutter.hpp"

/// The cutting channels of a burr's law.
namespace kerf::burring {

enum ChannelId : std::uint32_t { id_cut = 1, id_rub = 16, id_stick = 17, id_contact = 32 };
static_assert(id_cut + sector_count <= id_rub);

/// The spindle's state and the tool's motion as the law uses them.
struct Turning {
    double blade_rate;     ///< [1/s] blades that pass a point; at least those at the slowest speed that cuts
    double sense;          ///< [–] 1 clockwise as seen from the hand, −1 in reverse
    CuttingState cutting;  ///< cutting state of the blades
    Vec6 rate;             ///< [m/s, rad/s] of the tool, averaged over the last ticks
};

/// Adds one channel for each sector of the head in bone. Its blades resist motion along their mean normal.
///
///     F = Σ b (K_e (1 − e^(−t/t_e)) + K_c t),    t = v·n / (blades · speed)
///
/// summed over the points of the sector, with b the width of blade at each point and the coefficients of its tissue.
/// The channel's `follow` is the force against the turn, weighted by each point's chip. It pulls the burr aside and
/// resists its turn.   [haptic, nonblocking]
///
/// Source: edge and chip form after [altintas-2012], averaged over the turn; docs/models/burr.md.
void add_cutting(const EdgePoints& points, const EdgesInBone& in_bone, const BurrParameters& law,
                 const Turning& turning, Channels& channels) noexcept;

/// Returns the torque [N·m] of all cutting channels against the turn.   [haptic, nonblocking]
[[nodiscard]] double cutting_torque(const Advance& advance, double sense) noexcept;

}  // namespace kerf::burring
