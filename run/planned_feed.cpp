// SPDX-License-Identifier: Apache-2.0
#include "run/planned_feed.h"

#include <algorithm>
#include <cmath>

namespace kerf::run {
namespace {

bool is_fed_sideways(const Tool& tool) { return tool.setup.tool->tool->feed == KERF_FEED_SIDE; }

}  // namespace

Pose planned_pose(const Scene& scene, std::size_t step, double depth) {
    const Pose tip_first = scene.frames[step].pose_at({.depth = depth});
    const Tool& tool = scene.tool(step);
    if (!is_fed_sideways(tool)) {
        const double turn = depth * turn_of_feed(tool.setup, tool.outline);
        return turn != 0.0 ? tip_first * Pose{{}, quat_from_rotation_vector({0, 0, turn})} : tip_first;
    }
    const auto& cutting = tool.outline.cutting.outline();
    const auto widest = std::max_element(cutting.begin(), cutting.end(),
                                         [](const auto& a, const auto& b) { return a.radius < b.radius; });
    const Quat lying{std::sqrt(0.5), 0.0, -std::sqrt(0.5), 0.0};  // tool x along the axis
    return tip_first * Pose{-rotate(lying, Vec3{widest->radius, 0.0, widest->z}), lying};
}

Vec3 planned_direction(const Scene& scene, std::size_t step) {
    return is_fed_sideways(scene.tool(step)) ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
}

}  // namespace kerf::run
