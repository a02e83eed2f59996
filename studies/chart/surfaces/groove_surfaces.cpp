// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/surfaces/groove_surfaces.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "bone/remesh/accept.h"
#include "bone/surface/edges.h"
#include "core/field/cut/removed_volume.h"
#include "core/field/surface/bone_surface.h"
#include "kerf/units.hpp"
#include "studies/chart/exact_bone.h"
#include "studies/chart/surfaces/burr_on_slab.h"

namespace kerf::chart {

using namespace literals;

namespace {

constexpr Vec3 slab_size{24.0_mm, 10.0_mm, 6.0_mm};
constexpr double square = 0.5_mm, beside = 0.1_mm;  // [m] the groove lies a little beside the edges of the squares

bone::TaggedMesh slab_of_bone() { return bone::tagged(slab(slab_size.x, slab_size.y, slab_size.z, square)); }

/// How far the walls are from the capsule that the burr sweeps: at corners, middles of sides and of faces.
void measure_walls(const Groove& groove, const bone::TaggedMesh& mesh, GrooveSurface& made) {
    const Vec3 begin = groove.from + Vec3{0, 0, groove.radius}, way = groove.to - groove.from;
    double squares = 0.0, area = 0.0;
    for (std::size_t f = 0; f < mesh.tags.size(); ++f) {
        if (mesh.tags[f] != KERF_FACE_WALL) continue;
        const auto [a, b, c] = mesh.mesh.corners(mesh.mesh.triangles[f]);
        const double size = length(cross(b - a, c - a));
        for (const Vec3 p : {a, b, c, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a), (a + b + c) / 3.0}) {
            const double t = std::clamp(dot(p - begin, way) / dot(way, way), 0.0, 1.0);
            const double off = std::abs(length(p - begin - t * way) - groove.radius);
            squares += size * off * off;
            area += size;
            made.farthest = std::max(made.farthest, off);
        }
    }
    if (area > 0.0) made.rms = std::sqrt(squares / area);
    const std::vector<double> angles = min_angles_of_walls(mesh);
    made.walls = angles.size();
    made.faces = mesh.tags.size();
    if (angles.empty()) return;
    const auto at = [&](double share) {
        return angles[static_cast<std::size_t>(share * static_cast<double>(angles.size() - 1))];
    };
    made.few_angle = at(0.05);
    made.mid_angle = at(0.5);
}

}  // namespace

Groove groove_within(double depth) {
    Groove groove{{-6.0_mm, beside, -depth}, {6.0_mm, beside, -depth}};
    groove.volume = 12.0_mm * slot_area(groove.radius, depth) + dimple_volume(groove.radius, depth);
    return groove;
}

Groove groove_from_the_end(double depth) {
    Groove groove{{-0.5 * slab_size.x - 3.0_mm, beside, -depth}, {-3.0_mm, beside, -depth}};
    groove.volume = 9.0_mm * slot_area(groove.radius, depth) + 0.5 * dimple_volume(groove.radius, depth);
    return groove;
}

GrooveSurface surface_by_steps(const Groove& groove, const bone::StrategyCall& ask, const bone::StrategyCall& otherwise,
                               double tolerance, double feed, const Clock& clock) {
    const ToolSolid burr = ball_burr(groove.radius);
    const bone::TaggedMesh bone = slab_of_bone();
    const auto steps = in_steps(groove.from, groove.to, feed);
    bone::LocalCutting cut(bone, {&burr}, tolerance, ask, otherwise);
    const double time = clock([&] {
        for (const bone::CutStretch& step : steps) cut.cut(step);
    });
    GrooveSurface made;
    made.removed = cut.removed();
    made.step_ms = 1e-3 * time / static_cast<double>(steps.size());
    made.handed_over = cut.handed_over();
    if (!cut.stale().empty()) {
        made.flaw = cut.stale().front().why;
    } else {
        bone::RemeshRequest request;
        request.base = bone;
        made.flaw = bone::flaw_of_result(request, cut.surface().mesh());
    }
    measure_walls(groove, cut.surface().mesh(), made);
    return made;
}

GrooveSurface surface_at_once(const Groove& groove, const bone::StrategyCall& exact, const Clock& clock) {
    const ToolSolid burr = ball_burr(groove.radius);
    bone::RemeshRequest request;
    request.base = slab_of_bone();
    request.solids = {&burr};
    request.cuts = stretches_along({groove.from, groove.to});
    request.tolerance = 1e-6;
    bone::RemeshResult result;
    GrooveSurface made;
    made.step_ms = 1e-3 * clock([&] { result = exact(request); });
    made.flaw = result.status == KERF_OK ? bone::flaw_of_result(request, result.mesh) : result.message;
    if (result.status != KERF_OK) return made;
    made.removed = bone::signed_volume_of(request.base.mesh) - bone::signed_volume_of(result.mesh.mesh);
    measure_walls(groove, result.mesh, made);
    return made;
}

GrooveSurface surface_by_field(const Groove& groove, double spacing, double feed, const Clock& clock) {
    ExactBone bone;
    const Vec3 half = 0.5 * slab_size;
    bone.surface = [half](Vec3 p) {
        return std::max({std::abs(p.x) - half.x, std::abs(p.y) - half.y, std::abs(p.z + half.z) - half.z});
    };
    bone.tissues = {{"bone", 1850.0, {}}};
    bone.low = {-half.x, -half.y, -slab_size.z};
    bone.high = {half.x, half.y, 0.0};
    const Body body = body_of(bone, spacing, {0.3, 0.1, 0.7});
    const ToolSolid burr = ball_burr(groove.radius);
    const auto steps = in_steps(groove.from, groove.to, feed);
    CutField cut(body, 0);
    Mesh surface;
    const double time = clock([&] {
        for (const bone::CutStretch& step : steps) {
            CutRecord record;
            record.from = step.from;
            record.to = step.to;
            cut.stamp(record, burr);
        }
        surface = bone_surface(body, cut);
    });
    GrooveSurface made;
    made.removed = bone_volume(body, CutField(body, 0)) - bone_volume(body, cut);
    made.step_ms = 1e-3 * time / static_cast<double>(steps.size());
    bone::TaggedMesh mesh;
    mesh.mesh.vertices = surface.vertices;
    mesh.mesh.triangles.assign(surface.triangles.begin(), surface.triangles.end());
    const double deep = -0.5 * groove.depth();
    for (const bone::Triangle& t : mesh.mesh.triangles) {
        const auto corners = mesh.mesh.corners(t);
        const bool is_wall = std::all_of(corners.begin(), corners.end(), [&](Vec3 p) {
            return p.z < deep && p.z > -2.0 * groove.depth() && std::abs(p.y - groove.to.y) < groove.radius &&
                   p.x > -half.x + spacing && p.x < groove.to.x + groove.radius;
        });
        mesh.tags.push_back(is_wall ? KERF_FACE_WALL : KERF_FACE_SURFACE);
    }
    measure_walls(groove, mesh, made);
    return made;
}

}  // namespace kerf::chart
