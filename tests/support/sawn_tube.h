// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "bone/remesh/cut_path.h"
#include "bone/surface/surface_mesh.h"
#include "kerf/units.hpp"

/// A bone of any number of triangles, and a blade's ways through it.
namespace kerf::test {

/// A closed bent tube like a jaw, about 100 mm long and 18 mm thick, with bumps; about `triangles` faces.
inline bone::SurfaceMesh bent_bone(double triangles) {
    using namespace literals;
    // As many rings as make square quads: 100 mm along, 57 mm around.
    const auto around =
        static_cast<std::uint32_t>(std::max(8.0, std::round(std::sqrt(triangles / 2.0 * 57.0 / 100.0))));
    const auto along = static_cast<std::uint32_t>(std::max(8.0, std::round(triangles / 2.0 / around)));
    bone::SurfaceMesh mesh;
    for (std::uint32_t j = 0; j <= along; ++j)
        for (std::uint32_t i = 0; i < around; ++i) {
            const double turn = 2.0 * std::numbers::pi * (i + 0.37 * j) / around, way = static_cast<double>(j) / along;
            const double thick = 9.0_mm + 0.7_mm * std::sin(3.0 * turn + 9.0 * way) * std::cos(14.0 * way + turn);
            const double bend = 25.0_mm * (way - 0.5) * (way - 0.5);
            mesh.vertices.push_back({100.0_mm * (way - 0.5), thick * std::cos(turn) + bend, thick * std::sin(turn)});
        }
    const auto at = [&](std::uint32_t i, std::uint32_t j) { return j * around + i % around; };
    for (std::uint32_t j = 0; j < along; ++j)
        for (std::uint32_t i = 0; i < around; ++i)
            mesh.triangles.insert(mesh.triangles.end(), {bone::Triangle{at(i, j), at(i + 1, j + 1), at(i + 1, j)},
                                                         {at(i, j), at(i, j + 1), at(i + 1, j + 1)}});
    const auto low = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back({-50.0_mm, 6.25_mm, 0});
    mesh.vertices.push_back({50.0_mm, 6.25_mm, 0});
    for (std::uint32_t i = 0; i < around; ++i)
        mesh.triangles.insert(mesh.triangles.end(),
                              {bone::Triangle{low, at(i, 0), at(i + 1, 0)}, {low + 1, at(i + 1, along), at(i, along)}});
    if (bone::signed_volume_of(mesh) < 0.0)
        for (bone::Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
}

/// A blade 34 mm wide, wider than the bone, that leaves a slot of 0.4 mm. Its front is slightly bowed.
inline ToolSolid slot_blade() {
    using namespace literals;
    std::vector<kerf_profile_point> outline;
    for (int i = 0; i <= 5; ++i) {
        const double x = 17.0_mm * i / 5;
        outline.push_back({-x * x / 2.0_m, x});
    }
    outline.push_back({outline.back().z - 1.0_mm, 17.0_mm});
    return ToolSolid::prism(outline, 0.4_mm);
}

/// The blade's pose with its front `depth` past the bone's axis from above, where it cuts across the bone at `x`. It
/// looks down, a little turned, so that nothing is parallel to the mesh; moved along itself by `stroke`.
inline Pose blade_at(double x, double depth, double stroke = 0.0, Vec3 off = {}) {
    const Quat down = quat_between({0, 0, 1}, {0, 0, -1});
    const Quat turned = quat_from_rotation_vector({0.05, 0.08, 1.5707963 + 0.03});
    const Quat rotation = turned * down;
    const Vec3 way = rotate(rotation, {0, 0, 1}), across = rotate(rotation, {1, 0, 0});
    return {Vec3{x, 3.0e-3, 0} + depth * way + stroke * across + off, rotation};
}

/// A cut from above the bone to below it in steps of `feed`, to and fro by `stroke`.
inline std::vector<bone::CutStretch> cut_across(double x, double from, double to, double feed, double stroke) {
    std::vector<bone::CutStretch> cuts;
    const int steps = static_cast<int>(std::round((to - from) / feed));
    for (int i = 0; i < steps; ++i)
        cuts.push_back({blade_at(x, from + i * feed, i % 2 == 0 ? 0.0 : stroke),
                        blade_at(x, from + (i + 1) * feed, i % 2 == 0 ? stroke : 0.0), 0});
    return cuts;
}

}  // namespace kerf::test
