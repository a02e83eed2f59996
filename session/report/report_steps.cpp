// SPDX-License-Identifier: Apache-2.0
#include "session/report/report_steps.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "core/plugin/unit.h"
#include "session/report/report_data.h"

namespace kerf {
namespace {

// ---- names -------------------------------------------------------------------------------------------------------

constexpr std::array<std::pair<std::string_view, std::string_view>, 33> names{{
    {"axis-in-bone", "Planned axis in bone"},
    {"bone.balance", "Balance of volumes"},
    {"bone.crumb-volume", "Volume of crumbs"},
    {"bone.grooves", "Grooves of threads"},
    {"breach", "Breach"},
    {"depth", "Depth"},
    {"depth-in-air", "Depth gained in air"},
    {"duration", "Duration"},
    {"end-offset", "Offset at the end"},
    {"entry", "Contact with bone"},
    {"entry-offset", "Offset at the entry"},
    {"excess-removal", "Bone removed beyond the plan"},
    {"flatness", "Unevenness of the cut"},
    {"gertzbein-robbins", "Breach of the thread, Gertzbein–Robbins"},
    {"haptics.port-energy", "Energy balance of the device"},
    {"heary", "Breach of the thread, Heary"},
    {"held", "Piece held"},
    {"hole-angle", "Angle to the planned axis"},
    {"lateral-force", "Force across the shaft"},
    {"moved", "Piece moved"},
    {"narrowest-offset", "Offset at the narrowest bone"},
    {"offset", "Largest offset of the tip"},
    {"plane-angle", "Angle to the planned plane"},
    {"plane-offset", "Offset from the planned plane"},
    {"plunge", "Plunge past a far face"},
    {"plunge.hand", "Plunge of the hand"},
    {"removed", "Bone removed in the step"},
    {"removed-volume", "Bone removed"},
    {"separated", "Bone apart"},
    {"speed", "Speed of the tip"},
    {"thrust", "Thrust"},
    {"time-in-air", "Time in air"},
    {"torque", "Torque"},
}};

std::string words_of(std::string_view id) {
    std::string words(id);
    for (char& c : words)
        if (c == '-' || c == '_' || c == '.') c = ' ';
    return words;
}

std::string capitalised(std::string words) {
    if (!words.empty()) words[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(words[0])));
    return words;
}

/// Returns the name for people of a metric or quantity, from its id without the step.
std::string name_of(std::string_view id) {
    for (const auto& [known, name] : names)
        if (known == id) return std::string(name);
    const auto behind = [&](std::string_view prefix) { return words_of(id.substr(prefix.size())); };
    if (id.starts_with("clearance.")) return "Clearance to " + behind("clearance.");
    if (id.starts_with("breach-")) return "Breach of " + std::string(id.substr(7, id.size() - 9)) + "\u00a0mm";
    if (id.starts_with("measure.")) return capitalised(behind("measure."));
    if (id.starts_with("breach.")) return "Breach, " + behind("breach.");
    if (id.starts_with("gertzbein-robbins.")) return "Breach of the thread, " + behind("gertzbein-robbins.");
    return capitalised(id.starts_with("left.")     ? behind("left.") + " at the release"
                       : id.starts_with("signal.") ? behind("signal.")
                                                   : words_of(id));
}

/// Returns the id of a metric without its step.
std::string_view short_id(const MetricRow& metric) {
    const std::string_view id = metric.id;
    const bool has_step =
        id.size() > metric.scope.size() && id.starts_with(metric.scope) && id[metric.scope.size()] == '.';
    return has_step ? id.substr(metric.scope.size() + 1) : id;
}

// ---- cells -------------------------------------------------------------------------------------------------------

std::string with_unit(const std::string& number, const std::string& unit) {
    if (unit.empty()) return number;
    const std::string shown = html_escaped(unit_for_people(unit));
    return number + (shown == "°" ? "" : "\u00a0") + shown;
}

/// @param bounds   in the metric's unit
std::string value_html(const MetricRow& metric, std::span<const double> bounds = {}, bool with_uncertainty = true) {
    const bool is_uncertain = metric.uncertainty > 0.0;
    const double uncertainty = is_uncertain ? metric.uncertainty / metric.per_unit : -1.0;
    std::string number = sensible_number(metric.value / metric.per_unit, uncertainty, bounds);
    if (is_uncertain && with_uncertainty) number += " ± " + sensible_number(uncertainty, uncertainty);
    return with_unit(number, metric.unit);
}

/// Returns the first cell of a row: name for people, id for programs, and explanation.
std::string what_html(const std::string& name, std::string_view id, const std::string& help) {
    return "<th scope=\"row\">" + html_escaped(name) + " <code>" + html_escaped(id) + "</code>" +
           (help.empty() ? "" : "<p class=\"soft small\">" + html_escaped(help) + "</p>") + "</th>";
}

struct Result {
    const char* css;
    const char* text;
    bool is_failed = false;
};
constexpr Result reached{"ok", "✓ reached"}, missed{"broken", "✗ not reached", true}, kept{"ok", "✓ kept"},
    broken{"broken", "✗ broken", true}, unmeasured{"soft", "– not measured"};

/// @param what       result of what_html
/// @param measured   safe HTML, as is `bound`
std::string row_html(const std::string& what, const std::string& measured, const std::string& bound, Result result) {
    return std::string("<tr") + (result.is_failed ? " class=\"failed\"" : "") + ">" + what +
           "<td class=\"number\" data-label=\"Measured\">" + (measured.empty() ? "–" : measured) + "</td><td>" + bound +
           "</td><td class=\"" + result.css + "\">" + result.text + "</td></tr>\n";
}

std::string metric_row_html(const MetricRow& metric) {
    std::string name = name_of(short_id(metric));
    if (metric.occurrences > 1)
        name += ", " + std::to_string(metric.occurrence) + " of " + std::to_string(metric.occurrences);
    const std::string what = what_html(name, metric.id, metric.help);
    if (metric.status == "broken") return row_html(what, value_html(metric), "", broken);
    if (metric.status == "ok") return row_html(what, value_html(metric), "", {"ok", "✓ ok"});
    const std::string status = metric.status == "info" ? "" : html_escaped(metric.status);
    return row_html(what, value_html(metric), "", {"soft", status.c_str()});
}

std::string table_html(const std::string& rows) {
    return "<table class=\"stack\"><thead><tr><th scope=\"col\">Quantity</th><th scope=\"col\" class=\"number\">"
           "Measured</th><th scope=\"col\">Goal or limit</th><th scope=\"col\">Result</th></tr></thead><tbody>\n" +
           rows + "</tbody></table>\n";
}

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
                           const std::string& measured, const std::string& help, Result result) {
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
    // A step that never began has no times; only the first one begins at 0.
    const bool was_begun = step.done || (step.end > step.start && (index == 0 || step.start > 0.0));
    std::string html = "<h3>" + html_escaped(step.title.empty() ? step.id : step.title) + " <code>" +
                       html_escaped(step.id) + "</code></h3><p class=\"small\">";
    html += step.done   ? "<span class=\"ok\">✓ done</span>"
            : was_begun ? "<span class=\"broken\">✗ not done</span>"
                        : "<span class=\"broken\">✗ not begun</span>";
    if (const std::size_t limits = step.broken_limits.size(); limits > 0)
        html += " <span class=\"broken\">✗ " + std::to_string(limits) + (limits == 1 ? " limit" : " limits") +
                " broken</span>";
    if (was_begun)
        html += " <span class=\"soft\">· " + time_text(step.start) + " to " + time_text(step.end) + "</span>";
    html += "</p>\n";
    if (!was_begun) return html;
    return html + StepTable(step, demands != procedure.steps.end() ? *demands : none, summary, run).html();
}

// ---- holes and screws --------------------------------------------------------------------------------------------

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
    for (const StepRow* step : steps)
        rows.push_back("<th scope=\"row\">" + html_escaped(step->title.empty() ? step->id : step->title) + "</th>" +
                       outcome_html(*step));
    for (const Column& column : columns) {
        std::vector<const MetricRow*> metrics;
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

std::string steps_html(const RunSummary& summary, const DrawnRun& run, const RecordedProcedure& procedure) {
    std::string html;
    for (std::size_t step = 0; step < summary.steps.size(); ++step) html += step_html(step, summary, run, procedure);
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

}  // namespace kerf
