// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "kerf/contact_points.hpp"
#include "own_slot.h"
#include "saw_cutting.h"
#include "straight_blade.h"

/// Where the saw touches without cutting: its sides always, its teeth as far as they do not cut.
namespace kerf::sawing {

/// The slots of a blade's contact points, one channel each: three sectors of the still front; each side, near the front
/// and far from it; both narrow ends; the back edge of a straight blade.
enum ContactSlot : std::uint32_t { slot_tip = 0, slot_side = 3, slot_edge = 7, slot_back = 9 };
static_assert(slot_side == sector_count);

/// Where the blade may touch.
struct TouchingPoints {
    /// A point of the blade's sides: its own slot may tell of it.
    struct OnSide {
        std::size_t place;  ///< among all
        double behind;      ///< [m] the roots of the teeth
    };
    static constexpr std::size_t most_on_sides = 204;
    ContactPoints all;
    std::array<OnSide, most_on_sides> of_sides;
    std::size_t side_count = 0;
};
/// While the saw takes bone, or as it is else.   [haptic, nonblocking]
[[nodiscard]] TouchingPoints touching_points(const SawBlade& blade, const SawParameters& law, const BoneQuery& bone,
                                             bool removes) noexcept;
[[nodiscard]] TouchingPoints touching_points(const StraightBlade& blade, const SawParameters& law,
                                             const BoneQuery& bone, bool removes) noexcept;

/// As many contact channels as the law has room for, and friction for what the sides carried in the last tick [N].
/// [haptic, nonblocking]
template <class Blade>
void add_contact(const Blade& blade, const TouchingPoints& points, const SawParameters& law, const BoneQuery& bone,
                 const Oscillation& motion, const OwnSlot& slot, double last_binding, Channels& channels) noexcept;

/// What pressed on the blade's two sides together [N]: how hard it binds.   [haptic, nonblocking]
[[nodiscard]] double binding_of(const Advance& advance) noexcept;

}  // namespace kerf::sawing
