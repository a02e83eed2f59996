// SPDX-License-Identifier: Apache-2.0
#include "run/exact/compare_strategies.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bone/exact/base_surface.h"
#include "bone/exact/exact_track.h"
#include "bone/surface/triangle_tree.h"
#include "core/field/cut/removed_volume.h"
#include "core/field/surface/bone_surface.h"
#include "run/planned_feed.h"

namespace kerf::run {
namespace {

constexpr double advance = 0.1e-3;  // [m] per record

std::vector<CutRecord> planned_cut(const Scene& scene, std::size_t step, double depth) {
    std::vector<CutRecord> records;
    const int count = std::max(1, static_cast<int>(std::ceil((in_air_before_entry + depth) / advance)));
    for (int n = 0; n < count; ++n) {
        const auto pose_at = [&](int i) {
            return planned_pose(scene, step, (in_air_before_entry + depth) * i / count - in_air_before_entry);
        };
        CutRecord record;
        record.sequence = static_cast<std::uint64_t>(n);
        record.solid = static_cast<std::uint16_t>(scene.tool_of_step[step]);
        record.from = pose_at(n);
        record.to = pose_at(n + 1);
        records.push_back(record);
    }
    return records;
}

/// Returns the largest distance of a vertex within a box from another surface [m].
double farthest_from(const bone::SurfaceMesh& mesh, const bone::TriangleTree& other, const Box& box) {
    double farthest = 0.0;
    for (const Vec3 v : mesh.vertices)
        if (meet({v, v}, box)) farthest = std::max(farthest, other.distance(v, HUGE_VAL));
    return farthest;
}

}  // namespace

std::vector<StrategyCost> compare_strategies(const Scene& scene, std::size_t step, double depth,
                                             const StrategyHost& host, const std::vector<std::string>& strategies,
                                             const std::function<void(const std::string& what)>& report) {
    using Clock = std::chrono::steady_clock;
    const auto seconds_since = [](Clock::time_point start) {
        return std::chrono::duration<double>(Clock::now() - start).count();
    };
    const std::vector<CutRecord> records = planned_cut(scene, step, depth);
    const ToolSolid& solid = scene.tool(step).outline.cutting;
    const double voxel = scene.body.grid().spacing;
    Box box = bone::swept_box(solid, {records.front().from, records.back().to, 0});
    box.low = box.low - Vec3{voxel, voxel, voxel};
    box.high = box.high + Vec3{voxel, voxel, voxel};

    std::vector<StrategyCost> costs;
    std::vector<bone::SurfaceMesh> surfaces;
    report("surface: isosurface");
    CutField cut(scene.body, 0);
    const double uncut = bone_volume(scene.body, cut);
    const auto start = Clock::now();
    for (const CutRecord& record : records) cut.stamp(record, solid);
    const Mesh field = bone_surface(scene.body, cut);
    costs.push_back(
        {"isosurface", uncut - bone_volume(scene.body, cut), 0.0, seconds_since(start), field.triangles.size(), ""});
    bone::SurfaceMesh& shown = surfaces.emplace_back();
    shown.vertices = field.vertices;
    shown.triangles.assign(field.triangles.begin(), field.triangles.end());

    std::vector<std::string> notes;
    std::string flaw;
    const auto base = bone::base_surface(surface_anatomy(scene), scene.body, notes, flaw);
    bone::TaggedMesh bone;
    if (base) bone = bone::tagged(*base);
    for (const std::string& strategy : strategies) {
        report("surface: " + strategy);
        StrategyCost& cost = costs.emplace_back();
        bone::SurfaceMesh& made = surfaces.emplace_back();
        cost.strategy = strategy;
        cost.why_not = flaw;
        const auto child = base ? start_strategy(host, strategy, {}, cost.why_not) : nullptr;
        if (child == nullptr) continue;
        bone::ExactTools tools = exact_tools(scene);
        tools.strategies.assign(tools.solids.size(), {{strategy, child.get()}});
        CutHistory history;
        for (const CutRecord& record : records) history.push(record);
        bone::ExactTrack track(bone, {}, tools, voxel);
        const auto begun = Clock::now();
        track.follow(history);
        track.finish();
        cost.seconds = seconds_since(begun);
        if (!track.stale().empty()) cost.why_not = track.stale().front().why;
        made = track.mesh().mesh;
        cost.removed = bone::signed_volume_of(bone.mesh) - bone::signed_volume_of(made);
        cost.triangles = made.triangles.size();
    }
    if (!costs.back().why_not.empty() || strategies.empty()) return costs;
    const bone::TriangleTree reference(surfaces.back());
    for (std::size_t n = 0; n + 1 < costs.size(); ++n) {
        if (!costs[n].why_not.empty()) continue;
        const bone::TriangleTree own(surfaces[n]);
        costs[n].farthest =
            std::max(farthest_from(surfaces[n], reference, box), farthest_from(surfaces.back(), own, box));
    }
    return costs;
}

}  // namespace kerf::run
