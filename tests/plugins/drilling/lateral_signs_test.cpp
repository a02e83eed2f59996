// SPDX-License-Identifier: Apache-2.0
// Signs of all that acts across a drill's axis, from every side, through the running simulation. Tool frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/support/drill_rig.h"
#include "tests/support/rig.h"

namespace kerf {
namespace {

using namespace literals;

constexpr Vec3 z{0, 0, 1};
constexpr std::array<Vec3, 4> sides{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}}};  // world frame

struct Felt {
    Vec3 force{}, torque{};  ///< of the bone on the tool, about its tip
};
Felt in_tool(const Simulation& simulation, const Vec6& wrench) {
    const Quat tool_from_world = conjugate(simulation.world_from_tool().rotation);
    return {rotate(tool_from_world, linear(wrench)), rotate(tool_from_world, angular(wrench))};
}

/// A block that lies at one side of the plane through the axis.
Body half_block(Vec3 side) {
    Vec3 low{-6.0_mm, -6.0_mm, -6.0_mm}, high{6.0_mm, 6.0_mm, 0};
    if (side.x > 0.0) low.x = 0.0;
    if (side.x < 0.0) high.x = 0.0;
    if (side.y > 0.0) low.y = 0.0;
    if (side.y < 0.0) high.y = 0.0;
    return test::block(low, high, 0.125_mm, {0.31, 0.17, 0.73});
}

TEST(DrillInHalfABlock, IsPushedOutAndAgainstItsTurn) {
    for (const Vec3& side : sides) {
        // Given bone at one side, and a drill of which only the point is in it
        test::Rig simulation(half_block(side), test::twist_drill({{"diameter", 3.2_mm}, {"motor_torque", 20.0}}),
                             test::at_depth(-0.05_mm));
        Felt mean;
        double thrust = 0.0;
        for (double depth = -0.05_mm; depth < 0.8_mm; depth += 1.0_um) {
            const TickResult r = simulation.tick_direct({test::at_depth(depth)});
            if (depth < 0.5_mm) continue;  // five turns from there on
            const Felt felt = in_tool(simulation, r.bone_on_tool);
            mean.force = mean.force + felt.force;
            mean.torque = mean.torque + felt.torque;
            thrust += r.thrust;
        }
        const Vec3 bone = rotate(conjugate(simulation.world_from_tool().rotation), side);
        ASSERT_GT(thrust, 0.0);
        EXPECT_NEAR(mean.force.z, -thrust, 1e-6 * thrust);
        // Its cone presses the bone outwards, and is pressed away from it
        EXPECT_LT(dot(mean.force, bone), -0.05 * thrust) << "side " << side.x << ' ' << side.y;
        // Its lips go the way z × r there, and are held back
        EXPECT_LT(dot(mean.force, cross(z, bone)), -0.05 * thrust) << "side " << side.x << ' ' << side.y;
        EXPECT_LT(mean.torque.z, 0.0);
        // The side in bone is pushed back: r × (−thrust z), at about the middle of its radius
        EXPECT_GT(dot(mean.torque, cross(z, bone)), 0.3_mm * thrust) << "side " << side.x << ' ' << side.y;
        EXPECT_LT(dot(mean.torque, cross(z, bone)), 1.6_mm * thrust) << "side " << side.x << ' ' << side.y;
    }
}

TEST(DrillInItsHole, IsResistedAlikeWhicheverWayItIsMoved) {
    std::array<double, sides.size()> along{}, lever{};
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const Vec3 side = sides[i];
        test::Rig simulation(
            test::block({-6.0_mm, -6.0_mm, -12.0_mm}, {6.0_mm, 6.0_mm, 0}, 0.25_mm, {0.31, 0.17, 0.73}),
            test::twist_drill({{"diameter", 3.2_mm}, {"motor_torque", 20.0}}), test::at_depth(-0.5_mm));
        (void)simulation.feed(-0.5_mm, 5.0_mm, 2.0_um);
        Felt sum;
        int count = 0;
        for (double aside = 0.0; aside < 0.6_mm; aside += 1.0_um) {
            const TickResult r = simulation.tick_direct({test::at_depth(5.0_mm, 0.0, aside * side)});
            if (aside < 0.3_mm) continue;
            const Felt felt = in_tool(simulation, r.bone_on_tool);
            sum.force = sum.force + felt.force;
            sum.torque = sum.torque + felt.torque;
            ++count;
        }
        const Vec3 way = rotate(conjugate(simulation.world_from_tool().rotation), side);
        along[i] = dot(sum.force, way) / count;
        // What resists lies behind the tip: −|z| z × (−f way) = |z| f (z × way)
        lever[i] = dot(sum.torque, cross(z, way)) / count / -along[i];
        EXPECT_LT(along[i], -3.0) << "N, against the motion, side " << side.x << ' ' << side.y;
        EXPECT_GT(lever[i], 0.2_mm) << side.x << ' ' << side.y;
        EXPECT_LT(lever[i], 5.0_mm) << side.x << ' ' << side.y;
    }
    const auto [strongest, weakest] = std::minmax_element(along.begin(), along.end());
    EXPECT_NEAR(*strongest / *weakest, 1.0, 0.05) << "a block is the same to every side";
}

}  // namespace
}  // namespace kerf
