// SPDX-License-Identifier: Apache-2.0
#include "core/field/cut/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>

#include "tests/support/block.h"

namespace kerf {
namespace {

using namespace literals;

// A burr on a thin shank: the line from a point may enter it twice. It is pushed aside, along and turned.
TEST(Sweep, HoldsWhatTheSolidWasInAndNothingElse) {
    const ToolSolid burr({{0.0, 0.0}, {-1.0_mm, 2.0_mm}, {-3.0_mm, 2.0_mm}, {-3.5_mm, 0.6_mm}, {-9.0_mm, 0.6_mm}});
    ASSERT_FALSE(burr.is_convex());
    const Pose from = test::pointing({0.3_mm, 0, 0}, {0.1, 0.2, -1.0});
    const Pose to = test::pointing({1.4_mm, 0.9_mm, -0.5_mm}, {0.3, 0.1, -1.0});
    const Sweep sweep(burr, from, to, 0.2_mm, 0.4_mm);

    std::mt19937 random(7);
    std::uniform_real_distribution<double> x(-3.0_mm, 4.0_mm), z(-2.0_mm, 10.0_mm);
    int held = 0, only_between = 0;
    for (int n = 0; n < 4000; ++n) {
        const Vec3 p{x(random), x(random), z(random)};
        constexpr int instants = 4000;
        double deepest = -1.0, at_sub_poses = -1.0;
        for (int i = 0; i <= instants; ++i)
            deepest =
                std::max(deepest, -burr.distance(inverse(between(from, to, static_cast<double>(i) / instants)) * p));
        for (int i = 0; i <= sweep.sub_poses(); ++i)
            at_sub_poses = std::max(at_sub_poses, -burr.distance(inverse(sweep.sub_pose(i)) * p));
        EXPECT_LE(deepest, at_sub_poses + sweep.step());
        const double between_instants = 2.0_mm / instants;
        if (deepest > 0.0 || deepest < -between_instants) {
            EXPECT_EQ(sweep.contains(p, 0.0), deepest > 0.0) << n;
        }
        held += deepest > 0.0;
        only_between += deepest > 0.0 && at_sub_poses < 0.0;
    }
    EXPECT_GT(held, 200);
    EXPECT_GT(only_between, 0);
}

TEST(Sweep, WhatItHoldsItMayHoldAndLittleElse) {
    const ToolSolid burr({{0.0, 0.0}, {-1.0_mm, 2.0_mm}, {-3.0_mm, 2.0_mm}, {-3.5_mm, 0.6_mm}, {-9.0_mm, 0.6_mm}});
    const ToolSolid solids[] = {burr, test::drill_outline(1.6_mm, 59.0_deg, 4.0_mm),
                                test::blade_outline(20.0_mm, 2.0_mm, 3.0_mm, 0.9_mm)};
    const Pose from = test::pointing({0.3_mm, 0, 0}, {0.1, 0.2, -1.0});
    const Pose ends[] = {test::pointing({0.35_mm, 0.05_mm, -0.02_mm}, {0.1, 0.21, -1.0}),
                         test::pointing({0.7_mm, 0.4_mm, -0.1_mm}, {0.15, 0.2, -1.0})};
    std::mt19937 random(11);
    std::uniform_real_distribution<double> x(-3.0_mm, 4.0_mm), z(-2.0_mm, 6.0_mm);
    for (const ToolSolid& solid : solids)
        for (const Pose& to : ends) {
            const Sweep sweep(solid, from, to, 0.1_mm, 0.2_mm);
            std::size_t held = 0, may_be_held = 0, missed = 0;
            for (int block = 0; block < 300; ++block) {
                PointBlock points;
                while (points.count < block_capacity) points.add({x(random), x(random), z(random)});
                std::array<bool, block_capacity> may;
                sweep.may_contain(points, 0.0, may);
                for (std::size_t p = 0; p < points.count; ++p) {
                    const bool does = sweep.contains(points[p], 0.0);
                    held += does;
                    may_be_held += may[p];
                    missed += does && !may[p];
                }
            }
            EXPECT_EQ(missed, 0u);
            EXPECT_GT(held, 500u);
            EXPECT_LT(may_be_held, held + held / 3) << sweep.sub_poses() << " sub-poses";
        }
}

// What its land covers needs no sub-poses: to the depth that was asked for, every point of the way is as deep in one of
// the poses as it was at any instant, but for a ridge of half a step.
TEST(Sweep, ASlideAlongTheAxisIsCoveredByItsEnds) {
    constexpr double step = 0.05_mm, depth = 0.4_mm;
    const ToolSolid drill = test::drill_outline(1.6_mm, 59.0_deg, 3.0_mm),
                    blade = test::blade_outline(20.0_mm, 2.0_mm, 3.0_mm, 0.9_mm);
    const Pose from = test::pointing({0, 0, 0}, {0, 0, -1.0});
    struct Way {
        const ToolSolid& solid;
        double along, aside, tilt;
        int sub_poses;
    };
    for (const Way& way :
         {Way{drill, 0.2_mm, 0.0, 0.0, 1}, Way{drill, -0.2_mm, 0.0, 0.0, 1}, Way{drill, 0.5_mm, 0.02_mm, 0.0, 1},
          Way{drill, 0.4_mm, 0.11_mm, 0.0, 5}, Way{drill, 0.2_mm, 0.03_mm, 0.02, 2}, Way{drill, 0.0, 0.11_mm, 0.0, 3},
          Way{blade, 0.2_mm, 0.02_mm, 0.0, 1}}) {
        const Pose to = test::pointing({way.aside, 0, -way.along}, {way.tilt, 0, -1.0});
        const Sweep sweep(way.solid, from, to, step, depth);
        EXPECT_EQ(sweep.sub_poses(), way.sub_poses) << way.along << " along, " << way.aside << " aside";
        std::mt19937 random(3);
        std::uniform_real_distribution<double> x(-3.5_mm, 3.5_mm), z(-1.0_mm, 4.0_mm);
        double worst = 0.0;
        int near = 0;
        for (int n = 0; n < 20000; ++n) {
            const Vec3 p{x(random), x(random), z(random)};
            constexpr int instants = 100;
            double deepest = -1.0, at_sub_poses = -1.0;
            for (int i = 0; i <= instants; ++i)
                deepest = std::max(
                    deepest, -way.solid.distance(inverse(between(from, to, static_cast<double>(i) / instants)) * p));
            for (int i = 0; i <= sweep.sub_poses(); ++i)
                at_sub_poses = std::max(at_sub_poses, -way.solid.distance(inverse(sweep.sub_pose(i)) * p));
            if (deepest < 0.0) continue;
            near += deepest < depth;
            worst = std::max(worst, std::min(deepest, depth) - at_sub_poses);
        }
        EXPECT_GT(near, 200);
        const bool is_straight = way.aside == 0.0 && way.tilt == 0.0;
        EXPECT_LE(worst, is_straight ? 1e-9 : 0.5 * step) << way.along << " along, " << way.aside << " aside";
    }
}

// A burr does not cover its way, nor does a tool whose land is too short, nor one that widens towards its tip.
TEST(Sweep, ASolidWithoutALandIsFollowedStepByStep) {
    const Pose from = test::pointing({0, 0, 0}, {0, 0, -1.0}), to = test::pointing({0, 0, -0.4_mm}, {0, 0, -1.0});
    const ToolSolid burr({{0.0, 0.0}, {-1.0_mm, 2.0_mm}, {-3.0_mm, 2.0_mm}, {-3.5_mm, 0.6_mm}, {-9.0_mm, 0.6_mm}}),
        drill = test::drill_outline(1.6_mm, 59.0_deg, 1.7_mm), cone({{0.0, 0.0}, {-4.0_mm, 3.0_mm}});
    EXPECT_EQ(burr.land(), 0.0);
    EXPECT_EQ(cone.land(), 0.0);
    EXPECT_NEAR(drill.land(), 1.7_mm - 1.6_mm / std::tan(59.0_deg), 1e-9);
    for (const ToolSolid* solid : {&burr, &drill, &cone})
        EXPECT_EQ(Sweep(*solid, from, to, 0.1_mm, 0.4_mm).sub_poses(), 4);
}

TEST(Sweep, AStillSolidHoldsWhatItIsIn) {
    const ToolSolid drill = test::drill_outline(1.6_mm, 59.0_deg, 10.0_mm);
    const Pose pose = test::pointing({0, 0, 0}, {0, 0, -1.0});
    const Sweep sweep(drill, pose, pose, 0.1_mm, 0.2_mm);
    EXPECT_EQ(sweep.sub_poses(), 1);
    EXPECT_TRUE(sweep.contains({0, 0, 3.0_mm}, 0.0));
    EXPECT_FALSE(sweep.contains({0, 0, -1.0_mm}, 0.0));
}

}  // namespace
}  // namespace kerf
