// SPDX-License-Identifier: Apache-2.0
// What `displace` cannot make: it declines, and `local` cuts.
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>

#include "tests/plugins/burring/displace/displacing.h"
#include "tests/support/sawn_tube.h"

namespace kerf {
namespace {

using namespace literals;
using chart::ball_burr, chart::burr_at, test::euler_of, chart::in_steps, chart::slab;

constexpr double radius = 2.0_mm;

using Fallback = test::Displacing;

TEST_F(Fallback, APlateIsNotPiercedByDisplacement) {
    bone::RemeshRequest request;
    request.base = bone::tagged(slab(12.0_mm, 10.0_mm, 1.0_mm, 0.7_mm));
    const ToolSolid burr = ball_burr(radius);
    request.solids = {&burr};
    request.cuts = {{burr_at({0, 0, 1.0_mm}), burr_at({0, 0, -1.5_mm}), 0}};
    const bone::RemeshResult result = displace(request);
    EXPECT_EQ(result.status, KERF_REMESH_DECLINED);
    EXPECT_NE(result.message.find("another wall"), std::string::npos) << result.message;
}

TEST_F(Fallback, ABurrThroughAPlateOpensAHole) {
    // S-11: 1 mm of bone, a ball of 4 mm in steps of 0.25 mm, all the way through
    const bone::TaggedMesh plate = bone::tagged(slab(12.0_mm, 10.0_mm, 1.0_mm, 0.7_mm));
    ASSERT_EQ(euler_of(plate.mesh), 2);
    const ToolSolid burr = ball_burr(radius);
    bone::LocalCutting cut = cutting_with_local(plate, burr);
    for (const bone::CutStretch& step : in_steps({0.1_mm, 0.2_mm, 0.5_mm}, {0.1_mm, 0.2_mm, -5.75_mm}, 0.25_mm))
        EXPECT_TRUE(cut.cut(step));
    EXPECT_EQ(flaw_of(plate, cut), "");
    EXPECT_GE(cut.handed_over(), 1);
    EXPECT_LT(cut.handed_over(), 12) << "before it breaks through, and in the open hole, the surface is displaced";
    const bone::SurfaceMesh mesh = cut.surface().mesh().mesh;
    EXPECT_EQ(euler_of(mesh), 0) << "one hole: genus 1";
    EXPECT_EQ(bone::pieces_of(mesh, bone::half_edges_of(mesh)).count, 1U);
    const double by_hand = std::numbers::pi * radius * radius * 1.0_mm;
    EXPECT_NEAR(cut.removed(), by_hand, 0.02 * by_hand);
}

TEST_F(Fallback, AWallInTheWayOfTheBurrIsLeftToLocal) {
    // Two plates 0.5 mm apart: the burr goes through one into the other in one step.
    const bone::SurfaceMesh upper = slab(12.0_mm, 10.0_mm, 1.0_mm, 0.7_mm);
    bone::SurfaceMesh both = upper;
    for (const Vec3 v : upper.vertices) both.vertices.push_back(v - Vec3{0.05_mm, 0.03_mm, 1.5_mm});
    const auto first = static_cast<std::uint32_t>(upper.vertices.size());
    for (const bone::Triangle& t : upper.triangles)
        both.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    const bone::TaggedMesh plates = bone::tagged(std::move(both));
    const ToolSolid burr = ball_burr(radius);
    bone::LocalCutting cut = cutting_with_local(plates, burr);
    EXPECT_TRUE(cut.cut({burr_at({0, 0, 1.0_mm}), burr_at({0, 0, -2.0_mm}), 0}));
    EXPECT_EQ(flaw_of(plates, cut), "");
    EXPECT_EQ(cut.handed_over(), 1);
    const bone::SurfaceMesh mesh = cut.surface().mesh().mesh;
    EXPECT_EQ(bone::pieces_of(mesh, bone::half_edges_of(mesh)).count, 2U);
    EXPECT_EQ(euler_of(mesh), 2 + 0) << "the upper one has a hole, the lower one a dimple";
}

TEST_F(Fallback, ABladeIsLeftToLocal) {
    const bone::TaggedMesh bone = bone::tagged(test::bent_bone(8000.0));
    const ToolSolid blade = test::slot_blade();
    bone::LocalCutting cut = cutting_with_local(bone, blade);
    EXPECT_TRUE(cut.cut({test::blade_at(0.0, -13.0_mm), test::blade_at(0.0, -5.0_mm), 0}));
    EXPECT_EQ(cut.handed_over(), 1);
    EXPECT_EQ(cut.hand_over_reason(), "a blade is no burr: its slot has edges");
    EXPECT_EQ(flaw_of(bone, cut), "");
}

TEST_F(Fallback, StrokesInAllDirectionsStayClosed) {
    // Strokes of random depth and direction over one place, some of them through the wall of a hollow bone.
    const bone::SurfaceMesh outer = test::bent_bone(8000.0);
    const bone::TaggedMesh bone = bone::tagged(outer);
    const ToolSolid burr = ball_burr(1.5_mm);
    bone::LocalCutting cut = cutting_with_local(bone, burr);
    std::mt19937 random(21);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    std::vector<bone::CutStretch> cuts;
    for (int n = 0; n < 15; ++n) {
        const auto place = [&] {
            return Vec3{4.0_mm * any(random), 2.0_mm + 3.0_mm * any(random), 8.2_mm + 0.6_mm * any(random)};
        };
        const Quat down = quat_from_rotation_vector({0.3 * any(random), 0.3 * any(random), 0.0}) *
                          quat_between({0, 0, 1}, {0, 0, -1});
        cuts.push_back({{place(), down}, {place(), down}, 0});
        EXPECT_TRUE(cut.cut(cuts.back())) << n;
    }
    EXPECT_EQ(flaw_of(bone, cut), "");
    const double exact = locally_removed(bone, burr, cuts);
    EXPECT_NEAR(cut.removed(), exact, 3e-3 * exact);
}

}  // namespace
}  // namespace kerf
