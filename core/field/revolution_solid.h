// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/field/point_block.h"
#include "kerf/math.hpp"

/// A solid of revolution about the tool's z axis.
namespace kerf {

/// The outline is a polyline (z, radius) from the tip (largest z) backwards; it is closed by the axis and by a flat
/// end cap behind its last point. Tool frame [m].
class RevolutionSolid {
public:
    RevolutionSolid() = default;
    /// Pre: at least two points, z strictly falling, radii ≥ 0 (asserted).
    explicit RevolutionSolid(std::vector<kerf_profile_point> outline);

    /// Exact signed distance [m], negative inside. A convex solid's is that to the plane of its nearest face, unless an edge
    /// of the outline is nearer still.   [any] pure.
    [[nodiscard]] double distance(Vec3 point_in_tool) const noexcept;

    /// Minus the distance of a block [m].   [any] pure, nonblocking.
    void depths(const PointBlock& points_in_tool, BlockValues& depths) const noexcept;
    /// The same with the points given in another frame.
    void depths(const Pose& tool_from_other, const PointBlock& points_in_other, BlockValues& depths) const noexcept;

    /// Raises the samples of a cell [quanta] to their depths, rounded to the nearest quantum; those farther than `band` [m]
    /// outside raise nothing. True if any was raised; tells in which range they are then.   [any] nonblocking.
    bool raise(const SampleCell& cell, double band, double quantum, std::int16_t* samples, std::int16_t& lowest,
               std::int16_t& highest) const noexcept {
        return block_kernel().raise(shape(), cell, band, quantum, samples, lowest, highest);
    }

    /// A plane for each point of a block that the solid does not cross: around it nothing is deeper than the plane,
    /// depth + gradient · (from the point) [m], [–]. Pre: is_convex().   [any] pure, nonblocking.
    void tangents(const PointBlock& points_in_tool, BlockValues& depths, PointBlock& gradients) const noexcept {
        gradients.count = points_in_tool.count;
        block_kernel().tangents(shape(), points_in_tool.count, points_in_tool.coordinates(), depths.data(),
                                gradients.writable());
    }

    /// No point of the box is deeper [m]. Pre: is_convex().   [any] pure.
    [[nodiscard]] double deepest_in(Vec3 middle_in_tool, Vec3 half_extent) const noexcept;

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
    [[nodiscard]] const std::vector<kerf_profile_point>& outline() const noexcept { return outline_; }

private:
    /// The way to the nearest point of the outline, squared.
    [[nodiscard]] double squared_distance(double r, double z) const noexcept;
    [[nodiscard]] OutlineShape shape() const noexcept {
        return {outline_.data(), segments_.data(), outline_.size(), largest_radius_, is_convex_};
    }

    std::vector<kerf_profile_point> outline_;
    std::vector<OutlineSegment> segments_;
    double largest_radius_ = 0.0;
    bool is_convex_ = true;
};

}  // namespace kerf
