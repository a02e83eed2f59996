// SPDX-License-Identifier: Apache-2.0
#include "conformance/strategy_scenes.h"

#include <cmath>
#include <cstddef>
#include <numbers>

#include "bone/remesh/growing_surface.h"
#include "bone/remesh/swept_before.h"
#include "kerf/units.hpp"

namespace kerf::conformance {

using namespace literals;

namespace {

constexpr double pi = std::numbers::pi;

/// A box of bone with its top in z = 0, 12 × 8 × 5 mm, each face a grid of squares in two triangles.
bone::SurfaceMesh slab() {
    constexpr int steps[3] = {12, 8, 5};  // of a millimetre
    bone::SurfaceMesh mesh;
    std::vector<int> numbers(13 * 9 * 6, -1);
    const auto corner = [&](int x, int y, int z) {
        int& number = numbers[static_cast<std::size_t>((z * 9 + y) * 13 + x)];
        if (number < 0) {
            number = static_cast<int>(mesh.vertices.size());
            // A little askew, so that no cut runs along an edge.
            mesh.vertices.push_back({1e-3 * (x - 6.0 + 0.013), 1e-3 * (y - 4.0 + 0.017), 1e-3 * (z - 5.0)});
        }
        return static_cast<std::uint32_t>(number);
    };
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
    };
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (const int end : {0, steps[axis]})
            for (int i = 0; i < steps[u]; ++i)
                for (int j = 0; j < steps[v]; ++j) {
                    const auto at = [&](int du, int dv) {
                        int place[3] = {};
                        place[axis] = end;
                        place[u] = i + du;
                        place[v] = j + dv;
                        return corner(place[0], place[1], place[2]);
                    };
                    if (end == 0)
                        add(at(0, 0), at(0, 1), at(1, 1), at(1, 0));
                    else
                        add(at(0, 0), at(1, 0), at(1, 1), at(0, 1));
                }
    }
    return mesh;
}

/// A ball with its tip at the origin of the tool, as a burr's head.
ToolSolid ball(double radius) {
    constexpr int pieces = 96;
    std::vector<kerf_profile_point> outline;
    for (int i = 0; i <= pieces; ++i) {
        const double angle = pi * i / pieces;
        outline.push_back({radius * (std::cos(angle) - 1.0), i == 0 || i == pieces ? 0.0 : radius * std::sin(angle)});
    }
    return ToolSolid(outline);
}

/// The tool points down, its tip at a point.
Pose down(double x, double y, double z) { return {{x, y, z}, {0.0, 1.0, 0.0, 0.0}}; }

/// A ball of radius r whose tip moves from −half to half along x, at a depth h ≤ r below the top.
///
///     V = 2 half A + π h² (r − h/3),  A = r² acos(1 − h/r) − (r − h) √(2 r h − h²)
RemeshScene groove(const std::string& name, double r, double h, double half) {
    const double area = r * r * std::acos(1.0 - h / r) - (r - h) * std::sqrt(2.0 * r * h - h * h);
    return {name,
            ball(r),
            {down(-half, 0.0, -h), down(half, 0.0, -h), 0},
            2.0 * half * area + pi * h * h * (r - h / 3.0),
            2.0 * half * 2.0 * r * std::acos(1.0 - h / r) + 2.0 * pi * r * h};
}

std::vector<RemeshScene> make_scenes() {
    std::vector<RemeshScene> scenes;
    scenes.push_back(groove("a groove 0.6 mm deep by a ball of 4 mm", 2.0_mm, 0.6_mm, 2.0_mm));
    scenes.push_back(groove("a groove 1.6 mm deep by a ball of 4 mm", 2.0_mm, 1.6_mm, 1.0_mm));
    {
        // A cylinder of radius r with a flat end: V = π r² h.
        constexpr double r = 1.5_mm, h = 3.0_mm;
        const ToolSolid drill({{0.0, 0.0}, {-1e-6, r}, {-20.0_mm, r}});
        scenes.push_back({"a hole 3 mm deep by a flat drill of 3 mm",
                          drill,
                          {down(0.3_mm, 0.2_mm, 1.0_mm), down(0.3_mm, 0.2_mm, -h), 0},
                          pi * r * r * h,
                          pi * r * r + 2.0 * pi * r * h});
    }
    {
        // A blade of width 2 w and kerf k: V = 2 w k h.
        constexpr double w = 4.0_mm, k = 1.0_mm, h = 2.0_mm;
        const ToolSolid blade = ToolSolid::prism({{0.0, w}, {-20.0_mm, w}}, k);
        scenes.push_back({"a slot 2 mm deep by a blade of 1 mm",
                          blade,
                          {down(0.0, 0.0, 1.0_mm), down(0.0, 0.0, -h), 0},
                          2.0 * w * k * h,
                          2.0 * w * k + 2.0 * h * (2.0 * w + k)});
    }
    {
        // A tube of radii r and b: V = π (r² − b²) h. The core stays.
        constexpr double r = 2.5_mm, b = 1.7_mm, h = 2.0_mm;
        const ToolSolid tube = ToolSolid::hollow({{0.0, r}, {-20.0_mm, r}}, b);
        scenes.push_back({"a ring 2 mm deep by a tube of 5 mm",
                          tube,
                          {down(0.1_mm, 0.2_mm, 1.0_mm), down(0.1_mm, 0.2_mm, -h), 0},
                          pi * (r * r - b * b) * h,
                          pi * (r * r - b * b) + 2.0 * pi * (r + b) * h});
    }
    scenes.push_back({"a pass 0.5 mm above the bone",
                      ball(2.0_mm),
                      {down(-1.0_mm, 0.0, 0.5_mm), down(1.0_mm, 0.0, 0.5_mm), 0},
                      0.0,
                      0.0});
    return scenes;
}

}  // namespace

const std::vector<RemeshScene>& remesh_scenes() {
    static const std::vector<RemeshScene> scenes = make_scenes();
    return scenes;
}

RemeshTask task_of(const RemeshScene& scene, std::uint32_t scope, double tolerance) {
    static const bone::TaggedMesh bone = bone::tagged(slab());
    RemeshTask task;
    task.request.solids = {&scene.solid};
    task.request.cuts = {scene.cut};
    task.request.mode = KERF_REMESH_COMMIT;
    task.request.tolerance = tolerance;
    task.request.base = bone;
    if (scope == KERF_REMESH_WHOLE) return task;
    const bone::GrowingSurface surface(bone);
    Box box = bone::swept_box(scene.solid, scene.cut);
    if (scene.is_in_air()) box.low.z -= 1.0_mm;  // the faces below it
    const bone::SurfacePatch patch = surface.patch_in(box);
    task.request.base = patch.mesh;
    task.request.locked = patch.locked;
    task.ring = surface.ring_of(patch);
    return task;
}

}  // namespace kerf::conformance
