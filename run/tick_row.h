// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "core/haptics/scene/simulation.h"
#include "run/scene.h"
#include "run/signal_table.h"
#include "run/verdict/step_monitor.h"
#include "session/recording.h"

/// What a tick left, as the record keeps it.
namespace kerf {

/// How deep the tip is below the surface of the bone as it was before any cut [m], where the body has moved to. [main]
[[nodiscard]] double tip_inside(const Simulation& simulation, const StepMonitor& monitor, Vec3 tip);

/// The material under the tip, present bone only; −1 in air.   [main]
[[nodiscard]] std::int32_t tissue_at(const Scene& scene, const Simulation& simulation, Vec3 tip);

/// The row of the tick that just was.   [main]
/// @param handle    what the device reported, world frame
/// @param removed   [m³] so far
[[nodiscard]] TickRow row_of(const TickResult& result, const Scene& scene, const Simulation& simulation,
                             const StepMonitor& monitor, const SignalTable& signals, const Pose& handle,
                             std::int32_t tissue, double removed);

/// What the host knows of one of its own events beyond its id.   [main]
[[nodiscard]] std::string detail_of(const std::string& event, const Simulation& simulation);

}  // namespace kerf
