// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "kerf/contact_points.hpp"
#include "own_slot.h"
#include "saw_cutting.h"
#include "straight_blade.h"

/// Contact without cutting: the sides always, and the teeth while they do not cut.
namespace kerf::sawing {

/// Slots of the contact points, one channel each: three sectors of the still front; each side, near the front and far
/// from it; both narrow ends; the back edge of a straight blade.
enum ContactSlot : std::uint32_t { slot_tip = 0, slot_side = 3, slot_edge = 7, slot_back = 9 };
static_assert(slot_side == sector_count);

/// Points of the blade that may touch bone.
struct TouchingPoints {
    /// A point of the blade's sides, whose wall may come from the blade's own slot.
    struct OnSide {
        std::size_t index;  ///< index among all points
        double behind;      ///< [m] from the roots of the teeth
    };
    static constexpr std::size_t max_on_sides = 204;
    ContactPoints all;
    std::array<OnSide, max_on_sides> of_sides;
    std::size_t side_count = 0;
};
/// Returns the points. `removes` is true while the saw removes bone.   [haptic, nonblocking]
[[nodiscard]] TouchingPoints touching_points(const SawBlade& blade, const SawParameters& law, const BoneQuery& bone,
                                             bool removes) noexcept;
[[nodiscard]] TouchingPoints touching_points(const StraightBlade& blade, const SawParameters& law,
                                             const BoneQuery& bone, bool removes) noexcept;

/// Adds contact channels, as many as fit, and friction for the force on the sides in the last tick [N]. [haptic,
/// nonblocking]
template <class Blade>
void add_contact(const Blade& blade, const TouchingPoints& points, const SawParameters& law, const BoneQuery& bone,
                 const Oscillation& motion, const OwnSlot& slot, double last_binding, Channels& channels) noexcept;

/// Returns the sum of the forces on both sides of the blade [N], the binding force.   [haptic, nonblocking]
[[nodiscard]] double binding_of(const Advance& advance) noexcept;

}  // namespace kerf::sawing
