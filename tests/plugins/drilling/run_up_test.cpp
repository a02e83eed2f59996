// SPDX-License-Identifier: Apache-2.0
// A drill in a hand runs up through the frequency at which its tip swings, some 14 Hz; 1000 rpm are 16.7 Hz.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/drill_rig.h"

namespace kerf {
namespace {

using namespace literals;

constexpr double runout = 0.05_mm;

/// The farthest that the tip is aside of where it stood before its motor was switched on.
double farthest_aside(double deep) {
    const Body body = test::block({-6.0_mm, -6.0_mm, -20.0_mm}, {6.0_mm, 6.0_mm, 0}, 0.25_mm, {0.31, 0.17, 0.73});
    ToolSetup setup = test::twist_drill(
        {{"diameter", 3.2_mm}, {"length", 80.0_mm}, {"runout", runout}, {"run_up", 0.4_s}, {"motor_torque", 1.0}});
    ToolOutline outline;
    std::string why;
    EXPECT_TRUE(outline_of(setup, outline, why)) << why;
    const CouplingGains gains = in_hands(gains_for(*find_device("premium-1.5-6dof"), 1.0 / 50.0));
    Simulation simulation(body, setup, outline, gains, test::at_depth(-2.0_mm));
    const auto stand = [&](double depth, int ticks) {
        double farthest = 0.0;
        const Vec3 begun = simulation.world_from_tool().position;
        for (int i = 0; i < ticks; ++i) {
            (void)simulation.tick({test::at_depth(depth)});
            const Vec3 moved = simulation.world_from_tool().position - begun;
            farthest = std::max(farthest, std::hypot(moved.x, moved.y));
        }
        return farthest;
    };
    // It drills its hole, is drawn back a little from the bottom, and stops.
    for (double depth = -2.0_mm; depth < deep; depth += 1.0_um) (void)stand(depth, 1);
    (void)stand(deep - 0.5_mm, 500);
    simulation.command_drive(0, 0.0);
    (void)stand(deep - 0.5_mm, 2000);
    simulation.command_drive(0, 1000.0_rpm);
    return stand(deep - 0.5_mm, 2000);
}

TEST(RunUp, InAirTheTipStandsStill) { EXPECT_LT(farthest_aside(-1.0_mm), 2.0 * runout); }

TEST(RunUp, InItsHoleTheTipStaysWithinTwiceItsRunout) { EXPECT_LT(farthest_aside(5.0_mm), 2.0 * runout); }

}  // namespace
}  // namespace kerf
