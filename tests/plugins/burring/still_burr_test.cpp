// SPDX-License-Identifier: Apache-2.0
// A burr that does not turn, or not fast enough: it touches, rubs, and removes nothing. How its motor turns the hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/burr_rig.h"

namespace kerf {
namespace {

using namespace literals;
using burring::BurrCutting;

Body wide_block() { return test::block({-8.0_mm, -8.0_mm, -7.0_mm}, {8.0_mm, 8.0_mm, 0}, 0.25_mm, {0.31, 0.17, 0.73}); }

TEST(StillBurr, OnlyTouches) {  // P9
    for (const double rpm : {0.0, 500.0}) {
        test::Rig rig(wide_block(), test::round_burr({{"spindle_speed", rpm * 1.0_rpm}}), test::at_depth(-0.5_mm));
        double work = 0.0, peak = 0.0, last = 0.0;
        for (int i = -100; i <= 300; ++i) {  // in by 0.1 mm and out again
            const double thrust = rig.tick_direct({test::at_depth((i <= 100 ? i : 200 - i) * 1.0_um)}).thrust;
            work -= 0.5 * (last + thrust) * (i <= 100 ? 1.0_um : -1.0_um);
            peak = std::max(peak, thrust);
            last = thrust;
        }
        EXPECT_GT(peak, 5.0) << "N, at 0.1 mm and " << rpm;
        EXPECT_LT(peak, 300.0) << "finite";
        EXPECT_LE(work, 1e-3 * peak * 0.1_mm) << "it gives back no more than it took";
        rig.finish();
        EXPECT_EQ(rig.present().removed(), 0.0);
    }
}

TEST(StillBurr, ClingsToTheBone) {
    // Given a still burr that is pressed on a face, when it is drawn across it, then friction holds it back
    test::Rig rig(wide_block(), test::round_burr({{"spindle_speed", 0.0}}), test::at_depth(-0.5_mm));
    for (int i = 0; i <= 560; ++i) (void)rig.tick_direct({test::at_depth(-0.5_mm + i * 1.0_um)});
    TickResult r;
    for (int i = 0; i < 200; ++i) r = rig.tick_direct({test::at_depth(0.06_mm, 0.0, {i * 2.0_um, 0, 0})});
    EXPECT_GT(r.thrust, 5.0);
    EXPECT_NEAR(-r.bone_on_tool[0] / r.thrust, 0.3, 0.06);
}

TEST(StillBurr, TakesOverFromOneThatIsSwitchedOff) {
    // Given a burr that cuts under a steady push, when it is switched off, then it comes to rest and nothing jumps
    test::Rig rig(wide_block(), test::round_burr({{"run_up", 0.3}}), test::at_depth(-0.3_mm));
    for (int i = 0; i < 400; ++i) (void)rig.tick({test::at_depth(-0.3_mm)});
    double hand = -0.3_mm, speed = 0.0;
    const auto push = [&](double newton) {
        const TickResult r = rig.tick({test::at_depth(hand)});
        speed += 1e-3 / 0.1 * (0.01 * newton + dot(linear(r.command.wrench), Vec3{0, 0, -1}) - 2.0 * speed);
        hand += 1e-3 * speed;
        return r.thrust;
    };
    for (int i = 0; i < 700; ++i) (void)push(6.0);
    rig.command_drive(0, 0.0);
    double last = push(6.0), largest = 0.0;
    for (int i = 0; i < 1500; ++i) {
        const double thrust = push(6.0);
        largest = std::max(largest, std::abs(thrust - last));
        last = thrust;
    }
    EXPECT_NEAR(last, 6.0, 0.3);
    EXPECT_LT(largest, 0.6) << "N from tick to tick";
    rig.finish();
    const double removed = rig.present().removed();
    for (int i = 0; i < 300; ++i) (void)push(6.0);
    rig.finish();
    EXPECT_EQ(rig.present().removed(), removed);
}

TEST(StillBurr, StopsInBoneThatIsTooMuchForItsMotor) {
    test::Rig rig(wide_block(), test::round_burr({{"motor_torque", 0.5_Nmm}, {"run_up", 0.3}}),
                  test::at_depth(-0.3_mm));
    for (int i = 0; i < 400; ++i) (void)rig.tick_direct({test::at_depth(-0.3_mm)});
    bool has_stalled = false;
    for (int i = 0; i < 3000 && !has_stalled; ++i) {
        (void)rig.tick_direct(
            {test::at_depth(std::min<double>(-0.3_mm + i * 2.0_um, 2.0_mm), 0.0, {i * 2.0_um, 0, 0})});
        has_stalled = signals_of<BurrCutting>(rig.signals()).spindle_speed == 0.0;
    }
    EXPECT_TRUE(has_stalled);
}

// In air, 833 turns a second are reached in 0.3 s. The rotor of 2 g·cm² takes 2π · J · 2778 /s² = 3.49 mN·m to
// speed up, and as much to slow down: the hand is turned against the rotor's acceleration.
TEST(BurrMotor, TurnsTheHandAgainstItsAcceleration) {
    test::Rig rig(wide_block(), test::round_burr({{"run_up", 0.3}, {"inertia", 2e-7}}), test::at_depth(-20.0_mm));
    const double rate = 50000.0 / 60.0 / 0.3, wanted = 2e-7 * 2.0 * pi * rate;
    const auto torque_along = [&] {  // about the shaft, out of the tip
        const Vec6 wrench = rig.tick_direct({test::at_depth(-20.0_mm)}).bone_on_tool;
        return dot(angular(wrench), rotate(rig.world_from_tool().rotation, {0, 0, 1}));
    };
    const auto speed = [&] { return signals_of<BurrCutting>(rig.signals()).spindle_speed; };
    for (const double sense : {1.0, -1.0, 1.0}) {
        rig.command_drive(0, sense * 50000.0 / 60.0);
        (void)torque_along();
        int seen = 0;
        for (int i = 0; i < 700; ++i) {
            const double before = speed(), torque = torque_along();
            const bool is_speeding = std::abs(before) > 2.0 * rate * 1e-3 && sense * before < 830.0 - 2.0 * rate * 1e-3;
            if (!is_speeding) continue;
            EXPECT_NEAR(torque, -sense * wanted, 0.01 * wanted) << before << " /s";
            ++seen;
        }
        EXPECT_GT(seen, 250);
        EXPECT_NEAR(speed(), sense * 50000.0 / 60.0, 1e-6);
        EXPECT_NEAR(torque_along(), 0.0, 1e-9) << "at a constant speed";
    }
}

}  // namespace
}  // namespace kerf
