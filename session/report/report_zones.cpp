// SPDX-License-Identifier: Apache-2.0
#include "session/report/report_zones.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "session/report/metric_cells.h"
#include "session/report/report_data.h"

namespace kerf::session {

std::string_view zone_colour(std::size_t zone) noexcept {
    constexpr std::array<std::string_view, 6> colours{"#d6336c", "#7048e8", "#2f9e44", "#1c7ed6", "#e8590c", "#0c8599"};
    return colours[zone % colours.size()];
}

std::string approach_text(const ApproachRow& row) {
    return sensible_number(std::abs(row.clearance) * 1e3) + "\u00a0mm " + (row.clearance < 0.0 ? "inside " : "from ") +
           words_of(row.zone);
}

std::vector<ApproachRow> marked_approaches(const RunSummary& summary) {
    std::vector<ApproachRow> marked;
    for (const ApproachRow& row : summary.approaches) {
        const bool is_closest = std::none_of(
            summary.approaches.begin(), summary.approaches.end(),
            [&](const ApproachRow& other) { return other.zone == row.zone && other.clearance < row.clearance; });
        if (std::isfinite(row.clearance) && (is_closest || row.clearance < 0.0)) marked.push_back(row);
    }
    return marked;
}

bool is_bad(const ApproachRow& row, const RunSummary& summary) {
    const std::string metric = row.step + ".clearance." + row.zone;
    return row.clearance < 0.0 ||
           std::any_of(summary.metrics.begin(), summary.metrics.end(),
                       [&](const MetricRow& one) { return one.id == metric && one.status == "broken"; });
}

std::string zone_legend_html(const RunSummary& summary) {
    if (summary.zones.empty()) return {};
    std::string html = "<div class=\"legend\"><span>Zone:</span>";
    for (std::size_t i = 0; i < summary.zones.size(); ++i)
        html += "<span><i style=\"background:" + std::string(zone_colour(i)) + "\"></i>" +
                html_escaped(words_of(summary.zones[i].id)) + "</span>";
    return html + "<span>Parts behind bone are paler.</span></div>";
}

std::string approaches_html(const RunSummary& summary) {
    const std::vector<ApproachRow> rows = marked_approaches(summary);
    if (rows.empty()) return {};
    std::string html = "<ul class=\"approaches\">";
    for (const ApproachRow& row : rows)
        html += std::string("<li><span class=\"") + (is_bad(row, summary) ? "broken\">✗ " : "ok\">○ ") +
                html_escaped(approach_text(row)) + "</span> <span class=\"soft\">in step</span> <code>" +
                html_escaped(row.step) + "</code> <span class=\"soft\">at " + sensible_number(row.time) +
                "\u00a0s</span></li>";
    return html + "</ul>\n";
}

}  // namespace kerf::session
