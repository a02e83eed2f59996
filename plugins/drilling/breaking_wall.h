// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "bone_shell.h"
#include "twist_drill.h"

/// A shell of bone before a still tip, with free space behind it, breaks out before it is crushed, if it is thin.
namespace kerf::drilling {

/// Where a piece of a tip is: some of a cone, on one of its sides.
struct Piece {
    Vec3 at, normal;  ///< a place on it that is in bone, tool frame [m]; unit, out of the cone
};

/// What is before each of a tip's pieces, looked for on one of its `azimuth_count` sides a tick.
class WallAhead {
public:
    static constexpr std::size_t pieces_of_side = Shells::most / 2, most_pieces = azimuth_count * pieces_of_side;

    [[nodiscard]] std::size_t next_side() const noexcept { return next_; }
    /// @param pieces    #N ≤ pieces_of_side, of the next side, from the tip backwards
    /// @param step      [m] from place to place at which bone is asked how thick it is
    /// @param friction  [–] of the tip on bone   [haptic, nonblocking]
    void look(std::span<const Piece> pieces, double step, double friction, const BoneQuery& bone) noexcept;
    void forget() noexcept;

    [[nodiscard]] const Shell& ahead(std::size_t piece) const noexcept { return ahead_[piece]; }    ///< along the shaft
    [[nodiscard]] const Shell& beside(std::size_t piece) const noexcept { return beside_[piece]; }  ///< along its normal
    [[nodiscard]] double step() const noexcept { return step_; }                                   ///< [m] last looked with

private:
    static constexpr Shell unseen{Shell::never};
    static constexpr std::array<Shell, most_pieces> all_unseen() noexcept {
        std::array<Shell, most_pieces> shells{};
        shells.fill(unseen);
        return shells;
    }
    std::array<Shell, most_pieces> ahead_ = all_unseen(), beside_ = ahead_;
    std::size_t next_ = 0;
    double step_ = 0.0;
    bool has_seen_ = false;
};

/// What a tip's pieces press on, and what of that breaks. On each side those in the shell break it together, and so do sides that press on one
/// wall: then they are resisted by what it bears, P, shared out by what crushes each:
///
///     F = min(Σ f_i, P) + what crushes the rest
class PressedWall {
public:
    /// @param crushes  [N] along the shaft, of each piece, ring by ring from the tip backwards, one on each side; 0: it is not in bone
    /// @param broken   [N] under which a wall broke before, or 0: it bears nothing, and one of half as much again all   [haptic, nonblocking]
    PressedWall(std::span<const double> crushes, const WallAhead& wall, double broken) noexcept;

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

    std::array<double, WallAhead::most_pieces> share_;
    double breaks_ = 0.0;
    bool is_broken_ = false;
};

/// What has broken before the tip, until that is away from it.
class BrokenWall {
public:
    [[nodiscard]] double load() const noexcept { return load_; }  ///< [N] under which it broke; 0: nothing is broken
    [[nodiscard]] bool is_there() const noexcept { return load_ > 0.0; }
    /// More of it broke under `load` [N], or something did.   Whether that is to be told: once, and of no sliver.
    bool break_under(double load) noexcept;
    /// The tip went so far [m] along its shaft; `is_in_it`: it pressed on what is broken. What it is a `radius` [m] away from is forgotten.
    void go(double along, bool is_in_it, double radius) noexcept;

private:
    double load_ = 0.0, away_ = 0.0;  // [N], [m]
};

}  // namespace kerf::drilling
