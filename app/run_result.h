// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "app/scene.h"
#include "core/session/recording.h"

namespace kerf {

/// How a run ended.
enum class RunEnd { path_ended, steps_done, time_over, fault, interrupted, unrecorded };

/// The metric rows of the steps: depth, clearance to each limited zone, entry offset, time.   [any] pure.
[[nodiscard]] std::vector<MetricRow> metrics_of(const StepMonitor& monitor, const Scene& scene);

/// What came of the bone, if it came apart: pieces, crumbs, and the balance with the bone `before` [m³].   [any] pure.
[[nodiscard]] std::vector<MetricRow> piece_metrics(const RunSummary& summary, double before, std::size_t crumbs,
                                                   double crumb_volume);

/// How passive the loop was.   [any] pure.
[[nodiscard]] MetricRow port_energy_row(const PassivityGuard& guard);

/// Computes step rows, verdict, reasons and score. Pass: every goal reached and no limit broken. Fail: a limit broken.
/// Incomplete: goals missing, or interrupted before a limit broke. Invalid: a fault.   [any] pure.
/// @param time_limit   [s] of the procedure
void judge(const StepMonitor& monitor, RunEnd end, double duration, double time_limit, RunSummary& summary);

/// Whether the run ended as its rehearsal expects: "pass", "incomplete", or "fail" because of one limit alone, in the
/// one step that it names if it names one.
[[nodiscard]] bool ended_as_expected(const Rehearsal& rehearsal, const StepMonitor& monitor, Verdict verdict);

}  // namespace kerf
