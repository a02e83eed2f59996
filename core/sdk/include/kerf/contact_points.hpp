// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "kerf/assert.hpp"
#include "kerf/math.hpp"

namespace kerf {

/// Points of a tool's own surface that may touch bone. A law computes them when its tool is taken up, keeps them in its
/// state and queries the bone near them in every tick, with `Contact`.   [haptic, nonblocking]
class ContactPoints {
public:
    static constexpr std::size_t max_points = 304, max_slots = KERF_MAX_CHANNELS;

    /// @param at, outwards  point on the tool's surface and its unit normal; tool frame [m]
    /// @param stiffness     [N/m]
    /// @param facing        cosine between the bone's normal and −`outwards` up to which the bone has no force; the
    ///                      stiffness is full at 0.1 more
    /// @param slot          < max_slots
    void add(Vec3 at, Vec3 outwards, double stiffness, double facing, std::size_t slot) noexcept {
        KERF_ASSERT(count_ < max_points && slot < max_slots, "a tool has too many contact points or slots; use fewer");
        at_[count_] = at;
        outwards_[count_] = outwards;
        stiffness_[count_] = stiffness;
        facing_[count_] = facing;
        slot_[count_++] = slot;
    }
    [[nodiscard]] std::size_t count() const noexcept { return count_; }
    [[nodiscard]] Vec3 at(std::size_t i) const noexcept { return at_[i]; }
    [[nodiscard]] Vec3 outwards(std::size_t i) const noexcept { return outwards_[i]; }
    [[nodiscard]] double stiffness(std::size_t i) const noexcept { return stiffness_[i]; }
    [[nodiscard]] double facing(std::size_t i) const noexcept { return facing_[i]; }
    [[nodiscard]] std::size_t slot(std::size_t i) const noexcept { return slot_[i]; }
    [[nodiscard]] std::span<const Vec3> all() const noexcept { return {at_.data(), count_}; }

private:
    std::array<Vec3, max_points> at_, outwards_;
    std::array<double, max_points> stiffness_, facing_;
    std::array<std::size_t, max_points> slot_;
    std::size_t count_ = 0;
};

}  // namespace kerf
