// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/haptics/scene/simulation.h"
#include "run/scene.h"
#include "run/verdict/step_monitor.h"
#include "session/recording.h"

namespace kerf::run {

/// Adds the zones that the report draws, at their final poses, and where the tool came closest to each: zones of the
/// anatomy, and tissues that a limit names.   [main]
void add_zone_rows(const StepMonitor& monitor, const Scene& scene, const Simulation& simulation,
                   session::RunSummary& summary);

}  // namespace kerf::run
