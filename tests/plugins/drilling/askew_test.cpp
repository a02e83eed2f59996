// SPDX-License-Identifier: Apache-2.0
// A drill that meets bone askew is pushed aside and walks: where to is a matter of the law, not of the grid.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "tests/support/drill_rig.h"
#include "tests/support/rig.h"

namespace kerf {
namespace {

using namespace literals;

struct Bored {
    Body body;
    ToolSetup setup = test::twist_drill({{"diameter", 5.4_mm}});
    Simulation simulation;

    int turned_back = 0;  ///< ticks in which the tip went back on the way of the tick before, by more than 10 µm

    Bored(double spacing, double tilt, double depth, double feed = 1.0_mm_per_s)
        : body(test::block({-8.0_mm, -8.0_mm, -14.0_mm}, {8.0_mm, 8.0_mm, 0}, spacing, {0.31, 0.17, 0.73})),
          simulation(body, setup, test::rigid_outline(setup), test::gains(), test::at_depth(-0.1_mm, tilt)) {
        body.materials = {{"bone", 1000.0, {}}};
        Vec3 last{0, 0, 0};
        for (double hand = -0.1_mm; hand < depth; hand += feed * Simulation::dt) {
            const Vec3 from = simulation.world_from_tool().position;
            (void)simulation.tick({test::at_depth(hand, tilt)});
            const Vec3 way = simulation.world_from_tool().position - from;
            turned_back += dot(way, last) < 0.0 && std::min(length(way), length(last)) > 10.0_um;
            last = way;
        }
    }
};

/// How far apart two end.
double apart(const Bored& a, const Bored& b) {
    return length(a.simulation.world_from_tool().position - b.simulation.world_from_tool().position);
}

TEST(Askew, ADrillWalksTheSameWayOnEveryGrid) {
    for (const double feed : {1.0_mm_per_s, 4.0_mm_per_s}) {
        constexpr double tilt = 10.0_deg, depth = 8.0_mm;
        const Bored coarse(0.5_mm, tilt, depth, feed), fine(0.25_mm, tilt, depth, feed),
            finest(0.125_mm, tilt, depth, feed);
        const Vec3 aside = finest.simulation.world_from_tool().position - test::at_depth(depth, tilt).position;
        EXPECT_GT(std::hypot(aside.x, aside.y), 0.2_mm) << "it does walk, at " << feed;
        EXPECT_LT(apart(fine, finest), 0.01_mm) << feed;
        EXPECT_LT(apart(coarse, finest), 0.0625_mm)
            << feed << ": as well as its own wall is known, an eighth of a voxel";
        EXPECT_EQ(coarse.turned_back + fine.turned_back + finest.turned_back, 0) << "it does not shake, at " << feed;
    }
}

// Pushed at 8 mm/s on a slope of 30° whole bone takes no drill: it skids, and its lips catch and let go. That is the
// drill's own motion: shorter ticks do not calm it. A catch lasts 3 ms, so ticks of 1 ms make a third too much of it.
TEST(Askew, ADrillThatSkidsChattersByItselfAndNotByTheTick) {
    struct Skid {
        double speed = 0.0;  ///< [m/s] RMS of the tip across, of the second half
        Vec3 end{};
    };
    const auto skid = [](double period) {
        constexpr double tilt = 30.0_deg, feed = 8.0_mm_per_s;
        test::Rig simulation(
            test::block({-7.0_mm, -5.0_mm, -10.0_mm}, {14.0_mm, 5.0_mm, 0}, 0.25_mm, {0.31, 0.17, 0.73}),
            test::twist_drill({{"diameter", 5.4_mm}, {"motor_torque", 20.0}}), test::at_depth(-2.6_mm, tilt),
            test::gains(), period);
        const auto ticks = static_cast<int>(std::lround(1.2 / period));
        Skid found;
        for (int tick = 0; tick < ticks; ++tick) {
            const Vec3 from = simulation.world_from_tool().position;
            (void)simulation.tick({test::at_depth(-2.6_mm + feed * (tick + 1) * period, tilt)});
            const double across = (simulation.world_from_tool().position.x - from.x) / period;
            if (tick >= ticks / 2) found.speed += across * across / (0.5 * ticks);
        }
        found.speed = std::sqrt(found.speed);
        found.end = simulation.world_from_tool().position;
        return found;
    };
    const Skid usual = skid(1.0_ms), half = skid(0.5_ms), eighth = skid(0.125_ms);
    EXPECT_GT(eighth.speed, 15.0_mm_per_s) << "it does chatter: it skids at 5 mm/s";
    EXPECT_NEAR(half.speed / eighth.speed, 1.0, 0.15);
    EXPECT_LT(usual.speed / eighth.speed, 1.5);
    EXPECT_LT(length(usual.end - eighth.end), 0.2_mm);
}

// The land stands at the front of the hole it cuts: how far the committed cut lags is not felt.
TEST(Askew, InItsOwnHoleTheLandMeetsTheSameWallOnEveryGrid) {
    const auto held_aside = [](double spacing) {
        const Bored bored(spacing, 0.0, 6.0_mm);
        double least = 1e300;  // [N] of the edges, of four ways
        int ways = 0;
        for (const kerf_channel& c : test::law_now(bored.simulation))
            if (c.kind == KERF_CUT && c.d[2] == 0.0) {
                least = std::min(least, c.tau);
                ++ways;
            }
        EXPECT_EQ(ways, 4) << spacing;
        return least;
    };
    const double coarse = held_aside(0.5_mm), fine = held_aside(0.125_mm);
    EXPECT_GT(fine, 1.0);
    EXPECT_NEAR(coarse / fine, 1.0, 0.02);
}

// Pulled aside, a bit bends and lies deep in the wall of its hole: deeper than a fine grid knows distances. Its hole
// holds it all the same.
TEST(PulledAside, TheHoleHoldsADrillAsFirmlyOnEveryGrid) {
    const auto tip = [](const ToolSetup& setup, double spacing) {
        Body body = test::block({-5.0_mm, -5.0_mm, -24.0_mm}, {8.0_mm, 5.0_mm, 0}, spacing, {0.31, 0.17, 0.73});
        body.materials = {{"bone", 300.0, {}}};
        test::Rig simulation(body, setup, test::at_depth(-0.1_mm), test::gains(0.05));
        for (double depth = -0.1_mm; depth < 20.0_mm; depth += 4.0_um) {
            const double aside = 4.0_mm * std::clamp((depth - 8.0_mm) / 8.0_mm, 0.0, 1.0);
            (void)simulation.tick({test::at_depth(depth, 0.0, {aside, 0, 0})});
        }
        return simulation.world_from_tool().position;
    };
    const ToolSetup drill = test::twist_drill({{"diameter", 3.2_mm}});
    const Vec3 coarse = tip(drill, 0.5_mm), fine = tip(drill, 0.25_mm), finest = tip(drill, 0.125_mm);
    EXPECT_GT(finest.x, -1.0_mm) << "the hole holds it";
    EXPECT_LT(finest.x, -0.05_mm) << "and gives a little, to the other side: it turns about the rim of its hole";
    EXPECT_LT(length(coarse - finest), 0.0625_mm);
    EXPECT_LT(length(fine - finest), 0.01_mm);
    // Behind a short and thin pilot nearly all of a step drill's shank is as wide, and held as firmly.
    const Vec3 stepped = tip(
        test::step_drill({{"diameter", 1.0_mm}, {"shoulder_diameter", 3.2_mm}, {"shoulder_depth", 1.0_mm}}), 0.125_mm);
    EXPECT_NEAR(stepped.x, finest.x, 0.1_mm);
}

/// A drill in bone, pulled aside and let back.
struct Pull {
    std::vector<double> force;  ///< [N] across, of the bone on the tool, millimetre by millimetre
    double back_in_the_middle = 0.0;

    Pull(double density, double depth_of_hole, double spacing) {
        Body body = test::block({-5.0_mm, -5.0_mm, -24.0_mm}, {16.0_mm, 5.0_mm, 0}, spacing, {0.31, 0.17, 0.73});
        body.materials = {{"bone", density, {}}};
        const ToolSetup setup = test::twist_drill({{"diameter", 3.2_mm}, {"motor_torque", 20.0}});
        Simulation simulation(body, setup, test::rigid_outline(setup), test::gains(1.0 / 128.0),
                              test::at_depth(-0.1_mm));
        const auto move_with_tip = [&](double depth, double aside) {
            const double across = -simulation.tick({test::at_depth(depth, 0.0, {aside, 0, 0})}).bone_on_tool[0];
            return across;
        };
        for (double depth = -0.1_mm; depth < depth_of_hole; depth += 4.0_um) (void)move_with_tip(depth, 0.0);
        for (double aside = 0.0; aside < 10.0_mm; aside += 10.0_um) {
            const double across = move_with_tip(depth_of_hole, aside);
            if (aside >= (1.0 + static_cast<double>(force.size())) * 1.0_mm) force.push_back(across);
        }
        for (double aside = 10.0_mm; aside > 0.0; aside -= 10.0_um) (void)move_with_tip(depth_of_hole, aside);
        for (int tick = 0; tick < 2000; ++tick) back_in_the_middle = move_with_tip(depth_of_hole, 0.0);
    }
};

// (Bent by more than its radius it was let go: a hand of 0.02 N took a shank through spongy bone.)
TEST(PulledAside, AShankIsHeldHoweverFarItIsPulled) {
    for (const double depth : {8.0_mm, 20.0_mm}) {
        const Pull coarse(300.0, depth, 0.5_mm), fine(300.0, depth, 0.25_mm);
        ASSERT_EQ(coarse.force.size(), 9u);
        for (std::size_t i = 2; i < coarse.force.size(); ++i) {
            EXPECT_GT(fine.force[i], fine.force[i - 1] + 2.0) << "N, " << depth << ", after " << i + 1 << " mm";
            EXPECT_NEAR(coarse.force[i] / fine.force[i], 1.0, 0.03) << depth << ", after " << i + 1 << " mm";
        }
        EXPECT_NEAR(fine.back_in_the_middle, 0.0, 0.05) << "N, " << depth;
        EXPECT_NEAR(coarse.back_in_the_middle, 0.0, 0.05) << "N, " << depth;
    }
}

// 68 MPa (ρ / 1 g/cm³)² crush it. Four channels of those that stand for the shank push back here, of a diameter's
// length each: less than all of it.
TEST(PulledAside, WeakBoneIsCrushedByTheShank) {
    const double breaking_load = 68e6 * 0.1 * 0.1 * 3.2_mm * 20.0_mm;  // [N] along all of the shank in bone
    for (const double spacing : {0.5_mm, 0.25_mm}) {
        const Pull weak(100.0, 20.0_mm, spacing);
        EXPECT_LT(weak.force.back(), breaking_load) << "N";
        EXPECT_GT(weak.force.back(), 0.4 * breaking_load) << "N";
        EXPECT_NEAR(weak.force.back(), weak.force[weak.force.size() - 3], 1.0) << "N, two millimetres before";
    }
}

}  // namespace
}  // namespace kerf
