// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "studies/chart/powered/powered_scene.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// What all scenes of Kerf's round burr share; bone, path and names are left to each.
[[nodiscard]] PoweredScene round_burr_scene(double diameter, double spindle_speed, double feed);

/// A tool with its tip at a point, its shaft straight up.
[[nodiscard]] inline Pose looking_down(Vec3 tip) noexcept { return {tip, quat_between({0, 0, 1}, {0, 0, -1})}; }

}  // namespace kerf::chart
