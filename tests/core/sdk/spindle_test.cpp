// SPDX-License-Identifier: Apache-2.0
#include "kerf/spindle.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace kerf {
namespace {

using namespace literals;
using Phase = Spindle::Phase;

constexpr double dt = 1e-3;
constexpr double full = 1000.0_rpm;
/// 1 N·m, 0.2 s to 1000 rpm
constexpr Motor motor{1.0 * 0.2 / (2.0 * pi * full), 1.0};

Spindle at_speed(double speed) {
    Spindle spindle;
    spindle.speed = speed;
    spindle.phase = speed < 0.0 ? Phase::reversing : Phase::running;
    return spindle;
}

double time_to(Spindle& spindle, const Motor& m, double commanded, double load, double until, bool is_rising) {
    int ticks = 0;
    while ((is_rising ? spindle.speed < until : spindle.speed > until) && ticks < 100000) {
        spindle.step(m, commanded, load, dt);
        ++ticks;
    }
    return ticks * dt;
}

TEST(Spindle, RunsUpAsItsTorqueAndInertiaSay) {
    Spindle spindle;
    EXPECT_NEAR(time_to(spindle, motor, full, 0.0, full, true), 0.2, 1.5 * dt);
    EXPECT_EQ(spindle.phase, Phase::running);
    Spindle loaded;  // half of the torque is left over: twice the time
    EXPECT_NEAR(time_to(loaded, motor, full, 0.5, 0.95 * full, true), 0.95 * 0.4,
                0.01 /* below 5 rpm the load is less */);
}

TEST(Spindle, HoldsItsSpeedExactlyWhileTheTorqueLasts) {
    Spindle spindle;
    (void)time_to(spindle, motor, full, 0.0, full, true);
    for (const double load : {0.0, 0.2, 0.7, 0.999}) {
        spindle.step(motor, full, load, dt);
        EXPECT_EQ(spindle.speed, full) << load;
    }
}

TEST(Spindle, UnderMoreThanItsTorqueItBogsDownAndComesBack) {
    Spindle spindle;
    (void)time_to(spindle, motor, full, 0.0, full, true);
    // 2 N·m against 1: it loses speed as quickly as it gained it.
    EXPECT_NEAR(time_to(spindle, motor, full, 2.0, 0.5 * full, false), 0.1, 2.0 * dt);
    EXPECT_EQ(spindle.phase, Phase::bogging);
    EXPECT_GT(time_to(spindle, motor, full, 0.1, 0.94 * full, true), 0.0);
    EXPECT_EQ(spindle.phase, Phase::bogging) << "until it is back at speed";
    (void)time_to(spindle, motor, full, 0.1, full, true);
    EXPECT_EQ(spindle.phase, Phase::running);
}

TEST(Spindle, HeldItNeverTurnsBackwardsStallsAndWaitsToBeSwitchedOff) {
    Spindle spindle = at_speed(full);
    double last = full;
    int ticks = 0;
    for (; spindle.phase != Phase::stalled && ticks < 5000; ++ticks) {
        spindle.step(motor, full, 50.0, dt);
        ASSERT_GE(spindle.speed, 0.0);
        ASSERT_LE(spindle.speed, last);
        last = spindle.speed;
    }
    EXPECT_NEAR(ticks * dt, 0.2 / 49.0 + 0.02, 3.0 * dt) << "slowed by 49 N m, then held for 20 ms";
    EXPECT_EQ(spindle.speed, 0.0);
    EXPECT_EQ(spindle.torque, 1.0);

    // The load gone, it pulls on until the trigger is let go; only then it starts again.
    for (int i = 0; i < 100; ++i) spindle.step(motor, full, 0.0, dt);
    EXPECT_EQ(spindle.phase, Phase::stalled);
    EXPECT_EQ(spindle.torque, 1.0);
    spindle.step(motor, 0.0, 0.0, dt);
    EXPECT_EQ(spindle.phase, Phase::off);
    EXPECT_EQ(spindle.torque, 0.0);
    (void)time_to(spindle, motor, full, 0.0, full, true);
    EXPECT_EQ(spindle.phase, Phase::running);
}

TEST(Spindle, AControllerRampsItAndALoadStopsItSooner) {
    const Motor ramped{0.05e-3, 2.0, full / 0.2};
    Spindle spindle;
    EXPECT_NEAR(time_to(spindle, ramped, full, 0.0, full, true), 0.2, 1.5 * dt);
    spindle = {};
    spindle.step(ramped, full, 0.0, dt);
    EXPECT_NEAR(spindle.torque, 0.05e-3 * 2.0 * pi * full / 0.2, 1e-9) << "no more than the ramp takes";
    spindle = at_speed(full);
    EXPECT_NEAR(time_to(spindle, ramped, 0.0, 0.0, 0.1 * full, false), 0.18, 2.0 * dt) << "braked by the ramp";
    spindle = at_speed(full);
    const double stopped = 0.05e-3 * 2.0 * pi * full / 0.2;  // [s] by 0.2 N·m
    EXPECT_NEAR(time_to(spindle, ramped, 0.0, 0.2, 0.1 * full, false), 0.9 * stopped, 2.0 * dt);
}

TEST(Spindle, ASlowStartIsNoStall) {
    const Motor slow{1.0 * 10.0 / (2.0 * pi * full), 1.0};  // 10 s to speed: 100 ms below the crawling speed
    Spindle spindle;
    for (int i = 0; i < 2000; ++i) {
        spindle.step(slow, full, 0.5, dt);
        ASSERT_EQ(spindle.phase, Phase::spinning_up) << i;
    }
}

TEST(Spindle, IntoReverseItGoesThroughStandingStill) {
    Spindle spindle = at_speed(full);
    int ticks = 0;
    bool has_stood = false;
    for (; spindle.phase != Phase::reversing && ticks < 1000; ++ticks) {
        spindle.step(motor, -full, 0.0, dt);
        has_stood = has_stood || spindle.speed == 0.0;
    }
    EXPECT_TRUE(has_stood);
    EXPECT_NEAR(ticks * dt, 0.2 + 0.19, 4.0 * dt);
    EXPECT_LT(spindle.speed, -0.9 * full);
}

TEST(Spindle, WhatTheMotorPutsIntoItsOwnInertiaIsFeltByWhoeverHoldsIt) {
    Spindle spindle;
    spindle.step(motor, full, 0.0, dt);
    EXPECT_NEAR(spindle.excess_torque(0.0), 1.0, 1e-9) << "running up";
    spindle = at_speed(full);
    spindle.step(motor, full, 0.4, dt);
    EXPECT_NEAR(spindle.torque, 0.4, 1e-9);
    EXPECT_NEAR(spindle.excess_torque(0.4), 0.0, 1e-9) << "at speed the bone answers it";
    spindle.step(motor, 0.0, 0.0, dt);
    EXPECT_NEAR(spindle.excess_torque(0.0), -1.0, 1e-9) << "braked, it turns the hand along";
}

TEST(Spindle, SwitchedOffItRunsDownAndStops) {
    Spindle spindle = at_speed(full);
    EXPECT_TRUE(spindle.step(motor, 0.0, 0.0, dt));
    EXPECT_EQ(spindle.phase, Phase::running_down);
    EXPECT_NEAR(time_to(spindle, motor, 0.0, 0.0, 0.0, false), 0.2, 3.0 * dt);
    EXPECT_EQ(spindle.speed, 0.0);
    EXPECT_EQ(spindle.phase, Phase::off);
}

TEST(Spindle, WithoutInertiaItFollowsAtOnce) {
    Spindle spindle;
    spindle.step({0.0, 1.0}, full, 0.9, dt);
    EXPECT_EQ(spindle.speed, full);
    spindle.step({0.0, 1.0}, 0.5 * full, 0.9, dt);
    EXPECT_EQ(spindle.speed, 0.5 * full);
}

TEST(Spindle, GoesTheSameWayAtAnyLoopRate) {
    const auto speed_after = [](double step) {
        Spindle spindle;
        for (int i = 0; i < static_cast<int>(0.15 / step + 0.5); ++i) spindle.step(motor, full, 0.3, step);
        return spindle.speed;
    };
    for (const double step : {2e-3, 0.5e-3, 0.25e-3})
        EXPECT_NEAR(speed_after(step) / speed_after(1e-3), 1.0, 0.01) << step;
}

}  // namespace
}  // namespace kerf
