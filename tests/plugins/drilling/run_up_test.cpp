// SPDX-License-Identifier: Apache-2.0
// A drill in a hand runs up through the frequency at which its tip swings, some 14 Hz; 1000 rpm are 16.7 Hz. How its
// motor turns the hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "plugins/drilling/drill_force.h"
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

// In air, 1000 rpm are reached in 0.2 s: 83.3 /s². The rotor of 5e-5 kg·m² takes 2π · J · 83.3 /s² = 26.2 mN·m to speed
// up, and as much to slow down: the hand is turned against the rotor's acceleration.
TEST(DrillMotor, TurnsTheHandAgainstItsAcceleration) {
    constexpr double fast = 1000.0 / 60.0, rate = fast / 0.2, wanted = 5e-5 * 2.0 * pi * rate;
    test::Rig rig(test::block({-6.0_mm, -6.0_mm, -6.0_mm}, {6.0_mm, 6.0_mm, 0}, 0.5_mm),
                  test::twist_drill({{"run_up", 0.2}, {"inertia", 5e-5}, {"motor_torque", 0.1}}),
                  test::at_depth(-20.0_mm));
    const auto torque_along = [&] {  // about the shaft, out of the tip
        const Vec6 wrench = rig.tick_direct({test::at_depth(-20.0_mm)}).bone_on_tool;
        return dot(angular(wrench), rotate(rig.world_from_tool().rotation, {0, 0, 1}));
    };
    const auto speed = [&] { return signals_of<drilling::DrillCutting>(rig.signals()).spindle_speed; };
    for (const double sense : {1.0, -1.0, 1.0}) {
        rig.command_drive(0, sense * fast);
        (void)torque_along();
        int seen = 0;
        for (int i = 0; i < 450; ++i) {
            const double before = speed(), torque = torque_along();
            if (std::abs(before) < 2e-3 * rate || sense * before > fast - 2e-3 * rate) continue;
            EXPECT_NEAR(torque, -sense * wanted, 0.01 * wanted) << before << " /s";
            ++seen;
        }
        EXPECT_GT(seen, 150);
        EXPECT_NEAR(speed(), sense * fast, 1e-9);
        EXPECT_NEAR(torque_along(), 0.0, 1e-9) << "at a constant speed";
    }
}

}  // namespace
}  // namespace kerf
