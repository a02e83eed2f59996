// SPDX-License-Identifier: Apache-2.0
#include "run/device/workspace_fit.h"

#include <algorithm>
#include <cstddef>

namespace kerf::run {

namespace {

constexpr double room = 20e-3;  // [m] on all sides of a planned path [assumed]

/// One side of a workspace: what the motion needs there, and the distance to its end [m].
struct Side {
    double needed, there;

    /// Returns the scale with which the motion fits.
    [[nodiscard]] double scale() const noexcept { return needed < there ? needed / there : 1.0; }
    /// Returns by how much the handle would leave the workspace [m].
    [[nodiscard]] double beyond(double scale) const noexcept {
        constexpr double rounding = 1e-6;  // [m]
        const double beyond = needed / scale - std::max(there, 0.0);
        return beyond > rounding ? beyond : 0.0;
    }
};

}  // namespace

WorkspaceFit fit_into(const Box& workspace, Vec3 handle, const Box& motion) noexcept {
    const Vec3 below = handle - workspace.low, above = workspace.high - handle;
    const Side down[] = {{-motion.low.x, below.x}, {-motion.low.y, below.y}, {-motion.low.z, below.z}};
    const Side up[] = {{motion.high.x, above.x}, {motion.high.y, above.y}, {motion.high.z, above.z}};
    double scale = documents::min_scale;
    for (std::size_t axis = 0; axis < 3; ++axis) scale = std::max({scale, down[axis].scale(), up[axis].scale()});
    return {.scale = scale,
            .below = {down[0].beyond(scale), down[1].beyond(scale), down[2].beyond(scale)},
            .above = {up[0].beyond(scale), up[1].beyond(scale), up[2].beyond(scale)}};
}

Box motion_of(const documents::Rehearsal& rehearsal, const Scene& scene, const documents::DeviceStation& station) {
    const HandPlan plan = plan_of(rehearsal, scene);
    const Quat device_from_world = conjugate(station.world_from_device());
    Box box;
    Vec3 moved{};
    Pose before = plan.start;
    for (std::size_t i = 0; i < plan.intent.legs.size(); ++i) {
        const Pose& after = plan.intent.legs[i].target;
        const Vec3 grip{0, 0, scene.tool(rehearsal.path[i + 1].step).outline.handling.grip_z};
        moved = moved + rotate(device_from_world, after * grip - before * grip);
        box = joined(box, moved);
        before = after;
    }
    return grown(box, room);
}

}  // namespace kerf::run
