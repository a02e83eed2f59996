// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "session/recording.h"
#include "session/report/drawn_run.h"
#include "session/report/place_labels.h"
#include "session/report/recorded_procedure.h"
#include "session/report/step_series.h"

/// Pictures of the loads of each step over the depth along its own axis. They need no script.
namespace kerf::session {

/// A load that has a picture.
struct ChartedLoad {
    const char* quantity;             ///< of a limit: "thrust"
    const char* name;                 ///< for people
    const char* unit;                 ///< for people
    double per_unit;                  ///< SI
    double (*value)(const TickRow&);  ///< [SI]
};

/// Returns the loads of a step that have a picture: thrust, torque, and the force across the shaft if a limit is on it.
/// [any]
[[nodiscard]] std::vector<ChartedLoad> charted_loads(const RecordedStep& demands);

/// A goal or limit as a line in a picture.
struct BoundLine {
    double value = 0.0;  ///< in the unit of the axis
    std::string text;    ///< "limit 60 N"
    bool is_goal = false;
};

/// Returns the lines of the limits on a load.   [any]
[[nodiscard]] std::vector<BoundLine> load_lines(const RecordedStep& demands, const ChartedLoad& load);
/// Returns the lines of goals and limits on depth, in mm.   [any]
[[nodiscard]] std::vector<BoundLine> depth_lines(const RecordedStep& demands);

/// A deduction with its moment.
struct Moment {
    std::string numbers;  ///< "1"; "4, 5" of deductions at one moment
    double time = 0.0;    ///< [s]
};

/// Returns the size of a moment's mark [px].   [any] pure
[[nodiscard]] double mark_width(const Moment& moment) noexcept;
inline constexpr double mark_height = 18;

/// Returns a moment's numbers in a mark at `box`, with a line to the point `x`, `y`, as SVG.   [any]
[[nodiscard]] std::string mark_svg(const Moment& moment, double x, double y, const Rect& box);

/// Returns one load of a step over depth, as SVG: motion inwards and outwards, limits with their names, and the numbers
/// of deductions at their moments.   [any]
[[nodiscard]] std::string force_chart_svg(const StepSeries& series, const ChartedLoad& load,
                                          const RecordedStep& demands, const std::vector<Moment>& moments,
                                          const std::vector<std::string>& tissues, const std::string& title);

/// Returns the pictures of all steps that were reached, each with its legend, as HTML.   [any]
[[nodiscard]] std::string force_charts_html(const RunSummary& summary, const DrawnRun& run,
                                            const RecordedProcedure& procedure, const std::vector<Moment>& moments);

/// Returns the recorded demands of a step; an empty step if the procedure's text is unknown.   [any]
[[nodiscard]] const RecordedStep& demands_of(const RecordedProcedure& procedure, const std::string& step);

}  // namespace kerf::session
