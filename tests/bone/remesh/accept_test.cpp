// SPDX-License-Identifier: Apache-2.0
#include "bone/remesh/accept.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>

#include "bone/remesh/base_mesh.h"
#include "bone/remesh/growing_surface.h"
#include "kerf/units.hpp"
#include "tests/bone/surface/shapes.h"
#include "tests/support/block.h"

namespace kerf::bone {
namespace {

using namespace literals;
using test::cube, test::sphere, test::together, test::turned;

RemeshRequest request_for(const SurfaceMesh& base) {
    RemeshRequest request;
    request.base = tagged(base);
    return request;
}
/// The flaw that is found in a result for a cube of 10 mm.
std::string flaw_of(const SurfaceMesh& result) { return flaw_of_result(request_for(cube(10.0_mm)), tagged(result)); }

TEST(AcceptResult, TakesWhatIsSound) {
    EXPECT_EQ(flaw_of(cube(10.0_mm)), "");
    EXPECT_EQ(flaw_of(cube(9.0_mm)), "");
    EXPECT_EQ(flaw_of(together(cube(9.0_mm), turned(cube(5.0_mm)))), "") << "a cavity";
    EXPECT_EQ(flaw_of(together(cube(2.0_mm, {-2.0_mm, 0, 0}), cube(2.0_mm, {2.0_mm, 0, 0}))), "") << "two pieces";
    EXPECT_EQ(flaw_of({}), "") << "nothing is left";
}

TEST(AcceptResult, RefusesAnOpenMesh) {
    SurfaceMesh open = cube(9.0_mm);
    open.triangles.pop_back();
    EXPECT_NE(flaw_of(open).find("open edges"), std::string::npos) << flaw_of(open);
}
TEST(AcceptResult, RefusesMoreFacesThanItsToleranceNeeds) {
    RemeshRequest request = request_for(sphere(5.0_mm, 3));
    request.tolerance = 0.1_mm;  // 31 000 faces on 3.1 cm²
    EXPECT_EQ(flaw_of_result(request, tagged(sphere(5.0_mm, 6))), "") << "few enough to be checked in a moment";
    const std::string flaw = flaw_of_result(request, tagged(sphere(5.0_mm, 7)));
    EXPECT_NE(flaw.find("it has 131072 faces, before the cut 512; a surface to 100 um needs fewer than 314"),
              std::string::npos)
        << flaw;
    request.base = tagged(sphere(5.0_mm, 7));
    EXPECT_EQ(flaw_of_result(request, request.base), "") << "no more than before";
}
TEST(AcceptResult, RefusesAFaceTheOtherWayRound) {
    SurfaceMesh flipped = cube(9.0_mm);
    std::swap(flipped.triangles[3][0], flipped.triangles[3][1]);
    EXPECT_NE(flaw_of(flipped).find("look to different sides"), std::string::npos) << flaw_of(flipped);
}
TEST(AcceptResult, RefusesFacesThatCross) {
    const SurfaceMesh crossing = together(cube(4.0_mm), cube(4.0_mm, {1.0_mm, 1.1_mm, 1.2_mm}));
    EXPECT_NE(flaw_of(crossing).find("cross"), std::string::npos) << flaw_of(crossing);
    // By as little as doubles can tell
    const SurfaceMesh beside = cube(4.0_mm, {4.0_mm - 1e-15, 0.1_mm, 0.1_mm});
    EXPECT_NE(flaw_of_result(request_for(cube(20.0_mm)), tagged(together(cube(4.0_mm), beside))).find("cross"),
              std::string::npos);
}
TEST(AcceptResult, RefusesANeedleThatCrosses) {
    // A strip 0.1 nm wide, folded out of a cube's face and back through the cube beside it
    SurfaceMesh needle = together(cube(4.0_mm, {-3.0_mm, 0, 0}), cube(4.0_mm, {3.0_mm, 0, 0}));
    const auto first = static_cast<std::uint32_t>(needle.vertices.size());
    needle.vertices.insert(needle.vertices.end(), {{0, 0, 0}, {4.0_mm, 0, 0}, {4.0_mm, 1e-10, 0}, {4.0_mm, 0, 1e-10}});
    needle.triangles.insert(needle.triangles.end(), {Triangle{first, first + 2, first + 1},
                                                     {first, first + 3, first + 2},
                                                     {first, first + 1, first + 3},
                                                     {first + 1, first + 2, first + 3}});
    EXPECT_NE(flaw_of_result(request_for(cube(20.0_mm)), tagged(needle)).find("cross"), std::string::npos);
}
TEST(AcceptResult, RefusesPartsThatTouchInAVertex) {
    SurfaceMesh pinched = together(cube(4.0_mm), cube(4.0_mm, {4.0_mm, 4.0_mm, 4.0_mm}));
    snap(pinched, 0x1p-30);
    EXPECT_NE(flaw_of_result(request_for(cube(20.0_mm)), tagged(pinched)).find("only touch in a vertex"),
              std::string::npos);
}
TEST(AcceptResult, RefusesEdgesOfFourFaces) {
    SurfaceMesh joined = together(cube(4.0_mm), cube(4.0_mm, {4.0_mm, 4.0_mm, 0}));
    snap(joined, 0x1p-30);
    EXPECT_NE(flaw_of_result(request_for(cube(20.0_mm)), tagged(joined)).find("more than two faces"),
              std::string::npos);
}
TEST(AcceptResult, RefusesWhatLiesTwiceAtOnePoint) {
    EXPECT_NE(flaw_of(together(cube(4.0_mm), cube(4.0_mm))).find("where another one is"), std::string::npos);
}
TEST(AcceptResult, RefusesAFaceWithoutArea) {
    SurfaceMesh collapsed = cube(9.0_mm);
    collapsed.triangles.push_back({0, 0, 1});
    EXPECT_NE(flaw_of(collapsed).find("no area"), std::string::npos) << flaw_of(collapsed);
}
TEST(AcceptResult, RefusesWhatReachesBeyondTheBase) {
    EXPECT_NE(flaw_of(cube(10.1_mm)).find("beyond"), std::string::npos) << flaw_of(cube(10.1_mm));
}
TEST(AcceptResult, RefusesTagsThatAreMissing) {
    TaggedMesh mesh = tagged(cube(9.0_mm));
    mesh.tags.pop_back();
    EXPECT_NE(flaw_of_result(request_for(cube(10.0_mm)), mesh), "");
}

TEST(AcceptResult, WantsBorderAndLockedVerticesBackBitForBit) {
    SurfaceMesh patch = sphere(5.0_mm, 2);
    std::erase_if(patch.triangles, [&](const Triangle& t) { return patch.vertices[t[0]].z < 0.0; });
    RemeshRequest request = request_for(patch);
    request.locked.assign(patch.vertices.size(), 0);
    const Triangle last = patch.triangles.back();
    request.locked[last[0]] = 1;
    EXPECT_EQ(flaw_of_result(request, tagged(patch)), "");

    SurfaceMesh moved = patch;
    moved.vertices[last[0]] = (1.0 - 1e-15) * moved.vertices[last[0]];
    EXPECT_NE(flaw_of_result(request, tagged(moved)), "");
    SurfaceMesh smaller = patch;
    smaller.triangles.pop_back();
    EXPECT_NE(flaw_of_result(request, tagged(smaller)).find("border did not come back"), std::string::npos);
    SurfaceMesh open = patch;
    open.triangles.erase(open.triangles.begin());  // around the pole, which no edge of the border is near
    EXPECT_NE(flaw_of_result(request, tagged(open)).find("3 open edges within its border"), std::string::npos)
        << flaw_of_result(request, tagged(open));
}

TEST(AcceptResult, RefusesAnEdgeThatIsThereBeyondTheBorder) {
    // Two faces of a square; the ring has the square's other diagonal already.
    RemeshRequest request;
    request.base.mesh.vertices = {{0, 0, 0}, {1.0_mm, 0, 0}, {1.0_mm, 1.0_mm, 0}, {0, 1.0_mm, 0}};
    request.base.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    request.base.tags.assign(2, KERF_FACE_SURFACE);
    request.locked.assign(4, 1);
    TaggedMesh flipped = request.base, ring;
    flipped.mesh.triangles = {{0, 1, 3}, {1, 2, 3}};
    EXPECT_EQ(flaw_of_patch(request, flipped, ring), "");
    ring.mesh.vertices = {{1.0_mm, 0, 0}, {0, 1.0_mm, 0}, {0.5_mm, 0.5_mm, -3.0_mm}};
    ring.mesh.triangles = {{0, 1, 2}};
    ring.tags.assign(1, KERF_FACE_SURFACE);
    EXPECT_NE(flaw_of_patch(request, flipped, ring).find("beyond the border"), std::string::npos);
}

// ---- what cuts begin with

TEST(FieldSurface, IsClosedWithTheVolumeOfTheBlock) {
    const SurfaceMesh surface =
        field_surface(test::block({0, 0, 0}, {9.0_mm, 8.0_mm, 7.0_mm}, 0.5_mm, {0.3, 0.4, 0.5}));
    EXPECT_EQ(flaw_of_base(surface), "");
    EXPECT_NEAR(signed_volume_of(surface), 504e-9, 0.01 * 504e-9 /* a grid rounds edges off */);
}

TEST(Snap, JoinsVerticesWithinAStep) {
    SurfaceMesh soup = test::soup_of(cube(8.0_mm));
    double shift = 0.0;
    for (Vec3& v : soup.vertices) v.x += 1e-9 * std::sin(++shift);
    snap(soup, 0x1p-20);
    EXPECT_EQ(soup.vertices.size(), 8U);
    EXPECT_EQ(soup.triangles.size(), 12U);
    EXPECT_EQ(flaw_of_base(soup), "");
}

TEST(FlawOfBase, NamesWhatIsWrong) {
    EXPECT_EQ(flaw_of_base(cube(10.0_mm)), "");
    SurfaceMesh open = cube(10.0_mm);
    open.triangles.pop_back();
    EXPECT_NE(flaw_of_base(open).find("open edges"), std::string::npos);
    EXPECT_NE(flaw_of_base(turned(cube(10.0_mm))).find("inwards"), std::string::npos);
    EXPECT_NE(flaw_of_base(together(cube(4.0_mm), cube(4.0_mm, {1.0_mm, 1.1_mm, 1.2_mm}))).find("cross"),
              std::string::npos);
    EXPECT_NE(flaw_of_base({}).find("no faces"), std::string::npos);
}

/// A patch of a sphere with one vertex moved, and its ring.
std::string flaw_of_moved(Vec3 way) {
    const GrowingSurface surface(tagged(sphere(6.0_mm, 4)));
    const SurfacePatch patch = surface.patch_in({{-3.0_mm, -3.0_mm, 4.0_mm}, {3.0_mm, 3.0_mm, 7.0_mm}});
    RemeshRequest request;
    request.base = patch.mesh;
    request.locked = patch.locked;
    TaggedMesh moved = patch.mesh;
    std::size_t top = 0;
    for (std::size_t v = 0; v < moved.mesh.vertices.size(); ++v)
        if (moved.mesh.vertices[v].z > moved.mesh.vertices[top].z) top = v;
    moved.mesh.vertices[top] = moved.mesh.vertices[top] + way;
    return flaw_of_patch(request, moved, surface.ring_of(patch));
}

TEST(AcceptPatch, FindsNewFacesThatCrossOldOnesOrTheRing) {
    EXPECT_EQ(flaw_of_moved({}), "");
    EXPECT_EQ(flaw_of_moved({0, 0, -0.2_mm}), "");
    EXPECT_NE(flaw_of_moved({4.0_mm, 0, -0.8_mm}).find("cross"), std::string::npos) << "old faces of the patch";
    EXPECT_NE(flaw_of_moved({5.0_mm, 0, -1.5_mm}).find("cross"), std::string::npos) << "the ring";
}

// ---- bases --------------------------------------------------------------------------------------------------------

/// A cube of which an edge is divided in its middle, on one side only, where a face without area closes the gap.
SurfaceMesh cube_with_a_flat_face() {
    SurfaceMesh mesh = cube(10.0_mm);
    const Triangle t = mesh.triangles[0];
    const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(0.5 * (mesh.vertices[t[0]] + mesh.vertices[t[1]]));
    mesh.triangles[0] = {t[0], middle, t[2]};
    mesh.triangles.push_back({middle, t[1], t[2]});
    mesh.triangles.push_back({t[0], t[1], middle});
    return mesh;
}

TEST(BaseMesh, NamesAFaceWithoutArea) {
    EXPECT_NE(flaw_of_base(cube_with_a_flat_face()).find("no area"), std::string::npos)
        << flaw_of_base(cube_with_a_flat_face());
}

TEST(BaseMesh, AFlatFaceSharesTheAreaOfItsNeighbour) {
    SurfaceMesh mesh = cube_with_a_flat_face();
    const std::size_t faces = mesh.triangles.size();
    remove_flat_faces(mesh);
    EXPECT_EQ(flaw_of_base(mesh), "");
    EXPECT_EQ(mesh.triangles.size(), faces);
    EXPECT_NEAR(signed_volume_of(mesh), 1e-6, 1e-20);
}

TEST(BaseMesh, AnEdgeWithoutLengthBecomesAVertex) {
    SurfaceMesh mesh = cube(10.0_mm);
    // One corner twice: a fan of two faces hangs on the second one, and two flat ones close the gap.
    const std::uint32_t corner = mesh.triangles[0][0];
    const auto copy = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(mesh.vertices[corner]);
    const Triangle t = mesh.triangles[0];
    mesh.triangles[0] = {copy, t[1], t[2]};
    mesh.triangles.push_back({corner, t[1], copy});
    mesh.triangles.push_back({corner, copy, t[2]});
    EXPECT_NE(flaw_of_base(mesh), "");
    remove_flat_faces(mesh);
    EXPECT_EQ(flaw_of_base(mesh), "");
    EXPECT_EQ(mesh.triangles.size(), 12u);
    EXPECT_EQ(mesh.vertices.size(), 8u);
}

TEST(BaseMesh, ASoundOneStaysAsItIs) {
    SurfaceMesh mesh = sphere(5.0_mm, 3);
    const SurfaceMesh before = mesh;
    remove_flat_faces(mesh);
    EXPECT_EQ(mesh.triangles, before.triangles);
    EXPECT_EQ(mesh.vertices.size(), before.vertices.size());
}

}  // namespace
}  // namespace kerf::bone
