// SPDX-License-Identifier: Apache-2.0
#include "session/report/timeline.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>

#include "session/report/place_labels.h"
#include "session/report/report_data.h"
#include "text/plain_numbers.h"

namespace kerf::session {
namespace {

constexpr double font = 13, bar_top = 34, bar_height = 24, row_height = 18, side = 12;

std::string px(double value) {
    const text::PlainNumbers point;
    char digits[40];
    std::snprintf(digits, sizeof digits, "%.1f", value);
    return digits;
}

bool has_times(const StepRow& step, std::size_t index) {
    return step.end > step.start && (index == 0 || step.start > 0.0);  // only the first step begins at 0
}

}  // namespace

std::vector<DeductionRow> listed_deductions(const RunSummary& summary) {
    constexpr double smallest = 0.05;  // points
    std::vector<DeductionRow> rows;
    for (const DeductionRow& row : summary.deductions)
        if (std::isfinite(row.loss) && row.loss >= smallest) rows.push_back(row);
    std::stable_sort(rows.begin(), rows.end(),
                     [](const DeductionRow& a, const DeductionRow& b) { return a.loss > b.loss; });
    return rows;
}

std::vector<Moment> moments_of(const RunSummary& summary) {
    std::vector<Moment> moments;
    constexpr double same = 0.5e-3;  // [s] half a tick
    std::size_t number = 0;
    for (const DeductionRow& row : listed_deductions(summary)) {
        if (!row.at || !std::isfinite(*row.at)) continue;
        const std::string text = std::to_string(++number);
        const auto there = std::find_if(moments.begin(), moments.end(),
                                        [&](const Moment& moment) { return std::abs(moment.time - *row.at) < same; });
        if (there == moments.end())
            moments.push_back({text, *row.at});
        else
            there->numbers += ", " + text;
    }
    return moments;
}

std::string timeline_svg(const RunSummary& summary, const std::vector<Moment>& moments, double width) {
    const double whole = std::max(summary.duration, 1e-3);
    const auto x = [&](double time) { return side + std::clamp(time / whole, 0.0, 1.0) * (width - 2.0 * side); };
    std::string bars, below;

    // Steps: bars, with their names below
    std::vector<Label> names;
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < summary.steps.size(); ++i) {
        const StepRow& step = summary.steps[i];
        if (!has_times(step, i)) continue;
        const double from = x(step.start), to = x(step.end);
        const char* css = !step.broken_limits.empty() ? "step broken" : step.done ? "step done" : "step open";
        bars += std::string("<rect class=\"") + css + "\" x=\"" + px(from) + "\" y=\"" + px(bar_top) + "\" width=\"" +
                px(std::max(to - from - 1.5, 1.0)) + "\" height=\"" + px(bar_height) + "\"/>";
        names.push_back({0.5 * (from + to), bar_top + bar_height, text_width(step.id, font), row_height});
        texts.push_back(step.id);
    }
    const double names_top = bar_top + bar_height + 4;
    double height = names_top;
    std::vector<Rect> taken;
    for (std::size_t i = 0; i < names.size(); ++i) {  // as high as possible, centred below its bar
        Rect box{std::clamp(names[i].x - 0.5 * names[i].width, 0.0, std::max(0.0, width - names[i].width)), names_top,
                 names[i].width, row_height};
        const auto is_taken = [&] {
            return std::any_of(taken.begin(), taken.end(), [&](const Rect& one) {
                return do_meet({box.left - 6, box.top, box.width + 12, box.height}, one);
            });
        };
        while (is_taken()) box.top += row_height;
        taken.push_back(box);
        if (box.top > names_top)
            below +=
                "<path class=\"grid\" d=\"M" + px(names[i].x) + " " + px(names_top) + "V" + px(box.top + 3) + "\"/>";
        below +=
            "<text x=\"" + px(box.left) + "\" y=\"" + px(box.top + font) + "\">" + html_escaped(texts[i]) + "</text>";
        height = std::max(height, box.top + row_height);
    }

    // Times
    const double step = round_step(whole), axis = height + 4;
    for (double time = 0.0; time <= whole; time += step) {
        if (x(time) > width - 60) break;
        below += "<text class=\"tick\" x=\"" + px(x(time)) + "\" y=\"" + px(axis + font) +
                 "\" text-anchor=\"middle\">" + sensible_number(time) + "</text>";
    }
    below += "<text x=\"" + px(width) + "\" y=\"" + px(axis + font) + "\" text-anchor=\"end\">time in s</text>";
    height = axis + row_height;

    // Deductions: numbers above the bars
    std::vector<Label> labels;
    labels.reserve(moments.size());
    for (const Moment& moment : moments)
        labels.push_back({x(moment.time), bar_top - 4, mark_width(moment) + 2, mark_height + 2});
    // In the worst case all stand in one column.
    const double above = (mark_height + 4) * (static_cast<double>(moments.size()) + 1.0);
    const auto places = place_labels(labels, {0, bar_top - 6 - above, width, above});
    std::string marks;
    double highest = bar_top - 24;
    for (std::size_t i = 0; i < moments.size(); ++i) {
        marks += "<path class=\"moment\" d=\"M" + px(labels[i].x) + " " + px(bar_top - 4) + "V" +
                 px(bar_top + bar_height) + "\"/>";
        if (!places[i]) continue;
        highest = std::min(highest, places[i]->top - 1);
        marks += mark_svg(moments[i], labels[i].x, bar_top - 4, *places[i]);
    }
    if (moments.empty()) highest = bar_top - 4;
    return "<svg class=\"chart\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 " + px(highest) + " " + px(width) +
           " " + px(height - highest) +
           "\" role=\"img\"><title>Steps over time, with the moments of deductions</title>" + bars + below + marks +
           "</svg>";
}

std::string timeline_html(const RunSummary& summary, const std::vector<Moment>& moments) {
    if (!(summary.duration > 0.0) || summary.steps.empty()) return {};
    constexpr double wide = 960, narrow = 360;
    return "<figure id=\"moments\" class=\"timeline\"><div class=\"wide-only\">" +
           timeline_svg(summary, moments, wide) + "</div><div class=\"narrow-only\">" +
           timeline_svg(summary, moments, narrow) +
           "</div><figcaption class=\"legend\"><span><i class=\"key box done\"></i>step done</span><span><i "
           "class=\"key box "
           "broken\"></i>limit broken</span><span><i class=\"key box open\"></i>not done</span>" +
           (moments.empty() ? std::string() : "<span><i class=\"key number\">1</i>deduction of that number</span>") +
           "</figcaption></figure>\n";
}

}  // namespace kerf::session
