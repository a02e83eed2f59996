// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "bone_shell.h"
#include "twist_drill.h"

namespace kerf::drilling {

/// Where a piece of a tip is: some of a cone, on one of its sides.
struct Piece {
    Vec3 at, normal;  ///< a place on it that is in bone, tool frame [m]; unit, out of the cone
};

/// What is before each of a tip's pieces, which are numbered ring by ring from the tip backwards, one on each of
/// `azimuth_count` sides. Looked for on one side a tick.
class WallAhead {
public:
    static constexpr std::size_t pieces_of_side = Shells::most / 2, most_pieces = azimuth_count * pieces_of_side;

    [[nodiscard]] std::size_t next_side() const noexcept { return next_; }
    /// @param pieces    #N ≤ pieces_of_side, of the next side, from the tip backwards
    /// @param step      [m] from place to place at which bone is asked how thick it is
    /// @param friction  [–] of the tip on bone   [haptic, nonblocking]
    void look(std::span<const Piece> pieces, double step, double friction, const BoneQuery& bone) noexcept;
    void forget() noexcept;

    /// Ways out of a piece: along the shaft, and along its normal.
    [[nodiscard]] static std::size_t ahead_of(std::size_t piece) noexcept { return 2 * piece; }
    [[nodiscard]] static std::size_t beside(std::size_t piece) noexcept { return 2 * piece + 1; }
    [[nodiscard]] const Shell& on(std::size_t way) const noexcept { return shell_[way]; }
    /// Whether what begins after so much of a way [m] is where the way does: the first step may be half in the hole
    /// [judgement].
    [[nodiscard]] bool is_at_once(double begins) const noexcept { return begins < 1.5 * step_; }

private:
    static constexpr std::array<Shell, 2 * most_pieces> all_unseen() noexcept {
        std::array<Shell, 2 * most_pieces> shells{};
        shells.fill({.load = Shell::never});
        return shells;
    }
    std::array<Shell, 2 * most_pieces> shell_ = all_unseen();
    std::size_t next_ = 0;
    double step_ = 0.0;
    bool has_seen_ = false;
};

}  // namespace kerf::drilling
