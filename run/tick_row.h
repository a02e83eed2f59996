// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "core/haptics/scene/simulation.h"
#include "run/scene.h"
#include "run/signal_table.h"
#include "run/verdict/step_monitor.h"
#include "session/recording.h"

/// Computes the recorded row of a tick.
namespace kerf::run {

/// Returns the depth of the tip below the surface of the uncut bone [m], at the body's present pose. [main]
[[nodiscard]] double tip_inside(const Simulation& simulation, const StepMonitor& monitor, Vec3 tip);

/// Returns the material at the tip, in present bone only; −1 in air.   [main]
[[nodiscard]] std::int32_t tissue_at(const Scene& scene, const Simulation& simulation, Vec3 tip);

/// Returns the row of the last tick.   [main]
/// @param handle    pose that the device reported, world frame
/// @param removed   [m³] total so far
[[nodiscard]] session::TickRow row_of(const TickResult& result, const Scene& scene, const Simulation& simulation,
                                      const StepMonitor& monitor, const SignalTable& signals,
                                      const Pose& world_from_handle, std::int32_t tissue, double removed);

/// Returns details of an event of the host, as text.   [main]
[[nodiscard]] std::string event_detail(const std::string& event, const Simulation& simulation);

}  // namespace kerf::run
