// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/physics/published_files.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>

#include "kerf/units.hpp"
#include "session/recorder.h"
#include "session/report/report_data.h"
#include "studies/drawing/plot.h"
#include "studies/drawing/svg.h"

namespace kerf::chart {

using namespace literals;

namespace {

using drawing::csv_quoted;
using drawing::figure;

constexpr double width = 1040, height = 1126;
enum Colour { of_kerf = 0, of_line = 1, of_power = 5, of_proportion = 8, of_measured = 6 };

int colour_of(const std::string& law) {
    return law == "Kerf" ? of_kerf : law == "edge + chip" ? of_line : law == "power" ? of_power : of_proportion;
}

/// One quantity of the human femur over the feed, from standing still to a little over what was measured.
drawing::Panel feed_panel(const CuttingLaw& law, bool of_torque) {
    const PublishedSeries series = published_series().front();
    const double unit = of_torque ? 1.0_Nmm : 1.0;
    drawing::Panel panel{.title =
                             of_torque ? "Torque, human femur, 3.2 mm drill" : "Thrust, human femur, 3.2 mm drill"};
    panel.x = {.title = "feed in mm per revolution", .is_log = false, .low = 0.0, .high = 0.14};
    panel.y = {.title = of_torque ? "N mm" : "N", .is_log = false, .low = 0.0, .high = of_torque ? 220.0 : 240.0};
    const auto add = [&](const char* name, const std::function<double(double)>& at, bool is_dashed) {
        drawing::Curve curve{
            .name = name, .colour = colour_of(name), .is_dashed = is_dashed, .is_bold = std::string(name) == "Kerf"};
        curve.has_dots = false;
        for (int i = 0; i <= 140; ++i) curve.markers.push_back({i * 1e-3, at(i * 1e-6) / unit});
        panel.curves.push_back(std::move(curve));
    };
    for (const FeedLaw& fitted : fitted_laws(series, of_torque)) add(fitted.name, fitted.at, true);
    add(
        "Kerf", [&](double f) { return shared_law_at(law, f, of_torque); }, false);
    drawing::Curve measured{.colour = of_measured, .has_line = false, .has_labels_below = true};
    for (const PublishedMean& mean : series.means) {
        const double value = (of_torque ? mean.torque : mean.thrust) / unit,
                     sd = (of_torque ? mean.torque_sd : mean.thrust_sd) / unit;
        measured.markers.push_back({.x = series.feed(mean) / 1.0_mm,
                                    .y = value,
                                    .y_spread = sd,
                                    .label = figure(mean.speed * 60.0, 4) + " rpm",
                                    .told = figure(value, 4) + " +- " + figure(sd) + (of_torque ? " N mm" : " N")});
    }
    panel.curves.push_back(std::move(measured));
    return panel;
}

constexpr const char* feed_unknown = "; the study's feed is unknown, 1 mm/s is assumed";

/// How far predictions are off, one column per law.
drawing::Panel deviation_panel(const CuttingLaw& law) {
    drawing::Panel panel{
        .title = "Predictions, labelled with how many SD they are off. * Orelaja: feed unknown, 1 mm/s assumed; no SD"};
    panel.x = {.title = "prediction, in the order of physics.csv", .is_log = false, .low = 0.0, .high = 1.0};
    panel.y = {.title = "off by, in % of the measured mean",
               .is_log = false,
               .low = -50.0,
               .high = 50.0,
               .guides = {{0.0, ""}}};
    const auto all = predictions(law);
    panel.x.high = static_cast<double>(all.size()) + 1.0;
    std::string last;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::string group = all[i].sd > 0.0 ? all[i].tissue + ", " + all[i].quantity
                                                  : all[i].tissue + (all[i].is_feed_known ? "" : " *");
        if (group != last) panel.x.guides.push_back({static_cast<double>(i) + 0.5, group});
        last = group;
    }
    for (const char* name : {"proportional", "edge + chip", "power", "Kerf"}) {
        drawing::Curve curve{.name = name, .colour = colour_of(name), .has_line = false};
        for (std::size_t i = 0; i < all.size(); ++i) {
            const Prediction& p = all[i];
            if (p.law != name) continue;
            const double off = 100.0 * (p.predicted / p.measured - 1.0);
            curve.markers.push_back({.x = static_cast<double>(i) + 1.0,
                                     .y = off,
                                     .y_spread = 100.0 * p.sd / p.measured,
                                     .is_filled = p.sd > 0.0 && std::abs(p.off_in_sd()) <= 1.0,
                                     .label = p.sd > 0.0             ? figure(p.off_in_sd(), 2)
                                              : std::abs(off) > 50.0 ? figure(off, 3) + " %"
                                                                     : "",
                                     .told = p.source + ", " + p.tissue + ", " + p.quantity + " at " +
                                             figure(p.speed * 60.0, 4) + " rpm, " + p.law + ": " + figure(off, 3) +
                                             " %" + (p.is_feed_known ? "" : feed_unknown)});
        }
        panel.curves.push_back(std::move(curve));
    }
    return panel;
}

/// What an awl pushes through the walls of pedicles, beside what surgeons pushed with.
drawing::Panel awl_panel(std::span<const AwlWay> ways) {
    drawing::Panel panel{.title = "Largest push of an awl, 4 mm and 30 degrees, " + figure(aimed_wrong) +
                                  " degrees beside a pedicle's axis, where its wall breaks"};
    panel.x = {
        .title = "lumbar vertebra whose wall it is, of 1 to 5: thickness as measured [irie-2021], bone 100 and 64 %",
        .is_log = false,
        .low = 0.3,
        .high = 5.6};
    panel.y = {.title = "N", .is_log = false, .low = 0.0, .high = 500.0};
    panel.y.guides = {{measured_safe_push, "measured, safe"},
                      {measured_breach_push[0], ""},
                      {measured_breach_push[1], "measured, a breach"}};
    drawing::Curve along_axis{.name = "along the axis", .colour = of_line, .has_dots = false},
        medial{.name = "medial wall", .colour = of_kerf}, lateral{.name = "lateral wall", .colour = of_power};
    for (const double end : {panel.x.low, panel.x.high}) along_axis.markers.push_back({end, ways.front().push});
    for (const AwlWay& way : ways) {
        if (way.wall == nullptr) continue;
        (way.wall->is_medial ? medial : lateral)
            .markers.push_back({.x = static_cast<double>(way.wall->level),
                                .y = way.push,
                                .label = figure(way.wall->thickness / 1.0_mm) + " mm: " + figure(way.push) + " N"});
    }
    panel.curves = {std::move(along_axis), std::move(medial), std::move(lateral)};
    return panel;
}

const char* calibrated_on =
    "Calibrated on: proportional, the mean at 1000 rpm; edge + chip and power, the means at 1000 and 1500 rpm, each "
    "series by itself. "
    "Kerf: K_e and K_c of lips and chisel edge on the least-squares lines through all three means of the human femur, "
    "so that its figure at "
    "1250 rpm is no prediction; nothing of the bovine femur, whose feed is taken as 1 mm/s; 45 % of the thrust to the "
    "chisel edge (split point, Saha 1982); t_e assumed.";

}  // namespace

std::string published_svg(const CuttingLaw& law, std::span<const AwlWay> awl) {
    constexpr double half = 0.5 * width, tall = 380;
    std::string content =
        drawing::text_at(12, 24, "Physics: laws against published drilling tests", "class=\"kp-title\"");
    content += drawing::panel_svg(feed_panel(law, false), 0, 36, half, tall);
    content += drawing::panel_svg(feed_panel(law, true), half, 36, half, tall);
    content += drawing::panel_svg(deviation_panel(law), 0, 36 + tall, width, 330);
    if (!awl.empty()) content += drawing::panel_svg(awl_panel(awl), 0, 36 + tall + 330, width, 310);
    content += drawing::text_at(
        12, height - 24, "Filled: within 1 SD of the measured mean; hollow: not, or no SD was reported. Bars: +- 1 SD.",
        "class=\"kp-note\"");
    content += drawing::text_at(
        12, height - 40,
        "* The feed of the study is unknown. The figure holds for 1 mm/s, which is assumed: it does not measure Kerf.",
        "class=\"kp-note\"");
    content += drawing::text_at(12, height - 8, std::string(session::notice_line) + ".", "class=\"kp-note\"");
    return drawing::picture(width, height, "Physics: laws against published drilling tests", content);
}

std::string published_csv(const CuttingLaw& law, std::span<const Check> checks) {
    std::string text = std::string("# ") + session::notice_line + ".\n# " + calibrated_on +
                       "\nsource,tissue,quantity,speed_rpm,law,predicted,measured,sd,unit,off_in_sd,off_percent,feed\n";
    for (const Prediction& p : predictions(law)) {
        const double unit = p.quantity == "torque" ? 1.0_Nmm : 1.0;
        text += csv_quoted(p.source) + "," + csv_quoted(p.tissue) + "," + csv_quoted(p.quantity) + "," +
                figure(60.0 * p.speed, 4) + "," + csv_quoted(p.law) + "," + figure(p.predicted / unit, 4) + "," +
                figure(p.measured / unit, 4) + "," + (p.sd > 0.0 ? figure(p.sd / unit, 4) : "") + "," +
                (unit < 1.0 ? "N mm" : "N") + "," + (p.sd > 0.0 ? figure(p.off_in_sd()) : "") + "," +
                figure(100.0 * (p.predicted / p.measured - 1.0)) + "," + (p.is_feed_known ? "reported" : "assumed") +
                "\n";
    }
    text += "\ncheck,what,found,wanted,outcome,remark\n";
    for (const Check& check : checks)
        text += csv_quoted(check.id) + "," + csv_quoted(check.what) + "," + csv_quoted(check.found) + "," +
                csv_quoted(check.wanted) + "," + (check.passes ? "pass" : "fail") + "," + csv_quoted(check.remark) +
                "\n";
    return text;
}

std::string published_html(const CuttingLaw& law, std::span<const AwlWay> awl, std::span<const Check> checks) {
    std::string html = "<section><figure>" + published_svg(law, awl) + "</figure><p class=\"soft small\">" +
                       session::html_escaped(calibrated_on) +
                       "</p><div "
                       "class=\"wide\"><table><thead><tr><th>Check</th><th>What</th><th>Found</th><th>Wanted</"
                       "th><th>Outcome</th></tr></thead><tbody>";
    for (const Check& check : checks)
        html += "<tr><td>" + session::html_escaped(check.id) + "</td><td>" + session::html_escaped(check.what) +
                (check.remark.empty()
                     ? ""
                     : "<br><span class=\"soft small\">" + session::html_escaped(check.remark) + "</span>") +
                "</td><td>" + session::html_escaped(check.found) + "</td><td>" + session::html_escaped(check.wanted) +
                "</td><td class=\"" + (check.passes ? "ok\">pass" : "broken\">fail") + "</td></tr>";
    return html + "</tbody></table></div></section>\n";
}

}  // namespace kerf::chart
