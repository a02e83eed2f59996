// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "core/field/cut/tool_solid.h"

/// A solid on its way from one pose to another.
namespace kerf {

/// The farthest any point of the solid moves between two poses [m].   [any] pure.
[[nodiscard]] double largest_motion(const ToolSolid& solid, const Pose& from, const Pose& to) noexcept;

/// What of a solid's way from one pose to another leaves ridges between them, and what does not.
struct Travel {
    double motion = 0.0;  ///< [m] `largest_motion`
    double along = 0.0;   ///< [m] its slide along its own axis, which it covers
    /// [m] The farthest that any of its points moves besides: twice that, as on a slide only the pose ahead of a point
    /// can cover it; or all of its motion, if that is less.
    double aside = 0.0;
};
/// `depth` [m]: as deep as anybody asks within the solid. A slide is covered by a land that is longer by twice that.
/// [any] pure.
[[nodiscard]] Travel travel(const ToolSolid& solid, const Pose& from, const Pose& to, double depth) noexcept;

/// The pose a share `t` of the way from `from` to `to`.   [any] pure.
[[nodiscard]] Pose between(const Pose& from, const Pose& to, double t) noexcept;

class Sweep {
public:
    /// Poses are body_from_tool. `step` [m]: the farthest that any point may move from one sub-pose to the next, but
    /// for a slide that the solid covers to a depth of `depth` [m].
    Sweep(const ToolSolid& solid, const Pose& from, const Pose& to, double step, double depth) noexcept;

    /// How many sub-poses follow `from`; the last is `to`. A function of poses, solid, step and depth alone.
    [[nodiscard]] int sub_poses() const noexcept { return count_; }
    /// Sub-pose 0 is `from`.
    [[nodiscard]] Pose sub_pose(int i) const noexcept {
        return i == 0 ? from_ : i == count_ ? to_ : between(from_, to_, static_cast<double>(i) / count_);
    }
    /// No point of the sweep lies farther than this outside the nearest of the sub-poses after `from` [m].
    [[nodiscard]] double step() const noexcept { return slack * motion_ / count_; }

    /// Whether the solid holds `point` (body frame) at any pose on the way, deeper than `tolerance` [m].
    /// The distance to a solid changes no faster than its points move: what lies between two poses is bounded by what
    /// is at them, and halved until that bound decides.   [any] pure, nonblocking.
    [[nodiscard]] bool holds(Vec3 point, double tolerance) const noexcept;

    /// For a block: false where `holds` is, for most such points at the cost of two distances.   [any] pure,
    /// nonblocking.
    void may_hold(const PointBlock& points_in_body, double tolerance,
                  std::array<bool, block_capacity>& may) const noexcept;

private:
    static constexpr double slack = 1.02;  ///< for turns, whose speed is not quite uniform between two sub-poses

    struct Instant {
        double t, depth;
    };
    [[nodiscard]] Instant at(double t, Vec3 point) const noexcept;
    [[nodiscard]] bool holds_between(const Instant& a, const Instant& b, Vec3 point, double tolerance) const noexcept;

    const ToolSolid* solid_;
    Pose from_, to_;
    double motion_;  ///< [m]
    int count_;
};

}  // namespace kerf
