// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "studies/chart/chart.h"

/// The chart as files for people. For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// A row per marker. The first line, a comment, says what it is not for.
[[nodiscard]] std::string chart_csv(const Chart& chart);

/// A row per method and fineness: which tests of force it fails, and what was measured.
[[nodiscard]] std::string tests_csv(const Chart& chart);

/// One scene: force error, removed-volume error and largest step, each over the cost of a tick.
[[nodiscard]] std::string scene_svg(const Chart& chart, const std::string& scene);

/// Everything on one page that needs no network and no script.
[[nodiscard]] std::string chart_html(const Chart& chart);

/// Writes chart.csv, chart.html, one <scene>.svg per scene, tests.csv, physics.csv and physics.svg, with surfaces also
/// surfaces.csv and burr-surfaces.svg, each whole or not at all. Returns what went wrong, for people; empty if nothing
/// did.   [main]
[[nodiscard]] std::string write_chart(const std::string& folder, const Chart& chart);

/// Markers that no other beats in both cost and force error, cheapest first.
[[nodiscard]] std::vector<const Row*> pareto_front(const std::vector<const Row*>& rows);

/// The cheapest marker that passes every test and is under 7 % of force and 2 % of volume; nullptr: there is none.
[[nodiscard]] const Row* cheapest_enough(const std::vector<const Row*>& rows);

}  // namespace kerf::chart
