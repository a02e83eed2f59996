// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "run/scene.h"

namespace kerf {

/// Where the tool of a step is when it is fed straight along the step's axis, as the tool declares: with its tip at
/// `depth` [m] past the entry; or lying across the axis, its x into the bone, with its widest cutting point there.
/// [any] pure.
[[nodiscard]] Pose planned_pose(const Scene& scene, std::size_t step, double depth);

/// The direction of that feed in the tool frame.   [any] pure.
[[nodiscard]] Vec3 planned_direction(const Scene& scene, std::size_t step);

}  // namespace kerf
