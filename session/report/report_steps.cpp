// SPDX-License-Identifier: Apache-2.0
#include "session/report/report_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "core/plugin/unit.h"
#include "session/report/metric_cells.h"
#include "session/report/report_data.h"
#include "session/report/step_series.h"

namespace kerf::session {
namespace {

constexpr RowResult reached{"ok", "✓ reached"}, missed{"broken", "✗ not reached", true}, kept{"ok", "✓ kept"},
    broken{"broken", "✗ broken", true}, unmeasured{"soft", "– not measured"};

// ---- goals and limits --------------------------------------------------------------------------------------------

/// Returns "Goal: at least 30 mm".
std::string bound_html(const char* sort, const RecordedDemand& demand, const std::string& unit, double per_unit) {
    const auto end = [&](const char* words, double value) {
        return words + with_unit(number_as_written(value / per_unit), unit);
    };
    std::string text;
    if (demand.at_least) text += end("at least ", *demand.at_least);
    if (demand.at_least && demand.at_most) text += " and ";
    if (demand.at_most) text += end("at most ", *demand.at_most);
    return text.empty() ? std::string(sort) : std::string("<span class=\"soft\">") + sort + ":</span> " + text;
}

/// Returns the distance from a value to its nearest bound; negative beyond the bound.
double margin_of(double value, const RecordedDemand& demand) {
    double margin = HUGE_VAL;
    if (demand.at_least) margin = std::min(margin, value - *demand.at_least);
    if (demand.at_most) margin = std::min(margin, *demand.at_most - value);
    return margin;
}
bool is_within(double value, const RecordedDemand& demand) { return margin_of(value, demand) >= 0.0; }

/// Returns whether a quantity belongs to the finished cut or hole. The others are checked in every tick.
bool is_measured_at_end(const std::string& quantity) {
    constexpr std::array<std::string_view, 14> at_end{
        "plane_angle",      "plane_offset", "flatness", "hole_angle",     "entry_offset",
        "narrowest_offset", "end_offset",   "breach",   "excess_removal", "reduction_offset",
        "reduction_angle",  "axes_angle",   "tip_apex", "measure"};
    return std::find(at_end.begin(), at_end.end(), quantity) != at_end.end();
}

/// One step with its metrics, goals and limits.
class StepTable {
public:
    StepTable(const StepRow& step, const RecordedStep& demands, const RunSummary& summary, const DrawnRun& run)
        : step_(&step), demands_(&demands), summary_(&summary), run_(&run), is_used_(summary.metrics.size(), false) {}

    std::string html() {
        for (const RecordedDemand& goal : demands_->goals) add_goal(goal);
        for (const RecordedDemand& limit : demands_->limits) add_limit(limit);
        add_events();
        const bool has_demands = !demands_->id.empty();
        std::string others;
        for (std::size_t m = 0; m < summary_->metrics.size(); ++m) {
            const MetricRow& metric = summary_->metrics[m];
            if (metric.scope != step_->id || is_used_[m]) continue;
            if (has_demands)
                others += metric_row_html(metric);
            else
                add(metric_row_html(metric), metric.status == "broken");
        }
        const std::string demanded = failed_ + passed_;
        return (demanded.empty() ? "" : table_html(demanded)) +
               (others.empty() ? ""
                               : "<details><summary>Also measured</summary>" + table_html(others) + "</details>\n");
    }

private:
    void add(const std::string& row, bool is_failed) { (is_failed ? failed_ : passed_) += row; }

    /// Returns the possible metric ids of a demand, without the step.
    [[nodiscard]] static std::vector<std::string> ids_of(const RecordedDemand& demand) {
        std::string id = demand.quantity;
        std::replace(id.begin(), id.end(), '_', '-');
        if (demand.quantity == "clearance" || demand.quantity == "measure") return {id + "." + demand.of};
        if (demand.quantity == "signal") return {id + "." + demand.of, id + "." + demand.of + ".least"};
        if (demand.diameter) return {id + "-" + number_as_written(*demand.diameter * 1e3) + "mm", id};
        return {id};
    }

    /// Returns the metric of a demand; if there are several, the one farthest out of bounds. Null if there is none.
    const MetricRow* metric_of(const RecordedDemand& demand) {
        const MetricRow* found = nullptr;
        explained_ = nullptr;
        for (const std::string& id : ids_of(demand))
            for (std::size_t m = 0; m < summary_->metrics.size(); ++m) {
                const MetricRow& metric = summary_->metrics[m];
                if (metric.scope != step_->id || short_id(metric) != id) continue;
                explained_ = is_used_[m] ? &metric : explained_;
                is_used_[m] = true;
                if (found == nullptr || margin_of(metric.value, demand) < margin_of(found->value, demand))
                    found = &metric;
            }
        return found;
    }

    /// Returns the explanation of a metric, only for the first row that shows it.
    [[nodiscard]] std::string help_of(const MetricRow* metric) const {
        return metric != nullptr && metric != explained_ ? metric->help : std::string();
    }

    [[nodiscard]] std::optional<double> time_of(std::string_view event, const std::string& detail,
                                                std::size_t occurrence) const {
        for (const EventRow& one : run_->events())
            if (one.id == event && one.detail == detail && one.time >= step_->start && one.time <= step_->end &&
                occurrence-- == 0)
                return one.time;
        return std::nullopt;
    }

    static std::string at(std::optional<double> time) {
        return time ? "at " + sensible_number(*time) + "\u00a0s" : std::string();
    }

    std::string value_next_to_bound(const MetricRow& metric, const RecordedDemand& demand) const {
        std::vector<double> bounds;
        for (const auto& end : {demand.at_least, demand.at_most})
            if (end) bounds.push_back(*end / metric.per_unit);
        return value_html(metric, bounds);
    }

    std::string demand_row(const char* sort, const RecordedDemand& demand, const MetricRow* metric,
                           const std::string& measured, const std::string& help, RowResult result) {
        const std::string id = metric != nullptr ? std::string(short_id(*metric)) : ids_of(demand).front();
        const std::string unit = metric != nullptr ? metric->unit : demand.unit;
        const double per_unit = metric != nullptr ? metric->per_unit : parse_unit(unit).value_or(Unit{}).factor;
        return row_html(what_html(name_of(id), step_->id + "." + id, help), measured,
                        bound_html(sort, demand, unit, per_unit), result);
    }

    void add_goal(const RecordedDemand& goal) {
        const MetricRow* metric = metric_of(goal);
        const auto before = static_cast<std::size_t>(std::count_if(
            demands_->goals.data(), &goal, [&](const RecordedDemand& other) { return other.name() == goal.name(); }));
        const std::optional<double> time = time_of("goal_reached", step_->id + ": " + goal.name(), before);
        const bool are_events_missing = run_->event_count() > run_->events().size();
        const bool is_reached =
            step_->done || time || (are_events_missing && metric != nullptr && is_within(metric->value, goal));
        add(demand_row("Goal", goal, metric, metric != nullptr ? value_next_to_bound(*metric, goal) : at(time),
                       help_of(metric), is_reached ? reached : missed),
            !is_reached);
    }

    /// Returns whether a limit broke. Several limits may have one name; the step lists it once for each that broke.
    [[nodiscard]] bool is_broken(const RecordedDemand& limit, const MetricRow* metric) const {
        const auto times = std::count(step_->broken_limits.begin(), step_->broken_limits.end(), limit.name());
        const auto limits = std::count_if(demands_->limits.begin(), demands_->limits.end(),
                                          [&](const RecordedDemand& other) { return other.name() == limit.name(); });
        return times >= limits || (times > 0 && metric != nullptr && !is_within(metric->value, limit));
    }

    /// Returns the value that broke the limit. It follows the author's sentence in the reason.
    [[nodiscard]] std::string value_in_reason(const RecordedDemand& limit) const {
        const std::string begin = "Step `" + step_->id + "`: " + limit.reason;
        for (const std::string& reason : summary_->reasons)
            if (reason.starts_with(begin) && reason.size() > begin.size() + 1)
                return html_escaped(reason.substr(begin.size() + 1));
        return {};
    }

    void add_limit(const RecordedDemand& limit) {
        const MetricRow* metric = metric_of(limit);
        const bool has_broken = is_broken(limit, metric);
        // The limit on depth also counts depth in air; its metric does not.
        const bool has_metric_value = metric != nullptr && (!has_broken || !is_within(metric->value, limit));
        const bool is_unmeasured = metric == nullptr && is_measured_at_end(limit.quantity);
        add(demand_row("Limit", limit, metric,
                       has_metric_value ? value_next_to_bound(*metric, limit) : value_in_reason(limit),
                       has_broken && !limit.reason.empty() ? limit.reason : help_of(metric),
                       has_broken      ? broken
                       : is_unmeasured ? unmeasured
                                       : kept),
            has_broken);
    }

    /// Adds broken limits that are not in the procedure's text: events that damage the tool.
    void add_events() {
        for (const std::string& name : step_->broken_limits) {
            const bool is_in_text = std::any_of(demands_->limits.begin(), demands_->limits.end(),
                                                [&](const RecordedDemand& limit) { return limit.name() == name; });
            if (is_in_text) continue;
            add(row_html(what_html(name_of(name), name, ""), at(time_of("limit_broken", name, 0)),
                         demands_->id.empty() ? "" : "<span class=\"soft\">Limit:</span> must not happen", broken),
                true);
        }
    }

    const StepRow* step_;
    const RecordedStep* demands_;
    const RunSummary* summary_;
    const DrawnRun* run_;
    std::vector<bool> is_used_;
    const MetricRow* explained_ = nullptr;  ///< metric of the last demand, if an earlier row shows it, too
    std::string failed_, passed_;
};

std::string time_text(double seconds) { return sensible_number(seconds) + "\u00a0s"; }

std::string step_html(std::size_t index, const RunSummary& summary, const DrawnRun& run,
                      const RecordedProcedure& procedure) {
    const StepRow& step = summary.steps[index];
    static const RecordedStep none;
    const auto demands = std::find_if(procedure.steps.begin(), procedure.steps.end(),
                                      [&](const RecordedStep& one) { return one.id == step.id; });
    std::string html = "<h3>" + html_escaped(step.title.empty() ? step.id : step.title) + " <code>" +
                       html_escaped(step.id) + "</code></h3><p class=\"small\">";
    html += step.done ? "<span class=\"ok\">✓ done</span>" : "<span class=\"broken\">✗ not done</span>";
    if (const std::size_t limits = step.broken_limits.size(); limits > 0)
        html += " <span class=\"broken\">✗ " + std::to_string(limits) + (limits == 1 ? " limit" : " limits") +
                " broken</span>";
    if (step.end > step.start)
        html += " <span class=\"soft\">· " + time_text(step.start) + " to " + time_text(step.end) + "</span>";
    html += "</p>\n";
    return html + StepTable(step, demands != procedure.steps.end() ? *demands : none, summary, run).html();
}

}  // namespace

std::string steps_html(const RunSummary& summary, const DrawnRun& run, const RecordedProcedure& procedure) {
    std::string html;
    for (std::size_t step = 0; step < summary.steps.size(); ++step)
        if (was_reached(summary, run, step)) html += step_html(step, summary, run, procedure);
    if (const std::string titles = unreached_steps(summary, run); !titles.empty())
        html += "<h3>Not reached</h3><p><span class=\"broken\">✗</span> " + html_escaped(titles) + "</p>\n";
    std::string of_run;
    for (const MetricRow& metric : summary.metrics) {
        const bool is_of_step = std::any_of(summary.steps.begin(), summary.steps.end(),
                                            [&](const StepRow& step) { return step.id == metric.scope; });
        const bool is_of_bone = metric.id.starts_with("measure.");  // in a separate table
        if (!is_of_step && !is_of_bone && !is_of_simulation(metric)) of_run += metric_row_html(metric);
    }
    if (!of_run.empty()) html += "<h3>Whole run</h3>" + table_html(of_run);
    return html.empty() ? html : "<section class=\"steps\"><h2>Steps</h2>\n" + html + "</section>\n";
}

std::string checks_html(const RunSummary& summary) {
    std::string rows;
    for (const MetricRow& metric : summary.metrics)
        if (is_of_simulation(metric)) rows += metric_row_html(metric);
    return rows.empty() ? rows : table_html(rows);
}

}  // namespace kerf::session
