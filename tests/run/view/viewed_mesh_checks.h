// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "kerf/math.hpp"
#include "run/view/viewed_run.h"

/// Facts of a mesh that a viewer draws.
namespace kerf::test {

inline Vec3 vector_of(const std::array<float, 3>& p) {
    return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}
inline std::array<Vec3, 3> corners_of(const run::ViewedMesh& mesh, std::size_t triangle) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    return {vector_of(mesh.positions[a]), vector_of(mesh.positions[b]), vector_of(mesh.positions[c])};
}

/// By the divergence theorem; positive when the triangles run anticlockwise seen from outside.
inline double volume(const run::ViewedMesh& mesh) {
    double sum = 0.0;
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        const auto [a, b, c] = corners_of(mesh, n);
        sum += dot(a, cross(b, c)) / 6.0;
    }
    return sum;
}
inline double area(const run::ViewedMesh& mesh) {
    double sum = 0.0;
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        const auto [a, b, c] = corners_of(mesh, n);
        sum += 0.5 * length(cross(b - a, c - a));
    }
    return sum;
}

/// Returns the number of edges, by the position of their ends, that triangles do not run along equally often in both
/// directions.
inline int open_edges(const run::ViewedMesh& mesh) {
    using Point = std::array<float, 3>;
    std::vector<Point> points = mesh.positions;
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    const auto index = [&](std::uint32_t at) {
        return std::lower_bound(points.begin(), points.end(), mesh.positions[at]) - points.begin();
    };
    std::map<std::pair<std::ptrdiff_t, std::ptrdiff_t>, int> runs;
    for (const auto& triangle : mesh.triangles)
        for (std::size_t m = 0; m < 3; ++m) {
            const auto a = index(triangle[m]), b = index(triangle[(m + 1) % 3]);
            runs[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    return static_cast<int>(std::count_if(runs.begin(), runs.end(), [](const auto& run) { return run.second != 0; }));
}

/// Returns the largest difference of a normal's length from 1 [–].
inline double worst_length(const run::ViewedMesh& mesh) {
    double worst = 0.0;
    for (const auto& normal : mesh.normals) worst = std::max(worst, std::abs(length(vector_of(normal)) - 1.0));
    return worst;
}
/// Returns the smallest cosine between a triangle and the normals of its corners [–]: 1 for flat shading, negative if
/// a normal points inwards.
inline double worst_side(const run::ViewedMesh& mesh) {
    double worst = 1.0;
    for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
        const auto [a, b, c] = corners_of(mesh, n);
        for (const std::uint32_t corner : mesh.triangles[n])
            worst = std::min(worst, dot(normalized(cross(b - a, c - a)), vector_of(mesh.normals[corner])));
    }
    return worst;
}

}  // namespace kerf::test
