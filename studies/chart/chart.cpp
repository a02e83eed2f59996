// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/chart.h"

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <utility>
#include <vector>

#include "documents/yaml/read_map.h"
#include "studies/chart/drill/standing.h"
#include "studies/chart/powered/powered_measure.h"
#include "studies/drawing/svg.h"

namespace kerf::chart {

namespace {

/// The processor as it calls itself.
std::string processor_name() {
    std::ifstream in("/proc/cpuinfo");
    for (std::string line; std::getline(in, line);)
        if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
    return "an unknown processor";
}

std::string percent(double share) { return drawing::figure(100.0 * share) + " %"; }

/// What all parts of a chart are made from.
struct Making {
    const Plugins& plugins;
    const Request& request;
    Chart& chart;

    void say(const std::string& line) const {
        if (request.progress) request.progress(line);
    }
    void add(const Standing& standing) const {
        chart.standings.push_back(standing);
        say("tests  " + standing.method + "  " + standing.knob + "  " +
            (standing.fails.empty() ? "passes" : "fails " + drawing::joined(standing.fails)) + " (" + standing.told +
            ")");
    }
    /// @param more  for the line that is printed
    void add(Row row, const std::string& more) const {
        if (!row.measured.is_finite) row.fails.push_back("finite");
        say(row.scene + "  " + row.method + "  " + row.knob + "  force error " + percent(row.measured.force_error) +
            ", volume " + percent(row.measured.volume_error) + ", step " + percent(row.measured.peak_step) +
            ", p99.9 " + drawing::figure(row.measured.cost.p999) + " us" + more);
        chart.rows.push_back(std::move(row));
    }
    /// C.9: of four places of the grid. Where a voxel is small its place matters little, and a tick takes long.
    [[nodiscard]] int grids_of(const Fineness& fineness) const {
        constexpr double fine = 0.2e-3;  // [m]
        return request.is_quick || fineness.spacing < fine ? 1 : 4;
    }
};

void add_drill(const Making& making, const std::vector<Scene>& scenes) {
    if (scenes.empty()) return;
    Chart& chart = making.chart;
    const std::vector<Method> methods = all_methods(making.plugins, chart.law, making.request.is_quick);
    for (const Method& method : methods) {
        chart.methods.push_back({method.id, method.title, method.is_as_printed, stiffest(method, chart.law)});
        for (const Fineness& fineness : method.sweep) making.add(standing_of(method, chart.law, fineness));
    }
    for (const Scene& scene : scenes) {
        chart.scenes.push_back({scene.id, scene.title, scene.is_oblique});
        std::size_t standing = 0;
        for (const Method& method : methods) {
            const std::vector<Felt> led =
                walks(method, scene) ? led_by_hand(method, scene, finest) : std::vector<Felt>{};
            for (const Fineness& fineness : method.sweep) {
                Row row{scene.id,
                        method.id,
                        knob_text(method.knob, fineness),
                        fineness,
                        measure(method, scene, chart.law, fineness, making.grids_of(fineness), led),
                        chart.standings[standing++].fails};
                const Measured& m = row.measured;
                if (m.peak_step > largest_step) row.fails.push_back("S-16");
                making.add(row, walks(method, scene) ? "; from the same hand on 0.1 mm " + percent(m.same_hand) +
                                                           " (turns " + percent(m.same_hand_turn) + "), tips " +
                                                           drawing::figure(1e3 * m.apart) + " mm apart"
                                                     : "");
            }
        }
    }
}

/// Tests and notes of a cutter that no scene before had.
void add_cutter(const Making& making, const PoweredScene& scene, const std::vector<PoweredMethod>& methods) {
    Chart& chart = making.chart;
    const bool is_known = std::any_of(chart.methods.begin(), chart.methods.end(),
                                      [&](const MethodNote& note) { return note.cutter == scene.cutter; });
    if (is_known) return;
    for (const PoweredMethod& method : methods) {
        chart.methods.push_back({method.id, method.title, method.is_as_printed, 0.0, scene.cutter});
        for (const Fineness& fineness : method.sweep)
            making.add(powered_standing(making.plugins, method, scene, fineness));
    }
}

void add_powered(const Making& making, const PoweredScene& scene) {
    Chart& chart = making.chart;
    const std::vector<PoweredMethod> methods = powered_methods(making.plugins, scene, making.request.is_quick);
    add_cutter(making, scene, methods);
    const PoweredReference prescribed = reference_along(making.plugins, scene, prescribed_motion(scene), true);
    chart.scenes.push_back({.id = scene.id,
                            .title = scene.title,
                            .cutter = scene.cutter,
                            .has_torque = scene.line.has_value(),
                            .note = scene.note});
    for (const PoweredMethod& method : methods)
        for (const Fineness& fineness : method.sweep) {
            const double gain = powered_calibration(making.plugins, method, scene, fineness);
            const std::string knob = knob_text(method.knob, fineness);
            const auto standing =
                std::find_if(chart.standings.begin(), chart.standings.end(), [&](const Standing& one) {
                    return one.cutter == scene.cutter && one.method == method.id && one.knob == knob;
                });
            const Row row{
                scene.id,
                method.id,
                knob,
                fineness,
                measure_powered(making.plugins, method, scene, prescribed, fineness, making.grids_of(fineness), gain),
                standing->fails};
            making.add(row, scene.line ? ", torque " + percent(row.measured.torque_error) : "");
        }
}

}  // namespace

Chart make_chart(const Plugins& plugins, const Request& request, std::string& error) {
    Chart chart;
    const auto law = shared_law(plugins, error);
    if (!law) return chart;
    const bool is_one = !request.scene.empty();
    std::vector<Scene> scenes = request.is_quick && !is_one ? std::vector{slab_scene(0.0)} : all_scenes();
    std::vector<PoweredScene> powered =
        request.is_quick && !is_one ? std::vector<PoweredScene>{} : all_powered_scenes();
    if (is_one) {
        std::vector<std::string> known;
        const auto keep_the_one = [&](auto& from) {
            for (const auto& scene : from) known.push_back(scene.id);
            std::erase_if(from, [&](const auto& scene) { return scene.id != request.scene; });
        };
        keep_the_one(scenes);
        keep_the_one(powered);
        if (scenes.empty() && powered.empty()) {
            // No other command lists the scenes, so all are listed.
            const std::string meant = documents::closest(request.scene, known);
            std::string all;
            for (const std::string& id : known) all += (all.empty() ? "" : ", ") + id;
            error = "there is no scene `" + request.scene + "`. Write " +
                    (meant.empty() ? "one of " + all : "`" + meant + "`") + ".";
        }
    }
    for (const PoweredScene& scene : powered)
        if (error.empty()) error = why_no_exact_law(plugins, scene);
    if (!error.empty()) return chart;
    chart.processor = processor_name();
    chart.law = *law;
    chart.awl = awl_ways();
    chart.checks = published_checks(*law, chart.awl);
    const Making making{plugins, request, chart};
    add_drill(making, scenes);
    for (const PoweredScene& scene : powered) {
        add_powered(making, scene);
        if (!request.strategies) continue;
        for (SurfaceRow& row : burr_surfaces(scene.id, request.strategies, request.is_quick)) {
            making.say("surface  " + scene.id + "  " + row.groove + "  " + row.maker + "  " + row.knob + "  volume " +
                       percent(row.made.removed / row.volume - 1.0) + " off, walls " +
                       drawing::figure(1e6 * row.made.farthest) + " um, " + drawing::figure(row.made.step_ms) +
                       " ms a step" + (row.made.flaw.empty() ? "" : "; " + row.made.flaw));
            chart.surfaces.push_back(std::move(row));
        }
    }
    return chart;
}

}  // namespace kerf::chart
