// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "saw_teeth.h"

/// The cutting channels of a saw's law: feed, sides, ends.
namespace kerf::sawing {

inline constexpr std::size_t sector_count = 3;  ///< of the front: each has a direction of its own
enum ChannelId : std::uint32_t { id_feed = 1, id_rub = 7, id_side = 8, id_end = 10, id_contact = 16 };
static_assert(id_feed + sector_count * part_count <= id_rub);

/// The front, in three sectors; each in two parts of the oscillation. What goes with it: the sideways force of teeth
/// that are set to one side and have no neighbour, and below 100 Hz the force against the teeth's own motion. [haptic,
/// nonblocking]
void add_feed_cutting(const TeethInBone& in_bone, double kerf, const SawParameters& law, const Oscillation& motion,
                      double last_feed_rate, Channels& channels) noexcept;

/// Across the blade, where the flanks of teeth set to that side widen the slot, and in the plane at either end of the
/// front: while the teeth are at the front.   [haptic, nonblocking]
template <class Blade>
void add_side_cutting(const TeethInBone& in_bone, const Blade& blade, const SawParameters& law, const BoneQuery& bone,
                      const Oscillation& motion, Channels& channels) noexcept;

/// Of one tooth in the reference tissue, along its motion, in the mean over the oscillation [N].   [any] pure.
[[nodiscard]] double mean_cutting_force(double kerf, const SawParameters& law, const Stroke& stroke,
                                        double feed_rate) noexcept;

}  // namespace kerf::sawing
