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
    EXPECT_NEAR(time_to(loaded, motor, full, 0.5, 0.95 * full, true), 0.95 * 0.4, 0.01 /* below 5 rpm the load is less */);
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

TEST(Spindle, ALoadNeverTurnsItBackwards) {
    Spindle spindle{full, Phase::running};
    for (int i = 0; i < 5000; ++i) {
        spindle.step(motor, full, 50.0, dt);
        ASSERT_GE(spindle.speed, 0.0);
        ASSERT_LE(spindle.speed, full);
    }
    // It creeps where the fading load meets the torque: 50 (1 − e^(−ω/ω_e)) = 1.
    EXPECT_NEAR(spindle.speed, -5.0_rpm * std::log(1.0 - 1.0 / 50.0), 1e-6);
}

TEST(Spindle, SwitchedOffItRunsDownAndStops) {
    Spindle spindle{full, Phase::running};
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
    for (const double step : {2e-3, 0.5e-3, 0.25e-3}) EXPECT_NEAR(speed_after(step) / speed_after(1e-3), 1.0, 0.01) << step;
}

}  // namespace
}  // namespace kerf
