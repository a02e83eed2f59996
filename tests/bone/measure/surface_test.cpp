// SPDX-License-Identifier: Apache-2.0
// The same box as a mesh and as a field: both give the same distances and thicknesses.
#include <gtest/gtest.h>

#include <cmath>

#include "bone/measure/field_surface.h"
#include "bone/measure/mesh_surface.h"
#include "bone/measure/thickness.h"
#include "tests/support/block.h"

namespace kerf::bone {
namespace {

using namespace literals;

const Vec3 low{-(10.0_mm), -(6.0_mm), -(4.0_mm)}, high{10.0_mm, 6.0_mm, 4.0_mm};

SurfaceMesh box(Vec3 from, Vec3 to) {
    SurfaceMesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.vertices.push_back(
            {(i & 1) != 0 ? to.x : from.x, (i & 2) != 0 ? to.y : from.y, (i & 4) != 0 ? to.z : from.z});
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

struct Both {
    SurfaceMesh mesh = box(low, high);
    Body body = test::block(low, high, 0.5_mm, {0.3, 0.1, 0.7});
    CutField uncut{body, 0};
    MeshSurface as_mesh{mesh};
    FieldSurface as_field{body, uncut};
};

TEST(Thickness, IsThatOfTheBox) {
    const Both both;
    for (const MeasuredSurface* surface :
         {static_cast<const MeasuredSurface*>(&both.as_mesh), static_cast<const MeasuredSurface*>(&both.as_field)}) {
        const auto inside = thickness_at(*surface, {{2.0_mm, 1.0_mm, 0}, {0, 0, 1}}),
                   outside = thickness_at(*surface, {{2.0_mm, 1.0_mm, -20.0_mm}, {0, 0, 1}});
        ASSERT_TRUE(inside && outside);
        EXPECT_NEAR(inside->value, 8.0_mm, inside->uncertainty + 1e-9);
        EXPECT_NEAR(outside->value, 8.0_mm, outside->uncertainty + 1e-9);
        const Vec3 oblique = normalized(Vec3{1, 0, 1});
        const auto slanted = thickness_at(*surface, {{0, 0, 0}, oblique});
        ASSERT_TRUE(slanted);
        EXPECT_NEAR(slanted->value, 8.0_mm * std::sqrt(2.0), 2.0 * slanted->uncertainty + 1e-9);
        EXPECT_FALSE(thickness_at(*surface, {{2.0_mm, 1.0_mm, 20.0_mm}, {0, 0, 1}})) << "looks away";
        EXPECT_FALSE(thickness_at(*surface, {{20.0_mm, 1.0_mm, 0}, {0, 0, 1}})) << "passes by";
    }
    EXPECT_NEAR(thickness_at(both.as_field, {{2.0_mm, 1.0_mm, 0}, {0, 0, 1}})->uncertainty,
                std::sqrt(2.0) * 0.05 * 0.5_mm, 1e-7 /* its gradient is sampled */);
    EXPECT_EQ(thickness_at(both.as_mesh, {{2.0_mm, 1.0_mm, 0}, {0, 0, 1}})->uncertainty, 0.0);
}

TEST(Thickness, EndsAtAnEdgeOfTriangles) {
    const Both both;
    // Along the diagonals of the faces, where each hit is in two triangles.
    const auto thickness = thickness_at(both.as_mesh, {{0, 0, 0}, {0, 0, 1}});
    ASSERT_TRUE(thickness);
    EXPECT_NEAR(thickness->value, 8.0_mm, 1e-12);
}

TEST(Thickness, OfBoneThatIsCutIsWhatIsLeft) {
    Both both;
    CutField cut(both.body, 4096);
    CutRecord record;
    record.from = test::pointing({0, 0, -30.0_mm}, {0, 0, 1});
    record.to = test::pointing({0, 0, 30.0_mm}, {0, 0, 1});
    cut.stamp(record, test::drill_outline(2.0_mm, 60.0_deg, 20.0_mm));
    const FieldSurface drilled(both.body, cut);
    const auto wall = thickness_at(drilled, {{5.0_mm, 0, 0}, {1, 0, 0}});
    ASSERT_TRUE(wall);
    EXPECT_NEAR(wall->value, 8.0_mm, 2.0 * wall->uncertainty) << "from the hole's wall to the face";
    EXPECT_EQ(drilled.stretches_on({{0, 0, 0}, {1, 0, 0}}, -max_search_distance, max_search_distance).size(), 2U);
}

TEST(Thickness, IsUnknownBeyondTheRegion) {
    Both both;
    both.body.region = Region{both.body.grid().sample_position(10, 0, 0), both.body.grid().sample_position(40, 60, 40)};
    EXPECT_FALSE(thickness_at(both.as_field, {{0, 0, 0}, {1, 0, 0}}));
}

TEST(SurfaceDistance, IsNegativeInside) {
    const Both both;
    for (const MeasuredSurface* surface :
         {static_cast<const MeasuredSurface*>(&both.as_mesh), static_cast<const MeasuredSurface*>(&both.as_field)}) {
        for (const double z : {-30.0_mm, -5.0_mm, -3.5_mm, 0.0_mm, 3.0_mm, 4.5_mm, 12.0_mm}) {
            const auto found = surface_distance(*surface, {0, 0, z});
            ASSERT_TRUE(found);
            EXPECT_NEAR(found->value, std::abs(z) - 4.0_mm, found->uncertainty + 0.02_mm /* to the nearest vertex */)
                << z;
        }
    }
}

TEST(SurfacePoints, LieOnTheSurfaceAndInTheRegion) {
    const Both both;
    const Path edge{{{-(8.0_mm), 6.0_mm, 4.0_mm}, {8.0_mm, 6.0_mm, 4.0_mm}}, 3.0_mm};
    for (const MeasuredSurface* surface :
         {static_cast<const MeasuredSurface*>(&both.as_mesh), static_cast<const MeasuredSurface*>(&both.as_field)}) {
        const std::vector<Vec3> points = surface->points_in(edge);
        EXPECT_GT(points.size(), 100U);
        for (const Vec3 p : points) {
            EXPECT_LE(distance_to(edge, p), 3.0_mm);
            EXPECT_NEAR(test::box_distance(p, low, high), 0.0, 0.25_mm /* half a spacing at an edge */);
        }
    }
}

TEST(SurfaceDistance, IsUnknownForNoPoint) {
    const Both both;
    EXPECT_FALSE(both.as_field.distance_to({NAN, 0, 0}));
    EXPECT_FALSE(both.as_mesh.distance_to({NAN, 0, 0}));
    const SurfaceMesh none;
    EXPECT_FALSE(MeshSurface(none).distance_to({0, 0, 0}));
    EXPECT_TRUE(both.as_field.stretches_on({{NAN, 0, 0}, {1, 0, 0}}, -1.0, 1.0).empty());
    EXPECT_TRUE(both.as_field.stretches_on({{0, 0, 0}, {0, 0, 0}}, -1.0, 1.0).size() < 2U);
}

}  // namespace
}  // namespace kerf::bone
