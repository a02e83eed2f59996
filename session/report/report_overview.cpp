// SPDX-License-Identifier: Apache-2.0
#include "session/report/report_overview.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

#include "session/report/metric_cells.h"
#include "session/report/report_data.h"

namespace kerf::session {
namespace {

struct Column {
    std::string title;
    std::string id;  ///< of the metric, without its step
    bool is_grade = false;
    bool is_in_turns = false;
};

const MetricRow* find_metric(const RunSummary& summary, const std::string& step, std::string_view id) {
    const auto found = std::find_if(summary.metrics.begin(), summary.metrics.end(), [&](const MetricRow& metric) {
        return metric.scope == step && short_id(metric) == id;
    });
    return found != summary.metrics.end() ? &*found : nullptr;
}

bool has_metric(const RunSummary& summary, const std::string& step, std::string_view prefix) {
    return std::any_of(summary.metrics.begin(), summary.metrics.end(), [&](const MetricRow& metric) {
        return metric.scope == step && short_id(metric).starts_with(prefix);
    });
}

bool is_screw(const RunSummary& summary, const std::string& step) {
    return has_metric(summary, step, "gertzbein-robbins") || has_metric(summary, step, "left.");
}

bool is_hole(const RunSummary& summary, const std::string& step) {
    if (is_screw(summary, step)) return false;
    for (const char* id : {"hole-angle", "entry-offset", "end-offset", "excess-removal"})
        if (find_metric(summary, step, id) != nullptr) return true;
    return false;
}

/// Returns the name with hyphens, as in metrics. Limits have underscores.
std::string hyphened(std::string name) {
    std::replace(name.begin(), name.end(), '_', '-');
    return name;
}

bool has_broken(const StepRow& step, std::string_view metric) {
    return std::any_of(step.broken_limits.begin(), step.broken_limits.end(),
                       [&](const std::string& limit) { return hyphened(limit) == metric; });
}

/// @param is_engaged   the thread is in bone; else its turns are unknown
std::string cell_html(const Column& column, const StepRow& step, const MetricRow* metric, bool is_engaged) {
    if (metric == nullptr || (column.is_in_turns && !is_engaged)) return "<td class=\"none\">–</td>";
    std::string text;
    if (column.is_grade) {
        constexpr std::string_view word = "grade ";
        text = html_escaped(metric->status.starts_with(word) ? metric->status.substr(word.size()) : metric->status);
    } else if (column.is_in_turns) {
        constexpr double turn = 6.283185307179586;  // [rad]
        text = sensible_number(metric->value / turn);
    } else {
        MetricRow rounded = *metric;  // hundredths are enough here: the steps below have all digits
        if (metric->uncertainty > 0.0) rounded.uncertainty = std::max(metric->uncertainty, 0.05 * metric->per_unit);
        if (metric->uncertainty <= 0.0)
            rounded.value = std::round(metric->value / metric->per_unit * 100.0) / 100.0 * metric->per_unit;
        text = value_html(rounded, {}, false);
    }
    const bool is_broken = !column.is_grade && (metric->status == "broken" || has_broken(step, column.id));
    return "<td data-label=\"" + html_escaped(column.title) + "\"" + (is_broken ? " class=\"broken\"" : "") + ">" +
           (is_broken ? "✗\u00a0" : "") + text + "</td>";
}

std::string outcome_html(const StepRow& step) {
    if (step.broken_limits.empty())
        return step.done ? "<td class=\"ok\">✓ done</td>" : "<td class=\"broken\">✗ not done</td>";
    std::string limits;
    for (const std::string& limit : step.broken_limits)
        limits += (limits.empty() ? "" : ", ") + html_escaped(name_of(hyphened(limit)));
    return "<td class=\"broken\">✗ " + limits + "</td>";
}

/// Returns a table with one row for each of `steps`. Leaves out columns without values.
std::string overview_html(const RunSummary& summary, const char* title, const char* first,
                          const std::vector<const StepRow*>& steps, const std::vector<Column>& columns) {
    if (steps.empty()) return {};
    std::string head = std::string("<th scope=\"col\">") + first + "</th><th scope=\"col\">Result</th>";
    std::vector<std::string> rows;
    rows.reserve(steps.size());
    for (const StepRow* step : steps)
        rows.push_back("<th scope=\"row\">" + html_escaped(step->title.empty() ? step->id : step->title) + "</th>" +
                       outcome_html(*step));
    for (const Column& column : columns) {
        std::vector<const MetricRow*> metrics;
        metrics.reserve(steps.size());
        for (const StepRow* step : steps) metrics.push_back(find_metric(summary, step->id, column.id));
        if (std::all_of(metrics.begin(), metrics.end(), [](const MetricRow* metric) { return metric == nullptr; }))
            continue;
        head += "<th scope=\"col\">" + html_escaped(column.title) + "</th>";
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const MetricRow* engaged = find_metric(summary, steps[i]->id, "left.engaged");
            rows[i] += cell_html(column, *steps[i], metrics[i], engaged == nullptr || engaged->value > 0.0);
        }
    }
    std::string html = std::string("<h3>") + title +
                       "</h3><div class=\"wide\"><table class=\"stack overview\"><thead><tr>" + head +
                       "</tr></thead><tbody>\n";
    for (const std::string& row : rows) html += "<tr>" + row + "</tr>\n";
    return html + "</tbody></table></div>\n";
}

/// Adds columns for metrics whose ids come from the procedure: zones and diameters.
void add_named_columns(const RunSummary& summary, const std::vector<const StepRow*>& steps, std::string_view prefix,
                       std::vector<Column>& columns) {
    for (const StepRow* step : steps)
        for (const MetricRow& metric : summary.metrics) {
            const std::string id(short_id(metric));
            const bool is_known =
                std::any_of(columns.begin(), columns.end(), [&](const Column& column) { return column.id == id; });
            if (metric.scope == step->id && id.starts_with(prefix) && !is_known) columns.push_back({name_of(id), id});
        }
}

}  // namespace

std::string holes_html(const RunSummary& summary) {
    std::vector<const StepRow*> holes, screws;
    for (const StepRow& step : summary.steps) {
        if (is_screw(summary, step.id)) screws.push_back(&step);
        if (is_hole(summary, step.id)) holes.push_back(&step);
    }
    std::vector<Column> of_holes{{"Depth", "depth"},
                                 {"Angle", "hole-angle"},
                                 {"Offset at entry", "entry-offset"},
                                 {"Offset at narrowest", "narrowest-offset"},
                                 {"Offset at end", "end-offset"},
                                 {"Removed beyond the plan", "excess-removal"},
                                 {"Breach", "breach"}};
    add_named_columns(summary, holes, "breach-", of_holes);
    add_named_columns(summary, holes, "clearance.", of_holes);
    std::vector<Column> of_screws{{.title = "Gertzbein–Robbins", .id = "gertzbein-robbins", .is_grade = true},
                                  {.title = "Heary", .id = "heary", .is_grade = true},
                                  {"Depth", "depth"},
                                  {"Angle", "hole-angle"},
                                  {"Offset at entry", "entry-offset"},
                                  {"Offset at end", "end-offset"},
                                  {"Breach", "gertzbein-robbins"},
                                  {"Peak torque", "torque"},
                                  {.title = "Turns at the release", .id = "left.turned", .is_in_turns = true},
                                  {"Pull-out force, estimated", "left.pull-out"}};
    const bool has_peak = std::any_of(screws.begin(), screws.end(), [&](const StepRow* step) {
        return find_metric(summary, step->id, "torque") != nullptr;
    });
    if (!has_peak) of_screws.push_back({"Torque at the release", "left.torque"});
    add_named_columns(summary, screws, "clearance.", of_screws);
    const std::string html = overview_html(summary, "Holes", "Hole", holes, of_holes) +
                             overview_html(summary, "Screws and implants", "Implant", screws, of_screws);
    return html.empty() ? html : "<section><h2>Holes and screws</h2>\n" + html + "</section>\n";
}

std::string measures_html(const RunSummary& summary) {
    constexpr std::string_view first = "measure.", before = ".before";
    std::string rows;
    for (const MetricRow& metric : summary.metrics) {
        const std::string_view id = metric.id;
        if (!id.starts_with(first) || !id.ends_with(before)) continue;
        const std::string measure(id.substr(first.size(), id.size() - first.size() - before.size()));
        const MetricRow* after = find_metric(summary, metric.scope, "measure." + measure + ".after");
        const bool is_broken = after != nullptr && after->status == "broken";
        rows += std::string("<tr") + (is_broken ? " class=\"failed\"" : "") + ">" +
                what_html(capitalised(words_of(measure)), measure, metric.help) +
                "<td class=\"number\" data-label=\"Before\">" + value_html(metric) +
                "</td><td class=\"number\" data-label=\"In the end\">" + (after ? value_html(*after) : "–") +
                "</td><td class=\"" + (is_broken ? "broken\">✗ broken" : "ok\">") +
                (!is_broken && after != nullptr && after->status == "ok" ? "✓ ok" : "") + "</td></tr>\n";
    }
    return rows.empty() ? rows
                        : "<section><h2>Measures of the bone</h2>\n<table class=\"stack\"><thead><tr><th "
                          "scope=\"col\">Measure</th><th scope=\"col\" class=\"number\">Before the first cut</th><th "
                          "scope=\"col\" class=\"number\">In the end</th><th scope=\"col\">Result</th></tr></thead>"
                          "<tbody>\n" +
                              rows + "</tbody></table></section>\n";
}

}  // namespace kerf::session
