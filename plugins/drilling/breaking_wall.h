// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "wall_ahead.h"

/// A shell of bone before a still tip, with free space behind it, breaks out before it is crushed, if it is thin.
namespace kerf::drilling {

/// A wall that has broken, until the tip is away from it. One at a time: the last.
class BrokenWall {
public:
    BrokenWall() = default;
    /// @param within  [m] so far from its far side another is the same: half of the tip's radius [judgement]
    explicit BrokenWall(double within) noexcept : within_(within) {}

    [[nodiscard]] bool is_there() const noexcept { return shell_.load > 0.0; }
    /// What of a shell has not broken with it [–]: nothing of one that bears up to a quarter more, all of one that
    /// bears half as much again, to which its crack has not come [judgement]; and all of another wall.
    [[nodiscard]] double is_left_of(const Shell& shell) const noexcept;
    /// More of it broke, or another did.   Whether that is to be told: once, and of no sliver.
    bool break_out(const Shell& shell) noexcept;
    /// The tip went at `rate` [m/s, rad/s] for `dt` [s]; `is_in_it`: it pressed on what is broken. Two radii, 4
    /// `within`, away from there it is forgotten.
    void go(const Vec6& rate, double dt, bool is_in_it) noexcept;
    [[nodiscard]] double within() const noexcept { return within_; }

private:
    Shell shell_;  ///< tool frame, which goes with the tip
    Vec3 away_{};  ///< [m] from where the tip last pressed on it
    double within_ = 0.0;
};

/// What a tip's pieces press on, and what of that breaks. Pieces behind each other that are in one shell break it
/// together, and so do those on other sides that press on the same wall: then they are resisted by what it bears, P,
/// shared out by what crushes each:
///
///     F = min(Σ f_i, P) + what crushes the rest
class PressedWall {
public:
    /// @param crushes  [N] along the shaft, of each piece; 0: it is not in bone
    /// @param parts    which part of the tip each ring of pieces is on, with something straight between it and the
    /// next; #N/azimuth_count [haptic, nonblocking]
    PressedWall(std::span<const double> crushes, std::span<const std::uint8_t> parts, const WallAhead& wall,
                const BrokenWall& broken) noexcept;

    [[nodiscard]] double share(std::size_t piece) const noexcept { return share_[piece]; }  ///< [–] of what crushes it
    /// A way to what breaks, the strongest of it; `no_way`: nothing does.
    [[nodiscard]] std::size_t breaks_on() const noexcept { return breaks_on_; }
    [[nodiscard]] bool is_broken() const noexcept { return is_broken_; }  ///< some of what is pressed on
    static constexpr std::size_t no_way = 2 * WallAhead::most_pieces;

private:
    /// Pieces of one side behind each other that are in one shell.
    struct Group {
        std::size_t way =
            no_way;  ///< to the shell before the first piece behind them: before them it is no more as thick as it was
        double crushes = 0.0;  ///< [N] of what has not broken
        double left = 1.0;     ///< [–] that has not broken
    };
    struct Pressed {
        bool is_in_shell = false;
        std::size_t way = no_way;  ///< to it; none at its far side
    };
    [[nodiscard]] static Pressed pressed_by(std::size_t piece, const WallAhead& wall) noexcept;
    [[nodiscard]] static std::size_t whole_of(std::size_t way, std::size_t piece_behind, const WallAhead& wall,
                                              double within) noexcept;

    std::array<double, WallAhead::most_pieces> share_;
    std::size_t breaks_on_ = no_way;
    bool is_broken_ = false;
};

}  // namespace kerf::drilling
