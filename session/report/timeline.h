// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "session/recording.h"
#include "session/report/force_charts.h"

namespace kerf::session {

/// Returns the deductions that the page lists, the largest first.   [any]
[[nodiscard]] std::vector<DeductionRow> listed_deductions(const RunSummary& summary);

/// Returns the listed deductions that have a moment, numbered from 1 in that order.   [any]
[[nodiscard]] std::vector<Moment> moments_of(const RunSummary& summary);

/// Returns the steps over time as SVG, with the numbers of deductions at their moments.   [any]
/// @param width   of the picture; letters are 13 high
[[nodiscard]] std::string timeline_svg(const RunSummary& summary, const std::vector<Moment>& moments, double width);

/// Returns the timeline as HTML, once for wide screens and once for narrow ones. Empty for a run without time.   [any]
[[nodiscard]] std::string timeline_html(const RunSummary& summary, const std::vector<Moment>& moments);

}  // namespace kerf::session
