// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "wall_ahead.h"

/// A thin shell of bone between a still tip and free space breaks out before it is crushed.
namespace kerf::drilling {

/// The last wall that broke. It is remembered until the tip has moved away.
class BrokenWall {
public:
    BrokenWall() = default;
    /// @param within  [m] far sides within this distance are one wall: half of the tip's radius [judgement]
    explicit BrokenWall(double within) noexcept : within_(within) {}

    [[nodiscard]] bool is_there() const noexcept { return shell_.load > 0.0; }
    /// Returns the intact fraction of a shell [–]. It is 0 up to 1.25 times the load that broke the wall and 1 from 1.5
    /// times on, where the crack has not spread [judgement]. It is 1 for another wall.
    [[nodiscard]] double fraction_intact(const Shell& shell) const noexcept;
    /// Records that `shell` broke.
    /// @return true if this break is to be reported: once a wall, and never for a sliver
    bool break_out(const Shell& shell) noexcept;
    /// Moves the wall against the tool, which moved at `rate` [m/s, rad/s] for `dt` [s]. `is_pressed_on` is true while
    /// the tip presses on the broken wall. The wall is forgotten when the tip is two radii (4 `within`) away.
    void move_with_tip(const Vec6& rate, double dt, bool is_pressed_on) noexcept;
    [[nodiscard]] double within() const noexcept { return within_; }

private:
    Shell shell_;  ///< in the tool frame
    Vec3 away_{};  ///< [m] travel of the tip since it last pressed on the wall
    double within_ = 0.0;
};

/// Which walls the pieces of a tip press on, and which of them break. Pieces in line in one shell break it together. So
/// do pieces on other sides that press on the same wall. The resistance is then limited by the wall's breaking load P,
/// divided in proportion to the crushing force f_i of each piece:
///
///     F = min(Σ f_i, P) + the crushing force of the other pieces
class PressedWall {
public:
    /// @param crushes  [N] crushing force of each piece along the shaft; 0: not in bone
    /// @param parts    #N/azimuth_count index of the tip's part for each ring; straight sections separate parts
    /// [haptic, nonblocking]
    PressedWall(std::span<const double> crushes, std::span<const std::uint8_t> parts, const WallAhead& wall,
                const BrokenWall& broken) noexcept;

    /// Returns the fraction of a piece's crushing force that resists [–].
    [[nodiscard]] double resisting_fraction(std::size_t piece) const noexcept { return resisting_fraction_[piece]; }
    /// Returns the ray to the strongest wall that breaks, or `no_ray`.
    [[nodiscard]] std::size_t breaks_on() const noexcept { return breaks_on_; }
    [[nodiscard]] bool is_broken() const noexcept { return is_broken_; }  ///< the tip presses on broken bone
    static constexpr std::size_t no_ray = 2 * WallAhead::max_pieces;

private:
    /// Pieces of one side, in line, in one shell.
    struct Group {
        std::size_t ray = no_ray;  ///< to the shell before the rearmost piece, which sees its full thickness
        double crushes = 0.0;      ///< [N] crushing force of the intact part
        double left = 1.0;         ///< [–] intact fraction
    };
    struct Pressed {
        bool is_in_shell = false;
        std::size_t ray = no_ray;  ///< to the shell; `no_ray` at its far side
    };
    [[nodiscard]] static Pressed pressed_by(std::size_t piece, const WallAhead& wall) noexcept;
    [[nodiscard]] static std::size_t whole_of(std::size_t ray, std::size_t piece_behind, const WallAhead& wall,
                                              double within) noexcept;

    std::array<double, WallAhead::max_pieces> resisting_fraction_;
    std::size_t breaks_on_ = no_ray;
    bool is_broken_ = false;
};

}  // namespace kerf::drilling
