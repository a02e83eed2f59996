// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/surfaces/burr_surfaces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "kerf/units.hpp"
#include "session/recorder.h"
#include "studies/drawing/plot.h"
#include "studies/drawing/svg.h"
#include "studies/times.h"

namespace kerf::chart {

using namespace literals;
using drawing::csv_quoted;
using drawing::figure;

namespace {

struct NamedGroove {
    std::string name;
    Groove groove;
};
std::vector<NamedGroove> grooves_of(const std::string& scene) {
    if (scene == "burr-groove") return {{"1 mm deep, entered across an edge", groove_from_the_end(1.0_mm)}};
    if (scene == "grazing")
        return {{"50 um deep", groove_within(50.0_um)},
                {"10 um deep", groove_within(10.0_um)},
                {"1 um deep", groove_within(1.0_um)}};
    return {};
}

/// Of its walls; not a number where it has none [m].
double farthest_of(const SurfaceRow& row) { return row.made.walls > 0 ? row.made.farthest : std::nan(""); }

double percent_off(const SurfaceRow& row) { return 100.0 * std::abs(row.made.removed / row.volume - 1.0); }

std::string told_of(const SurfaceRow& row) {
    return row.maker + ", " + row.knob + ": volume " + figure(percent_off(row)) + " % off, walls " +
           figure(1e6 * row.made.farthest) + " um, " + figure(row.made.step_ms) + " ms a step" +
           (row.made.flaw.empty() ? "" : "; " + row.made.flaw);
}

/// One value of the ways of a groove over the cost of a step.
template <class Value>
drawing::Panel panel_of(const std::vector<SurfaceRow>& rows, const std::string& groove, const std::string& title,
                        const std::string& what, double least, double most, const Value& value) {
    drawing::Panel panel{.title = title};
    panel.x = {"ms a step", true, 0.01, 1e5, {}};
    panel.y = {what, true, least, most, {}};
    constexpr const char* makers[] = {"exact", "displace", "field"};
    for (int m = 0; m < 3; ++m) {
        drawing::Curve curve{.name = makers[m], .colour = m + 1};
        for (const SurfaceRow& row : rows)
            if (row.groove == groove && row.maker == makers[m] && std::isfinite(value(row)))
                curve.markers.push_back({row.made.step_ms, std::max(least, value(row)), 0.0, 0.0, row.made.flaw.empty(),
                                         row.knob, told_of(row)});
        if (!curve.markers.empty()) panel.curves.push_back(std::move(curve));
    }
    return panel;
}

}  // namespace

std::vector<SurfaceRow> burr_surfaces(const std::string& scene, const FindStrategy& find, bool quick) {
    constexpr double feed = 0.1_mm;
    std::vector<SurfaceRow> rows;
    const auto grooves = grooves_of(scene);
    if (grooves.empty()) return rows;
    const bone::StrategyCall displace = find(surface_strategies[0]), local = find(surface_strategies[1]),
                             exact = find(surface_strategies[2]);
    if (!exact || !displace || !local) return rows;
    const Clock by_the_clock = [](const auto& work) { return time_of(work); };
    for (const auto& [name, groove] : grooves) {
        const auto add = [&](const char* maker, const std::string& knob, const GrooveSurface& made) {
            rows.push_back({scene, name, maker, knob, groove.volume, made});
        };
        for (const double spacing : quick ? std::vector{0.5_mm, 0.25_mm} : std::vector{0.5_mm, 0.25_mm, 0.125_mm})
            add("field", figure(spacing / 1.0_mm) + " mm", surface_by_field(groove, spacing, feed, by_the_clock));
        for (const double tolerance : quick ? std::vector{80.0_um, 20.0_um} : std::vector{80.0_um, 20.0_um, 5.0_um})
            add("displace", figure(tolerance / 1.0_um) + " um",
                surface_by_steps(groove, displace, local, tolerance, feed, by_the_clock));
        add("exact", "all at once", surface_at_once(groove, exact, by_the_clock));
    }
    return rows;
}

std::string surfaces_csv(const std::vector<SurfaceRow>& rows) {
    std::string text =
        std::string("# ") + session::notice_line +
        ".\n# a groove by a ball burr of 4 mm in steps of 0.1 mm; times by the clock\n"
        "scene,groove,surface,knob,volume_mm3,closed_form_mm3,volume_error,walls_rms_um,walls_farthest_um,"
        "ms_per_step,faces,faces_of_walls,min_angle_5_percent_deg,min_angle_median_deg,"
        "steps_handed_over,flaw\n";
    for (const SurfaceRow& row : rows) {
        const GrooveSurface& m = row.made;
        for (const std::string& word : {row.scene, row.groove, row.maker, row.knob}) text += csv_quoted(word) + ",";
        for (const double value :
             {1e9 * m.removed, 1e9 * row.volume, m.removed / row.volume - 1.0, 1e6 * m.rms, 1e6 * farthest_of(row),
              m.step_ms, static_cast<double>(m.faces), static_cast<double>(m.walls), m.few_angle / 1.0_deg,
              m.mid_angle / 1.0_deg, static_cast<double>(m.handed_over)})
            text += (std::isfinite(value) ? figure(value, 5) : "") + ",";
        text += csv_quoted(m.flaw) + "\n";
    }
    return text;
}

std::string surfaces_svg(const std::vector<SurfaceRow>& rows) {
    std::vector<std::string> grooves;
    for (const SurfaceRow& row : rows)
        if (std::find(grooves.begin(), grooves.end(), row.groove) == grooves.end()) grooves.push_back(row.groove);
    constexpr double width = 1040, tall = 300, top = 40;
    const double height = top + tall * static_cast<double>(grooves.size()) + 50;
    const std::string title = "Surface of a burr's groove: field, displace, exact";
    std::string content = drawing::text_at(12, 24, title, "class=\"kp-title\"");
    for (std::size_t g = 0; g < grooves.size(); ++g) {
        const double y = top + tall * static_cast<double>(g);
        const auto volume = panel_of(rows, grooves[g], "Groove " + grooves[g] + ": volume",
                                     "|V - V_exact| / V_exact in %", 1e-3, 1e3, percent_off);
        const auto walls = panel_of(rows, grooves[g], "Its walls", "farthest from the swept ball in um", 1e-2, 1e3,
                                    [](const SurfaceRow& row) { return 1e6 * farthest_of(row); });
        content += drawing::panel_svg(volume, 0, y, 0.5 * width, tall);
        content += drawing::panel_svg(walls, 0.5 * width, y, 0.5 * width, tall);
    }
    content += drawing::text_at(12, height - 28,
                                "Steps of 0.1 mm. `exact` cuts all at once: all of its time. Filled: closed, no "
                                "crossings. Values beyond an axis stand on its end.");
    content += drawing::text_at(12, height - 10, std::string(session::notice_line) + ".", "class=\"kp-note\"");
    return drawing::picture(width, height, title, content);
}

}  // namespace kerf::chart
