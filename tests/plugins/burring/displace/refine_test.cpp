// SPDX-License-Identifier: Apache-2.0
#include "plugins/burring/displace/refine.h"

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
using burring::displacement::refine;
using burring::displacement::Triangles;
using test::mesh_of, test::triangles_of;

double longest_of(const Triangles& mesh, std::size_t f) {
    const Vec3 a = mesh.vertices[mesh.triangles[3 * f]], b = mesh.vertices[mesh.triangles[3 * f + 1]],
               c = mesh.vertices[mesh.triangles[3 * f + 2]];
    return std::max({length(b - a), length(c - b), length(a - c)});
}
Vec3 halfway(Vec3 a, Vec3 b) { return 0.5 * (a + b); }

/// Faces near a corner of the cube, down to `least` [m].
auto near_a_corner(double least) {
    return [least](const Triangles& mesh, std::uint32_t f, double longest) {
        const Vec3 corner{5.0_mm, 5.0_mm, 5.0_mm};
        double nearest = HUGE_VAL;
        for (std::size_t i = 0; i < 3; ++i)
            nearest = std::min(nearest, length(mesh.vertices[mesh.triangles[3 * f + i]] - corner));
        return longest > least && nearest < 1.0_mm;
    };
}

TEST(Refine, SplitsOneFaceInFourAndHalvesItsNeighbours) {
    Triangles mesh = triangles_of(test::sphere(5.0_mm, 0));
    ASSERT_TRUE(refine(
        mesh, [](const Triangles&, std::uint32_t f, double) { return f == 0; }, halfway, 1000));
    EXPECT_EQ(mesh.tags.size(), 7U + 4U + 3U);  // 8 faces: one becomes 4, three become 2
    EXPECT_EQ(mesh.vertices.size(), 6U + 3U);
    EXPECT_EQ(bone::flaw_of_base(mesh_of(mesh)), "");
}

TEST(Refine, KeepsVolumeAreaAndOldVertices) {
    const bone::SurfaceMesh cube = test::cube(10.0_mm);
    Triangles mesh = triangles_of(cube);
    ASSERT_TRUE(refine(mesh, near_a_corner(0.2_mm), halfway, 100'000));
    EXPECT_GT(mesh.tags.size(), 500U);
    EXPECT_EQ(bone::flaw_of_base(mesh_of(mesh)), "") << "conforming";
    EXPECT_NEAR(bone::signed_volume_of(mesh_of(mesh)), 1e-6, 1e-17);
    EXPECT_NEAR(bone::area_of(mesh_of(mesh)), 6e-4, 1e-14);
    for (std::size_t v = 0; v < cube.vertices.size(); ++v) EXPECT_TRUE(mesh.vertices[v] == cube.vertices[v]);
}

TEST(Refine, MakesNoAngleSmallerThanOneHalving) {
    Triangles mesh = triangles_of(test::cube(10.0_mm));
    ASSERT_TRUE(refine(mesh, near_a_corner(0.05_mm), halfway, 100'000));
    double least = HUGE_VAL;
    for (std::size_t f = 0; f < mesh.tags.size(); ++f)
        for (std::size_t i = 0; i < 3; ++i) {
            const auto at = [&](std::size_t n) { return mesh.vertices[mesh.triangles[3 * f + n % 3]]; };
            const Vec3 u = at(i + 1) - at(i), v = at(i + 2) - at(i);
            least = std::min(least, std::atan2(length(cross(u, v)), dot(u, v)));
        }
    // A face of the cube has 45°; halved over a leg it has atan(1/2) − or 45° − atan(1/2) = 18.4° at least.
    EXPECT_NEAR(least, 18.435_deg, 1e-3_deg);
}

TEST(Refine, DiffersByOneLevelAtMost) {
    Triangles mesh = triangles_of(test::cube(10.0_mm));
    ASSERT_TRUE(refine(mesh, near_a_corner(0.1_mm), halfway, 100'000));
    const bone::SurfaceMesh refined = mesh_of(mesh);
    bone::for_each_edge(bone::half_edges_of(refined), [&](const bone::HalfEdge* first, const bone::HalfEdge* last) {
        ASSERT_EQ(last - first, 2);
        const double one = longest_of(mesh, first->face), two = longest_of(mesh, first[1].face);
        EXPECT_LT(std::max(one, two), 2.9 * std::min(one, two));  // a level, and a halving: 2 √2
    });
}

TEST(Refine, LeavesTheBorderAlone) {
    bone::SurfaceMesh open = test::sphere(5.0_mm, 2);
    std::erase_if(open.triangles, [&](const bone::Triangle& t) {
        const auto [a, b, c] = open.corners(t);
        return a.z + b.z + c.z < 0.0;
    });
    bone::drop_unused_vertices(open);
    Triangles mesh = triangles_of(open);
    ASSERT_TRUE(refine(
        mesh, [](const Triangles&, std::uint32_t, double longest) { return longest > 1.6_mm; }, halfway, 100'000));
    const auto border_of = [](const bone::SurfaceMesh& of) {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> border;
        bone::for_each_edge(bone::half_edges_of(of), [&](const bone::HalfEdge* first, const bone::HalfEdge* last) {
            if (last - first == 1) border.emplace_back(first->from(), first->to());
        });
        return border;
    };
    EXPECT_EQ(border_of(mesh_of(mesh)), border_of(open));
    EXPECT_NEAR(bone::area_of(mesh_of(mesh)), bone::area_of(open), 1e-12);
    EXPECT_GT(mesh.tags.size(), 2 * open.triangles.size());
}

TEST(Refine, EndsWhereThereAreTooManyFaces) {
    Triangles mesh = triangles_of(test::cube(10.0_mm));
    EXPECT_FALSE(refine(
        mesh, [](const Triangles&, std::uint32_t, double) { return true; }, halfway, 5000));
}

}  // namespace
}  // namespace kerf
