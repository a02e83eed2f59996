// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "core/field/cut/tool_solid.h"

/// The motion of a solid from one pose to another.
namespace kerf {

/// Returns the largest distance that any point of the solid moves between two poses [m].   [any] pure.
[[nodiscard]] double largest_motion(const ToolSolid& solid, const Pose& from, const Pose& to) noexcept;

/// A solid's motion in two parts: a slide along its axis, which leaves no ridges between sub-poses, and the rest, which
/// does.
struct Travel {
    double motion = 0.0;  ///< [m] `largest_motion`
    double along = 0.0;   ///< [m] slide along the axis; 0 if the solid does not cover slides
    /// [m] Twice the largest motion of any point apart from the slide, at most `motion`. Doubled, because during a
    /// slide only the sub-pose ahead of a point can cover it.
    double aside = 0.0;
};
/// Returns the parts of a motion. `depth` [m]: up to this depth, the union of the sub-poses must be as deep as the
/// sweep. So the solid covers slides only if its land is longer than twice `depth`.   [any] pure.
[[nodiscard]] Travel travel(const ToolSolid& solid, const Pose& from, const Pose& to, double depth) noexcept;

/// Returns the pose at fraction `t` of the motion from `from` to `to`.   [any] pure.
[[nodiscard]] Pose between(const Pose& from, const Pose& to, double t) noexcept;

class Sweep {
public:
    /// Poses are body_from_tool. `step` [m]: largest motion of any point from one sub-pose to the next, except for a
    /// slide that the solid covers to a depth of `depth` [m].
    Sweep(const ToolSolid& solid, const Pose& from, const Pose& to, double step, double depth) noexcept;

    /// Returns the number of sub-poses after `from`; the last is `to`. Depends on poses, solid, step and depth alone.
    [[nodiscard]] int sub_poses() const noexcept { return count_; }
    /// Returns sub-pose `i`; 0 is `from`.
    [[nodiscard]] Pose sub_pose(int i) const noexcept {
        return i == 0 ? from_ : i == count_ ? to_ : between(from_, to_, static_cast<double>(i) / count_);
    }
    /// Returns an upper bound of the distance [m] of a point of the sweep from the nearest sub-pose after `from`.
    [[nodiscard]] double step() const noexcept { return slack * motion_ / count_; }

    /// Returns whether the solid contains `point` (body frame) deeper than `tolerance` [m] at any pose of the motion.
    /// The distance to a solid changes no faster than its points move. This bounds it between two poses; intervals are
    /// bisected until the bound decides.   [any] pure, nonblocking.
    [[nodiscard]] bool contains(Vec3 point, double tolerance) const noexcept;

    /// Writes for a block of points whether `contains` may be true. For most points that are outside, the cost is two
    /// distances.   [any] pure, nonblocking.
    void may_contain(const PointBlock& points_in_body, double tolerance,
                     std::array<bool, block_capacity>& may) const noexcept;

private:
    static constexpr double slack = 1.02;  ///< for rotations, whose speed is not quite uniform between two sub-poses

    struct Instant {
        double t, depth;
    };
    [[nodiscard]] Instant at(double t, Vec3 point) const noexcept;
    [[nodiscard]] bool contains_between(const Instant& a, const Instant& b, Vec3 point,
                                        double tolerance) const noexcept;

    const ToolSolid* solid_;
    Pose from_, to_;
    double motion_;  ///< [m]
    int count_;
};

}  // namespace kerf
