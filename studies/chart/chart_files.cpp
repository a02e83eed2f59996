// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/chart_files.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "session/recorder.h"
#include "session/report/report_data.h"
#include "session/report/report_page.h"
#include "studies/chart/physics/published_files.h"
#include "studies/drawing/plot.h"
#include "studies/drawing/svg.h"
#include "text/write_file.h"

namespace kerf::chart {

namespace {

using drawing::csv_quoted;
using drawing::figure;
using drawing::joined;

constexpr double just_felt = 0.07;    // [–] of a force: below it a difference cannot be felt
constexpr double seen_volume = 0.02;  // [–] of a hole
constexpr double picture_width = 1040, picture_height = 900;

std::vector<const Row*> rows_of(const Chart& chart, const std::string& scene) {
    std::vector<const Row*> rows;
    for (const Row& row : chart.rows)
        if (row.scene == scene) rows.push_back(&row);
    return rows;
}

int colour_of(const std::string& method) {
    constexpr const char* order[] = {"M9", "M8", "M4", "M2", "M3", "M5", "M1", "M6", "000", "001"};
    for (int i = 0; i < 10; ++i)
        if (method == order[i]) return i;
    constexpr const char* powered[] = {"", "M10", "M10 points", "", "", "", "M7", "", "004"};
    for (int i = 0; i < 9; ++i)
        if (method == powered[i]) return i;
    return 6;
}

/// The methods that a scene compares.
std::vector<MethodNote> methods_on(const Chart& chart, const std::string& cutter) {
    std::vector<MethodNote> methods;
    for (const MethodNote& method : chart.methods)
        if (method.cutter == cutter) methods.push_back(method);
    return methods;
}

SceneTitle title_of(const Chart& chart, const std::string& scene) {
    for (const SceneTitle& one : chart.scenes)
        if (one.id == scene) return one;
    return {.id = scene, .title = scene};
}

std::string stiffness_text(double newtons_per_metre) { return figure(1e-3 * newtons_per_metre, 2) + " N/mm"; }

std::string told_of(const Row& row) {
    const Measured& m = row.measured;
    return row.method + ", " + row.knob + ": force error " + figure(100.0 * m.force_error) + " %, worst grid " +
           figure(100.0 * m.worst_grid) + " %; volume " + figure(100.0 * m.volume_error) + " %; largest step " +
           figure(100.0 * m.peak_step) + " %; p99.9 " + figure(m.cost.p999) + " us, longest " + figure(m.cost.longest) +
           " us" + (row.fails.empty() ? "; passes" : "; fails " + joined(row.fails));
}

/// Tests that every marker of a method fails on a scene.
std::vector<std::string> always_failed(const Chart& chart, const std::string& scene, const std::string& method) {
    std::vector<std::string> common;
    bool is_first = true;
    for (const Row* row : rows_of(chart, scene)) {
        if (row->method != method) continue;
        if (is_first) common = row->fails;
        is_first = false;
        std::erase_if(common, [&](const std::string& id) {
            return std::find(row->fails.begin(), row->fails.end(), id) == row->fails.end();
        });
    }
    return common;
}

/// The ends of an axis: whole decades about the values, with room for what is written beside them.
void fit(drawing::Axis& axis, double least, double most) {
    constexpr double room = 1.25;
    axis.low = std::pow(10.0, std::floor(std::log10(least / room)));
    axis.high = std::pow(10.0, std::ceil(std::log10(most * room)));
    if (axis.high <= axis.low) axis.high = 10.0 * axis.low;
}

/// One of the three panels: `value` over cost.
template <class Value>
drawing::Panel panel_of(const Chart& chart, const std::string& scene, const std::string& title, const std::string& what,
                        double floor, const Value& value) {
    drawing::Panel panel{.title = title};
    panel.x.title = "cost of a tick, p99.9 in us (whisker: longest)";
    panel.x.guides = {{100.0, "100 us"}, {1000.0, "1 ms"}};
    panel.y.title = what;
    double min_x = 1e300, max_x = 0.0, min_y = 1e300, max_y = 0.0;
    for (const MethodNote& method : methods_on(chart, title_of(chart, scene).cutter)) {
        drawing::Curve curve{
            .colour = colour_of(method.id), .is_dashed = method.is_as_printed, .is_bold = method.id == "M9"};
        for (const Row* row : rows_of(chart, scene)) {
            if (row->method != method.id) continue;
            const double y = std::max(floor, value(row->measured)), x = row->measured.cost.p999;
            if (!std::isfinite(y)) continue;
            curve.markers.push_back({x, y, row->measured.cost.longest, 0.0, row->fails.empty(), "", told_of(*row)});
            min_x = std::min(min_x, x);
            max_x = std::max(max_x, row->measured.cost.longest);
            min_y = std::min(min_y, y);
            max_y = std::max(max_y, y);
        }
        if (curve.markers.empty()) continue;
        curve.name = method.id;
        panel.curves.push_back(std::move(curve));
    }
    if (max_x > 0.0) {
        panel.x.low = 0.8 * min_x;
        panel.x.high = 1.25 * std::max(max_x, 1000.0);
        fit(panel.y, min_y, max_y);
    }
    return panel;
}

}  // namespace

std::vector<const Row*> pareto_front(const std::vector<const Row*>& rows) {
    std::vector<const Row*> sorted = rows, front;
    std::sort(sorted.begin(), sorted.end(), [](const Row* a, const Row* b) {
        return a->measured.cost.p999 != b->measured.cost.p999 ? a->measured.cost.p999 < b->measured.cost.p999
                                                              : a->measured.force_error < b->measured.force_error;
    });
    for (const Row* row : sorted)
        if (std::isfinite(row->measured.force_error) &&
            (front.empty() || row->measured.force_error < front.back()->measured.force_error))
            front.push_back(row);
    return front;
}

const Row* cheapest_enough(const std::vector<const Row*>& rows) {
    const Row* best = nullptr;
    for (const Row* row : rows) {
        const Measured& m = row->measured;
        const bool is_enough = row->fails.empty() && m.force_error < just_felt && m.volume_error < seen_volume;
        if (is_enough && (best == nullptr || m.cost.p999 < best->measured.cost.p999)) best = row;
    }
    return best;
}

std::string chart_csv(const Chart& chart) {
    std::string text =
        std::string("# ") + session::notice_line + ".\n# costs in us of one tick, on " + chart.processor +
        "; all else is the same wherever it is run\n"
        "scene,method,knob,spacing_mm,points,force_error,force_error_worst_grid,volume_error,"
        "peak_step,rms_reference_N,rms_error_N,lateral_where_none_N,gain,same_hand_error,same_hand_"
        "error_of_turns,same_hand_apart_mm,where_none_N,torque_error,rms_torque_Nmm,exact_share,force_error_"
        "where_exact,cost_median_us,cost_p999_us,cost_longest_us,"
        "K_max_N_per_m,fails\n";
    for (const Row& row : chart.rows) {
        const Measured& m = row.measured;
        const std::string cutter = title_of(chart, row.scene).cutter;
        const auto at = std::find_if(chart.methods.begin(), chart.methods.end(), [&](const MethodNote& note) {
            return note.id == row.method && note.cutter == cutter;
        });
        text += csv_quoted(row.scene) + "," + csv_quoted(row.method) + "," + csv_quoted(row.knob) + ",";
        for (const double value : {1e3 * row.fineness.spacing,
                                   static_cast<double>(row.fineness.points),
                                   m.force_error,
                                   m.worst_grid,
                                   m.volume_error,
                                   m.peak_step,
                                   m.reference,
                                   m.force_error * m.reference,
                                   m.off_lateral,
                                   m.gain,
                                   m.same_hand,
                                   m.same_hand_turn,
                                   1e3 * m.apart,
                                   m.off_none,
                                   m.torque_error,
                                   1e3 * m.torque_reference,
                                   m.exact_share,
                                   m.exact_error,
                                   m.cost.median,
                                   m.cost.p999,
                                   m.cost.longest,
                                   at->stiffest})
            text += figure(value, 5) + ",";
        text += csv_quoted(joined(row.fails, " ")) + "\n";
    }
    return text;
}

std::string tests_csv(const Chart& chart) {
    std::string text = std::string("# ") + session::notice_line + ".\ncutter,method,knob,fails,measured\n";
    for (const Standing& standing : chart.standings)
        text += csv_quoted(standing.cutter) + "," + csv_quoted(standing.method) + "," + csv_quoted(standing.knob) +
                "," + csv_quoted(joined(standing.fails, " ")) + "," + csv_quoted(standing.told) + "\n";
    return text;
}

std::string scene_svg(const Chart& chart, const std::string& scene) {
    const SceneTitle said = title_of(chart, scene);
    const std::string& title = said.title;
    const std::vector<MethodNote> methods = methods_on(chart, said.cutter);

    auto force = panel_of(chart, scene, "Force error", "RMS |F - F_ref| / RMS |F_ref| in %", 1e-4,
                          [](const Measured& m) { return 100.0 * m.force_error; });
    force.y.guides = {{100.0 * just_felt, "7 %: a smaller difference cannot be felt"}};
    for (const Row* row : pareto_front(rows_of(chart, scene)))
        force.front.push_back({row->measured.cost.p999, 100.0 * row->measured.force_error});
    // What every marker of a curve fails stands in the legend; the rest beside the marker.
    for (drawing::Curve& curve : force.curves) {
        std::size_t i = 0;
        for (const Row* row : rows_of(chart, scene)) {
            if (curve.name != row->method || i >= curve.markers.size()) continue;
            drawing::Marker& marker = curve.markers[i];
            const auto common = always_failed(chart, scene, row->method);
            std::vector<std::string> words;
            if (i == 0 || i + 1 == curve.markers.size()) words.push_back(row->knob);
            for (const std::string& id : row->fails)
                if (std::find(common.begin(), common.end(), id) == common.end()) words.push_back(id);
            marker.label = joined(words, " ");
            ++i;
        }
        for (const MethodNote& method : methods)
            if (method.id == curve.name && method.stiffest > 0.0) {
                curve.name += " K " + stiffness_text(method.stiffest);
                break;
            }
    }
    const auto volume = panel_of(chart, scene, "Removed volume", "|V - V_exact| / V_exact in %", 1e-3,
                                 [](const Measured& m) { return 100.0 * m.volume_error; });
    auto step = panel_of(chart, scene, "Largest step from tick to tick", "in % of the largest |F_ref|", 1e-3,
                         [](const Measured& m) { return 100.0 * m.peak_step; });
    if (said.cutter == "drill") step.y.guides = {{100.0 / 31.0, "S-16: one point of 31"}};

    constexpr double half = 0.5 * picture_width, top = 40, tall = 410, low = 300;
    std::string content = drawing::text_at(12, 24, title, "class=\"kp-title\"");
    content += drawing::panel_svg(force, 0, top, picture_width, tall);
    content += drawing::panel_svg(volume, 0, top + tall, half, low);
    content += drawing::panel_svg(step, half, top + tall, half, low);
    double y = top + tall + low + 22, x = 12;
    for (const MethodNote& method : methods) {
        const auto fails = always_failed(chart, scene, method.id);
        content += drawing::marker_svg(x + 4, y - 4, colour_of(method.id), fails.empty());
        content += drawing::text_at(
            x + 14, y, method.id + " " + method.title + (fails.empty() ? "" : ": fails " + joined(fails, " ")));
        if (x > half) y += 17;
        x = x > half ? 12 : half + 12;
    }
    const Row* enough = cheapest_enough(rows_of(chart, scene));
    content += drawing::text_at(
        12, picture_height - 28,
        std::string("Cheapest that passes, under 7 % of force and 2 % of volume: ") +
            (enough != nullptr
                 ? enough->method + " at " + enough->knob + ", " + figure(enough->measured.cost.p999) + " us."
                 : "none.") +
            (said.is_oblique ? " M9 walks here: its thrust alone." : "") + (said.note.empty() ? "" : " " + said.note));
    content += drawing::text_at(12, picture_height - 10,
                                std::string(session::notice_line) + ". Filled: passes; hollow: fails. " +
                                    (methods.empty() || methods.front().stiffest > 0.0
                                         ? "K: the stiffest wall on a bare device without friction. "
                                         : "") +
                                    "Costs: " + chart.processor + ".",
                                "class=\"kp-note\"");
    return drawing::picture(picture_width, picture_height, title, content);
}

std::string chart_html(const Chart& chart) {
    std::string html =
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\">"
        "<title>Accuracy against speed</title><style>";
    html += session::report_style;
    html += "figure svg { width: 100%; }</style></head><body><main>\n<header class=\"top\"><div><h1>Accuracy against "
            "speed</h1>"
            "<p class=\"soft\">How right the force of a drill, a burr and a saw is, and what it costs. Costs were "
            "measured on " +
            session::html_escaped(chart.processor) + "; all else is the same wherever it is run.</p></div></header>\n";
    html += "<section><h2>Methods</h2><div class=\"wide\"><table><thead><tr><th>Method</th><th>What</th>"
            "<th class=\"number\">K_max</th><th>Tests failed, by fineness</th></tr></thead><tbody>";
    for (const MethodNote& method : chart.methods) {
        html += "<tr><td>" + session::html_escaped(method.id) + "</td><td>" + session::html_escaped(method.title) +
                "</td><td class=\"number\">" + session::html_escaped(stiffness_text(method.stiffest)) + "</td><td>";
        for (const Standing& standing : chart.standings)
            if (standing.method == method.id)
                html += "<span title=\"" + session::html_escaped(standing.told) + "\">" +
                        session::html_escaped(standing.knob) + ": <span class=\"" +
                        (standing.fails.empty() ? "ok\">none"
                                                : "broken\">" + session::html_escaped(joined(standing.fails, " "))) +
                        "</span></span><br>";
        html += "</td></tr>";
    }
    html +=
        "</tbody></table></div><p class=\"soft small\">S-01: a hand pushes into a block. S-07: twice the points. S-12: "
        "back into a "
        "finished hole. S-16: a step of more than one point of 31. S-19: the spindle stops. P9: standing in bone. "
        "finite: every force is a number. Rest "
        "the pointer "
        "on a line for its figures. K_max: the stiffest wall on a bare device without friction. Where M9 walks, its "
        "error is that of its thrust alone.</p></section>\n";
    for (const SceneTitle& scene : chart.scenes) {
        html += "<section><figure>" + scene_svg(chart, scene.id) + "</figure>";
        html += "<details><summary>Figures</summary><div class=\"wide\"><table><thead><tr><th>Method</th><th>Knob</th>"
                "<th class=\"number\">Force error</th><th class=\"number\">Volume</th><th class=\"number\">Step</th>"
                "<th class=\"number\">p99.9</th><th class=\"number\">Longest</th><th>Fails</th></tr></thead><tbody>";
        for (const Row* row : rows_of(chart, scene.id)) {
            const Measured& m = row->measured;
            const auto cell = [&](double value, const char* unit) {
                return "<td class=\"number\">" + session::sensible_number(value) + " " + unit + "</td>";
            };
            html += "<tr><td>" + session::html_escaped(row->method) + "</td><td>" + session::html_escaped(row->knob) +
                    "</td>" + cell(100.0 * m.force_error, "%") + cell(100.0 * m.volume_error, "%") +
                    cell(100.0 * m.peak_step, "%") + cell(m.cost.p999, "µs") + cell(m.cost.longest, "µs") + "<td>" +
                    session::html_escaped(joined(row->fails)) + "</td></tr>";
        }
        html += "</tbody></table></div></details></section>\n";
    }
    if (!chart.surfaces.empty()) html += "<section><figure>" + surfaces_svg(chart.surfaces) + "</figure></section>\n";
    html += published_html(chart.law, chart.awl, chart.checks);
    return html + "</main>\n<footer><p><strong>" + session::notice_line + ".</strong></p></footer></body></html>\n";
}

std::string write_chart(const std::string& folder, const Chart& chart) {
    text::MadeFolders made;
    if (std::string error = made.make(folder); !error.empty()) return error;
    std::string wrong;
    const auto write = [&](const std::string& name, const std::string& text) {
        const std::string what = text::write_file(folder + "/" + name, text);
        if (!what.empty()) wrong += (wrong.empty() ? "" : "\n") + what;
    };
    write("chart.csv", chart_csv(chart));
    write("chart.html", chart_html(chart));
    write("tests.csv", tests_csv(chart));
    write("physics.svg", published_svg(chart.law, chart.awl));
    write("physics.csv", published_csv(chart.law, chart.checks));
    if (!chart.surfaces.empty()) {
        write("surfaces.csv", surfaces_csv(chart.surfaces));
        write("burr-surfaces.svg", surfaces_svg(chart.surfaces));
    }
    for (const SceneTitle& scene : chart.scenes) write(scene.id + ".svg", scene_svg(chart, scene.id));
    if (wrong.empty()) made.keep();
    return wrong;
}

}  // namespace kerf::chart
