// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kerf/units.hpp"
#include "run/view/body_shape.h"
#include "run/view/zone_shape.h"
#include "tests/run/view/viewed_mesh_checks.h"

namespace kerf::run {
namespace {

using namespace literals;

documents::Zone zone_of(std::vector<documents::Solid> solids) {
    documents::Zone zone;
    zone.id = "canal";
    zone.solids = std::move(solids);
    return zone;
}
documents::SphereSolid sphere(Vec3 centre, double radius) {
    documents::SphereSolid solid;
    solid.centre = centre;
    solid.radius = radius;
    return solid;
}
Body ball(double radius, double spacing) {
    const double margin = 6.0 * spacing;
    const Vec3 high = (radius + margin) * Vec3{1, 1, 1};
    Body body;
    body.id = "ball";
    body.surface = LevelSet::build(Grid::covering(-high, high, spacing), [=](Vec3 p) { return length(p) - radius; });
    body.materials.push_back({"metal", 4500.0, {}});
    return body;
}
constexpr double of_unit_ball = 4.0 / 3.0 * std::numbers::pi;

TEST(ZoneShape, BallHasItsVolumeAndNormals) {
    const Vec3 centre{10.0_mm, -20.0_mm, 30.0_mm};
    const ViewedMesh mesh = zone_shape(zone_of({sphere(centre, 5.0_mm)}), 0.5_mm);

    EXPECT_NEAR(test::volume(mesh) / (of_unit_ball * 125e-9), 1.0, 0.01);
    EXPECT_EQ(test::open_edges(mesh), 0);
    EXPECT_LT(test::worst_length(mesh), 1e-5);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const Vec3 out = test::vector_of(mesh.positions[i]) - centre;
        EXPECT_NEAR(length(out), 5.0_mm, 0.03_mm);
        EXPECT_GT(dot(normalized(out), test::vector_of(mesh.normals[i])), 0.99);
    }
}

TEST(ZoneShape, UnitesItsSolids) {
    // Two balls a diameter apart are two surfaces; two equal balls are one.
    const ViewedMesh one = zone_shape(zone_of({sphere({}, 5.0_mm)}), 0.5_mm),
                     same = zone_shape(zone_of({sphere({}, 5.0_mm), sphere({}, 5.0_mm)}), 0.5_mm),
                     two = zone_shape(zone_of({sphere({}, 5.0_mm), sphere({20.0_mm, 0, 0}, 5.0_mm)}), 0.5_mm);

    EXPECT_EQ(same.positions, one.positions);
    EXPECT_NEAR(test::volume(two) / test::volume(one), 2.0, 0.01);
}

TEST(ZoneShape, KeepsItsLimitAtAnySpacing) {
    for (const double spacing : {0.01_mm + 0.0, 0.1_mm + 0.0, 100.0_mm + 0.0, 0.0}) {
        const ViewedMesh mesh = zone_shape(zone_of({sphere({}, 5.0_mm)}), spacing);
        EXPECT_LT(mesh.triangles.size(), max_zone_triangles) << spacing;
        EXPECT_NEAR(test::volume(mesh) / (of_unit_ball * 125e-9), 1.0, 0.1) << spacing;
    }
}

TEST(ZoneShape, ZoneWithoutSolidsIsEmpty) {
    EXPECT_TRUE(zone_shape(zone_of({}), 0.5_mm).triangles.empty());
    EXPECT_TRUE(zone_shape(zone_of({sphere({}, 0.0)}), 0.5_mm).triangles.empty());
}

TEST(BodyShape, BallHasItsVolumeAndNormals) {
    const ViewedMesh mesh = body_shape(ball(10.0_mm, 0.5_mm));

    EXPECT_NEAR(test::volume(mesh) / (of_unit_ball * 1e-6), 1.0, 0.005);
    EXPECT_EQ(test::open_edges(mesh), 0);
    EXPECT_LT(test::worst_length(mesh), 1e-5);
    EXPECT_GT(test::worst_side(mesh), 0.0);
}

TEST(BodyShape, FineBodyKeepsItsLimit) {
    // All samples of a ball of 100 voxels would give about 6 × 2 × 5000 triangles of each half: more than the limit.
    const ViewedMesh mesh = body_shape(ball(10.0_mm, 0.1_mm));

    EXPECT_LT(mesh.triangles.size(), max_body_triangles);
    EXPECT_GT(mesh.triangles.size(), max_body_triangles / 4);
    EXPECT_NEAR(test::volume(mesh) / (of_unit_ball * 1e-6), 1.0, 0.005);
}

TEST(BodyShape, BodyWithoutSurfaceIsEmpty) { EXPECT_TRUE(body_shape(Body{}).triangles.empty()); }

}  // namespace
}  // namespace kerf::run
