// SPDX-License-Identifier: Apache-2.0
#include "core/field/cut/tool_solid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/support/block.h"

namespace kerf {
namespace {

using namespace literals;

// A cone of 45° and radius 2 mm, on a cylinder that ends 10 mm behind the tip.
const ToolSolid tool = test::drill_outline(2.0_mm, 45.0_deg, 10.0_mm);

TEST(ToolSolid, DistanceIsThatOfConeWallAndCap) {
    EXPECT_NEAR(tool.distance({0, 0, 1.0_mm}), 1.0_mm, 1e-15);                     // ahead of the tip
    EXPECT_NEAR(tool.distance({3.0_mm, 0, -5.0_mm}), 1.0_mm, 1e-15);               // beside the wall
    EXPECT_NEAR(tool.distance({0, 1.5_mm, -5.0_mm}), -0.5_mm, 1e-15);              // inside, near the wall
    EXPECT_NEAR(tool.distance({0, 0, -11.0_mm}), 1.0_mm, 1e-15);                   // behind the cap
    EXPECT_NEAR(tool.distance({0, 0, -1.0_mm}), -1.0_mm / std::sqrt(2.0), 1e-15);  // on the axis, below the cone
}

TEST(ToolSolid, DistanceToATubeIsThatOfBothWalls) {
    const ToolSolid tube = ToolSolid::hollow({{0.0, 4.0_mm}, {-10.0_mm, 4.0_mm}}, 3.0_mm);
    EXPECT_NEAR(tube.distance({3.4_mm, 0, -5.0_mm}), -0.4_mm, 1e-15) << "nearer to the bore";
    EXPECT_NEAR(tube.distance({0, 3.7_mm, -5.0_mm}), -0.3_mm, 1e-15) << "nearer to the side";
    EXPECT_NEAR(tube.distance({3.5_mm, 0, -0.2_mm}), -0.2_mm, 1e-15) << "nearer to the rim";
    EXPECT_NEAR(tube.distance({1.0_mm, 0, -5.0_mm}), 2.0_mm, 1e-15) << "in the bore";
    EXPECT_NEAR(tube.distance({6.0_mm, 0, -5.0_mm}), 2.0_mm, 1e-15);
    EXPECT_NEAR(tube.distance({3.5_mm, 0, 1.0_mm}), 1.0_mm, 1e-15) << "before the rim";
    EXPECT_FALSE(tube.is_convex());
}

TEST(ToolSolid, APointLeavesATubeIntoItsBore) {
    const ToolSolid tube = ToolSolid::hollow({{0.0, 4.0_mm}, {-10.0_mm, 4.0_mm}}, 3.0_mm);
    EXPECT_NEAR(tube.travel_to_leave({3.4_mm, 0, -5.0_mm}, {-1, 0, 0}), 0.4_mm, 1e-12);
    EXPECT_NEAR(tube.travel_to_leave({3.4_mm, 0, -5.0_mm}, {1, 0, 0}), 0.6_mm, 1e-12);
    EXPECT_NEAR(tube.travel_to_leave({3.4_mm, 0, -5.0_mm}, {0, 0, 1}), 5.0_mm, 1e-12);
    EXPECT_EQ(tube.travel_to_leave({1.0_mm, 0, -5.0_mm}, {1, 0, 0}), 0.0) << "it is in no bone's way";
    const Vec3 in = tube.inward_direction({3.2_mm, 0, -5.0_mm});
    EXPECT_NEAR(in.x, 1.0, 1e-12) << "away from the bore";
}

TEST(ToolSolid, IsNotWhereAGapIs) {
    const ToolSolid heads = ToolSolid::parts({{0.0, 3.0_mm}, {-10.0_mm, 3.0_mm}}, 0.0, {{-4.0_mm, -6.0_mm}});
    EXPECT_NEAR(heads.distance({0, 0, -5.0_mm}), 1.0_mm, 1e-15) << "between the heads";
    EXPECT_NEAR(heads.distance({0, 0, -3.5_mm}), -0.5_mm, 1e-15) << "at the end of the first";
    EXPECT_NEAR(heads.distance({0, 0, -6.2_mm}), -0.2_mm, 1e-15) << "at the front of the second";
    EXPECT_NEAR(heads.travel_to_leave({0, 0, -2.0_mm}, {0, 0, -1}), 2.0_mm, 1e-12);
    EXPECT_NEAR(heads.travel_to_leave({0, 0, -8.0_mm}, {0, 0, 1}), 2.0_mm, 1e-12);
    EXPECT_FALSE(heads.is_convex());
    const std::vector<ToolSolid> parts = heads.each_part();
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_EQ(parts[0].tip_z(), 0.0);
    EXPECT_EQ(parts[0].end_z(), -4.0_mm);
    EXPECT_EQ(parts[1].tip_z(), -6.0_mm);
    EXPECT_EQ(parts[1].end_z(), -10.0_mm);
    for (const ToolSolid& part : parts) EXPECT_EQ(part.largest_radius(), 3.0_mm);
}

TEST(ToolSolid, APointLeavesAlongTheAxisThroughTheCone) {
    // At radius 1 mm the cone's face is 1 mm behind the tip.
    EXPECT_NEAR(tool.travel_to_leave({1.0_mm, 0, -4.0_mm}, {0, 0, 1}), 3.0_mm, 1e-12);
    EXPECT_NEAR(tool.travel_to_leave({1.0_mm, 0, -4.0_mm}, {1, 0, 0}), 1.0_mm, 1e-12);
    EXPECT_NEAR(tool.travel_to_leave({1.0_mm, 0, -4.0_mm}, {0, 0, -1}), 6.0_mm, 1e-12);
}

TEST(ToolSolid, OutsideThereIsNothingToLeave) { EXPECT_EQ(tool.travel_to_leave({3.0_mm, 0, -4.0_mm}, {0, 0, 1}), 0.0); }

TEST(ToolSolid, EndsExactlyOnItsSurfaceAfterThatTravel) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 p{2.0_mm * unit(random), 2.0_mm * unit(random), -5.0_mm + 5.0_mm * unit(random)};
        if (tool.distance(p) > -1e-6) continue;
        const Vec3 direction = normalized(Vec3{unit(random), unit(random), unit(random)});
        const double travel = tool.travel_to_leave(p, direction);
        EXPECT_NEAR(tool.distance(p + travel * direction), 0.0, 1e-12) << i;
        EXPECT_LT(tool.distance(p + 0.5 * travel * direction), 1e-12) << "convex: the way there lies inside";
    }
}

TEST(ToolSolid, NoPointOutsideGainsMoreDepthThanIsSaid) {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const ToolSolid blade = ToolSolid::prism({{0.0, 6.0_mm}, {-2.0_mm, 8.0_mm}, {-12.0_mm, 8.0_mm}}, 1.0_mm);
    const ToolSolid taper({{0.0, 0.0}, {-1.0_mm, 2.0_mm}, {-8.0_mm, 4.0_mm}});
    for (const ToolSolid* solid : {&tool, &blade, &taper}) {
        constexpr double reach = 0.12_mm;  // farther out, none ends inside
        int gained = 0, near_it = 0;
        for (int n = 0; n < 1000000; ++n) {
            const Vec3 p = {9.0_mm * unit(random), 9.0_mm * unit(random),
                            solid->end_z() + 7.0_mm * (1.0 + unit(random))};
            const double before = -solid->distance(p);
            if (before > 0.0 || before < -reach) continue;
            // Mostly along the axis, as tools go, and to and fro.
            const double lateral = n % 3 == 0 ? 0.1_mm : 0.001_mm, turn = n % 2 == 0 ? 0.0 : 0.002;
            const Pose moved{
                {lateral * unit(random), lateral * unit(random), 0.1_mm * unit(random)},
                quat_from_rotation_vector({turn * unit(random), turn * unit(random), turn * unit(random)})};
            const double after = -solid->distance(moved * p), gain = after - before,
                         most = solid->max_depth_gain_outside(moved);
            if (after < 0.0) continue;
            ASSERT_LE(gain, most + 1e-15) << n;
            ++near_it;
            gained += gain > 0.5 * most;
        }
        EXPECT_GT(near_it, 200);
        EXPECT_GT(gained, 50) << "and not much too large";
    }
    const Pose on{{0, 0, 0.1_mm}, {1, 0, 0, 0}};
    EXPECT_EQ(tool.max_depth_gain_outside(on), 0.0) << "the tool advances: where it stands is as deep as it gets";
    const ToolSolid drop({{0.0, 0.0}, {-2.0_mm, 2.0_mm}, {-4.0_mm, 1.0_mm}});
    EXPECT_NEAR(drop.max_depth_gain_outside(on), 0.1_mm, 1e-15) << "its back looks backwards";
}

TEST(ToolSolid, NoPointOfABoxGainsMoreDepthThanIsSaid) {
    const ToolSolid solids[] = {test::drill_outline(1.6_mm, 59.0_deg, 4.0_mm),
                                ToolSolid({{0.0, 0.5_mm}, {-0.4_mm, 1.0_mm}, {-2.0_mm, 1.2_mm}, {-4.0_mm, 1.2_mm}}),
                                ToolSolid({{0.0, 2.0_mm}, {-4.0_mm, 2.0_mm}}),
                                ToolSolid({{0.0, 0.3_mm}, {-1.0_mm, 1.5_mm}, {-4.0_mm, 1.5_mm}})};
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const auto vector = [&] { return Vec3{unit(random), unit(random), unit(random)}; };
    int negative = 0, tight = 0;
    for (int i = 0; i < 20000; ++i) {
        const ToolSolid& solid = solids[i % 4];
        const Vec3 half = 0.4_mm * Vec3{std::abs(unit(random)), std::abs(unit(random)), std::abs(unit(random))};
        const Vec3 middle{2.5_mm * unit(random), 2.5_mm * unit(random), -2.0_mm + 2.5_mm * unit(random)};
        const Vec3 moved = std::pow(10.0, -4.0 + unit(random)) * vector();
        const double spread = i % 3 == 0 ? 0.0 : 0.1 * length(moved), deepest = i % 2 == 0 ? 0.3_mm : 1.0;
        const double most = solid.max_depth_gain(middle, half, moved, spread, deepest);
        double found = -HUGE_VAL;
        for (int n = 0; n < 20; ++n) {
            const Vec3 aside = vector(), p = middle + Vec3{aside.x * half.x, aside.y * half.y, aside.z * half.z};
            const Vec3 before = p - moved - (0.5 * spread) * vector();
            if (-solid.distance(before) > deepest) continue;
            found = std::max(found, solid.distance(before) - solid.distance(p));
        }
        ASSERT_LE(found, most + 1e-12) << "solid " << i % 4;
        negative += most < 0.0;
        tight += found > most - 0.3 * length(moved);
    }
    EXPECT_GT(negative, 3000) << "it says less than that nothing moves faster than the solid";
    EXPECT_GT(tight, 5000);
}

}  // namespace
}  // namespace kerf
