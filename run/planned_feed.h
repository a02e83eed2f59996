// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "run/scene.h"

namespace kerf::run {

/// Returns the tool pose for a straight feed along the step's axis. The tip is at `depth` [m] beyond the entry. A tool
/// with side feed lies across the axis, its x axis into the bone, with its widest cutting point there. [any] pure.
[[nodiscard]] Pose planned_pose(const Scene& scene, std::size_t step, double depth);

/// Returns the direction of that feed in the tool frame.   [any] pure.
[[nodiscard]] Vec3 planned_direction(const Scene& scene, std::size_t step);

}  // namespace kerf::run
