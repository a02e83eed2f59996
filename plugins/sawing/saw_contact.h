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

inline constexpr std::size_t tip_points = 9;
/// [m] behind the roots of the teeth: rows of points on the sides, as far as the blade reaches.
inline constexpr std::array row_behind{0.25e-3, 3e-3, 7e-3, 15e-3, 30e-3};

/// Points of the blade that may touch bone.
struct TouchingPoints {
    /// A point of the blade's sides, whose wall may come from the blade's own slot.
    struct OnSide {
        std::size_t index;  ///< index among all points
        double behind;      ///< [m] from the roots of the teeth
    };
    static constexpr std::size_t max_on_sides = 204;
    static constexpr double tip_facing = 0.5, facing = 0.3;
    ContactPoints all;
    std::array<OnSide, max_on_sides> of_sides;
    std::size_t side_count = 0;

    /// Adds the teeth that do not cut: points along the front, with this stiffness [N/m].
    template <class Blade>
    void add_still_teeth(const Blade& blade, double stiffness) noexcept {
        for (std::size_t i = 0; i < tip_points; ++i) {
            const FrontPoint front = blade.front(2.0 * (static_cast<double>(i) + 0.5) / tip_points - 1.0);
            all.add(front.at, front.normal, stiffness, tip_facing, slot_tip + i * sector_count / tip_points);
        }
    }
    /// Adds a point on each side of a blade of this thickness [m]. `is_far`: from the front.
    void add_sides(double x, double z, double thickness, double behind, double stiffness, bool is_far) noexcept {
        for (const double side : {1.0, -1.0}) {
            of_sides[side_count++] = {all.count(), behind};
            all.add({x, side * 0.5 * thickness, z}, {0, side, 0}, stiffness, facing,
                    slot_side + (side > 0.0 ? 0u : 2u) + (is_far ? 1u : 0u));
        }
    }
    /// Adds a point of both narrow ends, at ± `x`.
    void add_ends(double x, double z, double stiffness) noexcept {
        for (const double side : {1.0, -1.0})
            all.add({side * x, 0.0, z}, {side, 0, 0}, stiffness, facing, slot_edge + (side > 0.0 ? 0u : 1u));
    }
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
