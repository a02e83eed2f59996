// SPDX-License-Identifier: Apache-2.0
// Uncertainties against numbers, of points and walls off every axis.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "bone/measure/border.h"
#include "bone/measure/cut_wall.h"
#include "bone/measure/distance.h"
#include "bone/measure/field_surface.h"
#include "bone/measure/fit_plane.h"
#include "bone/measure/mesh_surface.h"
#include "bone/measure/path.h"
#include "bone/measure/thickness.h"
#include "tests/bone/measure/wedge.h"
#include "tests/support/block.h"

namespace kerf::bone {
namespace {

using namespace literals;

const Quat askew = quat_from_rotation_vector({0.4, -0.9, 0.5});

void expect_near(Vec3 is, Vec3 wanted, double tolerance = 1e-12) {
    EXPECT_NEAR(is.x, wanted.x, tolerance);
    EXPECT_NEAR(is.y, wanted.y, tolerance);
    EXPECT_NEAR(is.z, wanted.z, tolerance);
}

// ---- fits ----------------------------------------------------------------------------------------------------------

TEST(LineThrough, ReportsTheResidualPerDirectionAcross) {
    // Four points of a line of 30 mm, 1 mm off it to either side: Σd² = 4 mm², N − 2 = 2
    std::vector<Vec3> points{{-15.0_mm, 1.0_mm, 0}, {-5.0_mm, -1.0_mm, 0}, {5.0_mm, -1.0_mm, 0}, {15.0_mm, 1.0_mm, 0}};
    for (Vec3& p : points) p = rotate(askew, p);
    const auto fitted = line_through(points);
    ASSERT_TRUE(fitted);
    EXPECT_NEAR(fitted->residual, 1.0_mm, 1e-12);  // √(4 mm² / (2 · 2))
    expect_near(fitted->line.direction, rotate(askew, {1, 0, 0}), 1e-9);
}

TEST(PlaneThrough, TurnsRightHandedThroughItsFirstPoints) {
    for (const double sense : {1.0, -1.0}) {
        std::vector<Vec3> points{{0, 0, 0}, {10.0_mm, 0, 0}, {0, sense * 10.0_mm, 0}, {10.0_mm, sense * 10.0_mm, 0}};
        for (Vec3& p : points) p = rotate(askew, p);
        const auto fitted = plane_through(points);
        ASSERT_TRUE(fitted);
        expect_near(fitted->plane.normal, rotate(askew, {0, 0, sense}), 1e-9);
    }
}

TEST(MirrorPlane, ReportsTheResidualAndTheTilt) {
    // Two pairs 20 mm wide. Their middles are 1 mm to either side; their ends 2 mm to the front and to the back.
    std::vector<Vec3> left{{11.0_mm, 1.0_mm, 0}, {9.0_mm, -1.0_mm, 30.0_mm}},
        right{{-9.0_mm, -1.0_mm, 0}, {-11.0_mm, 1.0_mm, 30.0_mm}};
    for (auto* side : {&left, &right})
        for (Vec3& p : *side) p = rotate(askew, p);
    const auto fitted = mirror_plane(left, right);
    ASSERT_TRUE(fitted);
    expect_near(fitted->plane.normal, rotate(askew, {1, 0, 0}), 1e-9);
    EXPECT_NEAR(fitted->residual, std::sqrt(2.0) * 1.0_mm, 1e-12);  // Σd² = 2 mm², N − 1 = 1
    EXPECT_NEAR(fitted->tilt_uncertainty, std::sqrt(8.0) / 20.0 / std::sqrt(2.0), 1e-12);  // Σa² = 8 mm²
}

TEST(DistanceBetween, LinesAtAnAcuteAngleAreNoNearer) {
    // 3 mm apart along z, at 30° to each other
    const Line one{{1.0_mm, 2.0_mm, 0}, {1, 0, 0}}, other{{-4.0_mm, 7.0_mm, 3.0_mm}, {std::cos(30.0_deg), 0.5, 0}};
    EXPECT_NEAR(distance_between(one, other), 3.0_mm, 1e-12);
    EXPECT_NEAR(distance_between(other, one), 3.0_mm, 1e-12);
}

TEST(Path, IsAsFarAsItsNearestEnd) {
    const Path path{{{0, 0, 0}, {10.0_mm, 0, 0}, {10.0_mm, 20.0_mm, 0}}, 1.0_mm};
    EXPECT_NEAR(distance_to(path, {-3.0_mm, 4.0_mm, 0}), 5.0_mm, 1e-12);
    EXPECT_NEAR(distance_to(path, {13.0_mm, 24.0_mm, 0}), 5.0_mm, 1e-12);
    EXPECT_NEAR(distance_to(path, {7.0_mm, 11.0_mm, 4.0_mm}), 5.0_mm, 1e-12) << "from the second stretch";
}

// ---- borders -------------------------------------------------------------------------------------------------------

TEST(BorderRoughness, IsOfTheSideThatItIsSeenFrom) {
    // Smooth towards −z; towards +z a comb of ±0.2 mm
    std::vector<Vec3> points;
    for (int i = 0; i < 40; ++i) {
        const double x = (i + 0.5) * 1.0_mm;
        points.push_back({x, 0, 0});
        points.push_back({x, 0, 3.0_mm + (i % 2 == 0 ? 0.0 : 0.4_mm)});
    }
    const Path along{{{0, 0, 0}, {40.0_mm, 0, 0}}, 10.0_mm};
    const auto below = border_roughness(points, along, {{0, 1, 0}, {0, 0, -1}}, 0.0),
               above = border_roughness(points, along, {{0, 1, 0}, {0, 0, 1}}, 0.0);
    ASSERT_TRUE(below && above);
    EXPECT_NEAR(below->value, 0.0, 1e-9);
    EXPECT_NEAR(above->value, 0.2_mm, 0.002_mm);
}

TEST(BorderRoughness, IgnoresBoneOutsideItsPath) {
    std::vector<Vec3> points;
    for (int i = 0; i < 40; ++i) points.push_back({(i + 0.5) * 1.0_mm, 0, 0});
    points.push_back({20.5_mm, 0, -12.0_mm});
    const auto smooth = border_roughness(points, {{{0, 0, 0}, {40.0_mm, 0, 0}}, 10.0_mm}, {{0, 1, 0}, {0, 0, -1}}, 0.0);
    ASSERT_TRUE(smooth);
    EXPECT_NEAR(smooth->value, 0.0, 1e-9);
}

// ---- walls of a cut ------------------------------------------------------------------------------------------------

/// Points of a wall off = `off` + tilt in both directions, on a grid that is denser at one corner.
std::vector<Vec3> wall_points(double off, double per_deep, double per_aside, double step = 0.0) {
    std::vector<Vec3> points;
    for (int i = 0; i < 10; ++i)
        for (int j = 0; j <= i; ++j) {
            const double deep = i * 1.0_mm, aside = j * 1.0_mm - 4.0_mm;
            points.push_back({off + per_deep * deep + per_aside * aside + (j % 2 == 0 ? step : -step), deep, -aside});
        }
    return points;
}
const WallWindow window{.entry = {}, .along = {0, 1, 0}, .normal = {1, 0, 0}, .half_width = 20.0_mm, .depth = 20.0_mm};

TEST(CutWall, TiltedInBothDirectionsIsFlatAndHasTheirAngle) {
    const auto wall = fit_wall(wall_points(0.0, 0.3, -0.4), window, 1.0_mm);
    ASSERT_TRUE(wall);
    EXPECT_NEAR(wall->angle, std::atan(0.5), 1e-12);
    EXPECT_NEAR(wall->flatness, 0.0, 1e-12);
}

TEST(CutWall, FlatnessIsAcrossTheWall) {
    // Two planes 0.2 mm apart along the window's normal, at atan 0.75 to it: 0.16 mm across them
    std::vector<Vec3> points;
    for (int i = 0; i < 8; ++i)
        for (const double step : {-0.1_mm, 0.1_mm})
            for (const double aside : {-1.0_mm, 1.0_mm})
                points.push_back({0.75 * i * 1.0_mm + step, i * 1.0_mm, aside});
    const auto wall = fit_wall(points, window, 1.0_mm);
    ASSERT_TRUE(wall);
    EXPECT_NEAR(wall->angle, std::atan(0.75), 1e-12);
    EXPECT_NEAR(wall->flatness, 0.16_mm, 1e-12);
}

TEST(CutWall, OffsetIsThatOfTheMiddleOfTheKerf) {
    // The wall that faces the normal lies half a kerf behind the middle
    EXPECT_NEAR(fit_wall(wall_points(-0.5_mm, 0, 0), window, 1.0_mm)->offset, 0.0, 1e-12);
    EXPECT_NEAR(fit_wall(wall_points(0.3_mm, 0, 0), window, 1.0_mm)->offset, 0.8_mm, 1e-12);
    EXPECT_NEAR(fit_wall(wall_points(-1.5_mm, 0, 0), window, 1.0_mm)->offset, 1.0_mm, 1e-12);
}

// ---- thickness -----------------------------------------------------------------------------------------------------

using test::wedge_angle;

/// w of both walls of the wedge, at the cosines 1 and cos 50°, along x.
double wedge_uncertainty(double wall) { return std::hypot(wall, wall / std::cos(wedge_angle)); }

TEST(Thickness, OfAWedgeHasTheUncertaintyOfBothItsWalls) {
    Body body = test::block({-1.0_mm, -6.0_mm, -6.0_mm}, {15.0_mm, 6.0_mm, 6.0_mm}, 0.4_mm, {0.3, 0.1, 0.7});
    body.surface = LevelSet::build(body.grid(), test::wedge_distance);
    const CutField uncut(body, 0);
    const FieldSurface surface(body, uncut);
    for (const double sense : {1.0, -1.0}) {
        const auto found = thickness_at(surface, {{4.0_mm, 0, 0}, {sense, 0, 0}});
        ASSERT_TRUE(found);
        EXPECT_NEAR(found->value, 8.0_mm, 0.02_mm);
        EXPECT_NEAR(found->uncertainty, wedge_uncertainty(0.05 * 0.4_mm), 1e-7 /* its gradient is sampled */);
    }
}

TEST(Stretches, HaveTheCosineOfEitherEnd) {
    Body body = test::block({-1.0_mm, -6.0_mm, -6.0_mm}, {15.0_mm, 6.0_mm, 6.0_mm}, 0.4_mm, {0.3, 0.1, 0.7});
    body.surface = LevelSet::build(body.grid(), test::wedge_distance);
    const CutField uncut(body, 0);
    const FieldSurface surface(body, uncut);
    const auto there = surface.stretches_on({{4.0_mm, 0, 0}, {1, 0, 0}}, -0.1, 0.1),
               back = surface.stretches_on({{4.0_mm, 0, 0}, {-1, 0, 0}}, -0.1, 0.1);
    ASSERT_TRUE(there.size() == 1 && back.size() == 1);
    EXPECT_NEAR(there[0].cosine_at_begin, 1.0, 1e-4);
    EXPECT_NEAR(there[0].cosine_at_end, std::cos(wedge_angle), 1e-3);
    EXPECT_NEAR(back[0].cosine_at_begin, std::cos(wedge_angle), 1e-3);
    EXPECT_NEAR(back[0].cosine_at_end, 1.0, 1e-4);
}

TEST(Thickness, OfAWedgeOfTrianglesHasTheUncertaintyOfBothItsWalls) {
    const SurfaceMesh mesh = test::wedge_mesh();
    const MeshSurface surface(mesh, 0.1_mm);
    for (const double sense : {1.0, -1.0}) {
        const auto found = thickness_at(surface, {{1.0_mm, 0.3_mm, 0.7_mm}, {sense, 0, 0}});
        ASSERT_TRUE(found);
        EXPECT_NEAR(found->value, 8.0_mm - 0.3_mm * std::tan(wedge_angle), 1e-12);
        EXPECT_NEAR(found->uncertainty, wedge_uncertainty(0.1_mm), 1e-12);
    }
}

TEST(Stretches, OfPartsThatOverlapEndAtTheOuterWalls) {
    // A box from x = −4 to 4 mm in the wedge, whose face x = 0 is inside it
    SurfaceMesh mesh = test::wedge_mesh();
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    SurfaceMesh box = test::wedge_mesh();
    for (Vec3& p : box.vertices) p = {p.x > 0.0 ? 4.0_mm : -4.0_mm, p.y, p.z};
    mesh.vertices.insert(mesh.vertices.end(), box.vertices.begin(), box.vertices.end());
    for (const Triangle& t : box.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    const MeshSurface surface(mesh);
    const auto stretches = surface.stretches_on({{1.0_mm, 0.3_mm, 0.7_mm}, {1, 0, 0}}, -0.1, 0.1);
    ASSERT_EQ(stretches.size(), 1u);
    EXPECT_NEAR(stretches[0].begin, -5.0_mm, 1e-12);
    EXPECT_NEAR(stretches[0].end, 7.0_mm - 0.3_mm * std::tan(wedge_angle), 1e-12);
    EXPECT_NEAR(stretches[0].cosine_at_begin, 1.0, 1e-12);
    EXPECT_NEAR(stretches[0].cosine_at_end, std::cos(wedge_angle), 1e-12);
}

TEST(FieldSurface, IsEnteredWhereALineFirstMeetsItsWall) {
    Body body = test::block({-1.0_mm, -6.0_mm, -6.0_mm}, {15.0_mm, 6.0_mm, 6.0_mm}, 0.4_mm, {0.3, 0.1, 0.7});
    body.surface = LevelSet::build(body.grid(), test::wedge_distance);
    const CutField uncut(body, 0);
    const FieldSurface surface(body, uncut);
    const Line through{{-2.0_mm, 1.0_mm, 0.5_mm}, {1, 0, 0}}, back{{16.0_mm, 1.0_mm, 0.5_mm}, {-1, 0, 0}};
    EXPECT_NEAR(surface.entry_on(through, 0.0, 1.0).value_or(-1.0), 2.0_mm, 0.02_mm);
    EXPECT_NEAR(surface.entry_on(back, 0.0, 1.0).value_or(-1.0), 8.0_mm + 1.0_mm * std::tan(wedge_angle), 0.02_mm);
    EXPECT_FALSE(surface.entry_on(through, 3.0_mm, 1.0)) << "it begins in bone";
}

}  // namespace
}  // namespace kerf::bone
