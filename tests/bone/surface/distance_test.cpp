// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "bone/surface/crossings.h"
#include "bone/surface/orient3d.h"
#include "bone/surface/signed_distance.h"
#include "bone/surface/thickness.h"
#include "kerf/units.hpp"
#include "tests/bone/surface/shapes.h"

namespace kerf::bone {
namespace {

using namespace literals;
using test::cube, test::sphere, test::together, test::turned;

std::vector<Vec3> scattered(double half_edge, int count) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> any(-half_edge, half_edge);
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) points.push_back({any(random), any(random), any(random)});
    return points;
}

// ---- predicates
// ------------------------------------------------------------------------------------------------------

TEST(Orient3d, TellsTheSidesOfAPlane) {
    EXPECT_EQ(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, -1}), 1);
    EXPECT_EQ(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1}), -1);
    EXPECT_EQ(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {7, -3, 0}), 0);
}
TEST(Orient3d, IsExactWhereRoundingWouldDecide) {
    // The plane x + y + z = 3 through points with one bit each, and neighbours of a point on it
    const Vec3 a{3, 0, 0}, b{0, 3, 0}, c{0, 0, 3};
    for (const double x : {0.1, 0.7, 1.3, 2.9})
        for (const double y : {0.01, 0.3, 1e-5}) {
            const double s = 0x1p-30 * std::floor(x * 0x1p30), t = 0x1p-30 * std::floor(y * 0x1p30), on = 3.0 - s - t;
            ASSERT_EQ(orient3d(a, b, c, {s, t, on}), 0);
            EXPECT_EQ(orient3d(a, b, c, {s, t, std::nextafter(on, 10.0)}), -1);
            EXPECT_EQ(orient3d(a, b, c, {s, t, std::nextafter(on, -10.0)}), 1);
        }
}
TEST(Orient3d, TurnsItsSignWithTwoPoints) {
    const auto points = scattered(1.0, 40);
    for (std::size_t i = 0; i + 3 < points.size(); ++i) {
        const Vec3 a = points[i], b = points[i + 1], c = points[i + 2], d = points[i + 3];
        EXPECT_EQ(orient3d(a, b, c, d), -orient3d(b, a, c, d));
        EXPECT_EQ(orient3d(a, b, c, d), orient3d(b, c, a, d));
        EXPECT_EQ(orient3d(a, b, c, 0.25 * (a + b) + 0.5 * c), orient3d(a, b, c, 0.25 * (a + b) + 0.5 * c));
    }
}

// ---- distance
// --------------------------------------------------------------------------------------------------------

TEST(SignedDistance, IsThatOfACube) {
    const SurfaceMesh mesh = cube(10.0_mm);
    const TriangleTree tree(mesh);
    SignedDistance distance(tree);
    EXPECT_NEAR(distance({0, 0, 0}), -5.0_mm, 1e-15);
    EXPECT_NEAR(distance({4.0_mm, 0, 0}), -1.0_mm, 1e-15);
    EXPECT_NEAR(distance({7.0_mm, 1.0_mm, 1.0_mm}), 2.0_mm, 1e-15);  // a face
    EXPECT_NEAR(distance({8.0_mm, 9.0_mm, 1.0_mm}), 5.0_mm, 1e-15);  // an edge: 3, 4
    EXPECT_NEAR(distance({6.0_mm, 7.0_mm, 7.0_mm}), 3.0_mm, 1e-15);  // a corner: 1, 2, 2
    EXPECT_NEAR(distance({5.0_mm, 0.3_mm, 0.3_mm}), 0.0, 1e-15);
}

TEST(SignedDistance, IsThatOfEveryTriangleTriedInTurn) {
    const SurfaceMesh mesh = together(sphere(8.0_mm, 3), turned(sphere(5.0_mm, 2)));
    const TriangleTree tree(mesh);
    SignedDistance distance(tree);
    for (const Vec3 p : scattered(11.0_mm, 2000)) {
        double least = HUGE_VAL;
        for (const Triangle& t : mesh.triangles) {
            const auto [a, b, c] = mesh.corners(t);
            least = std::min(least, distance_to_triangle(p, a, b, c));
        }
        const bool is_inside = tree.exact_winding(p) > 0.5;
        ASSERT_NEAR(distance(p), is_inside ? -least : least, 1e-12);
        ASSERT_EQ(distance(p), SignedDistance(tree)(p)) << "what was asked before must not matter";
    }
}

TEST(SignedDistance, OfASphereIsThatOfASphereToTheDepthOfItsFaces) {
    // Chords of 1/32 of a quarter circle stand 1 − cos(π/128) = 0.03 % from the circle; a face's middle, about twice
    // that
    const SurfaceMesh mesh = sphere(10.0_mm, 5);
    const TriangleTree tree(mesh);
    SignedDistance distance(tree);
    for (const Vec3 p : scattered(12.0_mm, 2000)) {
        const double exact = length(p) - 10.0_mm;
        EXPECT_LE(distance(p), std::abs(exact) + 0.01_mm);
        EXPECT_NEAR(distance(p), exact, 0.01_mm);
    }
}

TEST(SignedDistance, TurnsMovesAndMirrorsWithTheSurface) {
    const SurfaceMesh mesh = together(sphere(8.0_mm, 2, {1.0_mm, 2.0_mm, 0.5_mm}), cube(3.0_mm, {12.0_mm, 0, 0}));
    const Pose pose{{0.1, -0.2, 0.3}, quat_from_rotation_vector({0.4, -1.0, 0.7})};
    SurfaceMesh moved = mesh, mirrored = turned(mesh);
    for (Vec3& v : moved.vertices) v = pose * v;
    for (Vec3& v : mirrored.vertices) v.x = -v.x;
    const TriangleTree tree(mesh), moved_tree(moved), mirrored_tree(mirrored);
    SignedDistance distance(tree), after(moved_tree), in_mirror(mirrored_tree);
    for (const Vec3 p : scattered(15.0_mm, 500)) {
        EXPECT_NEAR(after(pose * p), distance(p), 1e-14);
        EXPECT_NEAR(in_mirror({-p.x, p.y, p.z}), distance(p), 1e-15);
    }
}

TEST(SignedDistance, DoesNotMindFacesWithoutArea) {
    // A needle and a face that is a point, on an edge of the cube
    SurfaceMesh mesh = cube(10.0_mm);
    mesh.vertices.push_back(0.5 * (mesh.vertices[0] + mesh.vertices[1]));
    mesh.triangles.push_back({0, 1, 8});
    mesh.triangles.push_back({8, 1, 0});
    mesh.triangles.push_back({8, 8, 8});
    const TriangleTree tree(mesh), plain(cube(10.0_mm));
    SignedDistance distance(tree), without(plain);
    for (const Vec3 p : scattered(9.0_mm, 2000)) ASSERT_NEAR(distance(p), without(p), 1e-15);
}

TEST(TriangleTree, WindsOnceInsideTwiceWhereTwoOverlapAndMinusOnceInsideOut) {
    const TriangleTree overlapping(together(sphere(5.0_mm, 3), sphere(5.0_mm, 3, {4.0_mm, 0, 0})));
    EXPECT_NEAR(overlapping.winding({-3.0_mm, 0, 0}), 1.0, 0.05);
    EXPECT_NEAR(overlapping.winding({2.0_mm, 0, 0}), 2.0, 0.05);
    EXPECT_NEAR(overlapping.winding({-6.0_mm, 0, 0}), 0.0, 0.05);
    EXPECT_NEAR(TriangleTree(turned(sphere(5.0_mm, 3))).winding({0, 0, 0}), -1.0, 0.05);
}
TEST(TriangleTree, QuickWindingIsWithinAQuarterOfTheExactOne) {
    // Two walls that lie close and look away from each other: the worst for dipoles
    const TriangleTree tree(together(sphere(8.0_mm, 4), turned(sphere(6.0_mm, 4))));
    double worst = 0.0;
    for (const Vec3 p : scattered(10.0_mm, 500))
        worst = std::max(worst, std::abs(tree.winding(p) - tree.exact_winding(p)));
    EXPECT_LT(worst, 0.25);
}

// ---- crossings
// -------------------------------------------------------------------------------------------------------

std::size_t crossings_in(const SurfaceMesh& mesh) { return crossings_of(mesh, TriangleTree(mesh)).size(); }

TEST(Crossings, AreNoneOnSoundSurfaces) {
    EXPECT_EQ(crossings_in(cube(10.0_mm)), 0u);
    EXPECT_EQ(crossings_in(sphere(10.0_mm, 4)), 0u);
    EXPECT_EQ(crossings_in(together(cube(2.0_mm), turned(cube(1.0_mm)))), 0u);
}
TEST(Crossings, AreThoseThatTryingAllPairsFinds) {
    const SurfaceMesh mesh = together(sphere(5.0_mm, 2), sphere(5.0_mm, 2, {3.1_mm, 0.7_mm, 0.3_mm}));
    std::size_t brute = 0;
    for (std::uint32_t s = 0; s < mesh.triangles.size(); ++s)
        for (std::uint32_t t = s + 1; t < mesh.triangles.size(); ++t) {
            const SurfaceMesh pair{mesh.vertices, {mesh.triangles[s], mesh.triangles[t]}};
            brute += crossings_in(pair);
        }
    EXPECT_GT(brute, 20u);
    EXPECT_EQ(crossings_in(mesh), brute);
}
TEST(Crossings, SeeTouchingFoldedAndFlatOverlaps) {
    const std::vector<Vec3> base{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const auto with = [&](std::vector<Vec3> more, Triangle face) {
        SurfaceMesh mesh{base, {{0, 1, 2}}};
        mesh.vertices.insert(mesh.vertices.end(), more.begin(), more.end());
        mesh.triangles.push_back(face);
        return crossings_in(mesh);
    };
    EXPECT_EQ(with({{0.2, 0.2, -1}, {0.2, 0.2, 1}, {5, 5, 1}}, {3, 4, 5}), 1u) << "through the middle";
    EXPECT_EQ(with({{0.2, 0.2, 0}, {0.2, 0.2, 1}, {0.4, 0.2, 1}}, {3, 4, 5}), 1u) << "a corner on the face";
    EXPECT_EQ(with({{0.2, 0.2, 1e-9}, {0.2, 0.2, 1}, {0.4, 0.2, 1}}, {3, 4, 5}), 0u) << "a nanometre above it";
    EXPECT_EQ(with({{0.1, 0.1, 0}, {0.3, 0.1, 0}, {0.1, 0.3, 0}}, {3, 4, 5}), 1u) << "lying within";
    EXPECT_EQ(with({{2, 2, 0}, {3, 2, 0}, {2, 3, 0}}, {3, 4, 5}), 0u) << "beside it in the same plane";
    EXPECT_EQ(with({{1, 1, 0}}, {2, 1, 3}), 0u) << "a square";
    EXPECT_EQ(with({{0.2, 0.2, 0}}, {2, 1, 3}), 1u) << "folded flat onto it";
    EXPECT_EQ(with({{1, 0, 1}, {1, 1, 1}}, {0, 3, 4}), 0u) << "sharing a corner";
    EXPECT_EQ(with({{0.5, 0.1, -1}, {0.5, 0.2, 1}}, {0, 3, 4}), 1u) << "sharing a corner and going through";
}

// ---- thickness
// -------------------------------------------------------------------------------------------------------

constexpr Box everywhere{{-1, -1, -1}, {1, 1, 1}};

TEST(Thickness, OfACubeIsItsEdge) {
    const SurfaceMesh mesh = cube(10.0_mm);
    const auto walls = measure_walls(mesh, TriangleTree(mesh), everywhere, 1.0_mm);
    ASSERT_TRUE(thinnest(walls));
    EXPECT_NEAR(thinnest(walls)->thickness, 10.0_mm, 1e-12);
    EXPECT_NEAR(thickness_at(walls, 1.0), 10.0_mm, 1e-12);
    double area = 0.0;
    for (const auto& wall : walls) area += wall.area;
    EXPECT_NEAR(area, 600e-6, 1e-12);
}
TEST(Thickness, OfAShellIsTheWayToTheCavity) {
    const SurfaceMesh mesh = together(sphere(10.0_mm, 4), turned(sphere(9.0_mm, 4)));
    const auto walls = measure_walls(mesh, TriangleTree(mesh), everywhere, 0.5_mm);
    EXPECT_NEAR(thinnest(walls)->thickness, 1.0_mm, 0.05_mm /* the depth of the faces */);
    EXPECT_NEAR(thickness_at(walls, 0.5), 1.0_mm, 0.05_mm);
    EXPECT_NEAR(fraction_under(walls, 1.1_mm), 1.0, 0.01);
    EXPECT_EQ(fraction_under(walls, 0.9_mm), 0.0);
}
TEST(Thickness, LooksOnlyIntoTheRegion) {
    const SurfaceMesh mesh = together(cube(10.0_mm), cube(2.0_mm, {20.0_mm, 0, 0}));
    const TriangleTree tree(mesh);
    EXPECT_NEAR(thinnest(measure_walls(mesh, tree, everywhere, 1.0_mm))->thickness, 2.0_mm, 1e-12);
    EXPECT_NEAR(thinnest(measure_walls(mesh, tree, {{-0.01, -0.01, -0.01}, {0.01, 0.01, 0.01}}, 1.0_mm))->thickness,
                10.0_mm, 1e-12);
}
TEST(Thickness, DoesNotTakeACrestForAWall) {
    // A roof of 90° with eaves of 45°; only its two gables are walls, 20 mm apart
    SurfaceMesh roof;
    roof.vertices = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, 0, 1}, {1, 0, 1}};
    for (Vec3& v : roof.vertices) v = 10.0_mm * v;
    roof.triangles = {{0, 3, 2}, {0, 2, 1}, {0, 1, 5}, {0, 5, 4}, {2, 3, 4}, {2, 4, 5}, {0, 4, 3}, {1, 2, 5}};
    ASSERT_NEAR(signed_volume_of(roof), 2e-6, 1e-12);
    const auto walls = measure_walls(roof, TriangleTree(roof), everywhere, 0.5_mm);
    EXPECT_NEAR(thinnest(walls)->thickness, 20.0_mm, 1e-12);
}

}  // namespace
}  // namespace kerf::bone
