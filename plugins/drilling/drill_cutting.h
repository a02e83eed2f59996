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

/// Channels of the turning edges: feed, heel and sideways cutting.
namespace kerf::drilling {

/// The spindle's state as the law uses it.
struct Turning {
    double n = 0.0;        ///< [1/s] for chip thickness; at least the slowest speed that cuts
    CuttingState cutting;  ///< cutting state of the edges
    double speed = 0.0;    ///< [1/s] magnitude of the actual speed
    double turns = 0.0;    ///< [–] revolutions in a tick at `n`
};

/// One hole for each land, from the tip backwards.
using OwnHoles = std::array<OwnHole, TwistDrill::max_lands>;

/// Adds the channels of lips, chisel edge and heel, and divides the feed among the edges.   [haptic, nonblocking]
void add_feed_cutting(Edges& edges, const DrillParameters& law, const Turning& turning, const Travel& travel,
                      Channels& channels) noexcept;

/// The circles that cut sideways, from the tip backwards. They depend on parameters and grid only.
class SideEdges {
public:
    struct Level {
        double radius, z, width, normal_radial;
        bool is_land = false;
        double inside = 0.0;  ///< [m] distance of a land's points inside the hole that it has cut
        [[nodiscard]] double normal_axial() const noexcept { return std::sqrt(1.0 - normal_radial * normal_radial); }
    };
    static constexpr std::size_t max_levels = 16, directions = 4,
                                 azimuths = 3;  ///< `azimuths` for each level and direction
    static constexpr std::size_t max_points = directions * max_levels * azimuths;

    SideEdges() = default;
    SideEdges(const TwistDrill& drill, const DrillParameters& law, const BoneQuery& bone) noexcept;

    [[nodiscard]] std::span<const Level> levels() const noexcept { return {level_.data(), level_count_}; }
    /// Samples all points: direction by direction, level by level.
    void ask(const BoneQuery& bone, std::array<kerf_bone_sample, max_points>& out) const noexcept {
        const std::size_t count = directions * level_count_ * azimuths;
        bone.sample({point_.data(), count}, {direction_.data(), count}, {out.data(), count});
    }
    /// Moves the lands in their holes at `rate` for `dt` [s], while the front advances by `advance` ≥ 0 [m] into bone.
    /// [haptic, nonblocking]
    void move_in_holes(const Vec6& rate, double dt, double advance, OwnHoles& holes) const noexcept;

private:
    std::array<Level, max_levels> level_;
    std::size_t level_count_ = 0;
    std::array<Vec3, max_points> point_, direction_;
};

/// Adds the channels of sideways cutting by the cones' flanks and the lands, averaged over a turn.
///
/// Each lip passes every azimuth once a turn. At azimuth θ from the motion it cuts t = s cos θ n_r/(n_lips n) and
/// pushes back along the motion with cos θ n_r of its force. Each point of a ring represents its fraction of the turn,
/// so the ring sums to the average. Bone is sampled on the ring, not at the present angle of the lips. The channels'
/// `follow` contains the spindle torque and the pull across the motion (side_work.h).
void add_side_cutting(const SideEdges& edges, const DrillParameters& law, const BoneQuery& bone, const Turning& turning,
                      const Travel& travel, const OwnHoles& holes, Channels& channels) noexcept;

}  // namespace kerf::drilling
