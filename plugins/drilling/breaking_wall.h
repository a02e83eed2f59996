// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "bone_shell.h"
#include "twist_drill.h"

/// A shell of bone before a still tip, with free space behind it, breaks out before it is crushed, if it is thin.
namespace kerf::drilling {

/// A piece of a tip: some of a cone, on one of its sides.
struct PressedPiece {
    Vec3 at, normal;     ///< a place on it that is in bone, tool frame [m]; unit, out of the cone
    double crush = 0.0;  ///< [N] along the shaft that crushes what is before it; 0: nothing is
};

/// What a tip's pieces press on, and what of that breaks. On each side those in the shell break it together, and so do sides that press on one
/// wall: then they are resisted by what it bears, P, shared out by what crushes each:
///
///     F = min(Σ f_i, P) + what crushes the rest
class PressedWall {
public:
    static constexpr std::size_t most_pieces = Shells::most / 2;

    /// @param pieces    #N ≤ most_pieces, ring by ring from the tip backwards, one on each of `azimuth_count` sides
    /// @param step      [m] from place to place at which bone is asked how thick it is
    /// @param friction  [–] of the tip on bone
    /// @param broken    [N] under which a wall broke before, or 0: it bears nothing, and one of half as much again all   [haptic, nonblocking]
    PressedWall(std::span<const PressedPiece> pieces, double step, double friction, double broken, const BoneQuery& bone) noexcept;

    [[nodiscard]] double share(std::size_t piece) const noexcept { return share_[piece]; }  ///< [–] of what crushes it
    [[nodiscard]] double breaks() const noexcept { return breaks_; }                        ///< [N] under which something breaks; 0: nothing does
    [[nodiscard]] bool is_broken() const noexcept { return is_broken_; }                    ///< some of what is pressed on

private:
    /// The pieces of one side that are in the shell.
    struct Side {
        Shell shell{};         ///< before the first piece behind them, as before them it is no more as thick as it was
        double crushes = 0.0;  ///< [N] of what has not broken
        double share = 1.0;    ///< [–] that has not broken
    };

    std::array<double, most_pieces> share_;
    double breaks_ = 0.0;
    bool is_broken_ = false;
};

/// What has broken before the tip, until that is away from it.
class BrokenWall {
public:
    [[nodiscard]] double load() const noexcept { return load_; }  ///< [N] under which it broke; 0: nothing is broken
    [[nodiscard]] bool is_there() const noexcept { return load_ > 0.0; }
    /// More of it broke under `load` [N], or something did.   Whether that is the first of it.
    bool break_under(double load) noexcept;
    /// The tip went so far [m] along its shaft; `is_in_it`: it pressed on what is broken. What it is a `radius` [m] away from is forgotten.
    void go(double along, bool is_in_it, double radius) noexcept;

private:
    double load_ = 0.0, away_ = 0.0;  // [N], [m]
};

}  // namespace kerf::drilling
