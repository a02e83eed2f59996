// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "session/recording.h"
#include "session/report/drawn_run.h"

/// The rows of a run by step, and by their direction along the step's axis.
namespace kerf::session {

/// Rows in which the tool moves in one direction along its axis: `begin` to `end`, both included. The next stroke
/// begins with the row that ends this one.
struct Stroke {
    std::size_t begin = 0, end = 0;
    bool is_inward = true;
    friend bool operator==(const Stroke&, const Stroke&) = default;
};

/// Returns the strokes of rows. A stroke ends at the row from which the depth turns back by more than `reversal` [m],
/// so tremor does not end one. Empty without rows.   [any] pure.
[[nodiscard]] std::vector<Stroke> strokes_of(std::span<const TickRow> rows, double reversal = 0.5e-3);

/// The rows of one step.
struct StepSeries {
    std::size_t step = 0;             ///< index
    std::size_t first = 0;            ///< index of its first row among all
    std::span<const TickRow> rows{};  ///< in order
    std::vector<Stroke> strokes{};    ///< of `rows`
};

/// Returns the rows of each step that has some. Leaves out rows without a step, and the first row of a
/// later step: in its first tick the tool of the step before is still in the hand.   [any]
/// @param rows   of the run, in order; must outlive the result
[[nodiscard]] std::vector<StepSeries> series_by_step(std::span<const TickRow> rows);

/// Returns whether the tool met anything in a step, or the step has a result. Without ticks, whether it has begun.
/// [any]
[[nodiscard]] bool was_reached(const RunSummary& summary, const DrawnRun& run, std::size_t step);

/// Returns the titles of steps that were not reached, separated by commas; empty if all were.   [any]
[[nodiscard]] std::string unreached_steps(const RunSummary& summary, const DrawnRun& run);

}  // namespace kerf::session
