// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "bone/surface/surface_mesh.h"
#include "kerf/units.hpp"

/// Bone with one slanted wall.
namespace kerf::test {

inline constexpr double wedge_angle = 50.0 / 180.0 * pi;
/// A wedge from the face x = 0 to a face that leans by `wedge_angle`, 8 mm thick at y = 0.
inline double wedge_distance(Vec3 p) {
    using namespace literals;
    const double slanted = (p.x - 8.0_mm) * std::cos(wedge_angle) + p.y * std::sin(wedge_angle);
    return std::max({-p.x, slanted, std::abs(p.y) - 5.0_mm, std::abs(p.z) - 5.0_mm});
}

/// The wedge of triangles, 10 mm wide and long.
inline bone::SurfaceMesh wedge_mesh() {
    const double t = std::tan(wedge_angle);
    using namespace literals;
    const double low = 8.0_mm + 5.0_mm * t, high = 8.0_mm - 5.0_mm * t;
    bone::SurfaceMesh mesh;
    for (const double z : {-5.0_mm, 5.0_mm})
        for (const Vec3 p : {Vec3{0, -5.0_mm, z}, Vec3{low, -5.0_mm, z}, Vec3{high, 5.0_mm, z}, Vec3{0, 5.0_mm, z}})
            mesh.vertices.push_back(p);
    const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
    };
    quad(3, 2, 1, 0);
    quad(4, 5, 6, 7);
    quad(0, 1, 5, 4);
    quad(1, 2, 6, 5);
    quad(2, 3, 7, 6);
    quad(3, 0, 4, 7);
    return mesh;
}

}  // namespace kerf::test
