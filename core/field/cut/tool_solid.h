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

/// What a tool removes or is: a solid of revolution about its z axis, which may be hollow, or a prism.
namespace kerf {

/// The outline is a polyline (z, radius) from the tip (largest z) backwards; it is closed by the axis and by a flat
/// end cap behind its last point. Tool frame [m].
///
/// A prism, such as a saw's blade, has the same outline with half of its width along x for the radius, and two flat
/// sides across y. So all that is said of (r, z) holds for both, with r = |x| in a prism.
class ToolSolid {
public:
    ToolSolid() = default;
    /// Pre: at least two points, z strictly falling, radii ≥ 0 (asserted).
    explicit ToolSolid(std::vector<kerf_profile_point> outline) : ToolSolid(std::move(outline), 0.0) {}
    /// A prism of `thickness` > 0 [m]. Pre: its outline is convex as well (asserted).
    [[nodiscard]] static ToolSolid prism(std::vector<kerf_profile_point> outline, double thickness) {
        return ToolSolid(std::move(outline), 0.5 * thickness);
    }

    /// A solid of revolution in several parts: it is not where a gap is. Pre: gaps within the outline's length, from
    /// the tip backwards, apart (asserted).
    struct Gap {
        double front, back;  ///< z [m]
    };
    [[nodiscard]] static ToolSolid parts(std::vector<kerf_profile_point> outline, double bore,
                                         const std::vector<Gap>& gaps);
    /// The parts of a solid, from the tip backwards: itself, if it has no gap.
    [[nodiscard]] std::vector<ToolSolid> each_part() const;
    [[nodiscard]] bool has_gaps() const noexcept { return !gaps_.empty(); }
    [[nodiscard]] const std::vector<Gap>& gaps() const noexcept { return gaps_; }

    /// A hollow solid of revolution: a bore of radius `bore` [m] goes all through it. Pre: 0 < bore, less than the
    /// largest radius (asserted).
    [[nodiscard]] static ToolSolid hollow(std::vector<kerf_profile_point> outline, double bore) {
        return ToolSolid(std::move(outline), 0.0, bore);
    }

    /// Exact signed distance [m], negative inside; outside of a hollow solid, before its rim, no more than that. A
    /// convex solid's is that to the plane of its nearest face, unless an edge of the outline is nearer still.   [any]
    /// pure.
    [[nodiscard]] double distance(Vec3 point_in_tool) const noexcept;

    /// Minus the distance of a block [m].   [any] pure, nonblocking.
    void depths(const PointBlock& points_in_tool, BlockValues& depths) const noexcept;
    /// The same with the points given in another frame.
    void depths(const Pose& tool_from_other, const PointBlock& points_in_other, BlockValues& depths) const noexcept;

    /// For kernels in single precision.
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

    /// Of a prism's outline those faces that may be the nearest to a point which is no farther than `reach` [m] from
    /// the surface and no farther than `spread` from x in the direction of x: with them alone such a point's distance
    /// has the same bits.   [any] pure.
    [[nodiscard]] SingleOutline faces_near(SingleOutline whole, double x, double spread, double reach) const noexcept;

    /// A plane for each point of a block that the solid does not cross: around it nothing is deeper than the plane,
    /// depth + gradient · (from the point) [m], [–]. Pre: is_convex().   [any] pure, nonblocking.
    void tangents(const PointBlock& points_in_tool, BlockValues& depths, PointBlock& gradients) const noexcept {
        gradients.count = points_in_tool.count;
        block_kernel().tangents(shape(), points_in_tool.count, points_in_tool.coordinates(), depths.data(),
                                gradients.writable());
    }

    /// No point of the box is deeper [m]. Pre: is_convex().   [any] pure.
    [[nodiscard]] double deepest_in(Vec3 middle_in_tool, Vec3 half_extent) const noexcept;

    /// No point of the box is deeper by more than this [m] where it stands than it was before it moved there: by
    /// `moved`, give or take `spread` [m]. Negative: all have become less deep. Points that were deeper than `deepest`
    /// do not count. Pre: convex, and no prism. [any] pure, nonblocking.
    [[nodiscard]] double most_gained(Vec3 middle_in_tool, Vec3 half_extent, Vec3 moved, double spread,
                                     double deepest) const noexcept;

    /// A point that is outside, before the solid's back end, and inside after it has gone to `moved` times its place,
    /// or at any instant of a straight way there that turns evenly, was outside by no more than this, less what it is
    /// inside then [m]. Pre: convex. [any] pure, nonblocking.
    [[nodiscard]] double most_gained_outside(const Pose& moved) const noexcept;

    /// Whether an edge of the outline, or of the solid's ends, may be so near to a point of a box. If none is, then
    /// what of the box lies outside a convex solid, by half of `distance` at most, lies beside a face.   [any] pure.
    [[nodiscard]] bool has_edge_within(Vec3 middle_in_tool, Vec3 half_extent, double distance) const noexcept;

    /// The unit vector along which a point's depth grows fastest: away from the nearest surface inside, towards it
    /// outside; on the surface inwards.   [any] pure.
    [[nodiscard]] Vec3 way_in(Vec3 point_in_tool) const noexcept;

    /// How far `point` must travel along unit `direction` to leave the solid [m]; 0 when it is outside or on the
    /// surface (within `tolerance`), infinite never: the solid is bounded.   [any] pure.
    [[nodiscard]] double travel_to_leave(Vec3 point_in_tool, Vec3 direction, double tolerance = 1e-9) const noexcept;

    /// Whether a straight line that has left the solid stays outside.
    [[nodiscard]] bool is_convex() const noexcept { return is_convex_; }
    [[nodiscard]] double tip_z() const noexcept { return outline_.front().z; }
    [[nodiscard]] double end_z() const noexcept { return outline_.back().z; }
    [[nodiscard]] double largest_radius() const noexcept { return largest_radius_; }
    /// [m] of its back end over which it is as wide as anywhere, if it only narrows from there to its tip; else 0. Such
    /// a solid covers its own way along its axis: where it was on a slide shorter than this, it is at one of its ends.
    [[nodiscard]] double land() const noexcept { return land_; }
    /// Solids of one shape have one; others another.
    [[nodiscard]] std::uint64_t shape_hash() const noexcept { return shape_hash_; }
    [[nodiscard]] bool is_prism() const noexcept { return half_thickness_ > 0.0; }
    [[nodiscard]] double thickness() const noexcept { return 2.0 * half_thickness_; }  ///< [m] of a prism; else 0
    [[nodiscard]] bool is_hollow() const noexcept { return bore_ > 0.0; }
    [[nodiscard]] double bore() const noexcept { return bore_; }  ///< [m] radius, of a hollow solid; else 0

    /// Eight points around the solid where its outline has `radius` at `z`. Of a prism those on its flat sides stand
    /// away from its edges, which a grid rounds off.   [any] pure.
    [[nodiscard]] std::array<Vec3, 8> around(double radius, double z) const noexcept;
    /// The same all along the outline, rings of points at most `apart` [m] from each other: `visit(ring)`.   [any]
    /// nonblocking
    template <class Visit>
    void for_each_ring(double apart, const Visit& visit) const {
        constexpr double most = 64.0;  // along one stretch
        for (std::size_t i = 0; i + 1 < outline_.size(); ++i) {
            const double dz = outline_[i + 1].z - outline_[i].z, dr = outline_[i + 1].radius - outline_[i].radius;
            const int steps = static_cast<int>(std::clamp(std::ceil(std::hypot(dz, dr) / apart), 1.0, most));
            for (int step = i == 0 ? 0 : 1; step <= steps; ++step) {
                const double t = static_cast<double>(step) / steps;
                visit(around(outline_[i].radius + t * dr, outline_[i].z + t * dz));
            }
        }
    }
    /// A box in the other frame that holds the solid.   [any] pure.
    struct Box {
        Vec3 low, high;
    };
    [[nodiscard]] Box box(const Pose& other_from_tool) const noexcept;
    [[nodiscard]] const std::vector<kerf_profile_point>& outline() const noexcept { return outline_; }

private:
    ToolSolid(std::vector<kerf_profile_point> outline, double half_thickness, double bore = 0.0);

    /// Where a point stands in the plane of the outline.
    [[nodiscard]] double radius_of(Vec3 p) const noexcept {
        return is_prism() ? std::abs(p.x) : std::sqrt(p.x * p.x + p.y * p.y);
    }
    /// The distance in that plane.
    [[nodiscard]] double distance(double r, double z) const noexcept;
    [[nodiscard]] Vec3 way_in_of_prism(Vec3 p) const noexcept;
    /// The way to the nearest point of the outline, squared.
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
    double bore_ = 0.0;            ///< [m] 0: it is not hollow
    std::vector<Gap> gaps_;
    std::vector<OutlineGap> slabs_;  ///< the gaps for kernels
    std::vector<SingleGap> single_slabs_;
    std::uint64_t shape_hash_ = 0;
    bool is_convex_ = true;
    bool is_blunt_ = true;  ///< its faces meet at 60° or more
};

}  // namespace kerf
