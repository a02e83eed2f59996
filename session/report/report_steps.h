// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "session/recording.h"
#include "session/report/drawn_run.h"
#include "session/report/recorded_procedure.h"

/// The tables of report.html, as HTML.
namespace kerf {

/// One row for each hole, and one for each screw or implant. Empty where there is neither.   [any]
[[nodiscard]] std::string holes_html(const RunSummary& summary);

/// One row for each measure of the bone: before the first cut and in the end. Empty without any.   [any]
[[nodiscard]] std::string measures_html(const RunSummary& summary);

/// The steps: goals and limits with what was measured, failing ones first, then the other metrics of the step. At last
/// the metrics of no step.   [any]
[[nodiscard]] std::string steps_html(const RunSummary& summary, const DrawnRun& run,
                                     const RecordedProcedure& procedure);

/// The metrics that check the simulation. Empty without any.   [any]
[[nodiscard]] std::string checks_html(const RunSummary& summary);

}  // namespace kerf
