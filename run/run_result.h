// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "run/scene.h"
#include "session/recording.h"

namespace kerf {

/// How a run ended.
enum class RunEnd { path_ended, steps_done, time_over, fault, interrupted, unrecorded };

/// Computes step rows, verdict, reasons and score. Pass: every goal reached and no limit broken. Fail: a limit broken.
/// Incomplete: goals missing, or interrupted before a limit broke. Invalid: a fault.   [any] pure.
/// @param time_limit   [s] of the procedure
void judge(const StepMonitor& monitor, RunEnd end, double duration, double time_limit, RunSummary& summary);

/// Whether the run ended as its rehearsal expects: "pass", "incomplete", or "fail" because of one limit alone, in the
/// one step that it names if it names one; of several where it expects others.
[[nodiscard]] bool ended_as_expected(const Rehearsal& rehearsal, const StepMonitor& monitor, Verdict verdict);

}  // namespace kerf
