// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "breaking_wall.h"
#include "drill_parameters.h"
#include "kerf/force.hpp"

/// A tip that removes no bone by turning crushes the bone ahead when the push exceeds the bone's strength, as an awl
/// does.
namespace kerf::drilling {

/// The contact load of the tip in one tick.
struct TipLoad {
    double force = 0.0;  ///< [N] along the shaft
    double depth = 0.0;  ///< [m] of the deepest contact channel with a force

    explicit TipLoad(const Advance& advance) noexcept;
};

/// The still tip in bone. It crushes bone at one pressure along the normal of its cones, and rubs along their slope:
///
///     dF = S(ρ) (n̂ + μ t̂) dA,    F_z = ∫ S(ρ) (1 + μ cot p) dA_z
///
/// with p the cone's half angle and A_z the cross-section. The force does not depend on the rate, because strength
/// hardly does: (1/s)^0.06. A tip with runout crushes the shape that its turn would remove. A thin wall with free space
/// behind it breaks out where its breaking load is lower (breaking_wall.h).
///
/// Source: S from [carter-hayes-1977]; docs/models/drilling.md.
class CrushingTip {
public:
    CrushingTip() = default;
    CrushingTip(const TwistDrill& drill, const DrillParameters& law, const BoneQuery& bone) noexcept;

    /// Returns whether the tip starts to crush bone. It does when the push exceeds the crushing force, when contact is
    /// deeper than any contact spring allows, or when the wall is broken already.   [haptic, nonblocking]
    [[nodiscard]] bool begins(const TipLoad& tip_load, const WallAhead& wall, const BrokenWall& broken,
                              const BoneQuery& bone) const noexcept;
    /// Samples the walls ahead of the next of the tip's sides.   [haptic, nonblocking]
    void sample_side(WallAhead& wall, const BoneQuery& bone) const noexcept;
    /// Walls that the tip presses on in a tick.
    struct PressedWalls {
        std::size_t breaks_on = PressedWall::no_ray;  ///< ray to the wall that breaks; `no_ray`: all bone is crushed
        bool is_broken = false;                       ///< the tip presses on broken bone
    };
    /// Adds a cut channel along the mean normal of the crushed surface, and one in each of four directions across the
    /// shaft.
    /// @param wall    its present samples
    /// @param broken  the wall that has broken   [haptic, nonblocking]
    PressedWalls add_to(Channels& channels, const WallAhead& wall, const BrokenWall& broken,
                        const BoneQuery& bone) const noexcept;

private:
    static constexpr std::size_t max_cone_rings = 24, max_straight_rings = 4 * TwistDrill::max_lands;
    static constexpr std::size_t max_on_cones = azimuth_count * max_cone_rings,
                                 max_points = max_on_cones + azimuth_count * max_straight_rings;
    /// This many adjacent rings of a cone, at one azimuth, form a piece. A piece breaks out as a whole.
    static constexpr std::size_t rings_of_piece = 3, max_piece_rings = WallAhead::pieces_of_side;
    [[nodiscard]] std::size_t piece_of(std::size_t point) const noexcept {
        return piece_ring_[point / azimuth_count] * azimuth_count + point % azimuth_count;
    }
    /// A sample point on a cone or on the straight section behind it. It represents an eighth of a ring.
    struct TipPoint {
        Vec3 at, out;   ///< [m]; unit, away from the shaft
        SinCos slope;   ///< of the cone's half angle
        double height;  ///< [m] of its ring
        double ahead;   ///< [m²] projected area along the shaft
        double aside;   ///< [m²] projected area outwards
        Vec6 along;     ///< n̂ + μ t̂ and its moment about the tip, per unit force along the shaft [–], [m]
        double rubs;    ///< [–] 1 + μ cot p
    };
    /// Along the shaft: the crushing force of each point and their sum [N], and the smallest gap to bone [m].
    struct Ahead {
        std::array<double, max_on_cones> force;
        double sum = 0.0, gap = 0.0;
        std::array<double, WallAhead::max_pieces>
            fraction;  ///< [–] fraction of each piece's crushing force that resists
        PressedWalls met;
    };
    using Samples = std::span<const kerf_bone_sample>;

    /// @param part  index of the tip's part; straight sections separate parts
    void add_cone(const Cone& cone, double runout, std::size_t rings, std::uint8_t part) noexcept;
    void add_straight(double radius, double from, double length) noexcept;
    /// @param ahead   [m²] of the whole ring
    /// @param across  [–] component of n̂ + μ t̂ across the shaft, per unit along it
    void add_ring(double radius, double z, SinCos slope, double height, double ahead, double across,
                  double rubs) noexcept;
    [[nodiscard]] Ahead ahead_of(Samples ahead, const WallAhead& wall, const BrokenWall& broken,
                                 std::uint32_t tissues) const noexcept;
    void limit_by_walls(Ahead& ahead, const WallAhead& wall, const BrokenWall& broken) const noexcept;
    void add_ahead(const Ahead& ahead, Channels& channels) const noexcept;
    void add_aside(Samples aside, const Ahead& ahead, std::uint32_t tissues, std::size_t direction,
                   Channels& channels) const noexcept;

    std::array<TipPoint, max_points> point_;  ///< cone points first, then points of straight sections
    std::size_t on_cones_ = 0, count_ = 0;
    std::array<std::uint8_t, max_cone_rings> piece_ring_{};  ///< index of the ring of pieces that each ring belongs to
    std::array<std::uint8_t, max_piece_rings> part_{};       ///< index of the part that each ring of pieces belongs to
    std::size_t piece_rings_ = 0;
    std::array<Vec3, max_on_cones + max_points> sample_point_,
        direction_;      ///< cone points ahead, then all points outwards
    double play_ = 0.0;  ///< [m] gap to bone at which a point no longer presses sideways
    double step_ = 0.0;  ///< [m] sampling step for wall thickness
    double friction_ = 0.0;
};

/// Returns whether bone yields under the full crushing force, not under less.   [haptic, nonblocking]
[[nodiscard]] bool is_crushed(const Advance& advance) noexcept;
/// Returns whether bone under crushing still supports the tip. It does with more than a tenth of the crushing force, or
/// of `begun` [N], the force at which crushing began, whichever is smaller. Below that the tip is back on the contact
/// spring, which such a force hardly compresses.   [haptic, nonblocking]
[[nodiscard]] bool continues_crushing(const Advance& advance, double begun) noexcept;

}  // namespace kerf::drilling
