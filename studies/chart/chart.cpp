// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/chart.h"

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <utility>

#include "studies/chart/standing.h"
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

}  // namespace

Chart make_chart(const Plugins& plugins, const Request& request, std::string& error) {
    Chart chart;
    const auto law = shared_law(plugins, error);
    if (!law) return chart;
    std::vector<Scene> scenes = request.is_quick && request.scene.empty() ? std::vector{slab_scene(0.0)} : all_scenes();
    if (!request.scene.empty()) {
        std::string known;
        for (const Scene& scene : scenes) known += (known.empty() ? "" : ", ") + scene.id;
        std::erase_if(scenes, [&](const Scene& scene) { return scene.id != request.scene; });
        if (scenes.empty()) error = "there is no scene `" + request.scene + "`. Write one of " + known + ".";
    }
    if (!error.empty()) return chart;
    const auto say = [&](const std::string& line) {
        if (request.progress) request.progress(line);
    };
    chart.processor = processor_name();
    chart.law = *law;
    chart.awl = awl_ways();
    chart.checks = published_checks(*law, chart.awl);
    const std::vector<Method> methods = all_methods(plugins, *law, request.is_quick);
    for (const Method& method : methods) {
        chart.methods.push_back({method.id, method.title, method.is_as_printed, stiffest(method, *law)});
        for (const Fineness& fineness : method.sweep) {
            const Standing& standing = chart.standings.emplace_back(standing_of(method, *law, fineness));
            say("tests  " + method.id + "  " + standing.knob + "  " +
                (standing.fails.empty() ? "passes" : "fails " + drawing::joined(standing.fails)) + " (" +
                standing.told + ")");
        }
    }
    // C.9: of four places of the grid. Where a voxel is small its place matters little, and a tick takes long.
    const auto grids_of = [&](const Fineness& fineness) {
        constexpr double fine = 0.2e-3;  // [m]
        return request.is_quick || fineness.spacing < fine ? 1 : 4;
    };
    for (const Scene& scene : scenes) {
        chart.scenes.push_back({scene.id, scene.title, scene.is_oblique});
        std::size_t standing = 0;
        for (const Method& method : methods) {
            const std::vector<Felt> led =
                walks(method, scene) ? led_by_hand(method, scene, finest) : std::vector<Felt>{};
            for (const Fineness& fineness : method.sweep) {
                Row row{scene.id,
                        method.id,
                        knob_text(method, fineness),
                        fineness,
                        measure(method, scene, *law, fineness, grids_of(fineness), led),
                        chart.standings[standing++].fails};
                if (row.measured.peak_step > largest_step) row.fails.push_back("S-16");
                if (!row.measured.is_finite) row.fails.push_back("finite");
                say(scene.id + "  " + row.method + "  " + row.knob + "  force error " +
                    percent(row.measured.force_error) + ", volume " + percent(row.measured.volume_error) + ", step " +
                    percent(row.measured.peak_step) + ", p99.9 " + drawing::figure(row.measured.cost.p999) + " us" +
                    (walks(method, scene) ? "; from the same hand on 0.1 mm " + percent(row.measured.same_hand) +
                                                " (turns " + percent(row.measured.same_hand_turn) + "), tips " +
                                                drawing::figure(1e3 * row.measured.apart) + " mm apart"
                                          : ""));
                chart.rows.push_back(std::move(row));
            }
        }
    }
    return chart;
}

}  // namespace kerf::chart
