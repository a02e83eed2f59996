// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "run/clock/realtime_thread.h"
#include "run/clock/wall_clock.h"
#include "session/recording.h"

namespace kerf::run {

/// Returns the figures of a clock for the summary, with the load and kernel of the machine now.   [main]
[[nodiscard]] session::ClockRow clock_row(double period, const TickTimes& times, const LateTicks& late,
                                          const RealtimeState& state);

}  // namespace kerf::run
