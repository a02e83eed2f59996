// SPDX-License-Identifier: Apache-2.0
// Cost against error of what may show a saw's cut: the field's own surface at several spacings, the strategies `local`
// and `exact`, and CGAL's corefinement of the whole mesh for each step. Writes a picture and a table.
//
//     left     a step of 0.1 mm with a stroke of 3 mm, in meshes of 5000 to 320 000 triangles: processor time
//     right    a whole slot through 80 000 triangles: processor time, and the error of the removed volume against
//              `exact`, which cuts it at once. A strategy that cuts step by step also shows each step.
//
// Usage: bench_remesh_chart FILE.svg [quick]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/strategy_modules.h"
#include "bone/remesh/local_cutting.h"
#include "bone/surface/mesh_distances.h"
#include "core/field/cut/removed_volume.h"
#include "core/field/surface/bone_surface.h"
#include "session/recorder.h"
#include "studies/drawing/plot.h"
#include "studies/drawing/svg.h"
#include "studies/times.h"
#include "tests/support/sawn_tube.h"

namespace {

using namespace kerf;
using namespace literals;
using drawing::figure;
using test::bent_bone, test::blade_at, test::cut_across, test::slot_blade;

bench::StrategyModules strategies;

bone::RemeshResult ask(const char* strategy, const bone::RemeshRequest& request) {
    return strategies.ask(strategy, request);
}

drawing::Marker marker(double x, double y, std::string label = {}) {
    drawing::Marker m;
    m.x = x;
    m.y = y;
    m.label = std::move(label);
    return m;
}
drawing::Curve curve(const std::string& name, int colour) {
    drawing::Curve c;
    c.name = name;
    c.colour = colour;
    return c;
}

/// Milliseconds of processor time for steps of one strategy, from 8 mm past the surface on.
drawing::Panel cost_of_steps(const std::vector<double>& sizes) {
    const ToolSolid blade = slot_blade();
    drawing::Curve local = curve("local", 0), strategy = curve("local, unchecked", 1), whole = curve("whole mesh", 2);
    strategy.is_dashed = true;
    std::printf("%10s  %10s %10s  %10s  %10s   ms a step: local, its p99, the strategy alone, whole\n", "triangles",
                "local", "p99", "alone", "whole");
    for (const double size : sizes) {
        const bone::TaggedMesh bone = bone::tagged(bent_bone(size));
        const auto all = cut_across(0.0, -13.0_mm, 0.0, 0.1_mm, 3.0_mm);
        std::vector<double> ours, asked, theirs;
        double in_strategy = 0.0;
        bone::LocalCutting saw(bone, {&blade}, 20e-6, [&](const bone::RemeshRequest& request) {
            bone::RemeshResult result;
            in_strategy += processor_time_of([&] { result = ask("local", request); });
            return result;
        });
        for (std::size_t n = 0; n < all.size(); ++n) {
            in_strategy = 0.0;
            const double time = processor_time_of([&] { saw.cut(all[n]); });
            if (n < 50) continue;  // in the air
            ours.push_back(1e-3 * time);
            asked.push_back(1e-3 * in_strategy);
        }
        bone::RemeshRequest request;
        request.base = bone;
        request.solids = {&blade};
        request.cuts = {{blade_at(0.0, -13.0_mm), blade_at(0.0, -8.0_mm), 0}};
        if (bone::RemeshResult begun = ask("whole_rounded", request); begun.status == KERF_OK)
            request.base = std::move(begun.mesh);
        for (std::size_t n = 50; n < (size > 50e3 ? 58u : 70u); ++n) {
            request.cuts = {all[n]};
            bone::RemeshResult result;
            theirs.push_back(1e-3 * processor_time_of([&] { result = ask("whole_rounded", request); }));
            if (result.status == KERF_OK) request.base = std::move(result.mesh);
        }
        const auto triangles = static_cast<double>(bone.tags.size());
        drawing::Marker ours_at = marker(triangles, times_of(ours).median);
        local.markers.push_back(ours_at);
        strategy.markers.push_back(marker(triangles, times_of(asked).median));
        whole.markers.push_back(marker(triangles, times_of(theirs).median));
        std::printf("%10.0f  %10.2f %10.2f  %10.2f  %10.2f\n", triangles, ours_at.y, quantile_of(ours, 0.99),
                    strategy.markers.back().y, whole.markers.back().y);
        std::fflush(stdout);
    }
    drawing::Panel panel;
    panel.title = "A step of 0.1 mm";
    panel.x = {"triangles of the mesh", true, 3e3, 1e6, {}};
    panel.y = {"median, ms", true, 1.0, 1e4, {}};
    panel.curves = {local, strategy, whole};
    return panel;
}

/// What the field makes of a slot: milliseconds to stamp it and to make the surface, and the removed volume [m³].
std::pair<double, double> field_slot(const bone::SurfaceMesh& bone, double spacing) {
    const Box box = bounds_of(bone);
    const Vec3 margin{4.0 * spacing, 4.0 * spacing, 4.0 * spacing};
    const Grid grid = Grid::covering(box.low - margin, box.high + margin, spacing);
    const bone::TriangleTree tree(bone);
    bone::MeshDistances distances(tree);
    Material material;
    material.id = "bone";
    material.density = 1000.0;
    const Body body{"bone", LevelSet::build(grid, distances), {}, {material}, {}};
    CutField cut(body, 0);
    const double uncut = bone_volume(body, cut);
    const ToolSolid blade = slot_blade();
    const double time = processor_time_of([&] {
        for (const bone::CutStretch& step : cut_across(0.0, -13.0_mm, 13.0_mm, 0.1_mm, 3.0_mm)) {
            CutRecord record;
            record.from = step.from;
            record.to = step.to;
            cut.stamp(record, blade);
        }
        (void)bone_surface(body, cut);
    });
    return {1e-3 * time, uncut - bone_volume(body, cut)};
}

drawing::Panel cost_of_a_slot(double size, const std::vector<double>& spacings) {
    const ToolSolid blade = slot_blade();
    const bone::TaggedMesh bone = bone::tagged(bent_bone(size));
    const auto steps = cut_across(0.0, -13.0_mm, 13.0_mm, 0.1_mm, 3.0_mm);
    bone::RemeshRequest request;
    request.base = bone;
    request.solids = {&blade};
    request.cuts = steps;
    bone::RemeshResult exact;
    const double exact_time = 1e-3 * processor_time_of([&] { exact = ask("exact", request); });
    const double volume = bone::signed_volume_of(bone.mesh) - bone::signed_volume_of(exact.mesh.mesh);
    const double least = 1e-4;  // [%] what the axis shows
    std::printf("\n%-28s %10s %12s %10s\n%-28s %10.0f %12.4f\n", "a slot in 260 steps", "ms", "removed, mm3", "error",
                "exact, at once", exact_time, 1e9 * volume);
    const auto error_of = [&](double removed) { return 100.0 * std::abs(removed / volume - 1.0); };
    drawing::Curve field = curve("isosurface", 3), local = curve("local", 0), reference = curve("exact", 2);
    for (const double spacing : spacings) {
        const auto [time, removed] = field_slot(bone.mesh, spacing);
        std::printf("%-28s %10.0f %12.4f %8.4f %%\n", ("isosurface at " + figure(1e3 * spacing) + " mm").c_str(), time,
                    1e9 * removed, error_of(removed));
        field.markers.push_back(marker(time, std::max(least, error_of(removed)), figure(1e3 * spacing) + " mm"));
    }
    bone::LocalCutting saw(bone, {&blade}, 20e-6, [](const bone::RemeshRequest& r) { return ask("local", r); });
    const double time = 1e-3 * processor_time_of([&] {
                            for (const bone::CutStretch& step : steps) saw.cut(step);
                        });
    std::printf("%-28s %10.0f %12.4f %8.4f %%\n", "local", time, 1e9 * saw.removed(), error_of(saw.removed()));
    local.markers.push_back(marker(time, std::max(least, error_of(saw.removed()))));
    reference.markers.push_back(marker(exact_time, least));
    drawing::Panel panel;
    panel.title = "A slot through " + figure(static_cast<double>(bone.tags.size())) + " triangles";
    panel.x = {"all of it, ms", true, 10.0, 1e6, {}};
    panel.y = {"error of the removed volume, %", true, least, 100.0, {}};
    panel.curves = {field, local, reference};
    return panel;
}

}  // namespace

int main(int argc, char** argv) {
    std::string error = strategies.open({"kerf_remesh_cgal"});
    if (argc < 2) error = "usage: bench_remesh_chart FILE.svg [quick]";
    if (!error.empty()) {
        std::fprintf(stderr, "%s\n", error.c_str());
        return 2;
    }
    const bool is_quick = argc > 2 && std::strcmp(argv[2], "quick") == 0;
    const auto steps = cost_of_steps(is_quick ? std::vector{5e3, 20e3} : std::vector{5e3, 20e3, 80e3, 320e3});
    const auto slot = cost_of_a_slot(is_quick ? 5e3 : 80e3,
                                     is_quick ? std::vector{0.5e-3} : std::vector{1e-3, 0.5e-3, 0.25e-3, 0.15e-3});
    constexpr double width = 1100, height = 480, top = 40;
    std::string content = drawing::text_at(12, 24, "What an exact surface costs", "class=\"kp-title\"");
    content += drawing::panel_svg(steps, 0, top, 0.5 * width, height - top - 50);
    content += drawing::panel_svg(slot, 0.5 * width, top, 0.5 * width, height - top - 50);
    content += drawing::text_at(12, height - 28,
                                "`whole mesh`: CGAL 5.5.1's corefinement for one step, unchecked. `exact` cuts all "
                                "steps at once and is the reference. Errors below 0.0001 % stand on the axis.");
    content += drawing::text_at(12, height - 10, std::string(session::notice_line) + ".", "class=\"kp-note\"");
    std::ofstream out(argv[1]);
    out << drawing::picture(width, height, "What an exact surface costs", content);
    if (!out.flush()) {
        std::fprintf(stderr, "%s cannot be written\n", argv[1]);
        return 3;
    }
    std::printf("%s\n", argv[1]);
    return 0;
}
