// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/field/tool_solid.h"

/// A solid on its way from one pose to another.
namespace kerf {

/// The farthest any point of the solid moves between two poses [m].   [any] pure.
[[nodiscard]] double largest_motion(const ToolSolid& solid, const Pose& from, const Pose& to) noexcept;

/// The pose a share `t` of the way from `from` to `to`.   [any] pure.
[[nodiscard]] Pose between(const Pose& from, const Pose& to, double t) noexcept;

class Sweep {
public:
    /// Poses are body_from_tool. `step` [m]: the farthest that any point may move from one sub-pose to the next.
    Sweep(const ToolSolid& solid, const Pose& from, const Pose& to, double step) noexcept;

    /// How many sub-poses follow `from`; the last is `to`. A function of poses, solid and step alone.
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

    /// For a block: false where `holds` is, for most such points at the cost of two distances.   [any] pure, nonblocking.
    void may_hold(const PointBlock& points_in_body, double tolerance, std::array<bool, block_capacity>& may) const noexcept;

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
