// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/powered/powered_methods.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kerf/assert.hpp"
#include "studies/chart/kerf_run.h"
#include "studies/chart/voxel_run.h"

namespace kerf::chart {

namespace {

NamedSetup with_points(NamedSetup named, const std::string& parameter, int points) {
    if (!parameter.empty()) named.set[parameter] = points;
    return named;
}

Setting setting_of(const PoweredScene& scene, const ToolSetup& setup) {
    return {scene.bone, setup, scene.path.front(), scene.feed, scene.working_force};
}

/// All that the cutting outline holds at a pose, poses no farther apart than a part of the voxel.
VoxelRun::Swept swept_by(const ToolSetup& setup, double spacing) {
    ToolOutline outline;
    std::string error;
    const bool is_made = outline_of(setup, outline, error);
    KERF_ASSERT(is_made, "a tool of a scene can be made");
    return [cutting = outline.cutting, spacing](const std::vector<Pose>& visited) -> std::function<bool(Vec3)> {
        const double reach =
            std::hypot(cutting.largest_radius(), 0.5 * cutting.thickness(), std::abs(cutting.outline().back().z));
        std::vector<Pose> tools_from_body;
        Pose last = visited.front();
        for (const Pose& pose : visited) {
            const Pose from_last = inverse(last) * pose;
            const double moved = length(from_last.position) + reach * length(small_rotation_vector(from_last.rotation));
            if (!tools_from_body.empty() && moved < 0.1 * spacing) continue;
            tools_from_body.push_back(inverse(pose));
            last = pose;
        }
        tools_from_body.push_back(inverse(visited.back()));
        return [=](Vec3 p) {
            return std::any_of(tools_from_body.begin(), tools_from_body.end(), [&](const Pose& tool_from_body) {
                const Vec3 at = tool_from_body * p;
                return dot(at, at) <= reach * reach && cutting.distance(at) <= 0.0;
            });
        };
    };
}

std::vector<Fineness> by_spacing(const PoweredScene& scene, bool quick) {
    std::vector<Fineness> sweep;
    for (const double spacing : scene.spacing_sweep) sweep.push_back({spacing, scene.usual_points, {}});
    if (quick && sweep.size() > 2) sweep.resize(2);
    return sweep;
}

std::vector<Fineness> by_points(const PoweredScene& scene, bool quick) {
    const double spacing = scene.spacing_sweep[scene.spacing_sweep.size() / 2];
    if (quick) return {{spacing, scene.points_sweep.front(), {}}, {spacing, scene.points_sweep.back(), {}}};
    std::vector<Fineness> sweep;
    for (const int points : scene.points_sweep) sweep.push_back({spacing, points, {}});
    return sweep;
}

PoweredMethod on_fields(const Plugins& plugins, const PoweredScene& scene, std::string id, std::string title,
                        KerfRun::Way way, Knob knob, bool quick) {
    PoweredMethod method{.id = std::move(id), .title = std::move(title), .knob = knob};
    method.sweep = knob == Knob::points ? by_points(scene, quick) : by_spacing(scene, quick);
    method.is_solved = way == KerfRun::Way::solved;
    method.more_points = scene.points.empty() ? 0.0 : 2.0;
    method.start = [=](const PoweredScene& in, const Fineness& fineness, double) -> std::unique_ptr<Run> {
        return std::make_unique<KerfRun>(setting_of(in, tool_of(plugins, in, fineness.points)), fineness, way);
    };
    return method;
}

}  // namespace

ToolSetup tool_of(const Plugins& plugins, const PoweredScene& scene, int points) {
    return with_points(scene.tool, scene.points, points).in(*plugins.own);
}

std::string why_no_exact_law(const Plugins& plugins, const PoweredScene& scene) {
    const NamedSetup& tool = scene.tool;
    if (!tool.is_in(*plugins.own))
        return "there is no plugin `" + tool.plugin + "` with `" + tool.tool + "` and `" + tool.force +
               "`. `kerf list` names those that were found.";
    const Values values = tool.all(*plugins.own);
    for (const std::string& id : scene.needs)
        if (!values.contains(id))
            return "`" + tool.plugin + "/" + tool.force + "` has other parameters than the chart knows: rebuild it.";
    return "";
}

std::vector<PoweredMethod> powered_methods(const Plugins& plugins, const PoweredScene& scene, bool quick) {
    std::vector<PoweredMethod> methods;
    PoweredMethod voxels{.id = "M2",
                         .title = "the law in binary voxels",
                         .sweep = by_spacing(scene, quick),
                         .more_points = scene.points.empty() ? 0.0 : 2.0};
    voxels.start = [=](const PoweredScene& in, const Fineness& fineness, double gain) -> std::unique_ptr<Run> {
        const ToolSetup setup = tool_of(plugins, in, fineness.points);
        return std::make_unique<VoxelRun>(setting_of(in, setup), fineness, VoxelBone::Reading::binary,
                                          VoxelRun::Removal::when_finished, gain, swept_by(setup, fineness.spacing));
    };
    methods.push_back(voxels);
    methods.push_back(on_fields(plugins, scene, "M10", "the law on distance fields, prescribed motion",
                                KerfRun::Way::direct, Knob::spacing, quick));
    if (!scene.points_sweep.empty())
        methods.push_back(
            on_fields(plugins, scene, "M10 points", "the same by points", KerfRun::Way::direct, Knob::points, quick));
    methods.push_back(on_fields(plugins, scene, "M9", "M10 with proxy and coupling: Kerf", KerfRun::Way::solved,
                                Knob::spacing, quick));
    for (const Rival& rival : scene.rivals) {
        const PluginRegistry* registry = nullptr;
        for (const PluginRegistry* one : {plugins.own, plugins.papers})
            if (one != nullptr && rival.setup.is_in(*one)) registry = one;
        if (registry == nullptr) continue;
        PoweredMethod method{.id = rival.id,
                             .title = rival.title,
                             .sweep = by_spacing(scene, quick),
                             .is_as_printed = rival.is_as_printed,
                             .is_calibrated = !rival.scale.empty(),
                             .more_points = rival.points.empty() ? 0.0 : rival.more_points};
        for (Fineness& fineness : method.sweep) fineness.points = rival.usual_points;
        method.start = [=](const PoweredScene& in, const Fineness& fineness, double gain) -> std::unique_ptr<Run> {
            NamedSetup scaled = with_points(rival.setup, rival.points, fineness.points);
            if (!rival.scale.empty()) scaled.set[rival.scale] = gain * rival.setup.all(*registry).at(rival.scale);
            const ToolSetup setup = scaled.in(*registry);
            return std::make_unique<KerfRun>(setting_of(in, setup), fineness, KerfRun::Way::direct);
        };
        methods.push_back(method);
    }
    return methods;
}

}  // namespace kerf::chart
