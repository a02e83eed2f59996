// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/field/grid/point_block.h"
#include "kerf/math.hpp"

/// The solid of a tool: a solid of revolution about its z axis, which may be hollow, or a prism.
namespace kerf {

/// The outline is a polyline (z, radius) from the tip (largest z) backwards. It is closed by the axis and by flat ends
/// at its first and last point. Tool frame [m].
///
/// A prism, such as a saw's blade, has the same kind of outline and two flat sides across y. Its radius is half of its
/// width along x. Comments on (r, z) are valid for both, with r = |x| in a prism.
class ToolSolid {
public:
    ToolSolid() = default;
    /// Makes a solid of revolution. Pre: at least two points, z strictly falling, radii ≥ 0 (asserted).
    explicit ToolSolid(std::vector<kerf_profile_point> outline) : ToolSolid(std::move(outline), 0.0) {}
    /// Returns a prism of `thickness` > 0 [m]. Pre: its outline is convex as well (asserted).
    [[nodiscard]] static ToolSolid prism(std::vector<kerf_profile_point> outline, double thickness) {
        return ToolSolid(std::move(outline), 0.5 * thickness);
    }

    /// A gap in a solid of revolution, at which it has no material. Pre: gaps lie within the outline's length, from the
    /// tip backwards, and do not touch (asserted).
    struct Gap {
        double front, back;  ///< z [m]
    };
    [[nodiscard]] static ToolSolid parts(std::vector<kerf_profile_point> outline, double bore,
                                         const std::vector<Gap>& gaps);
    /// Returns the parts of a solid, from the tip backwards; the solid itself if it has no gap.
    [[nodiscard]] std::vector<ToolSolid> each_part() const;
    [[nodiscard]] bool has_gaps() const noexcept { return !gaps_.empty(); }
    [[nodiscard]] const std::vector<Gap>& gaps() const noexcept { return gaps_; }

    /// Returns a solid of revolution with a bore of radius `bore` [m] through its whole length. Pre: 0 < bore < largest
    /// radius (asserted).
    [[nodiscard]] static ToolSolid hollow(std::vector<kerf_profile_point> outline, double bore) {
        return ToolSolid(std::move(outline), 0.0, bore);
    }

    /// Returns the exact signed distance [m], negative inside; outside, next to a bore or a gap, a lower bound. For a
    /// convex solid it is the distance to the plane of the nearest face, unless an edge of the outline is nearest.
    /// [any] pure.
    [[nodiscard]] double distance(Vec3 point_in_tool) const noexcept;

    /// Writes minus `distance` [m] for a block of points.   [any] pure, nonblocking.
    void depths(const PointBlock& points_in_tool, BlockValues& depths) const noexcept;
    /// Writes minus `distance` [m] for a block of points that are given in another frame.
    void depths(const Pose& tool_from_other, const PointBlock& points_in_other, BlockValues& depths) const noexcept;

    /// Returns the outline for kernels in single precision.
    [[nodiscard]] SingleOutline single() const noexcept {
        const auto &front = outline_.front(), &back = outline_.back();
        return {faces_.data(),
                faces_.size(),
                static_cast<float>(front.radius),
                static_cast<float>(front.z),
                static_cast<float>(back.radius),
                static_cast<float>(back.z),
                is_convex_,
                static_cast<float>(half_thickness_),
                static_cast<float>(bore_),
                single_slabs_.data(),
                single_slabs_.size()};
    }

    /// Returns `whole`, the outline of a prism, with only the faces that may be nearest to certain points. These points
    /// are within `reach` [m] of the surface, and within `spread` [m] of `x` along x. Their distances keep the same
    /// bits.   [any] pure.
    [[nodiscard]] SingleOutline faces_near(SingleOutline whole, double x, double spread, double reach) const noexcept;

    /// Writes for each point its depth [m] below a plane that the solid does not cross, and the gradient [–] of this
    /// depth. At any offset from the point, the depth in the solid is at most depth + gradient · offset. Pre:
    /// is_convex().   [any] pure, nonblocking.
    void tangents(const PointBlock& points_in_tool, BlockValues& depths, PointBlock& gradients) const noexcept {
        gradients.count = points_in_tool.count;
        block_kernel().tangents(shape(), points_in_tool.count, points_in_tool.coordinates(), depths.data(),
                                gradients.writable());
    }

    /// Returns an upper bound of the depth in the solid of any point of a box [m]. Pre: is_convex().   [any] pure.
    [[nodiscard]] double deepest_in(Vec3 middle_in_tool, Vec3 half_extent) const noexcept;

    /// Returns an upper bound of the gain in depth [m] of any point that is now in a box. Relative to the solid, each
    /// point has moved by `moved`, with an uncertainty of `spread` [m]. Negative: all points have become less deep.
    /// Points that were deeper than `deepest` [m] do not count. Pre: convex, not a prism.   [any] pure, nonblocking.
    [[nodiscard]] double max_depth_gain(Vec3 middle_in_tool, Vec3 half_extent, Vec3 moved, double spread,
                                        double deepest) const noexcept;

    /// Returns an upper bound of the gain in depth [m] of a point: former distance plus present depth. It is valid for
    /// a point that was outside, ahead of the solid's back end, and is inside at `moved` · former position. It is also
    /// valid at any instant of a straight motion to there with uniform rotation. Pre: convex.
    /// [any] pure, nonblocking.
    [[nodiscard]] double max_depth_gain_outside(const Pose& moved) const noexcept;

    /// Returns whether an edge of the outline or of the solid's ends may be within `distance` [m] of a point of a box.
    /// If not, any point of the box that is outside a convex solid by at most `distance` / 2 is nearest to a face's
    /// interior.   [any] pure.
    [[nodiscard]] bool has_edge_within(Vec3 middle_in_tool, Vec3 half_extent, double distance) const noexcept;

    /// Returns the unit vector along which a point's depth grows fastest: inside, away from the nearest surface;
    /// outside, towards it; on the surface, inwards.   [any] pure.
    [[nodiscard]] Vec3 inward_direction(Vec3 point_in_tool) const noexcept;

    /// Returns the distance [m] that `point` must travel along unit `direction` to leave the solid; 0 if it is outside
    /// or on the surface (within `tolerance`). Always finite: the solid is bounded.   [any] pure.
    [[nodiscard]] double travel_to_leave(Vec3 point_in_tool, Vec3 direction, double tolerance = 1e-9) const noexcept;

    /// Returns whether a straight line that has left the solid stays outside.
    [[nodiscard]] bool is_convex() const noexcept { return is_convex_; }
    [[nodiscard]] double tip_z() const noexcept { return outline_.front().z; }
    [[nodiscard]] double end_z() const noexcept { return outline_.back().z; }
    [[nodiscard]] double largest_radius() const noexcept { return largest_radius_; }
    /// Returns the length [m] of the back part with the largest radius, if the solid only narrows from there to its
    /// tip; else 0. Such a solid covers its own slides along its axis: on a slide shorter than this, its sweep is the
    /// union of its two end poses.
    [[nodiscard]] double land() const noexcept { return land_; }
    /// Returns a 64-bit hash of the shape: equal for solids of the same shape.
    [[nodiscard]] std::uint64_t shape_hash() const noexcept { return shape_hash_; }
    [[nodiscard]] bool is_prism() const noexcept { return half_thickness_ > 0.0; }
    [[nodiscard]] double thickness() const noexcept { return 2.0 * half_thickness_; }  ///< [m] of a prism; else 0
    [[nodiscard]] bool is_hollow() const noexcept { return bore_ > 0.0; }
    [[nodiscard]] double bore() const noexcept { return bore_; }  ///< [m] radius of a hollow solid's bore; else 0

    /// Returns eight points around the solid's surface at `z`, where its outline has `radius`. Points on the flat sides
    /// of a prism keep a distance from its edges, which a grid rounds off.   [any] pure.
    [[nodiscard]] std::array<Vec3, 8> around(double radius, double z) const noexcept;
    /// Calls `visit(ring)` for rings of eight points along the whole outline. Rings are at most `apart` [m] from each
    /// other, but at most 64 steps divide a segment.   [any] nonblocking
    template <class Visit>
    void for_each_ring(double apart, const Visit& visit) const {
        constexpr double maximum = 64.0;  // steps along one segment
        for (std::size_t i = 0; i + 1 < outline_.size(); ++i) {
            const double dz = outline_[i + 1].z - outline_[i].z, dr = outline_[i + 1].radius - outline_[i].radius;
            const int steps = static_cast<int>(std::clamp(std::ceil(std::hypot(dz, dr) / apart), 1.0, maximum));
            for (int step = i == 0 ? 0 : 1; step <= steps; ++step) {
                const double t = static_cast<double>(step) / steps;
                visit(around(outline_[i].radius + t * dr, outline_[i].z + t * dz));
            }
        }
    }
    /// A box along the axes of the other frame that contains the solid.   [any] pure.
    struct Box {
        Vec3 low, high;
    };
    [[nodiscard]] Box box(const Pose& other_from_tool) const noexcept;
    [[nodiscard]] const std::vector<kerf_profile_point>& outline() const noexcept { return outline_; }

private:
    ToolSolid(std::vector<kerf_profile_point> outline, double half_thickness, double bore = 0.0);

    /// Returns the radial coordinate of a point in the plane of the outline.
    [[nodiscard]] double radius_of(Vec3 p) const noexcept {
        return is_prism() ? std::abs(p.x) : std::sqrt(p.x * p.x + p.y * p.y);
    }
    /// Returns the signed distance in that plane [m], negative inside.
    [[nodiscard]] double distance(double r, double z) const noexcept;
    [[nodiscard]] Vec3 inward_direction_of_prism(Vec3 p) const noexcept;
    /// Returns the squared distance to the nearest point of the outline or of its flat ends [m²].
    [[nodiscard]] double squared_distance(double r, double z) const noexcept;
    [[nodiscard]] OutlineShape shape() const noexcept {
        return {outline_.data(), segments_.data(), outline_.size(), largest_radius_, is_convex_, half_thickness_,
                bore_,           slabs_.data(),    slabs_.size()};
    }

    std::vector<kerf_profile_point> outline_;
    std::vector<OutlineSegment> segments_;
    std::vector<OutlineFace> faces_;
    double largest_radius_ = 0.0;
    double land_ = 0.0;
    double half_thickness_ = 0.0;  ///< [m] 0: a solid of revolution
    double bore_ = 0.0;            ///< [m] 0: not hollow
    std::vector<Gap> gaps_;
    std::vector<OutlineGap> slabs_;  ///< the gaps for kernels
    std::vector<SingleGap> single_slabs_;
    std::uint64_t shape_hash_ = 0;
    bool is_convex_ = true;
    bool is_blunt_ = true;  ///< all angles between neighbouring faces, inside the solid, are 60° or more
};

}  // namespace kerf
