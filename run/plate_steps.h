// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/haptics/scene/simulation.h"
#include "run/scene.h"
#include "run/verdict/step_monitor.h"

namespace kerf {

/// Lets the steps on holes of implants follow the implants that are in the scene, each in the frame of the body that
/// the step belongs to; of one that is not there its planned pose.   [main] between ticks
void follow_plates(const Scene& scene, const Simulation& simulation, StepMonitor& monitor);

/// Returns the sleeve of the step that runs, on the step's axis as the monitor has it, on the body that the axis
/// belongs to; nothing for an instrument without one.   [main]
[[nodiscard]] std::optional<Guide> guide_of_step(const Scene& scene, const StepMonitor& monitor);

}  // namespace kerf
