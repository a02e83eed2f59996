// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "session/recording.h"
#include "session/report/drawn_run.h"
#include "session/report/recorded_procedure.h"

/// The tables of single steps in report.html, as HTML.
namespace kerf::session {

/// Returns the steps as HTML: goals and limits with the measured values, failed ones first, then the other metrics of
/// the step. Metrics without a step come last.   [any]
[[nodiscard]] std::string steps_html(const RunSummary& summary, const DrawnRun& run,
                                     const RecordedProcedure& procedure);

/// Returns the metrics that check the simulation as HTML. Empty without any.   [any]
[[nodiscard]] std::string checks_html(const RunSummary& summary);

}  // namespace kerf::session
