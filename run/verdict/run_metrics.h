// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "run/scene.h"
#include "session/recording.h"

/// Metric rows of a run: of the operation, and of the simulation itself.
namespace kerf::run {

/// Returns the metric rows of the steps: depth, clearance to each limited zone, cut or hole, time in air, and the
/// quantities of other goals and limits.   [any] pure.
[[nodiscard]] std::vector<session::MetricRow> metrics_of(const StepMonitor& monitor, const Scene& scene);

/// Returns a row for each signal of an implant's law at the moment when its driver left it.   [any] pure.
/// @param signals   SI, declared order
[[nodiscard]] std::vector<session::MetricRow> implant_metrics(const std::string& step, const kerf_force& law,
                                                              const double* signals);
/// Returns the part of the bone around an implant's thread that is left at the end of the run.   [any] pure.
[[nodiscard]] session::MetricRow bone_kept_row(const std::string& step, double part);
/// Returns the bone volume in the grooves of threads, which the removed volume does not include [m³].   [any] pure.
[[nodiscard]] session::MetricRow groove_row(double volume);
/// Returns the number of radiographs or of requests for help.   [any] pure.
[[nodiscard]] session::MetricRow count_row(std::string id, std::size_t count, std::string help);

/// Returns the rows of separated bone, pieces and crumbs. As a check of the simulation, also the balance with the bone
/// `before` [m³].   [any] pure.
[[nodiscard]] std::vector<session::MetricRow> piece_metrics(const session::RunSummary& summary, double before,
                                                            std::size_t crumbs, double crumb_volume);

/// Returns the energy balance of the loop, a check of the simulation.   [any] pure.
[[nodiscard]] session::MetricRow port_energy_row(const PassivityGuard& guard);

}  // namespace kerf::run
