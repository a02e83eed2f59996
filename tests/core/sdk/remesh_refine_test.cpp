// SPDX-License-Identifier: Apache-2.0
#include "kerf/remesh_refine.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "kerf/units.hpp"

namespace kerf::remeshing {
namespace {

using namespace literals;
using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// A square of `cells` × `cells` cells of two faces each, in z = 0.
Triangles square(int cells, double side) {
    Triangles mesh;
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i) mesh.vertices.push_back({side * i / cells, side * j / cells, 0.0});
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            const auto a = static_cast<std::uint32_t>(j * (cells + 1) + i), b = a + 1,
                       c = a + static_cast<std::uint32_t>(cells) + 1, d = c + 1;
            mesh.triangles.insert(mesh.triangles.end(), {a, b, d, a, d, c});
            mesh.tags.insert(mesh.tags.end(), {1, 2});
        }
    return mesh;
}

std::map<Edge, int> faces_of_edges(const Triangles& mesh) {
    std::map<Edge, int> count;
    for (std::size_t f = 0; f < mesh.tags.size(); ++f)
        for (std::size_t side = 0; side < 3; ++side) {
            const std::uint32_t a = mesh.triangles[3 * f + side], b = mesh.triangles[3 * f + (side + 1) % 3];
            ++count[{std::min(a, b), std::max(a, b)}];
        }
    return count;
}

double area_of(const Triangles& mesh) {
    double area = 0.0;
    for (std::size_t f = 0; f < mesh.tags.size(); ++f) {
        const std::uint32_t* t = &mesh.triangles[3 * f];
        const Vec3 a = mesh.vertices[t[0]];
        area += 0.5 * cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a).z;  // < 0 for a face that turned over
    }
    return area;
}

double min_angle_of(const Triangles& mesh) {
    double least = 4.0;
    for (std::size_t f = 0; f < mesh.tags.size(); ++f)
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t* t = &mesh.triangles[3 * f];
            const Vec3 at = mesh.vertices[t[corner]], u = mesh.vertices[t[(corner + 1) % 3]] - at,
                       v = mesh.vertices[t[(corner + 2) % 3]] - at;
            least = std::min(least, std::atan2(length(cross(u, v)), dot(u, v)));
        }
    return least;
}

TEST(SplitLongEdges, LeavesNoneNearThePlace) {
    constexpr double side = 10.0_mm;
    Triangles mesh = square(2, side);
    const Vec3 place{3.0_mm, 4.0_mm, 0.0};
    const auto is_near = [&](Vec3 middle, double span) { return length(middle - place) < 1.0_mm + 0.5 * span; };
    split_long_edges(mesh, {}, 0.3_mm, is_near);
    for (const auto& [edge, faces] : faces_of_edges(mesh)) {
        const Vec3 from = mesh.vertices[edge.first], to = mesh.vertices[edge.second];
        EXPECT_TRUE(length(to - from) <= 0.3_mm || !is_near(0.5 * (from + to), length(to - from)));
        const bool is_border = std::max(from.x, to.x) == 0.0 || std::min(from.x, to.x) == side ||
                               std::max(from.y, to.y) == 0.0 || std::min(from.y, to.y) == side;
        EXPECT_EQ(faces, is_border ? 1 : 2) << "no vertex lies within an edge";
    }
    EXPECT_NEAR(area_of(mesh), side * side, 1e-15);
    EXPECT_GT(min_angle_of(mesh), 0.39) << "half of the least angle before, 45 degrees";
    EXPECT_LT(mesh.tags.size(), 4000u) << "it stays coarse elsewhere";
}

// A long edge that must stay whole bounds how far its faces are split: else their halves would be split for ever.
TEST(SplitLongEdges, EndsBesideALockedBorder) {
    constexpr double side = 10.0_mm;
    Triangles mesh = square(3, side);
    const std::vector<Vec3> before = mesh.vertices;
    std::vector<std::uint8_t> locked;
    for (const Vec3 v : mesh.vertices) locked.push_back(v.x == 0.0 || v.y == 0.0 || v.x == side || v.y == side);
    const auto border = [&] {
        std::vector<Edge> edges;
        for (const auto& [edge, faces] : faces_of_edges(mesh))
            if (faces == 1) edges.push_back(edge);
        return edges;
    };
    const std::vector<Edge> border_before = border();
    split_long_edges(mesh, locked, 0.1_mm, [](Vec3, double) { return true; });
    EXPECT_EQ(border(), border_before);
    for (std::size_t v = 0; v < before.size(); ++v) EXPECT_EQ(length(mesh.vertices[v] - before[v]), 0.0);
    EXPECT_NEAR(area_of(mesh), side * side, 1e-15);
}

// Near in the middle of one edge only, while the faces have longer ones that are not.
TEST(SplitLongEdges, EndsWhereOnlyOnePlaceIsNear) {
    for (const double reach : {0.05_mm, 0.4_mm, 1.3_mm}) {
        Triangles mesh = square(1, 10.0_mm);
        mesh.vertices[2].y = mesh.vertices[3].y = 1.0_mm;  // long, thin faces
        const double area = area_of(mesh);
        split_long_edges(mesh, {}, 0.1_mm, [&](Vec3 middle, double) {
            return length(middle - Vec3{0.0, 0.5_mm, 0.0}) < reach;
        });
        EXPECT_LT(mesh.tags.size(), 20000u);
        EXPECT_GT(mesh.tags.size(), 2u);
        EXPECT_NEAR(area_of(mesh), area, 1e-15);
        for (const auto& [edge, faces] : faces_of_edges(mesh)) EXPECT_LE(faces, 2);
    }
}

}  // namespace
}  // namespace kerf::remeshing
