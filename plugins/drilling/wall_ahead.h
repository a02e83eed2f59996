// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "bone_shell.h"
#include "twist_drill.h"

namespace kerf::drilling {

/// A piece of the tip: part of a cone, on one of its sides.
struct Piece {
    Vec3 at, normal;  ///< a point of it in bone, tool frame [m]; unit, outward normal of the cone
};

/// The shells ahead of a tip's pieces. Pieces are numbered ring by ring from the tip backwards, one on each of
/// `azimuth_count` sides. Each tick samples one side.
class WallAhead {
public:
    static constexpr std::size_t pieces_of_side = Shells::max_rays / 2, max_pieces = azimuth_count * pieces_of_side;

    [[nodiscard]] std::size_t next_side() const noexcept { return next_; }
    /// Samples the shells ahead of one side.
    /// @param pieces    #N ≤ pieces_of_side, of the next side, from the tip backwards
    /// @param step      [m] between the bone samples that measure thickness
    /// @param friction  [–] of the tip on bone   [haptic, nonblocking]
    void sample_side(std::span<const Piece> pieces, double step, double friction, const BoneQuery& bone) noexcept;
    void forget() noexcept;

    /// Ray numbers of a piece: along the shaft, and along its normal.
    [[nodiscard]] static std::size_t ahead_of(std::size_t piece) noexcept { return 2 * piece; }
    [[nodiscard]] static std::size_t along_normal(std::size_t piece) noexcept { return 2 * piece + 1; }
    [[nodiscard]] const Shell& on(std::size_t ray) const noexcept { return shell_[ray]; }
    /// Returns whether a distance `begins` [m] along a ray counts as its start. The first step may be half in the hole
    /// [judgement].
    [[nodiscard]] bool is_at_once(double begins) const noexcept { return begins < 1.5 * step_; }

private:
    static constexpr std::array<Shell, 2 * max_pieces> all_unseen() noexcept {
        std::array<Shell, 2 * max_pieces> shells{};
        shells.fill({.load = Shell::never});
        return shells;
    }
    std::array<Shell, 2 * max_pieces> shell_ = all_unseen();
    std::size_t next_ = 0;
    double step_ = 0.0;
    bool has_seen_ = false;
};

}  // namespace kerf::drilling
