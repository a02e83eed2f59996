// SPDX-License-Identifier: Apache-2.0
// A hand faster than a voxel a tick: nothing is jumped, nothing is missed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <string_view>

#include "tests/support/drill_rig.h"
#include "tests/support/probe.h"
#include "tests/support/rig.h"

namespace kerf {
namespace {

using namespace literals;

// S-04: 1 m/s at a plate of 0.5 mm, one millimetre a tick, at any phase.
TEST(FastMotion, AProbeDoesNotPassThroughAThinPlate) {
    const Body body = test::block({-4.0_mm, -4.0_mm, -0.5_mm}, {4.0_mm, 4.0_mm, 0}, 0.25_mm, {0.3, 0.6, 0.2});
    const ToolSetup setup = test::probe(500.0_N_per_mm);
    std::mt19937 random(4);
    for (int i = 0; i < 200; ++i) {
        const double phase = static_cast<double>(random()) / 4294967296.0;
        double depth = -3.0_mm - phase * 1.0_mm;
        test::Rig simulation(body, setup, test::at_depth(depth), test::gains(1.0));
        double felt = 0.0;
        for (int t = 0; t < 8; ++t) {
            depth += 1.0_mm;
            felt = std::max(felt, simulation.tick({test::at_depth(depth)}).thrust);
        }
        EXPECT_GT(felt, 0.1) << "phase " << phase;
        EXPECT_GT(simulation.world_from_tool().position.z, -0.1_mm) << "it stands on the plate, phase " << phase;
    }
}

TEST(FastMotion, ItIsDoneInPartsOnlyWithBoneInReach) {
    test::Rig simulation(test::block({-4.0_mm, -4.0_mm, -8.0_mm}, {4.0_mm, 4.0_mm, 0}, 0.25_mm), test::twist_drill(),
                         test::at_depth(-60.0_mm));
    int max_far = 0, max_near = 0;
    for (double depth = -60.0_mm; depth < -2.0_mm; depth += 0.5_mm) {
        const TickResult r = simulation.tick({test::at_depth(depth)});
        (-simulation.world_from_tool().position.z < -20.0_mm ? max_far : max_near) =
            std::max(-simulation.world_from_tool().position.z < -20.0_mm ? max_far : max_near, r.parts);
    }
    EXPECT_EQ(max_far, 1);
    EXPECT_GE(max_near, 4) << "0.5 mm a tick, an eighth of a millimetre a part";
    EXPECT_LE(max_near, 16);
}

TEST(FastMotion, AToolThatBoneResistsIsNoFasterThanAMetreASecond) {
    test::Rig simulation(test::block({-4.0_mm, -4.0_mm, -8.0_mm}, {4.0_mm, 4.0_mm, 0}, 0.5_mm),
                         test::probe(500.0_N_per_mm), test::at_depth(-30.0_mm, 0.0, {0, 0, 0}), test::gains(1.0));
    Pose last = simulation.world_from_tool();
    int resisted = 0;
    for (int t = 0; t < 40; ++t) {
        const TickResult r = simulation.tick({test::at_depth(-30.0_mm + 5.0_mm * t)});
        const Pose now = simulation.world_from_tool();
        if (last.position.z < 4.0_mm) {
            const bool was_resisted = length(linear(r.bone_on_tool)) > 0.0;
            EXPECT_LE(length(now.position - last.position), (was_resisted ? 1.0_mm : 4.0_mm) * (1.0 + 1e-9))
                << t << ": sixteen parts of half a voxel, or a metre a second";
            resisted += was_resisted;
        }
        last = now;
    }
    EXPECT_GT(resisted, 20);
    EXPECT_GT(last.position.z, -0.2_mm) << "and it met the bone";
}

TEST(FastMotion, WhileTooMuchWaitsToBeCommittedTheToolIsSlowerThanTheHand) {
    // Given bone that gives way to anything, on a grid so fine that half a metre a second sideways is more than can be
    // stamped
    constexpr double h = 0.12_mm;
    Body body = test::block({-4.0_mm, -3.0_mm, -4.0_mm}, {14.0_mm, 3.0_mm, 0}, h, {0.1, 0.4, 0.8});
    body.materials[0].density = 5.0;
    const ToolSetup setup = test::twist_drill({{"run_up", 0.0}});
    Simulation simulation(body, setup, test::rigid_outline(setup), test::gains(), test::at_depth(-0.5_mm));
    double depth = -0.5_mm, x = 0.0;
    const auto go = [&] {
        const TickResult r = simulation.tick({test::at_depth(depth, 0.0, {x, 0, 0})});
        return r;
    };
    for (; depth < 3.0_mm; depth += 0.01_mm) (void)go();

    int behind = 0, said = 0;
    for (; x < 10.0_mm; x += 0.5_mm) {
        const bool was_behind = simulation.tracker().is_behind();
        const Pose from = simulation.world_from_tool();
        const TickResult r = go();
        for (std::size_t e = 0; e < r.event_count; ++e) said += std::string_view(r.events[e]) == "haptics.held_back";
        if (!was_behind) continue;
        ++behind;
        EXPECT_EQ(r.parts, 1);
        EXPECT_LE(largest_motion(simulation.outline().whole, from, simulation.world_from_tool()), 0.5 * h * 1.001);
    }
    EXPECT_GT(behind, 5);
    EXPECT_GE(said, 1);
    EXPECT_LT(said, behind) << "once each time";

    // Then it comes after, and all of it is gone
    for (int i = 0; i < 400; ++i) (void)go();
    EXPECT_FALSE(simulation.tracker().is_behind());
    EXPECT_GT(simulation.world_from_tool().position.x, 9.0_mm);
    simulation.finish();
    EXPECT_TRUE(simulation.committed().same_bits(simulation.exact()));
}

// The tool outruns the field's resolution, yet what it swept is gone.
TEST(FastMotion, APushThroughSoftBoneLeavesNothingStanding) {
    Body body = test::block({-5.0_mm, -5.0_mm, -6.0_mm}, {5.0_mm, 5.0_mm, 0}, 0.5_mm, {0.1, 0.4, 0.8});
    body.materials[0].density = 5.0;  // next to nothing: the drill falls through
    test::Rig simulation(body, test::twist_drill(), test::at_depth(-2.0_mm));
    for (int i = 0; i < 100; ++i) {  // it runs up
        (void)simulation.tick({test::at_depth(-2.0_mm)});
    }
    int most = 0;
    for (double depth = -2.0_mm; depth < 14.0_mm; depth += 1.0_mm) {
        most = std::max(most, simulation.tick({test::at_depth(depth)}).parts);
    }
    for (int i = 0; i < 60; ++i) {
        (void)simulation.tick({test::at_depth(14.0_mm)});
    }
    simulation.finish();
    ASSERT_GE(most, 3);
    // Voxels are counted by their distance to the wall; where it bends that is h²/24 too much for each length of it: π
    // h²/12 of the hole's area, 0.8 % here.
    const double radius = 1.6_mm, h = 0.5_mm, area = pi * (radius * radius + h * h / 12.0);
    EXPECT_NEAR(simulation.present().removed() / (area * 6.0_mm), 1.0, 0.005);
    EXPECT_TRUE(simulation.committed().same_bits(simulation.exact()));
}

}  // namespace
}  // namespace kerf
