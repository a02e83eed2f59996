// SPDX-License-Identifier: Apache-2.0
#include "session/report/report_score.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "session/report/report_data.h"

namespace kerf::session {

namespace {

std::string subject_of(const DeductionRow& row) {
    const std::string name = row.name.empty() ? "" : " <code>" + html_escaped(row.name) + "</code>";
    if (row.kind == "limit") return "Limit" + name;
    if (row.kind == "goal") return "Goal" + name;
    if (row.kind == "metric") return "Metric" + name;
    return row.kind == "step" ? "Goals of the step" : "The run";
}

}  // namespace

std::string score_html(const RunSummary& summary) {
    if (summary.deductions.empty()) return {};
    std::vector<DeductionRow> rows = summary.deductions;
    std::stable_sort(rows.begin(), rows.end(),
                     [](const DeductionRow& a, const DeductionRow& b) { return a.loss > b.loss; });
    std::string html = "<section><h2>Where the score lost points</h2><div class=\"wide\"><table><thead><tr>"
                       "<th scope=\"col\">What</th><th scope=\"col\">Step</th><th scope=\"col\">At</th>"
                       "<th scope=\"col\">Points</th></tr></thead><tbody>";
    for (const DeductionRow& row : rows) {
        if (!std::isfinite(row.loss) || row.loss < 0.05) continue;
        html += "<tr><th scope=\"row\">" + subject_of(row) +
                (row.detail.empty() ? "" : "<p class=\"soft small\">" + html_escaped(row.detail) + "</p>") +
                "</th><td>" + html_escaped(row.step) + "</td><td>" +
                (row.at ? sensible_number(*row.at) + " s" : std::string()) + "</td><td>−" + sensible_number(row.loss) +
                "</td></tr>";
    }
    return html + "</tbody></table></div><p class=\"soft small\">Band: " + html_escaped(summary.score_band) +
           ". Rules " + std::to_string(summary.score_rules) + ".</p></section>\n";
}

}  // namespace kerf::session
