// SPDX-License-Identifier: Apache-2.0
// The strategy `displace` against volumes that can be worked out by hand, and against laws.
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <random>

#include "bone/remesh/remesh_child.h"
#include "bone/surface/triangle_tree.h"
#include "tests/bone/surface/shapes.h"
#include "tests/plugins/burring/displace/displacing.h"
#include "tests/support/block.h"
#include "tests/support/sawn_tube.h"

namespace kerf {
namespace {

using namespace literals;
using chart::ball_burr, chart::burr_at, test::euler_of, chart::in_steps, chart::min_angles_of_walls, chart::slab,
    chart::stretches_along;

constexpr double radius = 2.0_mm;

using Displace = test::Displacing;

bone::TaggedMesh bone_slab(double square = 1.0_mm) { return bone::tagged(slab(24.0_mm, 10.0_mm, 8.0_mm, square)); }

double volume_of(const bone::LocalCutting& cutting) { return bone::signed_volume_of(cutting.surface().mesh().mesh); }

TEST_F(Displace, AGrooveHasTheVolumeByHand) {
    const bone::TaggedMesh bone = bone_slab();
    const ToolSolid burr = ball_burr(radius);
    bone::LocalCutting cut = cutting(bone, burr, 8e-6);
    EXPECT_TRUE(cut.cut({burr_at({-6.0_mm, 0.1_mm, -1.0_mm}), burr_at({6.0_mm, 0.1_mm, -1.0_mm}), 0}));
    EXPECT_EQ(flaw_of(bone, cut), "");
    // 2.457 mm² of slot, and half a dimple of 1 mm at either end
    const double by_hand = 12.0e-3 * 2.4567e-6 + std::numbers::pi * 5.0 / 3.0 * 1e-9;
    EXPECT_NEAR(12.0e-3 * chart::slot_area(radius, 1.0_mm) + chart::dimple_volume(radius, 1.0_mm), by_hand, 1e-12);
    EXPECT_NEAR(cut.removed(), by_hand, 1e-3 * by_hand);
    EXPECT_NEAR(bone::signed_volume_of(bone.mesh) - volume_of(cut), cut.removed(), 1e-6 * by_hand);
}

TEST_F(Displace, ADimpleDeeperThanTheBallOverhangs) {
    const bone::TaggedMesh bone = bone_slab();
    const ToolSolid burr = ball_burr(radius);
    bone::LocalCutting cut = cutting(bone, burr);
    EXPECT_TRUE(cut.cut({burr_at({0.1_mm, 0.2_mm, -3.0_mm}), burr_at({0.1_mm, 0.2_mm, -3.0_mm}), 0}));
    EXPECT_EQ(flaw_of(bone, cut), "");
    const double by_hand = chart::dimple_volume(radius, 3.0_mm);  // 9 π mm³: the opening is narrower than the ball
    EXPECT_NEAR(by_hand, 9.0 * std::numbers::pi * 1e-9, 1e-15);
    EXPECT_NEAR(cut.removed(), by_hand, 2e-3 * by_hand);
}

TEST_F(Displace, ABlindHoleEndsInACone) {
    const bone::TaggedMesh bone = bone_slab();
    const double half_angle = 60.0_deg, depth = 6.0_mm;
    const ToolSolid drill = test::drill_outline(radius, half_angle, 30.0_mm);
    bone::LocalCutting cut = cutting(bone, drill);
    EXPECT_TRUE(cut.cut({burr_at({0, 0, 1.0_mm}), burr_at({0, 0, -depth}), 0}));
    EXPECT_EQ(flaw_of(bone, cut), "");
    const double by_hand = std::numbers::pi * radius * radius * (depth - 2.0 / 3.0 * radius / std::tan(half_angle));
    EXPECT_NEAR(cut.removed(), by_hand, 1e-3 * by_hand);
}

TEST_F(Displace, AStepDrillIsCutInConvexParts) {
    const bone::TaggedMesh bone = bone_slab();
    const ToolSolid drill({{0.0, 1.0_mm}, {-3.0_mm, 1.0_mm}, {-3.5_mm, 2.0_mm}, {-20.0_mm, 2.0_mm}});
    bone::LocalCutting cut = cutting(bone, drill);
    for (const bone::CutStretch& step : in_steps({0.1_mm, 0.2_mm, 0.5_mm}, {0.1_mm, 0.2_mm, -5.0_mm}, 0.5_mm))
        EXPECT_TRUE(cut.cut(step));
    EXPECT_EQ(flaw_of(bone, cut), "");
    // 3 mm narrow, 0.5 mm of a cone, 1.5 mm wide
    const double by_hand = std::numbers::pi * (1.0 * 3.0 + (1.0 + 2.0 + 4.0) / 3.0 * 0.5 + 4.0 * 1.5) * 1e-9;
    EXPECT_NEAR(cut.removed(), by_hand, 5e-3 * by_hand);  // its sharp edges are a face wide
}

TEST_F(Displace, FacesAsLargeAsTheSlabGiveTheSameGroove) {
    const bone::TaggedMesh bone = bone_slab(30.0_mm);
    ASSERT_EQ(bone.tags.size(), 12U);
    const ToolSolid burr = ball_burr(radius);
    bone::LocalCutting cut = cutting(bone, burr);
    for (const bone::CutStretch& step : in_steps({-6.0_mm, 0, -1.0_mm}, {6.0_mm, 0, -1.0_mm}, 0.5_mm))
        EXPECT_TRUE(cut.cut(step));
    EXPECT_EQ(flaw_of(bone, cut), "");
    const double by_hand = 12.0e-3 * chart::slot_area(radius, 1.0_mm) + chart::dimple_volume(radius, 1.0_mm);
    EXPECT_NEAR(cut.removed(), by_hand, 2e-3 * by_hand);
}

TEST_F(Displace, StepsOfAnyLengthMakeOneGroove) {
    const bone::TaggedMesh bone = bone_slab();
    const ToolSolid burr = ball_burr(radius);
    std::vector<double> removed;
    std::vector<std::size_t> faces;
    for (const double feed : {12.0_mm, 1.0_mm, 0.1_mm}) {
        bone::LocalCutting cut = cutting(bone, burr);
        for (const bone::CutStretch& step : in_steps({-6.0_mm, 0, -1.0_mm}, {6.0_mm, 0, -1.0_mm}, feed))
            EXPECT_TRUE(cut.cut(step));
        EXPECT_EQ(flaw_of(bone, cut), "") << feed;
        removed.push_back(cut.removed());
        faces.push_back(cut.surface().face_count());
    }
    for (const double one : removed) EXPECT_NEAR(one, removed.front(), 1e-3 * removed.front());
    EXPECT_LT(faces.back(), 1.2 * static_cast<double>(faces.front())) << "short steps leave no strips";
}

TEST_F(Displace, AGrooveInACurvedBoneHasTheExactVolume) {
    const bone::TaggedMesh bone = bone::tagged(test::bent_bone(8000.0));
    const ToolSolid burr = ball_burr(radius);
    std::vector<bone::CutStretch> cuts;
    std::mt19937 random(3);
    std::normal_distribution<double> tremor(0.0, 20e-6);
    Pose last{};
    for (int i = 0; i <= 20; ++i) {  // around the bone while along it, and the burr turns with the surface
        const double angle = 0.6 + 0.03 * i;
        const Vec3 out{0, std::cos(angle), std::sin(angle)}, tremble{tremor(random), tremor(random), tremor(random)};
        const Pose next{Vec3{-3.0_mm + 0.3_mm * i, 0, 0} + 8.3_mm * out + tremble, quat_between({0, 0, 1}, -out)};
        if (i > 0) cuts.push_back({last, next, 0});
        last = next;
    }
    bone::LocalCutting cut = cutting(bone, burr, 8e-6);
    for (const bone::CutStretch& step : cuts) EXPECT_TRUE(cut.cut(step));
    EXPECT_EQ(flaw_of(bone, cut), "");
    const double exact = exactly_removed(bone, burr, cuts);
    EXPECT_NEAR(cut.removed(), exact, 3e-3 * exact); /* 0.5 mm deep: a third of 5 um lacks everywhere */
}

TEST_F(Displace, ABlindTunnelIsDugByDisplacement) {
    // Down and then along, with 1 mm of bone over the ball: a blind tunnel, still a disc of surface moved inwards.
    const bone::TaggedMesh bone = bone_slab();
    const ToolSolid burr = ball_burr(radius);
    auto cuts = in_steps({-6.0_mm, 0, 0}, {-6.0_mm, 0, -5.0_mm}, 0.5_mm);
    for (const bone::CutStretch& cut : in_steps({-6.0_mm, 0, -5.0_mm}, {2.0_mm, 0, -5.0_mm}, 0.5_mm))
        cuts.push_back(cut);
    bone::LocalCutting cut = cutting(bone, burr);
    for (const bone::CutStretch& step : cuts) EXPECT_TRUE(cut.cut(step));
    EXPECT_EQ(flaw_of(bone, cut), "");
    EXPECT_EQ(euler_of(cut.surface().mesh().mesh), 2);
    const double exact =
        exactly_removed(bone, burr, stretches_along({{-6.0_mm, 0, 0}, {-6.0_mm, 0, -5.0_mm}, {2.0_mm, 0, -5.0_mm}}));
    EXPECT_NEAR(cut.removed(), exact, 2e-3 * exact);
}

// ---- laws ---------------------------------------------------------------------------------------------------------

/// A groove with tremor in a bone, in its patch.
bone::RemeshRequest groove_request(const ToolSolid& burr) {
    bone::RemeshRequest request;
    const bone::GrowingSurface bone(bone::tagged(test::bent_bone(8000.0)));
    request.cuts = {{{{-2.0_mm, 2.0_mm, 8.2_mm}, quat_between({0, 0, 1}, {0, 0, -1})},
                     {{2.0_mm, 2.1_mm, 8.1_mm}, quat_between({0, 0, 1}, {0, 0, -1})},
                     0}};
    request.solids = {&burr};
    const bone::SurfacePatch patch = bone.patch_in(bone::swept_box(burr, request.cuts.front()));
    request.base = patch.mesh;
    request.locked = patch.locked;
    request.tolerance = 20e-6;
    return request;
}

TEST_F(Displace, MovesNothingOutsideTheContact) {
    const ToolSolid burr = ball_burr(radius);
    const bone::RemeshRequest request = groove_request(burr);
    const bone::RemeshResult result = displace(request);
    ASSERT_EQ(result.status, KERF_OK) << result.message;
    const bone::TriangleTree before(request.base.mesh);
    std::size_t old_faces = 0;
    for (std::size_t f = 0; f < result.mesh.tags.size(); ++f) {
        if (result.mesh.tags[f] != KERF_FACE_SURFACE) continue;
        ++old_faces;
        const auto [a, b, c] = result.mesh.mesh.corners(result.mesh.mesh.triangles[f]);
        for (const Vec3 p : {a, b, c, (a + b + c) / 3.0}) ASSERT_LT(before.distance(p, 1.0), 2e-9);
    }
    EXPECT_GT(old_faces, 100U);
}

TEST_F(Displace, PutsTheWallOnTheSweptBurr) {
    const ToolSolid burr = ball_burr(radius);
    const bone::RemeshRequest request = groove_request(burr);
    const bone::RemeshResult result = displace(request);
    ASSERT_EQ(result.status, KERF_OK) << result.message;
    const bone::CutStretch& cut = request.cuts.front();
    const Vec3 begin = cut.from * Vec3{0, 0, -radius}, end = cut.to * Vec3{0, 0, -radius}, way = end - begin;
    const bone::TriangleTree before(request.base.mesh);
    std::size_t walls = 0;
    for (std::size_t f = 0; f < result.mesh.tags.size(); ++f) {
        if (result.mesh.tags[f] != KERF_FACE_WALL) continue;
        ++walls;
        const auto [a, b, c] = result.mesh.mesh.corners(result.mesh.mesh.triangles[f]);
        const auto axis_to = [&](Vec3 p) {
            return p - (begin + std::clamp(dot(p - begin, way) / dot(way, way), 0.0, 1.0) * way);
        };
        for (const Vec3 p : {a, b, c}) {
            const double off = length(axis_to(p)) - radius;  // the outline's chords lie up to 0.15 um inside the ball
            EXPECT_TRUE(std::abs(off) < 0.2e-6 || before.distance(p, 1.0) < 2e-9) << off;
            EXPECT_LT(off, 1.5e-6);  // a vertex of the old surface may be on the rim: 1.25 um
        }
        const Vec3 middle = (a + b + c) / 3.0;
        EXPECT_LT(dot(cross(b - a, c - a), axis_to(middle)), 0.0) << "it looks at the burr";
        EXPECT_GT(length(axis_to(middle)) - radius, -6e-6) << "a quarter of the tolerance, and the chords";
    }
    EXPECT_GT(walls, 200U);
}

TEST_F(Displace, KeepsLockedVerticesBitForBit) {
    const ToolSolid burr = ball_burr(radius);
    const bone::RemeshRequest request = groove_request(burr);
    const bone::RemeshResult result = displace(request);
    ASSERT_EQ(result.status, KERF_OK) << result.message;
    std::size_t locked = 0;
    for (std::size_t v = 0; v < request.locked.size(); ++v) {
        if (request.locked[v] == 0) continue;
        ++locked;
        const Vec3 needed = request.base.mesh.vertices[v];
        EXPECT_TRUE(std::any_of(result.mesh.mesh.vertices.begin(), result.mesh.mesh.vertices.end(),
                                [&](Vec3 got) { return std::memcmp(&got, &needed, sizeof got) == 0; }));
    }
    EXPECT_GT(locked, 20U);
    EXPECT_EQ(bone::flaw_of_result(request, result.mesh), "") << "its border is the same, and no faces cross";
}

TEST_F(Displace, DeclinesAPatchWhoseBorderTheBurrReaches) {
    const ToolSolid burr = ball_burr(radius);
    bone::RemeshRequest request = groove_request(burr);
    const bone::GrowingSurface bone(bone::tagged(test::bent_bone(8000.0)));
    const bone::SurfacePatch patch = bone.patch_in({{-1.0_mm, 1.5_mm, 7.0_mm}, {1.0_mm, 2.5_mm, 12.0_mm}});
    request.base = patch.mesh;
    request.locked = patch.locked;
    const bone::RemeshResult result = displace(request);
    EXPECT_EQ(result.status, KERF_REMESH_DECLINED);
    EXPECT_EQ(result.message, "the burr reaches the border of the patch");
}

TEST_F(Displace, TouchingAThousandTimesChangesNothing) {
    // S-14: a ball of bone, the burr touching it everywhere, and sliding along a slab.
    const ToolSolid burr = ball_burr(radius);
    const bone::TaggedMesh ball = bone::tagged(test::sphere(6.0_mm, 4)), flat = bone_slab();
    bone::LocalCutting on_ball = cutting(ball, burr), on_flat = cutting(flat, burr);
    const bone::TaggedMesh ball_before = on_ball.surface().mesh(), flat_before = on_flat.surface().mesh();
    std::mt19937 random(9);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int n = 0; n < 1000; ++n) {
        const Vec3 out = normalized(Vec3{any(random), any(random), any(random)});
        const Pose there{6.0_mm * out, quat_between({0, 0, 1}, -out)};
        EXPECT_TRUE(on_ball.cut({there, there, 0}));
        EXPECT_TRUE(on_flat.cut({burr_at({8.0_mm * any(random), 3.0_mm * any(random), 0}),
                                 burr_at({8.0_mm * any(random), 3.0_mm * any(random), 0}), 0}));
    }
    EXPECT_EQ(on_ball.removed(), 0.0);
    EXPECT_EQ(on_flat.removed(), 0.0);
    for (const auto& [before, after] :
         {std::pair(ball_before, on_ball.surface().mesh()), std::pair(flat_before, on_flat.surface().mesh())}) {
        EXPECT_TRUE(after.mesh.triangles == before.mesh.triangles);
        EXPECT_TRUE(std::equal(after.mesh.vertices.begin(), after.mesh.vertices.end(), before.mesh.vertices.begin(),
                               before.mesh.vertices.end(), [](Vec3 a, Vec3 b) { return a == b; }));
    }
}

TEST_F(Displace, RepeatingAGrooveRemovesNothingMore) {
    const bone::TaggedMesh bone = bone_slab();
    const ToolSolid burr = ball_burr(radius);
    bone::LocalCutting cut = cutting(bone, burr);
    const bone::CutStretch along{burr_at({-6.0_mm, 0, -1.0_mm}), burr_at({6.0_mm, 0, -1.0_mm}), 0};
    EXPECT_TRUE(cut.cut(along));
    const double once = cut.removed();
    const std::size_t faces = cut.surface().face_count();
    for (int n = 0; n < 20; ++n) EXPECT_TRUE(cut.cut(n % 2 == 0 ? bone::CutStretch{along.to, along.from, 0} : along));
    EXPECT_NEAR(cut.removed(), once, 1e-6 * once);
    EXPECT_EQ(cut.surface().face_count(), faces);
}

TEST_F(Displace, TurningTheWorldTurnsTheGroove) {
    const ToolSolid burr = ball_burr(radius);
    const bone::RemeshRequest request = groove_request(burr);
    const bone::RemeshResult result = displace(request);
    ASSERT_EQ(result.status, KERF_OK) << result.message;
    const Pose turn{{30.0_mm, -20.0_mm, 5.0_mm}, quat_from_rotation_vector({0.7, -0.4, 1.1})};
    bone::RemeshRequest turned = request;
    for (Vec3& v : turned.base.mesh.vertices) v = turn * v;
    for (bone::CutStretch& cut : turned.cuts) cut = {turn * cut.from, turn * cut.to, cut.solid};
    const bone::RemeshResult other = displace(turned);
    ASSERT_EQ(other.status, KERF_OK) << other.message;
    EXPECT_EQ(bone::flaw_of_result(turned, other.mesh), "");
    const double removed = bone::volume_between(result.mesh.mesh, request.base.mesh);
    EXPECT_NEAR(bone::volume_between(other.mesh.mesh, turned.base.mesh), removed,
                1e-4 * removed /* rounding decides ties */);
}

TEST_F(Displace, MirroringTheWorldMirrorsTheGroove) {
    const ToolSolid burr = ball_burr(radius);
    const bone::RemeshRequest request = groove_request(burr);
    const bone::RemeshResult result = displace(request);
    ASSERT_EQ(result.status, KERF_OK) << result.message;
    bone::RemeshRequest mirrored = request;
    for (Vec3& v : mirrored.base.mesh.vertices) v.x = -v.x;
    for (bone::Triangle& t : mirrored.base.mesh.triangles) std::swap(t[1], t[2]);
    for (bone::CutStretch& cut : mirrored.cuts) {
        cut.from.position.x = -cut.from.position.x;
        cut.to.position.x = -cut.to.position.x;
    }
    const bone::RemeshResult other = displace(mirrored);
    ASSERT_EQ(other.status, KERF_OK) << other.message;
    const double removed = bone::volume_between(result.mesh.mesh, request.base.mesh);
    EXPECT_NEAR(bone::volume_between(other.mesh.mesh, mirrored.base.mesh), removed,
                1e-3 * removed /* other diagonals */);
}

TEST_F(Displace, MakesTheSameBitsHereAndInAProcessOfItsOwn) {
    const ToolSolid burr = ball_burr(radius);
    const bone::RemeshRequest request = groove_request(burr);
    const bone::RemeshResult one = displace(request), two = displace(request);
    std::string error;
    const auto child =
        bone::RemeshChild::start({KERF_BUILD_DIR "/libexec/kerf/kerf-remesh", test::burring_module, "displace"}, error);
    ASSERT_NE(child, nullptr) << error;
    EXPECT_EQ(child->scope(), std::uint32_t{KERF_REMESH_PATCH});
    const bone::RemeshResult there = child->remesh(request, std::chrono::seconds(60));
    ASSERT_EQ(one.status, KERF_OK) << one.message;
    for (const bone::RemeshResult* other : {&two, &there}) {
        ASSERT_EQ(other->status, KERF_OK) << other->message;
        EXPECT_EQ(other->mesh.mesh.triangles, one.mesh.mesh.triangles);
        EXPECT_TRUE(std::equal(one.mesh.mesh.vertices.begin(), one.mesh.mesh.vertices.end(),
                               other->mesh.mesh.vertices.begin(), other->mesh.mesh.vertices.end(),
                               [](Vec3 a, Vec3 b) { return a == b; }));
    }
}

TEST_F(Displace, TakesAClosedMeshToo) {
    bone::RemeshRequest request;
    request.base = bone_slab();
    const ToolSolid burr = ball_burr(radius);
    request.solids = {&burr};
    request.cuts = in_steps({-6.0_mm, 0, -1.0_mm}, {6.0_mm, 0, -1.0_mm}, 3.0_mm);
    const bone::RemeshResult result = displace(request);
    ASSERT_EQ(result.status, KERF_OK) << result.message;
    EXPECT_EQ(bone::flaw_of_result(request, result.mesh), "");
    const double by_hand = 12.0e-3 * chart::slot_area(radius, 1.0_mm) + chart::dimple_volume(radius, 1.0_mm);
    EXPECT_NEAR(bone::volume_between(result.mesh.mesh, request.base.mesh), by_hand, 2e-3 * by_hand);
}

TEST_F(Displace, LeavesNoSliversOnAverage) {
    const bone::TaggedMesh bone = bone_slab();
    const ToolSolid burr = ball_burr(radius);
    bone::LocalCutting cut = cutting(bone, burr);
    for (const bone::CutStretch& step : in_steps({-6.0_mm, 0, -1.0_mm}, {6.0_mm, 0, -1.0_mm}, 0.5_mm)) cut.cut(step);
    const std::vector<double> angles = min_angles_of_walls(cut.surface().mesh());
    ASSERT_GT(angles.size(), 1000U);
    EXPECT_GT(angles[angles.size() / 2], 25.0_deg);
}

}  // namespace
}  // namespace kerf
