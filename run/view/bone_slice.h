// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/haptics/scene/simulation.h"
#include "run/view/viewed_run.h"

namespace kerf::run {

/// Returns the distances to the committed bone of all bodies on a square of a plane that moves with the tool.   [main]
/// @param step  [m] between samples
/// @param edge  number of samples along each side
[[nodiscard]] ViewedSlice bone_slice(const Simulation& simulation, const Pose& tool_from_slice, double step, int edge);

}  // namespace kerf::run
