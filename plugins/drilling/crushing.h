// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "breaking_wall.h"
#include "drill_parameters.h"
#include "kerf/force.hpp"

/// A tip that takes no bone by turning: pushed harder than the bone before it bears, it crushes its way, as an awl
/// does.
namespace kerf::drilling {

/// How the tip stood on bone in a tick.
struct Standing {
    double force = 0.0;  ///< [N] along the shaft
    double depth = 0.0;  ///< [m] of the deepest channel that carried

    explicit Standing(const Advance& advance) noexcept;
};

/// Bone before the tip is crushed at one pressure along the normal of its cones, and rubs along their slope:
///
///     dF = S(ρ) (n̂ + μ t̂) dA,    F_z = ∫ S(ρ) (1 + μ cot p) dA_z
///
/// p the cone's half angle, A_z the cross-section. At any rate, as strength hardly depends on it: (1/s)^0.06. A tip
/// that runs off crushes what its turning shape removes. Where bone is thin before it and free behind, it breaks out
/// instead, if that costs less (breaking_wall.h).
///
/// Source: S from [carter-hayes-1977]; docs/models/drilling.md.
class CrushingTip {
public:
    CrushingTip() = default;
    CrushingTip(const TwistDrill& drill, const DrillParameters& law, const BoneQuery& bone) noexcept;

    /// Whether bone gives way under it: pushed by more than crushes it, or as deep as nothing gives by its spring
    /// alone; or it is broken already.   [haptic, nonblocking]
    [[nodiscard]] bool begins(const Standing& standing, const WallAhead& wall, const BrokenWall& broken,
                              const BoneQuery& bone) const noexcept;
    /// Looks for what is thin before it, on the next of its sides.   [haptic, nonblocking]
    void look(WallAhead& wall, const BoneQuery& bone) const noexcept;
    /// What a tick's push meets besides its channels.
    struct Met {
        std::size_t breaks_on = PressedWall::no_way;  ///< a way to what breaks out under it; none: all is crushed
        bool is_broken = false;                       ///< some of what it presses on
    };
    /// A cut along the mean normal of what is crushed, and one each way across the shaft.
    /// @param wall    looked for before
    /// @param broken  which of it is   [haptic, nonblocking]
    Met add_to(Channels& channels, const WallAhead& wall, const BrokenWall& broken,
               const BoneQuery& bone) const noexcept;

private:
    static constexpr std::size_t most_cone_rings = 24, most_straight_rings = 4 * TwistDrill::most_lands;
    static constexpr std::size_t most_on_cones = azimuth_count * most_cone_rings,
                                 most = most_on_cones + azimuth_count * most_straight_rings;
    /// So many rings of a cone behind each other, at an azimuth, are a piece that breaks out or does not.
    static constexpr std::size_t rings_of_piece = 3, most_piece_rings = WallAhead::pieces_of_side;
    [[nodiscard]] std::size_t piece_of(std::size_t place) const noexcept {
        return piece_ring_[place / azimuth_count] * azimuth_count + place % azimuth_count;
    }
    /// A place on a cone, or on what is straight behind it, which stands for an eighth of a ring.
    struct Place {
        Vec3 at, out;   ///< [m]; unit, away from the shaft
        SinCos slope;   ///< of the cone's half angle
        double height;  ///< [m] of its ring
        double ahead;   ///< [m²] area across the shaft
        double aside;   ///< [m²] area that it shows outwards
        Vec6 along;     ///< n̂ + μ t̂, and its moment about the tip, for one along the shaft [–], [m]
        double rubs;    ///< [–] 1 + μ cot p
    };
    /// Along the shaft: what crushes each place [N] and all of them, and the least way to bone [m].
    struct Ahead {
        std::array<double, most_on_cones> force;
        double sum = 0.0, gap = 0.0;
        std::array<double, WallAhead::most_pieces> share;  ///< [–] of each piece, which has not broken out
        Met met;
    };
    using Samples = std::span<const kerf_bone_sample>;

    /// @param part  of the tip, counted by what is straight between them
    void add_cone(const Cone& cone, double runout, std::size_t rings, std::uint8_t part) noexcept;
    void add_straight(double radius, double from, double length) noexcept;
    /// @param ahead   [m²] of all of the ring
    /// @param across  [–] of n̂ + μ t̂ for one along the shaft
    void add_ring(double radius, double z, SinCos slope, double height, double ahead, double across,
                  double rubs) noexcept;
    [[nodiscard]] Ahead ahead_of(Samples ahead, const WallAhead& wall, const BrokenWall& broken,
                                 std::uint32_t tissues) const noexcept;
    void give_way(Ahead& ahead, const WallAhead& wall, const BrokenWall& broken) const noexcept;
    void add_ahead(const Ahead& ahead, Channels& channels) const noexcept;
    void add_aside(Samples aside, const Ahead& ahead, std::uint32_t tissues, std::size_t way,
                   Channels& channels) const noexcept;

    std::array<Place, most> place_;  ///< on cones, then on what is straight
    std::size_t on_cones_ = 0, count_ = 0;
    std::array<std::uint8_t, most_cone_rings> piece_ring_{};  ///< of each ring: which of the rings of pieces it is in
    std::array<std::uint8_t, most_piece_rings>
        part_{};  ///< of each ring of pieces: cones with nothing straight between them are one
    std::size_t piece_rings_ = 0;
    std::array<Vec3, most_on_cones + most> asked_, direction_;  ///< those on cones ahead, then all of them aside
    double play_ = 0.0;  ///< [m] so far from bone a place presses no more on it sideways
    double step_ = 0.0;  ///< [m] from place to place as it asks how thick a wall is
    double friction_ = 0.0;
};

/// Whether bone is crushed by as much as crushes it, and not held by less.   [haptic, nonblocking]
[[nodiscard]] bool is_crushed(const Advance& advance) noexcept;
/// Whether bone that was crushed still carries the tip: by more than a tenth of `begun` [N], with which that began, or
/// of what crushes it. Let go, the tip stands on contact's spring again, which so little hardly presses in.   [haptic,
/// nonblocking]
[[nodiscard]] bool goes_on_crushing(const Advance& advance, double begun) noexcept;

}  // namespace kerf::drilling
