// SPDX-License-Identifier: Apache-2.0
// The force gate, tick by tick: 5 ms down, 50 ms up, and no more than 0.4 N a millisecond.
#include "core/haptics/loop/force_gate.h"

#include <gtest/gtest.h>

namespace kerf {
namespace {

using State = ForceGate::State;
constexpr double dt = 1e-3;
constexpr double limit = 8.0;  // [N]

/// A gate that has been shut by a fault.
ForceGate shut() {
    ForceGate gate;
    for (int i = 0; i < 10; ++i) gate.step(false, dt);
    return gate;
}

TEST(ForceGate, IsOpenWithoutAFault) {
    ForceGate gate;
    for (int i = 0; i < 100; ++i) gate.step(true, dt);
    EXPECT_EQ(gate.state(), State::open);
    EXPECT_EQ(gate.gain(), 1.0);
    EXPECT_FALSE(gate.is_closed_or_closing());
    EXPECT_EQ(gate.usable_fraction(limit, 3.0, dt), 1.0);
}

TEST(ForceGate, ClosesInFiveTicks) {
    ForceGate gate;
    for (const double gain : {0.8, 0.6, 0.4, 0.2}) {
        gate.step(false, dt);
        EXPECT_NEAR(gate.gain(), gain, 1e-12);
        EXPECT_EQ(gate.state(), State::closing);
        EXPECT_TRUE(gate.is_closed_or_closing());
    }
    gate.step(false, dt);
    EXPECT_EQ(gate.gain(), 0.0);
    EXPECT_EQ(gate.state(), State::shut);
    EXPECT_TRUE(gate.is_closed_or_closing());
}

TEST(ForceGate, ClosesFullyAfterAFaultOfOneTick) {
    ForceGate gate;
    gate.step(false, dt);
    for (int i = 0; i < 4; ++i) {
        EXPECT_EQ(gate.state(), State::closing);
        gate.step(true, dt);
    }
    EXPECT_EQ(gate.state(), State::shut);
    EXPECT_EQ(gate.gain(), 0.0);
}

TEST(ForceGate, StaysShutWhileTheFaultLasts) {
    ForceGate gate = shut();
    for (int i = 0; i < 100; ++i) gate.step(false, dt);
    EXPECT_EQ(gate.state(), State::shut);
    EXPECT_EQ(gate.gain(), 0.0);
    EXPECT_EQ(gate.usable_fraction(limit, 0.0, dt), 0.0);
}

TEST(ForceGate, OpensInFiftyTicksOnceAllIsWell) {
    ForceGate gate = shut();
    for (int i = 1; i < 50; ++i) {
        gate.step(true, dt);
        EXPECT_EQ(gate.state(), State::opening);
        EXPECT_FALSE(gate.is_closed_or_closing());
        EXPECT_NEAR(gate.gain(), 0.02 * i, 1e-9);
        EXPECT_NEAR(gate.usable_fraction(limit, 0.02 * i * limit, dt), 0.02 * i, 1e-9) << "the time is what bounds it";
    }
    gate.step(true, dt);
    EXPECT_EQ(gate.gain(), 1.0);
}

TEST(ForceGate, AFaultWhileItOpensClosesItAgain) {
    ForceGate gate = shut();
    for (int i = 0; i < 25; ++i) gate.step(true, dt);
    gate.step(false, dt);
    EXPECT_EQ(gate.state(), State::closing);
    EXPECT_NEAR(gate.gain(), 0.3, 1e-9) << "half open, less a fifth";
}

TEST(ForceGate, AllowsFourTenthsOfANewtonATick) {
    ForceGate gate = shut();
    for (int i = 0; i < 49; ++i) gate.step(true, dt);
    // The gain would allow 7.84 N
    EXPECT_NEAR(gate.usable_fraction(limit, 0.0, dt), 0.4 / limit, 1e-12);
    EXPECT_NEAR(gate.usable_fraction(limit, 2.0, dt), 2.4 / limit, 1e-12);
    EXPECT_NEAR(gate.usable_fraction(limit, 2.0, 2.0 * dt), 2.8 / limit, 1e-12) << "in two milliseconds";
    EXPECT_NEAR(gate.usable_fraction(limit, 7.9, dt), 0.98, 1e-9) << "but the gain bounds it still";
}

TEST(ForceGate, OpensWhenTheRiseBoundIsNotReached) {
    // Given a gate that has had its 50 ms, and a force that is at the bound on the rise
    ForceGate gate = shut();
    for (int i = 0; i < 60; ++i) gate.step(true, dt);
    double force = 0.0;
    EXPECT_NEAR(gate.usable_fraction(limit, force, dt), 0.05, 1e-12);
    force = 0.4;
    EXPECT_NEAR(gate.usable_fraction(limit, force, dt), 0.1, 1e-12) << "held: it goes on opening";
    EXPECT_EQ(gate.state(), State::opening);

    // When the force is less than the bound
    EXPECT_EQ(gate.usable_fraction(limit, 0.7, dt), 1.0);

    // Then it is open
    EXPECT_EQ(gate.state(), State::open);
}

TEST(ForceGate, IsOpenWhenTheWholeLimitIsAllowed) {
    ForceGate gate = shut();
    for (int i = 0; i < 60; ++i) gate.step(true, dt);
    double force = 0.0;
    int ticks = 0;
    for (; gate.state() == State::opening && ticks < 100; ++ticks)
        force = gate.usable_fraction(limit, force, dt) * limit;
    EXPECT_EQ(ticks, 20) << "8 N by 0.4 N";
    EXPECT_EQ(force, limit);
}

TEST(ForceGate, OpensAnewFromNothingAfterASecondFault) {
    ForceGate gate = shut();
    for (int i = 0; i < 60; ++i) gate.step(true, dt);
    (void)gate.usable_fraction(limit, 7.0, dt);
    for (int i = 0; i < 10; ++i) gate.step(false, dt);
    gate.step(true, dt);
    EXPECT_EQ(gate.state(), State::opening);
    EXPECT_NEAR(gate.gain(), 0.02, 1e-12);
    EXPECT_NEAR(gate.usable_fraction(limit, 0.0, dt), 0.02, 1e-12);
    EXPECT_EQ(gate.state(), State::opening);
}

}  // namespace
}  // namespace kerf
