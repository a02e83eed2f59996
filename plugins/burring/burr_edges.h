// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "burr_head.h"
#include "burr_parameters.h"
#include "kerf/force.hpp"

/// The blades of a turning head, averaged over the turn, as points of its surface. Each point represents a part of it.
namespace kerf::burring {

inline constexpr std::size_t column_count = 12;                     ///< columns of points around the axis
inline constexpr std::size_t azimuth_count = 6;                     ///< sectors around the axis
inline constexpr std::size_t sector_count = 1 + 2 * azimuth_count;  ///< the end; the front half; the rear half
inline constexpr std::size_t wide_count = 1 + azimuth_count;        ///< the end, and both halves joined
/// Returns the wide sector that contains a sector.
[[nodiscard]] constexpr std::size_t wide_sector(std::size_t sector) noexcept {
    return sector < wide_count ? sector : sector - azimuth_count;
}
inline constexpr double max_cutting_gap = 0.1e-3;  ///< [m] points this much farther from bone than the nearest one do
                                                   ///< not cut yet

/// A point of the head's surface.
struct EdgePoint {
    Vec3 at;       ///< [m]
    Vec3 turning;  ///< unit, direction of the blades while the burr turns clockwise as seen from the hand
    double width;  ///< [m] of blade at the point, averaged over the turn
    std::size_t sector;
};

/// The points of a head. They depend on parameters and grid only.
///
/// Each blade runs along the whole meridian. So a stretch ds of the meridian has `blades` ds of edge around the head,
/// at any radius. This length is divided among the columns. Points of different columns lie at different heights, so
/// that a flat bone surface does not meet a whole ring at once.
class EdgePoints {
public:
    static constexpr std::size_t max_points = 336;

    EdgePoints() = default;
    EdgePoints(const BurrHead& head, const BurrParameters& law, const BoneQuery& bone) noexcept;

    [[nodiscard]] std::size_t count() const noexcept { return count_; }
    [[nodiscard]] const EdgePoint& operator[](std::size_t i) const noexcept { return point_[i]; }
    [[nodiscard]] Vec3 outwards(std::size_t i) const noexcept { return outwards_[i]; }  ///< unit normal
    [[nodiscard]] double width() const noexcept { return width_; }                      ///< [m] sum over all points
    /// Returns how far inside the head a point samples bone [m]: the largest error of the wall of the burr's own
    /// groove.
    [[nodiscard]] double inside(std::size_t i) const noexcept { return inside_[i]; }
    /// Samples bone at all points, along their normals.   [haptic, nonblocking]
    void sample(const BoneQuery& bone, std::span<kerf_bone_sample> out) const noexcept {
        bone.sample({sample_point_.data(), count_}, {outwards_.data(), count_}, out);
    }
    /// Returns the sector of a point of the head.
    [[nodiscard]] static std::size_t sector_of(const MeridianPoint& at, double along, double meridian,
                                               std::size_t column) noexcept;

private:
    std::array<EdgePoint, max_points> point_;
    std::array<Vec3, max_points> outwards_, sample_point_;
    std::size_t count_ = 0;
    std::array<double, max_points> inside_;
    double width_ = 0.0;
};

/// Returns the angle of a column of points about the axis.
[[nodiscard]] SinCos azimuth_of(std::size_t column) noexcept;

/// Bone at the points in this tick.
struct EdgesInBone {
    std::array<double, EdgePoints::max_points>
        resisted;  ///< [–] resistance of each point, relative to the reference tissue
    std::array<double, EdgePoints::max_points> gap;  ///< [m] to bone, along the point's normal
    double engaged = 0.0;                            ///< [m] of blade in bone

    void sample(const EdgePoints& points, const BurrParameters& law, const BoneQuery& bone) noexcept;
};

}  // namespace kerf::burring
