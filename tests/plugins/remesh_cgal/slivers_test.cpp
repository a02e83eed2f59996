// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugins/remesh_cgal/slivers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "bone/remesh/base_mesh.h"
#include "bone/surface/edges.h"
#include "kerf/units.hpp"
#include "tests/bone/surface/shapes.h"
#include "tests/support/flat_triangles.h"

namespace kerf {
namespace {

using namespace literals;
using remesh_cgal::Triangles;
using test::mesh_of, test::triangles_of;

double min_height(const bone::SurfaceMesh& mesh) {
    double least = HUGE_VAL;
    for (const bone::Triangle& t : mesh.triangles) {
        const auto [a, b, c] = mesh.corners(t);
        least = std::min(least, length(cross(b - a, c - a)) / std::max({length(b - a), length(c - b), length(a - c)}));
    }
    return least;
}

TEST(Slivers, LeaveASoundMeshAlone) {
    const bone::SurfaceMesh sphere = test::sphere(5.0_mm, 3);
    Triangles mesh = triangles_of(sphere);
    remesh_cgal::remove_slivers(mesh, 1e-9);
    EXPECT_EQ(mesh_of(mesh).triangles, sphere.triangles);
}

/// A cube one of whose faces has a vertex this far from the middle of its diagonal.
bone::SurfaceMesh with_needle(double off) {
    bone::SurfaceMesh mesh = test::cube(10.0_mm);
    // Faces 0 and 1 share the edge 0–3.
    const auto n = static_cast<std::uint32_t>(mesh.vertices.size());
    const Vec3 across = normalized(mesh.vertices[2] - mesh.vertices[1]);
    mesh.vertices.push_back(0.5 * (mesh.vertices[0] + mesh.vertices[3]) + off * across);
    mesh.triangles[0] = {0, 2, n};
    mesh.triangles.push_back({2, 3, n});
    mesh.triangles.push_back({0, n, 3});  // the needle
    return mesh;
}

TEST(Slivers, FlipAVertexOffItsOppositeSide) {
    const bone::SurfaceMesh needle = with_needle(1e-11);
    ASSERT_EQ(bone::flaw_of_base(needle), "");
    Triangles mesh = triangles_of(needle);
    remesh_cgal::remove_slivers(mesh, 1e-9);
    const bone::SurfaceMesh mended = mesh_of(mesh);
    EXPECT_EQ(bone::flaw_of_base(mended), "");
    EXPECT_GT(min_height(mended), 1.0_mm);
    EXPECT_NEAR(bone::signed_volume_of(mended), 1e-6, 1e-15);
}

TEST(Slivers, CollapseShortEdges) {
    bone::SurfaceMesh mesh = with_needle(2.0_mm);
    // Split the new vertex's edge to corner 2 a picometre beside the vertex.
    const std::uint32_t at = 8, n = 9;
    mesh.vertices.push_back(mesh.vertices[at] + 1e-12 * normalized(mesh.vertices[2] - mesh.vertices[at]));
    mesh.triangles[0] = {0, 2, n};
    const auto second = std::find(mesh.triangles.begin(), mesh.triangles.end(), bone::Triangle{2, 3, at});
    *second = {2, 3, n};
    mesh.triangles.push_back({0, n, at});
    mesh.triangles.push_back({n, 3, at});
    Triangles all = triangles_of(mesh);
    remesh_cgal::remove_slivers(all, 1e-9);
    EXPECT_EQ(all.vertices.size(), 9U);
    EXPECT_EQ(bone::flaw_of_base(mesh_of(all)), "");
    EXPECT_NEAR(bone::signed_volume_of(mesh_of(all)), 1e-6, 1e-15);
}

TEST(Slivers, KeepTheBorderBitForBit) {
    bone::SurfaceMesh open = test::sphere(5.0_mm, 2);
    std::erase_if(open.triangles, [&](const bone::Triangle& t) {
        const auto [a, b, c] = open.corners(t);
        return a.z + b.z + c.z < 0.0;
    });
    bone::drop_unused_vertices(open);
    // Two border vertices a tenth of a nanometre apart
    const auto loops = bone::border_loops_of(bone::half_edges_of(open));
    ASSERT_EQ(loops.size(), 1U);
    const std::uint32_t one = loops[0].vertices[0], next = loops[0].vertices[1];
    open.vertices[next] = open.vertices[one] + Vec3{1e-10, 0, 0};
    Triangles mesh = triangles_of(open);
    remesh_cgal::remove_slivers(mesh, 1e-9);
    const auto is_there = [&](Vec3 v) {
        return std::any_of(mesh.vertices.begin(), mesh.vertices.end(), [&](Vec3 w) { return v == w; });
    };
    for (const std::uint32_t v : loops[0].vertices) EXPECT_TRUE(is_there(open.vertices[v]));
}

}  // namespace
}  // namespace kerf
