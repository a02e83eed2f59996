// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "run/clock/tick_clock.h"
#include "run/run_procedure.h"

namespace kerf::run {

/// Runs a rehearsal of the scene's procedure on a clock: the simulated hand moves in real time, and the periods that
/// the clock missed pass for the hand, too. The session replays in lock-step to the same bits.   [main] the ticks run
/// on the calling thread
[[nodiscard]] RunOutcome run_on_clock(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request,
                                      TickClock& clock);

/// Runs a rehearsal on the wall clock, on a real-time thread. The summary gets the clock's figures.   [main]
[[nodiscard]] RunOutcome run_live(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request);

}  // namespace kerf::run
