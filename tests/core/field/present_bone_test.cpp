// SPDX-License-Identifier: Apache-2.0
// What bone counts, tissue by tissue, and gives back with a snapshot, once and a second time.
#include "core/field/pieces/present_bone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/field/cut/sweep.h"
#include "core/field/pieces/bridge.h"
#include "tests/support/block.h"

namespace kerf {
namespace {

using namespace literals;

constexpr double crumb = 5e-9;  // [m³]

/// A bar of 14 mm along x, 3 mm wide and high, and a saw that takes 1 mm of it.
struct Bar {
    Body body = test::block({-7.0_mm, -1.5_mm, -1.5_mm}, {7.0_mm, 1.5_mm, 1.5_mm}, 0.25_mm);
    Body other = test::block({-1.0_mm, -1.0_mm, -1.0_mm}, {1.0_mm, 1.0_mm, 1.0_mm}, 0.25_mm);
    ToolSolid wall = ToolSolid::prism({{0.0, 0.5_mm}, {-12.0_mm, 0.5_mm}}, 12.0_mm);
    PresentBone bone{body, 4096};
    std::uint64_t sequence = 0;

    Bar() { bone.find_pieces(crumb); }
    void cut_at(double x) {
        CutRecord record;
        record.sequence = sequence++;
        record.from = record.to = {{x, 0, 6.0_mm}, {1, 0, 0, 0}};
        for (const NewSeparation& found : bone.apply(record, wall)) bone.mark_adopted(found.separation);
    }
};

TEST(PresentBone, GivesBackEveryCountWithItsSnapshot) {
    Bar bar;
    const BoneImage before = bar.bone.image();
    bar.cut_at(6.1_mm);  // leaves 0.4 mm at the end, a crumb
    bar.cut_at(0.0);
    (void)bar.bone.add(bar.other);
    const BoneImage after = bar.bone.image();
    const double crumbs = bar.bone.crumb_volume(), removed = bar.bone.removed(), added = bar.bone.added();
    const std::uint64_t hash = bar.bone.hash();
    ASSERT_EQ(bar.bone.crumbs(), 1u);
    ASSERT_EQ(bar.bone.count(), 3u);
    EXPECT_GT(crumbs, 0.0);
    EXPECT_NEAR(added, 8e-9, 0.5e-9);

    for (int time = 0; time < 2; ++time) {
        bar.bone.restore(before);
        EXPECT_EQ(bar.bone.crumbs(), 0u);
        EXPECT_EQ(bar.bone.crumb_volume(), 0.0);
        EXPECT_EQ(bar.bone.removed(), 0.0);
        EXPECT_EQ(bar.bone.added(), 0.0);
        EXPECT_EQ(bar.bone.count(), 1u);
        bar.bone.restore(after);
        EXPECT_EQ(bar.bone.crumbs(), 1u);
        EXPECT_EQ(bar.bone.crumb_volume(), crumbs);
        EXPECT_EQ(bar.bone.removed(), removed);
        EXPECT_EQ(bar.bone.added(), added);
        EXPECT_EQ(bar.bone.count(), 3u);
        EXPECT_EQ(bar.bone.hash(), hash);
    }
}

TEST(PresentBone, SeparatesAgainAfterItsSnapshot) {
    Bar bar;
    const BoneImage before = bar.bone.image();
    std::uint64_t first = 0;
    for (int time = 0; time < 2; ++time) {
        bar.cut_at(2.0_mm);
        ASSERT_EQ(bar.bone.count(), 2u) << time;
        EXPECT_NEAR(bar.bone.removed(), 9e-9, 0.2e-9);
        if (time == 0) first = bar.bone.hash();
        EXPECT_EQ(bar.bone.hash(), first);
        bar.bone.restore(before);
    }
}

TEST(PresentBone, CountsEachTissueAlone) {
    // Given a bar whose second tissue begins at x = 1 mm
    Bar bar;
    bar.body.materials.front().border = LevelSet::build(bar.body.grid(), [](Vec3 p) { return p.x - 1.0_mm; });
    bar.body.materials.push_back({"spongy", 300.0, {}});
    PresentBone bone(bar.body, 4096);
    const auto expect_removed_after = [&](double x, double first, double second) {
        CutRecord record;
        record.sequence = bar.sequence++;
        record.from = record.to = {{x, 0, 6.0_mm}, {1, 0, 0, 0}};
        (void)bone.apply(record, bar.wall);
        EXPECT_NEAR(bone.removed_of_material(0), first, 0.2e-9) << x;
        EXPECT_NEAR(bone.removed_of_material(1), second, 0.2e-9) << x;
        EXPECT_NEAR(bone.removed(), first + second, 0.3e-9) << x;
    };
    expect_removed_after(-3.0_mm, 9e-9, 0.0);
    expect_removed_after(4.0_mm, 9e-9, 9e-9);
    expect_removed_after(1.1_mm, 9e-9 + 3.6e-9, 9e-9 + 5.4e-9);  // 0.4 and 0.6 mm of it
}

// ---- bridges -------------------------------------------------------------------------------------------------------

TEST(Bridge, SpansTheGapToAPieceThatLiesTurned) {
    // Given a piece 0.8 mm over another, upside down and turned by a quarter
    const Body low = test::block({-2.0_mm, -1.0_mm, -4.0_mm}, {2.0_mm, 1.0_mm, 0}, 0.2_mm),
               high = test::block({-1.0_mm, -2.0_mm, -3.0_mm}, {1.0_mm, 2.0_mm, 0}, 0.2_mm);
    const CutField of_low(low, 0), of_high(high, 0);
    const Quat turn = quat_from_rotation_vector({0, 0, 0.5 * pi}) * quat_from_rotation_vector({pi, 0, 0});
    const Pose low_from_high{{0, 0, 0.8_mm}, turn};
    const auto up = bridge_between({&low, &of_low}, {&high, &of_high}, inverse(low_from_high));
    const auto down = bridge_between({&high, &of_high}, {&low, &of_low}, low_from_high);
    ASSERT_TRUE(up && down);
    EXPECT_NEAR(up->span, 0.8_mm, 0.02_mm);
    EXPECT_NEAR(down->span, 0.8_mm, 0.02_mm);
    EXPECT_LT(uncut_distance(up->bone, locate(up->bone, {1.5_mm, 0.5_mm, 0.4_mm})), 0.0);
    EXPECT_LT(uncut_distance(down->bone, locate(down->bone, {0.5_mm, 1.5_mm, 0.4_mm})), 0.0);
}

// ---- poses ---------------------------------------------------------------------------------------------------------

TEST(Between, TakesTheShorterTurnForBothSignsOfAQuaternion) {
    const Pose from{{}, quat_from_rotation_vector({0.2, 0.1, -0.3})};
    const Quat to = quat_from_rotation_vector({0.4, -0.1, 0.2});
    const Pose one = between(from, {{}, to}, 0.5), other = between(from, {{}, {-to.w, -to.x, -to.y, -to.z}}, 0.5);
    EXPECT_NEAR(one.rotation.w, other.rotation.w, 1e-15);
    EXPECT_NEAR(one.rotation.x, other.rotation.x, 1e-15);
    EXPECT_NEAR(one.rotation.y, other.rotation.y, 1e-15);
    EXPECT_NEAR(one.rotation.z, other.rotation.z, 1e-15);
}

TEST(LargestMotion, IsThatOfTheFarthestPointOffTheAxis) {
    // A cylinder of 2 mm from the tip to 30 mm behind it. About x by 0.1: 2 sin 0.05 × √(30² + 2²) mm.
    const ToolSolid tool({{0.0, 2.0_mm}, {-30.0_mm, 2.0_mm}});
    const Pose still{{0.1, 0.2, 0.3}, quat_from_rotation_vector({0.4, -0.9, 0.5})};
    for (const double sense : {1.0, -1.0}) {
        const auto moved = [&](Vec3 by, Vec3 turn) {
            return largest_motion(tool, still, still * Pose{by, quat_from_rotation_vector(sense * turn)});
        };
        EXPECT_NEAR(moved({1.0_mm, 2.0_mm, -2.0_mm}, {}), 3.0_mm, 1e-12);
        EXPECT_NEAR(moved({}, {0.1, 0, 0}), 2.0 * std::sin(0.05) * std::hypot(30.0_mm, 2.0_mm), 1e-9);
        EXPECT_NEAR(moved({}, {0, 0, 0.1}), 2.0 * std::sin(0.05) * 2.0_mm, 1e-9);
    }
}

}  // namespace
}  // namespace kerf
