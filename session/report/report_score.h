// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "session/recording.h"
#include "session/report/drawn_run.h"

namespace kerf::session {

/// Returns the section with the timeline and what the score lost, as HTML. Each deduction with a moment has a number,
/// which the timeline and the pictures of forces show. One row lists all steps that were not reached. Empty for a run
/// without time and deductions.   [any]
[[nodiscard]] std::string score_html(const RunSummary& summary, const DrawnRun& run);

}  // namespace kerf::session
