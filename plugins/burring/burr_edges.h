// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "burr_head.h"
#include "burr_parameters.h"
#include "kerf/force.hpp"

/// The blades of a turning head, averaged over the turn: points of its surface, each of which stands for a part of it.
namespace kerf::burring {

inline constexpr std::size_t column_count = 12;                     ///< of points around the axis
inline constexpr std::size_t azimuth_count = 6;                     ///< of sectors around it
inline constexpr std::size_t sector_count = 1 + 2 * azimuth_count;  ///< the end; the front half; the rear half
inline constexpr std::size_t wide_count = 1 + azimuth_count;        ///< the same with both halves together
/// The wide sector that a sector is part of.
[[nodiscard]] constexpr std::size_t wide_sector(std::size_t sector) noexcept {
    return sector < wide_count ? sector : sector - azimuth_count;
}
inline constexpr double left_behind = 0.1e-3;  ///< [m] points farther from bone than the nearest by this wait (R2)

/// A point of the head's surface.
struct EdgePoint {
    Vec3 at;       ///< [m]
    Vec3 turning;  ///< unit, the way the blades go there while the burr turns clockwise as the hand sees it
    double width;  ///< [m] of blade that is there, averaged over the turn
    std::size_t sector;
};

/// All of them: what follows from parameters and grid alone.
///
/// Each blade runs along the whole meridian, so a circle of the head has `blades` ds of edge on a stretch ds of it,
/// wherever on the head it is. Columns of points share it. Their points lie at other heights in each column, so that
/// the edge of the bone does not meet a whole ring at once.
class EdgePoints {
public:
    static constexpr std::size_t most = 336;

    EdgePoints() = default;
    EdgePoints(const BurrHead& head, const BurrParameters& law, const BoneQuery& bone) noexcept;

    [[nodiscard]] std::size_t count() const noexcept { return count_; }
    [[nodiscard]] const EdgePoint& operator[](std::size_t i) const noexcept { return point_[i]; }
    [[nodiscard]] Vec3 outwards(std::size_t i) const noexcept { return outwards_[i]; }  ///< unit normal
    [[nodiscard]] double width() const noexcept { return width_; }                      ///< [m] of all of them
    /// How far inside the head bone is sampled [m]: as far as the wall of its own groove may lie inside it.
    [[nodiscard]] double inside(std::size_t i) const noexcept { return inside_[i]; }
    /// Samples the bone at all of them, along their normals.   [haptic, nonblocking]
    void sample(const BoneQuery& bone, std::span<kerf_bone_sample> out) const noexcept {
        bone.sample({asked_.data(), count_}, {outwards_.data(), count_}, out);
    }
    /// The sector of a point of the head.
    [[nodiscard]] static std::size_t sector_of(const MeridianPoint& at, double along, double meridian,
                                               std::size_t column) noexcept;

private:
    std::array<EdgePoint, most> point_;
    std::array<Vec3, most> outwards_, asked_;
    std::size_t count_ = 0;
    std::array<double, most> inside_;
    double width_ = 0.0;
};

/// The middle of a column of points about the axis.
[[nodiscard]] SinCos azimuth_of(std::size_t column) noexcept;

/// The points as the bone is around them now.
struct EdgesInBone {
    std::array<double, EdgePoints::most> resisted;  ///< [–] of each point: share of the reference tissue's resistance
    std::array<double, EdgePoints::most> gap;       ///< [m] to bone, along the point's normal
    double engaged = 0.0;                           ///< [m] of blade in bone

    void sample(const EdgePoints& points, const BurrParameters& law, const BoneQuery& bone) noexcept;
};

}  // namespace kerf::burring
