// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "documents/station.h"
#include "run/clock/tick_clock.h"
#include "run/device/opened_device.h"
#include "run/run_procedure.h"

namespace kerf::run {

/// Runs a rehearsal of the scene's procedure on a clock: the simulated hand moves in real time, and the periods that
/// the clock missed pass for the hand, too. The session replays in lock-step to the same bits.   [main] the ticks run
/// on the calling thread
[[nodiscard]] RunOutcome run_on_clock(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request,
                                      TickClock& clock);

/// Runs a procedure on a clock with a hand at a device. A device that is silent for 10 s ends the run. The session
/// replays in lock-step to the same bits.   [main] the ticks run on the calling thread
/// Pre: the scene was made for the device's record.
[[nodiscard]] RunOutcome run_on_clock(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request,
                                      TickClock& clock, OpenedDevice& device, const documents::DeviceStation& station);

/// Runs a rehearsal on the wall clock, on a real-time thread, or with a hand at a device. The summary gets the clock's
/// figures.   [main]
[[nodiscard]] RunOutcome run_live(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request);
[[nodiscard]] RunOutcome run_live(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request,
                                  OpenedDevice& device, const documents::DeviceStation& station);

}  // namespace kerf::run
