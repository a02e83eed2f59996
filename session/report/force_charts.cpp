// SPDX-License-Identifier: Apache-2.0
#include "session/report/force_charts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <span>

#include "session/report/place_labels.h"
#include "session/report/report_data.h"
#include "text/plain_numbers.h"

namespace kerf::session {
namespace {

constexpr double width = 420, height = 236, left = 46, right = 10, top = 40, bottom = 34, font = 13;
constexpr double far_above = 3.0;  ///< a limit this many times above the greatest load is not drawn

std::string px(double value) {
    const text::PlainNumbers point;
    char digits[40];
    std::snprintf(digits, sizeof digits, "%.1f", value);
    return digits;
}

/// The ranges of a picture, in the units of its axes.
struct Ranges {
    double shallow = 0.0, deep = 1e-3, low = 0.0, high = 1e-9;

    [[nodiscard]] double x(double depth) const {
        return left + (depth - shallow) / (deep - shallow) * (width - left - right);
    }
    [[nodiscard]] double y(double load) const {
        return height - bottom - (load - low) / (high - low) * (height - top - bottom);
    }
};

struct Point {
    double depth = 0.0, load = 0.0;  ///< in the units of the axes
};
Point point_of(const TickRow& row, const ChartedLoad& load) {
    return {row.depth * 1e3, load.value(row) / load.per_unit};
}
bool is_finite(const Point& point) { return std::isfinite(point.depth) && std::isfinite(point.load); }

Ranges ranges_of(const StepSeries& series, const ChartedLoad& load, const std::vector<BoundLine>& limits,
                 const std::vector<BoundLine>& depths) {
    Ranges ranges;
    for (const TickRow& row : series.rows) {
        const Point point = point_of(row, load);
        if (!is_finite(point)) continue;
        ranges.shallow = std::min(ranges.shallow, point.depth);
        ranges.deep = std::max(ranges.deep, point.depth);
        ranges.low = std::min(ranges.low, point.load);
        ranges.high = std::max(ranges.high, point.load);
    }
    // Most of the travel through air is left out.
    ranges.shallow = std::max(ranges.shallow, -0.15 * std::max(ranges.deep, 1.0));
    for (const BoundLine& line : depths) ranges.deep = std::max(ranges.deep, line.value);
    ranges.deep += 0.03 * (ranges.deep - ranges.shallow);
    const double greatest = ranges.high;
    for (const BoundLine& line : limits)
        if (line.value <= far_above * greatest) ranges.high = std::max(ranges.high, line.value);
    const double space = 0.07 * (ranges.high - ranges.low);
    ranges.high += space;
    if (ranges.low < 0.0) ranges.low -= space;
    return ranges;
}

/// Appends the grid with its numbers, and the titles of the axes.
void add_axes(const Ranges& ranges, const ChartedLoad& load, std::string& svg) {
    const auto number = [](double tick) { return sensible_number(std::abs(tick) < 1e-9 ? 0.0 : tick); };
    const double x_step = round_step(ranges.deep - ranges.shallow), y_step = round_step(ranges.high - ranges.low);
    constexpr double title_width = 96;  // of "depth in mm"
    for (double tick = std::ceil(ranges.shallow / x_step) * x_step; tick <= ranges.deep; tick += x_step) {
        const std::string x = px(ranges.x(tick));
        svg += "<path class=\"grid\" d=\"M" + x + " " + px(top) + "V" + px(height - bottom) + "\"/>";
        if (ranges.x(tick) < width - right - title_width)
            svg += "<text x=\"" + x + "\" y=\"" + px(height - bottom + 17) + "\" text-anchor=\"middle\">" +
                   number(tick) + "</text>";
    }
    for (double tick = std::ceil(ranges.low / y_step) * y_step; tick <= ranges.high; tick += y_step) {
        const double y = ranges.y(tick);
        svg += "<path class=\"" + std::string(std::abs(tick) < 1e-9 ? "zero" : "grid") + "\" d=\"M" + px(left) + " " +
               px(y) + "H" + px(width - right) + "\"/><text x=\"" + px(left - 6) + "\" y=\"" + px(y + 4) +
               "\" text-anchor=\"end\">" + number(tick) + "</text>";
    }
    svg += "<text class=\"axis\" x=\"4\" y=\"14\">" + html_escaped(load.name) + " in " + load.unit +
           "</text><text x=\"" + px(width - right) + "\" y=\"" + px(height - bottom + 17) +
           "\" text-anchor=\"end\">depth in mm</text>";
}

/// Appends the tissue first met at each depth, behind the curves.
void add_tissues(const StepSeries& series, const std::vector<std::string>& names, const Ranges& ranges,
                 std::string& svg) {
    double deepest = -HUGE_VAL, begin = 0.0;
    int tissue = -1;
    const auto fill = [&] {
        const double from = ranges.x(std::max(begin, ranges.shallow)), to = ranges.x(deepest);
        if (tissue >= 0 && static_cast<std::size_t>(tissue) < names.size() && to > from)
            svg += "<rect x=\"" + px(from) + "\" y=\"" + px(top) + "\" width=\"" + px(to - from) + "\" height=\"" +
                   px(height - top - bottom) + "\" fill=\"" +
                   colour_of_tissue(names, static_cast<std::size_t>(tissue)) + "\" opacity=\"0.4\"/>";
    };
    for (const TickRow& row : series.rows) {
        const double depth = row.depth * 1e3;
        if (!(depth > deepest)) continue;
        if (row.tissue != tissue) {
            fill();
            begin = std::max(deepest, series.rows.front().depth * 1e3);
            tissue = row.tissue;
        }
        deepest = depth;
    }
    fill();
}

/// Appends a stroke: of the rows in each column of pixels the ends and both extremes.
void add_stroke(const StepSeries& series, const Stroke& stroke, const ChartedLoad& load, const Ranges& ranges,
                std::string& svg) {
    constexpr double columns = 300.0;  // of pixels in a picture
    const std::size_t max_rows = series.rows.size() / static_cast<std::size_t>(columns) + 1;
    const double max_travel = (ranges.deep - ranges.shallow) / columns;
    std::string points;
    const auto add = [&](std::size_t row) {
        const Point point = point_of(series.rows[row], load);
        if (is_finite(point) && point.depth >= ranges.shallow)
            points += px(ranges.x(point.depth)) + "," + px(ranges.y(point.load)) + " ";
    };
    for (std::size_t begin = stroke.begin, end = begin; begin <= stroke.end; begin = end + 1) {
        std::size_t low = begin, high = begin;
        const double depth = point_of(series.rows[begin], load).depth;
        for (end = begin; end < stroke.end && end + 1 - begin < max_rows; ++end)
            if (std::abs(point_of(series.rows[end + 1], load).depth - depth) > max_travel) break;
        for (std::size_t row = begin; row <= end; ++row) {
            if (load.value(series.rows[row]) < load.value(series.rows[low])) low = row;
            if (load.value(series.rows[row]) > load.value(series.rows[high])) high = row;
        }
        std::array<std::size_t, 4> kept{begin, low, high, end};
        std::sort(kept.begin(), kept.end());
        for (std::size_t i = 0; i < kept.size(); ++i)
            if (i == 0 || kept[i] != kept[i - 1]) add(kept[i]);
    }
    if (points.empty()) return;
    points.pop_back();
    svg += std::string("<polyline class=\"") + (stroke.is_inward ? "inwards" : "outwards") + "\" points=\"" + points +
           "\"/>";
}

/// A text in a picture, and the point that it names.
struct NamedPoint {
    std::string text;
    const char* css;
    double x = 0.0, y = 0.0;
};

/// Appends the lines of goals and limits, and their names where there is space.
void add_lines(const Ranges& ranges, const std::vector<BoundLine>& limits, const std::vector<BoundLine>& depths,
               std::string& svg) {
    std::vector<NamedPoint> names;
    const auto css = [](const BoundLine& line) { return line.is_goal ? "goal" : "limit"; };
    for (const BoundLine& line : limits) {
        if (line.value > ranges.high || line.value < ranges.low) continue;
        const double y = ranges.y(line.value);
        svg += std::string("<path class=\"line ") + css(line) + "\" d=\"M" + px(left) + " " + px(y) + "H" +
               px(width - right) + "\"/>";
        names.push_back({line.text, css(line), left, y - 10});  // above its line
    }
    for (const BoundLine& line : depths) {
        const double x = ranges.x(line.value);
        svg += std::string("<path class=\"line ") + css(line) + "\" d=\"M" + px(x) + " " + px(top) + "V" +
               px(height - bottom) + "\"/>";
        names.push_back({line.text, css(line), x, top});
    }
    std::vector<Label> labels;
    labels.reserve(names.size());
    for (const NamedPoint& name : names) labels.push_back({name.x, name.y, text_width(name.text, font), font + 2});
    // Names of depths are above the plot. The title of the axis is at its left.
    const Rect frame{left, 2, width - left, height - bottom - 2};
    std::vector<Rect> taken{{0, 0, 190, 18}};
    for (std::size_t i = 0; i < names.size(); ++i) {
        const bool is_depth = names[i].y == top;
        const Rect own = is_depth ? Rect{left, 2, width - left, top - 4} : frame;
        const auto at = place_labels({&labels[i], 1}, own, taken).front();
        if (!at) continue;
        taken.push_back(*at);
        svg += std::string("<text class=\"name ") + names[i].css + "\" x=\"" + px(at->left) + "\" y=\"" +
               px(at->top + font - 1) + "\">" + html_escaped(names[i].text) + "</text>";
    }
}

/// Appends the numbers of deductions at their moments in this step.
void add_moments(const StepSeries& series, const ChartedLoad& load, const Ranges& ranges,
                 const std::vector<Moment>& moments, std::string& svg) {
    std::vector<Label> labels;
    std::vector<const Moment*> shown;
    constexpr double half_tick = 0.5e-3;  // [s]
    for (const Moment& moment : moments) {
        if (moment.time < series.rows.front().time - half_tick) continue;
        const auto row = std::lower_bound(series.rows.begin(), series.rows.end(), moment.time - half_tick,
                                          [](const TickRow& one, double time) { return one.time < time; });
        if (row == series.rows.end() || row + 1 == series.rows.end()) continue;  // judged after the step
        const Point point = point_of(*row, load);
        if (!is_finite(point) || point.depth < ranges.shallow) continue;
        labels.push_back({ranges.x(point.depth), ranges.y(point.load), mark_width(moment), mark_height});
        shown.push_back(&moment);
    }
    const auto places = place_labels(labels, {left, top, width - left - right, height - top - bottom});
    for (std::size_t i = 0; i < shown.size(); ++i) {
        const std::string x = px(labels[i].x), y = px(labels[i].y);
        svg += "<circle class=\"moment\" cx=\"" + x + "\" cy=\"" + y + "\" r=\"3.5\"/>";
        if (!places[i]) continue;
        svg += mark_svg(*shown[i], labels[i].x, labels[i].y, *places[i]);
    }
}

/// Returns the legend of a picture.
std::string legend_of(const StepSeries& series, const std::vector<BoundLine>& limits,
                      const std::vector<BoundLine>& depths, double greatest) {
    const auto has = [&](bool is_inward) {
        return std::any_of(series.strokes.begin(), series.strokes.end(),
                           [&](const Stroke& stroke) { return stroke.is_inward == is_inward; });
    };
    std::string html;
    const auto add = [&](const char* css, const std::string& text) {
        html += std::string("<span><i class=\"key ") + css + "\"></i>" + html_escaped(text) + "</span>";
    };
    if (has(true)) add("inwards", "moving in");
    if (has(false)) add("outwards", "moving out");
    for (const auto* lines : {&limits, &depths})
        for (const BoundLine& line : *lines)
            add(line.is_goal ? "goal" : "limit",
                line.text + (lines == &limits && line.value > far_above * greatest ? ", far above the picture" : ""));
    return "<figcaption class=\"legend\">" + html + "</figcaption>";
}

double greatest_of(const StepSeries& series, const ChartedLoad& load) {
    double greatest = 1e-9;
    for (const TickRow& row : series.rows)
        if (const double value = load.value(row) / load.per_unit; std::isfinite(value))
            greatest = std::max(greatest, value);
    return greatest;
}

std::string text_of_bound(const char* sort, const char* end, double value, const char* unit) {
    return std::string(sort) + " " + end + number_as_written(value) + "\u00a0" + unit;
}

}  // namespace

double mark_width(const Moment& moment) noexcept {
    constexpr double letters = 12, beside = 4;  // [px]
    return std::max(mark_height, text_width(moment.numbers, letters) + 2.0 * beside);
}

std::string mark_svg(const Moment& moment, double x, double y, const Rect& box) {
    const double middle_x = box.left + 0.5 * box.width, middle_y = box.top + 0.5 * box.height;
    const double width = mark_width(moment);
    return "<path class=\"moment\" d=\"M" + px(x) + " " + px(y) + "L" + px(middle_x) + " " + px(middle_y) +
           "\"/><rect class=\"moment\" x=\"" + px(middle_x - 0.5 * width) + "\" y=\"" +
           px(middle_y - 0.5 * mark_height) + "\" width=\"" + px(width) + "\" height=\"" + px(mark_height) +
           "\" rx=\"" + px(0.5 * mark_height) + "\"/><text class=\"number-in\" x=\"" + px(middle_x) + "\" y=\"" +
           px(middle_y + 4) + "\" text-anchor=\"middle\">" + moment.numbers + "</text>";
}

const RecordedStep& demands_of(const RecordedProcedure& procedure, const std::string& step) {
    static const RecordedStep none;
    const auto found = std::find_if(procedure.steps.begin(), procedure.steps.end(),
                                    [&](const RecordedStep& one) { return one.id == step; });
    return found != procedure.steps.end() ? *found : none;
}

std::vector<ChartedLoad> charted_loads(const RecordedStep& demands) {
    std::vector<ChartedLoad> loads{
        {"thrust", "thrust", "N", 1.0, [](const TickRow& row) { return row.thrust; }},
        {"torque", "torque about the shaft", "N·mm", 1e-3, [](const TickRow& row) { return std::abs(row.torque); }}};
    if (std::any_of(demands.limits.begin(), demands.limits.end(),
                    [](const RecordedDemand& limit) { return limit.quantity == "lateral_force"; }))
        loads.push_back({"lateral_force", "force across the shaft", "N", 1.0, &lateral_force});
    return loads;
}

std::vector<BoundLine> load_lines(const RecordedStep& demands, const ChartedLoad& load) {
    std::vector<BoundLine> lines;
    for (const RecordedDemand& limit : demands.limits)
        if (limit.quantity == load.quantity && limit.at_most) {
            const double value = *limit.at_most / load.per_unit;
            lines.push_back({value, text_of_bound("limit", "", value, load.unit), false});
        }
    return lines;
}

std::vector<BoundLine> depth_lines(const RecordedStep& demands) {
    std::vector<BoundLine> lines;
    for (const auto* list : {&demands.goals, &demands.limits})
        for (const RecordedDemand& demand : *list) {
            if (demand.quantity != "depth") continue;
            const bool is_goal = list == &demands.goals;
            for (const auto& [end, words] : {std::pair(demand.at_least, "from "), std::pair(demand.at_most, "to ")})
                if (end)
                    lines.push_back({*end * 1e3,
                                     text_of_bound(is_goal ? "goal" : "limit", is_goal ? words : "", *end * 1e3, "mm"),
                                     is_goal});
        }
    return lines;
}

std::string force_chart_svg(const StepSeries& series, const ChartedLoad& load, const RecordedStep& demands,
                            const std::vector<Moment>& moments, const std::vector<std::string>& tissues,
                            const std::string& title) {
    const std::vector<BoundLine> limits = load_lines(demands, load), depths = depth_lines(demands);
    const Ranges ranges = ranges_of(series, load, limits, depths);
    std::string svg = "<svg class=\"chart\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + px(width) + " " +
                      px(height) + "\" role=\"img\"><title>" + html_escaped(title) + "</title>";
    add_tissues(series, tissues, ranges, svg);
    add_axes(ranges, load, svg);
    for (const bool is_inward : {false, true})  // motion inwards is in front
        for (const Stroke& stroke : series.strokes)
            if (stroke.is_inward == is_inward) add_stroke(series, stroke, load, ranges, svg);
    add_lines(ranges, limits, depths, svg);
    add_moments(series, load, ranges, moments, svg);
    return svg + "</svg>";
}

std::string force_charts_html(const RunSummary& summary, const DrawnRun& run, const RecordedProcedure& procedure,
                              const std::vector<Moment>& moments) {
    const std::vector<TickRow> rows = run.plotted();
    std::string html;
    for (const StepSeries& series : series_by_step(rows)) {
        if (series.step >= summary.steps.size() || !run.has_met_bone(series.step)) continue;
        const StepRow& step = summary.steps[series.step];
        const RecordedStep& demands = demands_of(procedure, step.id);
        const std::string name = step.title.empty() ? step.id : step.title;
        html += "<h3>" + html_escaped(name) + " <code>" + html_escaped(step.id) + "</code></h3><div class=\"charts\">";
        for (const ChartedLoad& load : charted_loads(demands))
            html += "<figure>" +
                    force_chart_svg(series, load, demands, moments, summary.tissues,
                                    name + ": " + load.name + " over depth") +
                    legend_of(series, load_lines(demands, load), depth_lines(demands), greatest_of(series, load)) +
                    "</figure>";
        html += "</div>\n";
    }
    if (const std::string titles = unreached_steps(summary, run); !titles.empty())
        html += "<p class=\"soft\">Steps that were not reached: " + html_escaped(titles) + ".</p>\n";
    return html;
}

}  // namespace kerf::session
