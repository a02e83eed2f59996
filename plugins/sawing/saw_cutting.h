// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "saw_teeth.h"

/// Cutting channels of a saw's law: feed, sides, ends.
namespace kerf::sawing {

inline constexpr std::size_t sector_count = 3;  ///< of the front, each with its own direction
enum ChannelId : std::uint32_t { id_feed = 1, id_rub = 7, id_side = 8, id_end = 10, id_contact = 16 };
static_assert(id_feed + sector_count * part_count <= id_rub);

/// Adds the feed channels: three sectors of the front, each in two parts of the oscillation. `follow` contains the
/// sideways force of teeth that are set to one side and have no neighbour, and below 100 Hz the force against the
/// teeth's motion.   [haptic, nonblocking]
void add_feed_cutting(const TeethInBone& in_bone, double kerf, const SawParameters& law, const Oscillation& motion,
                      double last_feed_rate, Channels& channels) noexcept;

/// Adds the channels across the blade, where the flanks of set teeth widen the slot, and in its plane at both ends of
/// the front. They exist while the teeth are at the front.   [haptic, nonblocking]
template <class Blade>
void add_side_cutting(const TeethInBone& in_bone, const Blade& blade, const SawParameters& law, const BoneQuery& bone,
                      const Oscillation& motion, Channels& channels) noexcept;

/// Returns the force of one tooth in the reference tissue along its motion, averaged over the oscillation [N].   [any]
/// pure.
[[nodiscard]] double mean_cutting_force(double kerf, const SawParameters& law, const Stroke& stroke,
                                        double feed_rate) noexcept;

}  // namespace kerf::sawing
