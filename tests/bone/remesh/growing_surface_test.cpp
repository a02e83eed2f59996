// SPDX-License-Identifier: Apache-2.0
#include "bone/remesh/growing_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bone/remesh/base_mesh.h"
#include "bone/surface/edges.h"
#include "kerf/remesh.h"
#include "kerf/units.hpp"
#include "tests/bone/surface/shapes.h"

namespace kerf::bone {
namespace {

using namespace literals;

Box box_of(const SurfaceMesh& mesh, const Triangle& t) {
    SurfaceMesh one;
    for (const Vec3 v : mesh.corners(t)) one.vertices.push_back(v);
    one.triangles = {{0, 1, 2}};
    return bounds_of(one);
}

const Box cap{{-3.0_mm, -3.0_mm, 4.0_mm}, {3.0_mm, 3.0_mm, 7.0_mm}};

TEST(GrowingSurface, FindsEveryFaceWhoseBoxMeetsTheRegion) {
    const SurfaceMesh sphere = test::sphere(6.0_mm, 4);
    const GrowingSurface surface(tagged(sphere));
    const SurfacePatch patch = surface.patch_in(cap);
    std::size_t expected = 0;
    for (std::uint32_t f = 0; f < sphere.triangles.size(); ++f) {
        if (!meet(box_of(sphere, sphere.triangles[f]), cap)) continue;
        ++expected;
        EXPECT_TRUE(std::binary_search(patch.faces.begin(), patch.faces.end(), f));
    }
    EXPECT_GE(patch.faces.size(), expected);
    EXPECT_LE(patch.faces.size(), expected + 10) << "a few more around pinched vertices";
    EXPECT_TRUE(pinched_vertices_of(patch.mesh.mesh, half_edges_of(patch.mesh.mesh)).empty());
}

TEST(GrowingSurface, LocksTheBorderAndNothingElse) {
    const GrowingSurface surface(tagged(test::sphere(6.0_mm, 4)));
    const SurfacePatch patch = surface.patch_in(cap);
    std::vector<std::uint8_t> on_border(patch.locked.size(), 0);
    const std::vector<HalfEdge> edges = half_edges_of(patch.mesh.mesh);
    for_each_edge(edges, [&](const HalfEdge* first, const HalfEdge* last) {
        if (last - first == 1) on_border[first->low] = on_border[first->high] = 1;
    });
    EXPECT_EQ(patch.locked, on_border);
    EXPECT_GT(std::count(on_border.begin(), on_border.end(), 1), 10);
}

TEST(GrowingSurface, HasARingThatClosesTheBorder) {
    const GrowingSurface surface(tagged(test::sphere(6.0_mm, 4)));
    const SurfacePatch patch = surface.patch_in(cap);
    const TaggedMesh ring = surface.ring_of(patch);
    // The border of patch and ring together lies away from the patch's own.
    SurfaceMesh both = patch.mesh.mesh;
    const auto first = static_cast<std::uint32_t>(both.vertices.size());
    both.vertices.insert(both.vertices.end(), ring.mesh.vertices.begin(), ring.mesh.vertices.end());
    for (const Triangle& t : ring.mesh.triangles) both.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    snap(both, 0x1p-30);
    const SurfaceMesh alone = patch.mesh.mesh;
    for (const BorderLoop& loop : border_loops_of(half_edges_of(both)))
        for (const std::uint32_t v : loop.vertices)
            for (const Vec3 inner : alone.vertices) EXPECT_GT(length(both.vertices[v] - inner), 1e-6);
}

TEST(GrowingSurface, IsTheSameAfterAPatchReplacedItself) {
    const TaggedMesh sphere = tagged(test::sphere(6.0_mm, 4));
    GrowingSurface surface(sphere);
    for (int n = 0; n < 3; ++n) {
        const SurfacePatch patch = surface.patch_in(cap);
        surface.replace(patch, patch.mesh);
    }
    const TaggedMesh after = surface.mesh();
    EXPECT_EQ(surface.face_count(), sphere.mesh.triangles.size());
    EXPECT_EQ(after.mesh.vertices.size(), sphere.mesh.vertices.size());
    EXPECT_EQ(flaw_of_base(after.mesh), "");
    EXPECT_NEAR(signed_volume_of(after.mesh), signed_volume_of(sphere.mesh), 1e-20);
}

TEST(GrowingSurface, ReusesTheNumbersOfWhatWentAway) {
    GrowingSurface surface(tagged(test::sphere(6.0_mm, 3)));
    std::uint32_t highest = 0;
    for (int n = 0; n < 50; ++n) {
        const SurfacePatch patch = surface.patch_in(cap);
        highest = std::max(highest, patch.faces.back());
        surface.replace(patch, patch.mesh);
    }
    EXPECT_LT(highest, 512U);
}

TEST(GrowingSurface, TakesAPatchThatWasCut) {
    // A cap is pushed in: its inner vertices move, its border stays.
    GrowingSurface surface(tagged(test::sphere(6.0_mm, 4)));
    const SurfacePatch patch = surface.patch_in(cap);
    TaggedMesh pushed = patch.mesh;
    for (std::size_t v = 0; v < pushed.mesh.vertices.size(); ++v)
        if (patch.locked[v] == 0) pushed.mesh.vertices[v].z -= 1.0_mm;
    std::fill(pushed.tags.begin(), pushed.tags.end(), std::uint8_t{KERF_FACE_WALL});
    const double before = signed_volume_of(surface.mesh().mesh);
    surface.replace(patch, pushed);
    const TaggedMesh after = surface.mesh();
    EXPECT_EQ(flaw_of_base(after.mesh), "");
    const double lost = volume_between(pushed.mesh, patch.mesh.mesh);
    EXPECT_GT(lost, 0.0);
    EXPECT_NEAR(before - signed_volume_of(after.mesh), lost, 1e-6 * lost);
    EXPECT_EQ(static_cast<std::size_t>(std::count(after.tags.begin(), after.tags.end(), KERF_FACE_WALL)),
              pushed.tags.size());
}

TEST(GrowingSurface, FindsNothingInTheAir) {
    const GrowingSurface surface(tagged(test::sphere(6.0_mm, 3)));
    EXPECT_TRUE(surface.patch_in({{20.0_mm, 0, 0}, {21.0_mm, 1.0_mm, 1.0_mm}}).faces.empty());
    EXPECT_TRUE(surface.patch_in({{-1.0_mm, -1.0_mm, -1.0_mm}, {1.0_mm, 1.0_mm, 1.0_mm}}).faces.empty());
}

// ---- moments ------------------------------------------------------------------------------------------------------

/// Pushes a cap in by an amount and tags it.
void push_in(GrowingSurface& surface, const Box& where, double by) {
    const SurfacePatch patch = surface.patch_in(where);
    TaggedMesh pushed = patch.mesh;
    for (std::size_t v = 0; v < pushed.mesh.vertices.size(); ++v)
        if (patch.locked[v] == 0) pushed.mesh.vertices[v].z -= by;
    std::fill(pushed.tags.begin(), pushed.tags.end(), std::uint8_t{KERF_FACE_WALL});
    surface.replace(patch, pushed);
}
const Box second_cap{{-3.0_mm, -3.0_mm, -7.0_mm}, {3.0_mm, 3.0_mm, -4.0_mm}};

void expect_same(const TaggedMesh& a, const TaggedMesh& b) {
    EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
    EXPECT_EQ(a.tags, b.tags);
    ASSERT_EQ(a.mesh.vertices.size(), b.mesh.vertices.size());
    for (std::size_t v = 0; v < a.mesh.vertices.size(); ++v) EXPECT_TRUE(a.mesh.vertices[v] == b.mesh.vertices[v]);
}

TEST(GrowingSurface, GoesBackToAMoment) {
    GrowingSurface surface(tagged(test::sphere(6.0_mm, 5)));
    push_in(surface, cap, 0.5_mm);
    const TaggedMesh was = surface.mesh();
    const GrowingSurface::Moment moment = surface.moment();
    push_in(surface, cap, 0.7_mm);
    push_in(surface, second_cap, -0.3_mm);
    surface.restore(moment);
    expect_same(surface.mesh(), was);
    EXPECT_EQ(surface.face_count(), was.mesh.triangles.size());
    // And what follows is found by the region and by the vertex, as on a surface that never left.
    push_in(surface, cap, 0.2_mm);
    EXPECT_EQ(flaw_of_base(surface.mesh().mesh), "");
}

TEST(GrowingSurface, GoesOnFromAMomentAsIfNothingHadBeen) {
    GrowingSurface straight(tagged(test::sphere(6.0_mm, 5))), detour(tagged(test::sphere(6.0_mm, 5)));
    for (GrowingSurface* one : {&straight, &detour}) push_in(*one, cap, 0.5_mm);
    const GrowingSurface::Moment moment = detour.moment();
    push_in(detour, second_cap, -0.3_mm);
    push_in(detour, cap, 0.7_mm);
    detour.restore(moment);
    for (GrowingSurface* one : {&straight, &detour}) {
        push_in(*one, second_cap, -0.1_mm);
        push_in(*one, cap, 0.1_mm);
    }
    expect_same(detour.mesh(), straight.mesh());
}

TEST(GrowingSurface, AMomentSharesThePagesThatDidNotChange) {
    GrowingSurface surface(tagged(test::sphere(6.0_mm, 6)));
    const GrowingSurface::Moment before = surface.moment();
    push_in(surface, {{-0.5_mm, -0.5_mm, 5.0_mm}, {0.5_mm, 0.5_mm, 7.0_mm}}, 0.1_mm);
    const GrowingSurface::Moment after = surface.moment();
    std::size_t shared = 0;
    for (std::size_t page = 0; page < before.faces.pages().size(); ++page)
        shared += before.faces.pages()[page] == after.faces.pages()[page];
    EXPECT_GT(shared, before.faces.pages().size() / 2);
    EXPECT_LT(shared, before.faces.pages().size());
}

TEST(GrowingSurface, GoesForwardAgain) {
    GrowingSurface surface(tagged(test::sphere(6.0_mm, 5)));
    const GrowingSurface::Moment before = surface.moment();
    push_in(surface, cap, 0.5_mm);
    const TaggedMesh pushed = surface.mesh();
    const GrowingSurface::Moment after = surface.moment();
    surface.restore(before);
    surface.restore(after);
    expect_same(surface.mesh(), pushed);
}

TEST(GrowingSurface, HasNothingOfAnEmptyMesh) {
    GrowingSurface surface((TaggedMesh()));
    EXPECT_EQ(surface.face_count(), 0u);
    EXPECT_TRUE(surface.patch_in(cap).faces.empty());
    EXPECT_TRUE(surface.mesh().mesh.triangles.empty());
}

}  // namespace
}  // namespace kerf::bone
