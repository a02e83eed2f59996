// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/drill/methods.h"

#include <algorithm>
#include <memory>

#include "kerf/units.hpp"
#include "studies/chart/drill/lip_run.h"
#include "studies/chart/kerf_run.h"
#include "studies/chart/named_setup.h"
#include "studies/chart/voxel_run.h"
#include "studies/drawing/svg.h"

namespace kerf::chart {

namespace {

using namespace literals;

constexpr const char* drilling = "kerf.drilling";
constexpr const char* printed_papers = "papers.as_printed";
constexpr int usual_points = 31;  // per lip

Values drill_of(const Scene& scene) {
    return {{"diameter", scene.drill.diameter},
            {"point_angle", scene.drill.point_angle},
            {"web", scene.drill.web},
            {"spindle_speed", scene.spindle},
            {"run_up", 0.0},          // the motor follows at once
            {"motor_torque", 20.0}};  // [N·m] and never gives way: the papers have none
}

ToolSetup own_setup(const Plugins& plugins, const Scene& scene, const Fineness& fineness) {
    Values set = drill_of(scene);
    const Span lip = span_of(scene.drill, 0);
    set["element_pitch"] = (lip.to - lip.from) / fineness.points;
    return NamedSetup{drilling, "twist_drill", "drill_cutting", set}.in(*plugins.own);
}

Setting setting_of(const Scene& scene, const ToolSetup& setup) {
    return {scene.bone, setup, scene.pose_at(scene.depth.front()), scene.feed};
}

/// The drill's cone and cylinder where its tip was deepest.
VoxelRun::Swept hole_of(const Scene& scene) {
    return [=](const std::vector<Pose>& visited) -> std::function<bool(Vec3)> {
        double deepest = scene.depth.front();
        for (const Pose& pose : visited) deepest = std::max(deepest, dot(pose.position - scene.entry, scene.along));
        const Pose tool_from_body = inverse(scene.pose_at(deepest));
        const double radius = scene.drill.radius(), slope = radius / scene.drill.point_depth();
        return [=](Vec3 p) {
            const Vec3 at = tool_from_body * p;
            const double r = std::min(radius, -at.z * slope);
            return at.z < 0.0 && at.x * at.x + at.y * at.y <= r * r;
        };
    };
}

/// What the softest tissue resists of the hardest: the one figure a paper's user has to give for cancellous bone.
double softest_share(const ExactBone& bone, const CuttingLaw& law) {
    double least = 1e300, most = 0.0;
    for (const auto& tissue : bone.tissues) {
        least = std::min(least, law.resistance(tissue.density));
        most = std::max(most, law.resistance(tissue.density));
    }
    return least / most;
}

ToolSetup printed_setup(const Plugins& plugins, const CuttingLaw& law, const char* force, const Scene& scene,
                        const Fineness& fineness) {
    Values set = drill_of(scene);
    // Edges: 0.1 mm whatever the voxel; surface: one voxel. More points than usual are closer by as much.
    const double closer = static_cast<double>(usual_points) / fineness.points;
    set["element_interval"] = 0.1_mm * closer;
    set["voxel_width"] = fineness.spacing * closer;
    set["softer"] = softest_share(scene.bone, law);
    return NamedSetup{printed_papers, "paper_drill", force, set}.in(*plugins.papers);
}

std::vector<Fineness> by_spacing(bool quick) {
    if (quick) return {{0.5_mm, usual_points, {}}, {0.25_mm, usual_points, {}}};
    return {{1.0_mm, usual_points, {}},
            {0.5_mm, usual_points, {}},
            {0.25_mm, usual_points, {}},
            {0.1_mm, usual_points, {}}};
}

std::vector<Fineness> by_points(bool quick) {
    std::vector<Fineness> sweep;
    for (const int points : quick ? std::vector{8, 31} : std::vector{4, 8, 16, 31, 62, 125})
        sweep.push_back({0.5_mm, points, {}});
    return sweep;
}

/// The shared law on voxels.
Method on_voxels(const Plugins& plugins, const char* id, const char* title, VoxelBone::Reading reading, bool quick) {
    Method method{.id = id, .title = title, .sweep = by_spacing(quick)};
    method.start = [=](const Scene& scene, const Fineness& fineness, double gain) -> std::unique_ptr<Run> {
        return std::make_unique<VoxelRun>(setting_of(scene, own_setup(plugins, scene, fineness)), fineness, reading,
                                          VoxelRun::Removal::when_finished, gain, hole_of(scene));
    };
    method.first_lag = 1;
    return method;
}

Method as_printed(const Plugins& plugins, const CuttingLaw& law, const char* id, const char* title, const char* force,
                  VoxelBone::Reading reading, VoxelRun::Removal removal, bool quick) {
    Method method{.id = id, .title = title, .sweep = by_spacing(quick), .is_as_printed = true, .is_calibrated = true};
    method.start = [=](const Scene& scene, const Fineness& fineness, double gain) -> std::unique_ptr<Run> {
        return std::make_unique<VoxelRun>(setting_of(scene, printed_setup(plugins, law, force, scene, fineness)),
                                          fineness, reading, removal, gain, hole_of(scene));
    };
    return method;
}

/// A drill that finds its own motion walks: its grid is wider.
Scene with_room(Scene scene) {
    const double room = scene.is_oblique ? 5.0_mm : 0.0;
    scene.bone.low = scene.bone.low - Vec3{room, room, room};
    scene.bone.high = scene.bone.high + Vec3{room, room, room};
    return scene;
}

Method on_fields(const Plugins& plugins, const char* id, const char* title, KerfRun::Way way, Knob knob, bool quick) {
    Method method{.id = id, .title = title, .knob = knob};
    method.sweep = knob == Knob::points ? by_points(quick) : by_spacing(quick);
    method.is_solved = way == KerfRun::Way::solved;
    if (method.is_solved) {
        method.setup = [=](const Scene& scene, const Fineness& fineness) {
            return own_setup(plugins, scene, fineness);
        };
        method.replay = [=](const Scene& scene, const Fineness& fineness) -> std::unique_ptr<Run> {
            return std::make_unique<KerfRun>(setting_of(with_room(scene), own_setup(plugins, scene, fineness)),
                                             fineness, KerfRun::Way::direct);
        };
    }
    method.start = [=](const Scene& scene, const Fineness& fineness, double) -> std::unique_ptr<Run> {
        const Scene wide = way == KerfRun::Way::solved ? with_room(scene) : scene;
        return std::make_unique<KerfRun>(setting_of(wide, own_setup(plugins, scene, fineness)), fineness, way);
    };
    method.first_lag = 1;
    return method;
}

}  // namespace

std::string knob_text(Knob knob, const Fineness& fineness) {
    return knob == Knob::spacing ? drawing::figure(fineness.spacing / 1.0_mm) + " mm"
                                 : std::to_string(fineness.points) + " points";
}

std::optional<CuttingLaw> shared_law(const Plugins& plugins, std::string& error) {
    const ComponentInfo* tool = info_of(*plugins.own, drilling, "twist_drill");
    const ComponentInfo* force = info_of(*plugins.own, drilling, "drill_cutting");
    if (tool == nullptr || force == nullptr) {
        error = std::string("there is no plugin `") + drilling + "`. `kerf list` names those that were found.";
        return std::nullopt;
    }
    auto law = cutting_law_of(force->parameters);
    if (!law)
        error = std::string("`") + drilling + "/drill_cutting` has other parameters than the chart knows: rebuild it.";
    return law;
}

std::vector<Method> all_methods(const Plugins& plugins, const CuttingLaw& law, bool quick) {
    using Reading = VoxelBone::Reading;
    using Removal = VoxelRun::Removal;
    const bool has_printed =
        plugins.papers != nullptr && info_of(*plugins.papers, printed_papers, "tsai_2007") != nullptr;
    std::vector<Method> methods;
    if (has_printed)
        methods.push_back(as_printed(plugins, law, "M1", "touch by counting, as printed", "touch_count",
                                     Reading::binary, Removal::when_finished, quick));
    methods.push_back(on_voxels(plugins, "M2", "chip load, binary voxels", Reading::binary, quick));
    methods.push_back(on_voxels(plugins, "M3", "chip load, trilinear density", Reading::density, quick));
    methods.push_back(
        on_fields(plugins, "M4", "chip load, borders within a voxel", KerfRun::Way::direct, Knob::points, quick));
    methods.push_back(on_voxels(plugins, "M5", "chip load, mixed elements", Reading::fraction, quick));
    if (has_printed)
        methods.push_back(as_printed(plugins, law, "M6", "density alone, as printed", "dental_implant",
                                     Reading::density, Removal::where_asked, quick));
    Method lips{
        .id = "M8", .title = "lip integral on distance fields", .knob = Knob::points, .sweep = by_points(quick)};
    lips.start = [law](const Scene& scene, const Fineness& fineness, double) -> std::unique_ptr<Run> {
        return std::make_unique<LipRun>(scene, law, fineness);
    };
    methods.push_back(lips);
    methods.push_back(
        on_fields(plugins, "M9", "M4 with proxy and coupling: Kerf", KerfRun::Way::solved, Knob::spacing, quick));
    if (has_printed) {
        methods.push_back(as_printed(plugins, law, "000", "Tsai 2007, as printed", "tsai_2007", Reading::binary,
                                     Removal::when_finished, quick));
        methods.push_back(as_printed(plugins, law, "001", "volumetric drilling, as printed", "volumetric_drilling",
                                     Reading::binary, Removal::where_asked, quick));
    }
    return methods;
}

}  // namespace kerf::chart
