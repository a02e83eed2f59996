// SPDX-License-Identifier: Apache-2.0
#include "session/report/report_score.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "session/report/report_data.h"
#include "session/report/step_series.h"
#include "session/report/timeline.h"

namespace kerf::session {

namespace {

std::string subject_of(const DeductionRow& row) {
    const std::string name = row.name.empty() ? "" : " <code>" + html_escaped(row.name) + "</code>";
    if (row.kind == "limit") return "Limit" + name;
    if (row.kind == "goal") return "Goal" + name;
    if (row.kind == "metric") return "Metric" + name;
    return row.kind == "step" ? "Goals of the step" : "The run";
}

/// Returns the time of a deduction, with its number as a link to the timeline.
std::string moment_html(const DeductionRow& row, std::size_t number) {
    if (!row.at || !std::isfinite(*row.at)) return {};
    return "<a class=\"key number\" href=\"#moments\" data-time=\"" + number_as_written(*row.at) + "\">" +
           std::to_string(number) + "</a> " + sensible_number(*row.at) + "\u00a0s";
}

}  // namespace

std::string score_html(const RunSummary& summary, const DrawnRun& run) {
    const std::string timeline = timeline_html(summary, moments_of(summary));
    const std::vector<DeductionRow> rows = listed_deductions(summary);
    if (rows.empty())
        return timeline.empty() ? timeline : "<section><h2>The run over time</h2>" + timeline + "</section>\n";

    std::string html = "<section><h2>Where the score lost points</h2>" + timeline +
                       "<div class=\"wide\"><table class=\"stack score\"><thead><tr>"
                       "<th scope=\"col\">What</th><th scope=\"col\">Step</th><th scope=\"col\">At</th>"
                       "<th scope=\"col\">Points</th></tr></thead><tbody>";
    double unreached = 0.0;
    std::size_t number = 0;
    for (const DeductionRow& row : rows) {
        const auto step = std::find_if(summary.steps.begin(), summary.steps.end(),
                                       [&](const StepRow& one) { return one.id == row.step; });
        if (!row.at && step != summary.steps.end() &&
            !was_reached(summary, run, static_cast<std::size_t>(step - summary.steps.begin()))) {
            unreached += row.loss;
            continue;
        }
        number += row.at && std::isfinite(*row.at) ? 1 : 0;
        html += "<tr><th scope=\"row\">" + subject_of(row) +
                (row.detail.empty() ? "" : "<p class=\"soft small\">" + html_escaped(row.detail) + "</p>") +
                "</th><td data-label=\"Step\">" + html_escaped(row.step) + "</td><td data-label=\"At\">" +
                moment_html(row, number) + "</td><td data-label=\"Points\">−" + sensible_number(row.loss) +
                "</td></tr>";
    }
    if (unreached > 0.0)
        html += "<tr><th scope=\"row\">Steps that were not reached<p class=\"soft small\">" +
                html_escaped(unreached_steps(summary, run)) + "</p></th><td></td><td></td><td data-label=\"Points\">−" +
                sensible_number(unreached) + "</td></tr>";
    return html + "</tbody></table></div><p class=\"soft small\">Band: " + html_escaped(summary.score_band) +
           ". Rules " + std::to_string(summary.score_rules) + ".</p></section>\n";
}

}  // namespace kerf::session
