// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/haptics/scene/simulation.h"
#include "run/scene.h"
#include "run/verdict/step_monitor.h"

namespace kerf::run {

/// Updates the frames of steps on holes of implants, each in the frame of the body that owns the step. They follow the
/// implant in the scene, or its planned pose if it is not there yet.   [main] between ticks
void follow_plates(const Scene& scene, const Simulation& simulation, StepMonitor& monitor);

/// Returns the sleeve of the running step, on the step's axis in the monitor and on the body that owns it; nothing for
/// an instrument without a sleeve.   [main]
[[nodiscard]] std::optional<Guide> guide_of_step(const Scene& scene, const StepMonitor& monitor);

}  // namespace kerf::run
