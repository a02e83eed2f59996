// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "drill_channels.h"
#include "drill_edges.h"
#include "kerf/powered_cutter.hpp"
#include "own_hole.h"

/// What the turning edges put into the law: feed, heel, sideways.
namespace kerf::drilling {

/// How the drill turns, as the law takes it.
struct Turning {
    double n = 0.0;        ///< [1/s] for chip thickness: never below the slowest that cuts
    CuttingState cutting;  ///< how far the edges cut
    double speed = 0.0;    ///< [1/s] magnitude of the actual speed
    double turns = 0.0;    ///< [–] of `n` in a tick
};

/// Of each land, from the tip backwards.
using OwnHoles = std::array<OwnHole, TwistDrill::most_lands>;

/// Lips, chisel edge and heel. Shares the feed out among the edges.   [haptic, nonblocking]
void add_feed_cutting(Edges& edges, const DrillParameters& law, const Turning& turning, const Travel& travel,
                      Channels& channels) noexcept;

/// What cuts sideways, as circles from the tip backwards: what follows from parameters and grid alone.
class SideEdges {
public:
    struct Level {
        double radius, z, width, normal_radial;
        bool is_land = false;
        double inside = 0.0;  ///< [m] of a land: how far inside the hole it has cut its points lie
        [[nodiscard]] double normal_axial() const noexcept { return std::sqrt(1.0 - normal_radial * normal_radial); }
    };
    static constexpr std::size_t most_levels = 16, ways = 4, azimuths = 3;  ///< of each level, to each way
    static constexpr std::size_t most = ways * most_levels * azimuths;

    SideEdges() = default;
    SideEdges(const TwistDrill& drill, const DrillParameters& law, const BoneQuery& bone) noexcept;

    [[nodiscard]] std::span<const Level> levels() const noexcept { return {level_.data(), level_count_}; }
    /// One way after the other, level by level.
    void ask(const BoneQuery& bone, std::array<kerf_bone_sample, most>& out) const noexcept {
        const std::size_t count = ways * level_count_ * azimuths;
        bone.sample({point_.data(), count}, {direction_.data(), count}, {out.data(), count});
    }
    /// Moves the lands in their holes: `rate` for `dt` [s], in which the front went `advance` ≥ 0 [m] into bone.
    /// [haptic, nonblocking]
    void move_in_holes(const Vec6& rate, double dt, double advance, OwnHoles& holes) const noexcept;

private:
    std::array<Level, most_levels> level_;
    std::size_t level_count_ = 0;
    std::array<Vec3, most> point_, direction_;
};

/// Cutting sideways: the cone's flank and the corner behind it, averaged over the turn.
///
/// Each lip passes every azimuth once a turn. At azimuth θ from the motion it takes t = s cos θ n_r/(n_lips n) and
/// pushes back along the motion with cos θ n_r of its force, so a ring of points, each standing for its share of the
/// turn, sums to the mean. Bone is asked for where the ring is, not where the lips are now. What cutting takes follows
/// (side_work.h): the spindle's torque, and a pull across the motion.
void add_side_cutting(const SideEdges& edges, const DrillParameters& law, const BoneQuery& bone, const Turning& turning,
                      const Travel& travel, const OwnHoles& holes, Channels& channels) noexcept;

}  // namespace kerf::drilling
