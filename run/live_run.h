// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "documents/station.h"
#include "run/clock/tick_clock.h"
#include "run/device/mouse_totals.h"
#include "run/device/opened_device.h"
#include "run/run_procedure.h"

namespace kerf::run {

/// Runs a rehearsal of the scene's procedure on a clock: the simulated hand moves in real time, and the periods that
/// the clock missed pass for the hand, too. The session replays to the same bits.   [main] ticks and run are on the
/// calling thread, one after the other
[[nodiscard]] RunOutcome run_on_clock(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request,
                                      TickClock& clock);

/// Does the same with the ticks on a thread of their own, while the run follows on the calling thread: as on the wall
/// clock, but with any clock, which must leave the run time to follow.   [main]
[[nodiscard]] RunOutcome run_beside_clock(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request,
                                          TickClock& clock);

/// Runs a procedure on a clock with a hand at a device. A device that is silent for 10 s ends the run. The session
/// replays to the same bits.   [main] ticks and run are on the calling thread, one after the other
/// Pre: the scene was made for the device's record.
[[nodiscard]] RunOutcome run_on_clock(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request,
                                      TickClock& clock, OpenedDevice& device, const documents::DeviceStation& station);

/// Runs a procedure on a clock with a hand whose aim a mouse moves: `box` gets the mouse's totals, from any one other
/// thread. The request's rehearsal gives the pose at the start and the actions of the steps, and nothing else. While
/// the totals are paused no tick runs, so the run cannot end either. The session replays to the same bits.   [main]
/// ticks and run are on the calling thread, one after the other
[[nodiscard]] RunOutcome run_on_clock(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request,
                                      TickClock& clock, MouseBox& box);
/// Does the same with the ticks on a thread of their own.   [main]
[[nodiscard]] RunOutcome run_beside_clock(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request,
                                          TickClock& clock, MouseBox& box);

/// Runs a rehearsal on the wall clock, on a real-time thread, or with a hand at a device or mouse. The summary gets the
/// clock's figures.   [main]
[[nodiscard]] RunOutcome run_live(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request);
[[nodiscard]] RunOutcome run_live(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request,
                                  OpenedDevice& device, const documents::DeviceStation& station);
[[nodiscard]] RunOutcome run_live(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request,
                                  MouseBox& box);

}  // namespace kerf::run
