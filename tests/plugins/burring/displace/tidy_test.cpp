// SPDX-License-Identifier: Apache-2.0
#include "plugins/burring/displace/tidy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bone/remesh/base_mesh.h"
#include "kerf/units.hpp"
#include "tests/bone/surface/shapes.h"

namespace kerf {
namespace {

using namespace literals;
using burring::displacement::tidy;
using burring::displacement::Triangles;

bone::SurfaceMesh mesh_of(const Triangles& all) {
    bone::SurfaceMesh mesh;
    mesh.vertices = all.vertices;
    for (std::size_t f = 0; f < all.tags.size(); ++f)
        mesh.triangles.push_back({all.triangles[3 * f], all.triangles[3 * f + 1], all.triangles[3 * f + 2]});
    bone::drop_unused_vertices(mesh);
    return mesh;
}

/// A cube of 10 mm, one of whose faces has a vertex more, this far from the middle of its diagonal and this high over
/// its plane. Vertex 8 is the new one.
Triangles with_needle(double off, double high = 0.0) {
    const bone::SurfaceMesh cube = test::cube(10.0_mm);
    Triangles all;
    all.vertices = cube.vertices;
    // Faces 0 and 1 share the edge 0–3.
    const Vec3 across = normalized(cube.vertices[2] - cube.vertices[1]),
               out = normalized(cross(cube.vertices[2] - cube.vertices[0], cube.vertices[3] - cube.vertices[0]));
    all.vertices.push_back(0.5 * (cube.vertices[0] + cube.vertices[3]) + off * across + high * out);
    for (std::size_t f = 1; f < cube.triangles.size(); ++f)
        all.triangles.insert(all.triangles.end(), cube.triangles[f].begin(), cube.triangles[f].end());
    for (const bone::Triangle& t : {bone::Triangle{0, 2, 8}, {2, 3, 8}, {0, 8, 3}})
        all.triangles.insert(all.triangles.end(), t.begin(), t.end());
    all.tags.assign(all.triangles.size() / 3, KERF_FACE_SURFACE);
    return all;
}
const std::vector<std::uint8_t> nothing(9, 0), all_of_them(9, 1), the_last{0, 0, 0, 0, 0, 0, 0, 0, 1};
constexpr burring::displacement::TidyLimits limits{1e-9, 0.5_um, 2.5_um};

TEST(Tidy, RemovesANeedleInAPlane) {
    Triangles mesh = with_needle(0.01_mm);
    ASSERT_EQ(bone::flaw_of_base(mesh_of(mesh)), "");
    tidy(mesh, nothing, the_last, limits);
    EXPECT_EQ(mesh.tags.size(), 12U) << "the vertex is joined with another one";
    EXPECT_EQ(bone::flaw_of_base(mesh_of(mesh)), "");
    EXPECT_NEAR(bone::signed_volume_of(mesh_of(mesh)), 1e-6, 1e-18);
}

TEST(Tidy, LeavesNeedlesThatWereThere) {
    Triangles mesh = with_needle(0.01_mm);
    const std::vector<std::uint32_t> before = mesh.triangles;
    tidy(mesh, nothing, nothing, limits);
    EXPECT_EQ(mesh.triangles, before);
}

TEST(Tidy, KeepsVerticesThatMustStay) {
    Triangles mesh = with_needle(0.01_mm);
    tidy(mesh, all_of_them, the_last, limits);
    const bone::SurfaceMesh left = mesh_of(mesh);
    EXPECT_EQ(left.vertices.size(), 9U) << "an edge is turned";
    EXPECT_EQ(bone::flaw_of_base(left), "");
    EXPECT_NEAR(bone::signed_volume_of(left), 1e-6, 1e-18);
}

TEST(Tidy, DoesNotFlattenWhatStandsOut) {
    // 0.02 mm over the plane: to remove it would move the surface by more than the limits.
    Triangles mesh = with_needle(0.01_mm, 0.02_mm);
    const double before = bone::signed_volume_of(mesh_of(mesh));
    tidy(mesh, nothing, the_last, limits);
    EXPECT_EQ(mesh_of(mesh).vertices.size(), 9U);
    EXPECT_NEAR(bone::signed_volume_of(mesh_of(mesh)), before, 1e-18);
}

TEST(Tidy, KeepsTheRimOfAWall) {
    // The needle is all that there is of a wall: its rim is not straight.
    Triangles mesh = with_needle(0.5_mm);
    mesh.tags.back() = KERF_FACE_WALL;
    tidy(mesh, nothing, the_last, limits);
    EXPECT_EQ(std::count(mesh.tags.begin(), mesh.tags.end(), KERF_FACE_WALL), 1);
    EXPECT_EQ(mesh_of(mesh).vertices.size(), 9U);
}

}  // namespace
}  // namespace kerf
