// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "run/scene.h"
#include "session/recording.h"

/// What a run measured, as rows: of the operation, and of the simulation itself.
namespace kerf {

/// The metric rows of the steps: depth, clearance to each limited zone, cut or hole, time in air, and what other goals
/// and limits are on.   [any] pure.
[[nodiscard]] std::vector<MetricRow> metrics_of(const StepMonitor& monitor, const Scene& scene);

/// What the law of an implant said when its driver left it: a row for each of its signals.   [any] pure.
/// @param signals   SI, declared order
[[nodiscard]] std::vector<MetricRow> implant_metrics(const std::string& step, const kerf_force& law,
                                                     const double* signals);
/// The bone that the grooves of threads have taken, which is not part of what was removed [m³].   [any] pure.
[[nodiscard]] MetricRow groove_row(double volume);

/// What came of the bone, if it came apart: pieces and crumbs; and, as a check of the simulation, the balance with the
/// bone `before` [m³].   [any] pure.
[[nodiscard]] std::vector<MetricRow> piece_metrics(const RunSummary& summary, double before, std::size_t crumbs,
                                                   double crumb_volume);

/// How passive the loop was, a check of the simulation.   [any] pure.
[[nodiscard]] MetricRow port_energy_row(const PassivityGuard& guard);

}  // namespace kerf
