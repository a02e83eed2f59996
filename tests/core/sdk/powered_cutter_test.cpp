// SPDX-License-Identifier: Apache-2.0
#include "kerf/powered_cutter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace kerf {
namespace {

constexpr double dt = 1e-3, slowest_cut = 5.0, speed = 100.0;
enum class Happened { off, speeding_up, running, reversing, bogging, stalled, running_down };
constexpr PhaseEvents<Happened> events{.off = Happened::off,
                                       .speeding_up = Happened::speeding_up,
                                       .running = Happened::running,
                                       .reversing = Happened::reversing,
                                       .bogging = Happened::bogging,
                                       .stalled = Happened::stalled,
                                       .running_down = Happened::running_down};

/// A cutter with the events that it reported.
struct Bench {
    PoweredCutter cutter;
    Motor motor = Motor::with_run_up(0.1, speed, 0.5, 1e-6);
    std::vector<Happened> reported;

    void run(double commanded, double load, int ticks) {
        for (int i = 0; i < ticks; ++i) {
            kerf_action action[KERF_MAX_ACTIONS];
            kerf_commit_out out{};
            out.action = action;
            Actions actions(out);
            cutter.step(motor, commanded, load, dt, slowest_cut, events, actions);
            for (std::uint32_t a = 0; a < out.action_count; ++a) reported.push_back(Happened(action[a].value));
        }
    }
};

TEST(PoweredCutter, RunsUpAndReportsIt) {
    Bench bench;
    bench.run(speed, 0.0, 150);
    EXPECT_NEAR(bench.cutter.speed(), speed, 1e-9);
    EXPECT_EQ(bench.reported, (std::vector{Happened::speeding_up, Happened::running}));
}

TEST(PoweredCutter, RemovesBoneFromItsSlowestSpeedOn) {
    Bench bench;
    while (bench.cutter.speed() < slowest_cut) {
        EXPECT_FALSE(bench.cutter.cutting.removes_bone()) << bench.cutter.speed();
        bench.run(speed, 0.0, 1);
    }
    EXPECT_TRUE(bench.cutter.cutting.removes_bone());
}

TEST(PoweredCutter, StallsUnderMoreThanItsTorqueAndFades) {
    Bench bench;
    bench.run(speed, 0.0, 150);
    bench.run(speed, 5.0, 100);
    EXPECT_EQ(bench.cutter.motor.phase, Spindle::Phase::stalled);
    EXPECT_EQ(bench.reported.back(), Happened::stalled);
    EXPECT_FALSE(bench.cutter.cutting.removes_bone());
}

TEST(CuttingState, FadesWithTwoMilliseconds) {
    CuttingState state;
    state.step(true, dt);
    EXPECT_EQ(state.fraction, 1.0);
    for (int i = 0; i < 4; ++i) state.step(false, dt);
    EXPECT_NEAR(state.fraction, std::exp(-2.0), 1e-12);
    EXPECT_TRUE(state.resists());
    EXPECT_FALSE(state.removes_bone());
    for (int i = 0; i < 40; ++i) state.step(false, dt);
    EXPECT_EQ(state.fraction, 0.0);
    EXPECT_FALSE(state.resists());
}

TEST(Motor, WithoutRunUpFollowsAtOnce) {
    const Motor motor = Motor::with_run_up(0.0, speed, 0.5, 1e-6);
    EXPECT_EQ(motor.inertia, 0.0);
    EXPECT_EQ(motor.torque, 0.5);
    EXPECT_EQ(Motor::with_run_up(0.1, speed, 0.5, 1e-6).ramp, speed / 0.1);
}

}  // namespace
}  // namespace kerf
