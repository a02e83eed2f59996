// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "run/scene.h"
#include "session/recording.h"

namespace kerf::run {

/// Reason for the end of a run.
enum class RunEnd {
    path_ended,
    steps_done,
    time_over,
    fault,
    interrupted,
    unrecorded,
    device_silent,
    diverged,     ///< on the clock: loop and run differ, so a law is not a function of its inputs
    fell_behind,  ///< on the clock: the run could not keep up with the loop
};

/// Computes step rows, verdict and reasons. Pass: every goal reached and no limit broken. Fail: a limit broken, or an
/// implant left otherwise than its goals say. Incomplete: goals missing, or interrupted before a limit broke. Invalid:
/// a fault. A measure whose uncertainty reaches beyond a bound of a goal or limit adds a reason, and leaves the verdict
/// as its value decides it.   [any] pure.
/// @param time_limit   [s] of the procedure
void judge(const StepMonitor& monitor, RunEnd end, double duration, double time_limit, session::RunSummary& summary);

/// Returns whether the run ended as its rehearsal expects: "pass", "incomplete", or "fail". A failure must be by the
/// one expected limit, or goal of an implant that was left otherwise, in the expected step if there is one. Other
/// limits may break, and other goals be missed, only if the rehearsal expects others.
[[nodiscard]] bool ended_as_expected(const documents::Rehearsal& rehearsal, const StepMonitor& monitor,
                                     session::Verdict verdict);

}  // namespace kerf::run
