// SPDX-License-Identifier: Apache-2.0
// What the hand's side reports and commands for a tool that lies askew, with round numbers.
#include "core/haptics/loop/hand_port.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kerf/units.hpp"

namespace kerf {
namespace {

using namespace literals;

constexpr double dt = 1e-3, scale = 0.25;
constexpr Vec3 grip{0, 0, -100.0_mm};
/// Takes x to y, y to z and z to x.
const Quat cycled{0.5, 0.5, 0.5, 0.5};
const Pose askew{{0.1, 0.2, 0.3}, cycled};

CouplingGains gains() {
    CouplingGains g;
    g.stiffness = 1000.0;
    g.damping = 2.0;
    g.force_limit = 8.0;
    g.torque_limit = 0.2;
    g.has_torque = true;
    g.spare_damping = 5.0;
    g.force_scale = scale;
    return g;
}

HandPort port(const CouplingGains& of = gains(), const Pose& start = askew) { return {of, {.grip_z = grip.z}, start}; }

void expect_near(Vec3 is, Vec3 wanted, double tolerance = 1e-12) {
    EXPECT_NEAR(is.x, wanted.x, tolerance);
    EXPECT_NEAR(is.y, wanted.y, tolerance);
    EXPECT_NEAR(is.z, wanted.z, tolerance);
}

// ---- what a tick reports -------------------------------------------------------------------------------------------

/// A solved step, in the frame of the tool: 3 N of release against its −z, 1 N, 2 N and 4 N of the spring.
struct Solved {
    Balance balance;
    Motion motion;
    TickResult result;

    Solved() {
        balance.centre = {0, 0, -40.0_mm};
        balance.force = {.pull = {10.0, 20.0, 30.0}, .drag = {2.0, 5.0}, .limit = {100.0, 100.0}};
        balance.torque = {.pull = {0.1, 0.2, 0.3}, .drag = {0.5, 0.25}, .limit = {100.0, 100.0}};
        balance.release_along = {0, 0, -1};
        balance.hand_velocity = {0.1, 0.2, 0.3};
        balance.hand_turn = {0.5, 0.25, 2.0};
        motion.force = {1.0, 2.0, 4.0};
        motion.torque = {0.1, 0.2, 0.4};
    }
    void report(double weight = 1.0) { port().add_wrenches(balance, motion, weight, askew, result); }
};

TEST(HandPort, ReportsTheReleaseInTheWorld) {
    Solved solved;
    solved.motion.release = 3.0;
    solved.report();
    expect_near(solved.result.released_on_hand, {-3.0, 0, 0});
}

TEST(HandPort, ReportsTheReactionInTheWorld) {
    Solved solved;
    solved.report();
    expect_near(linear(solved.result.limited_on_hand), {-4.0, -1.0, -2.0});
}

TEST(HandPort, CountsTheReleaseInTheReaction) {
    Solved solved;
    solved.motion.release = 3.0;
    solved.report();
    expect_near(linear(solved.result.limited_on_hand), {-4.0 - 3.0, -1.0, -2.0});
}

TEST(HandPort, ReportsTheTorqueAboutTheGrip) {
    // The centre is 60 mm before the grip: 60 mm × (1, 2, 4) N = (−0.12, 0.06, 0) N·m
    Solved solved;
    solved.report();
    expect_near(angular(solved.result.limited_on_hand), {-0.4, -0.1 + 0.12, -0.2 - 0.06});
}

TEST(HandPort, ReportsTheCouplingWithoutItsLimits) {
    Solved solved;
    solved.balance.force.limit = {1.0, 1.0};
    solved.motion.rate = make_vec6({0.5, 0.0, 1.0}, {0.0, 2.0, 4.0});
    solved.report();
    // The centre moves by v + ω × r = (0.5 − 0.08, 0, 1) m/s: 30 − 5, 10 − 0.84, 20
    expect_near(linear(solved.result.coupled_on_hand), {-25.0, -9.16, -20.0});
    // 0.1, 0.2 − 1, 0.3 − 1 at the centre, and 60 mm × the force at the grip
    expect_near(angular(solved.result.coupled_on_hand), {0.7, -0.1 + 0.06 * 20.0, 0.8 - 0.06 * 9.16});
    EXPECT_NEAR(linear(solved.result.limited_on_hand).x, -1.0, 1e-12);
}

TEST(HandPort, WeighsEveryPartOfATick) {
    Solved solved;
    solved.motion.release = 3.0;
    solved.report(0.25);
    solved.report(0.75);
    Solved whole;
    whole.motion.release = 3.0;
    whole.report();
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_NEAR(solved.result.limited_on_hand[i], whole.result.limited_on_hand[i], 1e-12);
        EXPECT_NEAR(solved.result.coupled_on_hand[i], whole.result.coupled_on_hand[i], 1e-12);
    }
    expect_near(solved.result.released_on_hand, {-3.0, 0, 0});
    EXPECT_NEAR(solved.result.power_hand, whole.result.power_hand, 1e-12);
}

TEST(HandPort, AddsThePowerOfTorquesToThatOfForces) {
    Solved solved;
    solved.report();
    EXPECT_NEAR(solved.result.power_hand, (0.1 + 0.4 + 1.2) + (0.05 + 0.05 + 0.8), 1e-12);
}

TEST(HandPort, CountsTheReleaseInThePower) {
    Solved solved;
    solved.motion.release = 3.0;
    solved.report();
    EXPECT_NEAR(solved.result.power_hand, 0.1 + 0.4 + 7.0 * 0.3 + 0.9, 1e-12);
}

// ---- the command ---------------------------------------------------------------------------------------------------

/// A hand that moves and turns at constant rates, and a tool that does not.
struct Moving {
    HandPort hand;
    Vec3 velocity{20.0_mm_per_s, -10.0_mm_per_s, 40.0_mm_per_s}, turning{0.2, 0.5, -0.4};

    explicit Moving(const CouplingGains& of = gains()) : hand(port(of)) {
        Pose pose = askew;
        for (int i = 0; i < 200; ++i) {
            pose = {pose.position + dt * velocity, quat_from_rotation_vector(dt * turning) * pose.rotation};
            (void)hand.read({pose}, askew, 0.0, dt);
        }
    }
};

TEST(HandPort, ScalesTheCommandToTheDevice) {
    HandPort hand = port();
    TickResult result;
    result.limited_on_hand = {4.0, -8.0, 12.0, 0.2, -0.3, 0.1};
    hand.command(askew, dt, result);
    expect_near(linear(result.command.wrench), {1.0, -2.0, 3.0});
    expect_near(angular(result.command.wrench), {0.05, -0.075, 0.025});
}

TEST(HandPort, GivesTheSetpointTheToolsRateAtTheGrip) {
    // v = (1, 2, 3) mm/s, ω = (0.1, 0.2, 0.3) rad/s in the tool; ω × grip = (−20, 10, 0) mm/s
    HandPort hand = port();
    TickResult result;
    result.rate = make_vec6({1.0_mm_per_s, 2.0_mm_per_s, 3.0_mm_per_s}, {0.1, 0.2, 0.3});
    hand.command(askew, dt, result);
    expect_near(result.command.setpoint.velocity, {3.0_mm_per_s, -19.0_mm_per_s, 12.0_mm_per_s});
}

TEST(HandPort, GivesTheSetpointTheGainsOfTheCoupling) {
    HandPort hand = port();
    TickResult result;
    hand.command(askew, dt, result);
    EXPECT_EQ(result.command.setpoint.stiffness, 1000.0);
    EXPECT_EQ(result.command.setpoint.damping, 2.0);
    EXPECT_EQ(result.command.setpoint.limit, 8.0);
}

TEST(HandPort, SetpointAndCommandAreOneForce) {
    Moving moving;
    TickResult result;
    result.limited_on_hand = {4.0, -8.0, 12.0, 0, 0, 0};
    result.released_on_hand = {1.0, 2.0, -4.0};
    result.rate = make_vec6({5.0_mm_per_s, 1.0_mm_per_s, -2.0_mm_per_s}, {0.3, -0.1, 0.2});
    moving.hand.command(askew, dt, result);
    const Setpoint& to = result.command.setpoint;
    // At the grip of a tool whose z is the world's x: ω × (−100, 0, 0) mm
    const Vec3 of_hand = moving.velocity + cross(moving.turning, {-0.1, 0, 0});
    const Vec3 force =
        1000.0 * (to.position - moving.hand.pose().position) + 2.0 * (to.velocity - of_hand) + to.carried;
    expect_near(force, {1.0, -2.0, 3.0}, 1e-6 /* of the hand's rate */);
    expect_near(linear(result.command.wrench), {1.0, -2.0, 3.0});
    expect_near(to.carried, {0.25, 0.5, -1.0});
}

/// Under 8 N the hand goes along by 0.5 mm: 3.9 mJ more than is tolerated.
HandPort in_excess() {
    HandPort hand = port();
    TickResult result;
    result.limited_on_hand = {0, 32.0, 0, 0, 0, 0};
    hand.command(askew, dt, result);
    (void)hand.read({{askew.position + Vec3{0, 0.5_mm, 0}, cycled}}, askew, 1e3, dt);
    return hand;
}

TEST(HandPort, CarriesTheCorrectionOutsideTheSpring) {
    HandPort hand = in_excess();
    TickResult result;
    hand.command(askew, dt, result);
    expect_near(result.command.setpoint.carried, {0, -2.5, 0}, 1e-9);  // 5 N·s/m at 0.5 m/s
    expect_near(linear(result.command.wrench), {0, -2.5, 0}, 1e-9);
}

TEST(HandPort, AddsTheReleaseToTheCorrectionInWhatIsCarried) {
    HandPort hand = in_excess();
    TickResult result;
    result.released_on_hand = {4.0, 2.0, 8.0};
    hand.command(askew, dt, result);
    expect_near(result.command.setpoint.carried, {1.0, 0.5 - 2.5, 2.0}, 1e-9);
}

// ---- energy --------------------------------------------------------------------------------------------------------

TEST(HandPort, CountsTheWorkAtTheGrip) {
    // Given 2 N along the world's z and 0.1 N·m about its y, on a hand that turns about the tool's tip by 1 mrad
    HandPort hand = port();
    TickResult result;
    result.limited_on_hand = {0, 0, 8.0, 0, 0.4, 0};
    hand.command(askew, dt, result);

    // When the grip, 100 mm to −x, so rises by 0.1 mm
    (void)hand.read({{askew.position, quat_from_rotation_vector({0, 1e-3, 0}) * cycled}}, askew, 1e3, dt);

    // Then the hand got the work of both
    EXPECT_NEAR(hand.passivity().energy(), -(2.0 * 0.1_mm + 0.1 * 1e-3), 1e-9);
}

TEST(HandPort, StoresTheToolsEnergyOnTheDevicesSide) {
    HandPort hand = port();
    TickResult result;
    result.limited_on_hand = {0, 0, -32.0, 0, 0, 0};
    hand.command(askew, dt, result);
    const Pose pushed{askew.position + Vec3{0, 0, 1.0_mm}, cycled};
    (void)hand.read({pushed}, pushed, 4e-3, dt);  // 8 mJ put in, into a tool that has 4 mJ and no stretch
    EXPECT_NEAR(hand.passivity().energy(), scale * 4e-3, 1e-12);
}

TEST(HandPort, CreditsTheMotorsWorkOnce) {
    HandPort hand = port();
    Balance balance;
    Motion motion;
    balance.following = {0, 0, 8.0, 0, 0, 0.5};
    motion.rate = {0, 0, 0.25, 0, 0, 4.0};
    hand.credit_motor(balance, motion, dt);  // 2 W and 2 W for a tick
    (void)hand.read({askew}, askew, 1e3, dt);
    EXPECT_NEAR(hand.passivity().energy(), scale * 4e-3, 1e-12);
    (void)hand.read({askew}, askew, 1e3, dt);
    EXPECT_NEAR(hand.passivity().energy(), scale * 4e-3, 1e-12);
}

TEST(HandPort, CreditsNoWorkAgainstTheMotor) {
    HandPort hand = port();
    Balance balance;
    Motion motion;
    balance.following = {0, 0, 8.0, 0, 0, 0};
    motion.rate = {0, 0, -0.25, 0, 0, 0};
    hand.credit_motor(balance, motion, dt);
    (void)hand.read({askew}, askew, 1e3, dt);
    EXPECT_EQ(hand.passivity().energy(), 0.0);
}

TEST(HandPort, DropsTheMotorsWorkOfALostHand) {
    HandPort hand = port();
    Balance balance;
    Motion motion;
    balance.following = {0, 0, 8.0, 0, 0, 0};
    motion.rate = {0, 0, 0.25, 0, 0, 0};
    hand.credit_motor(balance, motion, dt);
    EXPECT_FALSE(hand.read({.world_from_handle = askew, .is_lost = true}, askew, 1e3, dt));
    EXPECT_FALSE(hand.read({askew}, askew, 1e3, dt));
    EXPECT_TRUE(hand.read({askew}, askew, 1e3, dt));
    EXPECT_EQ(hand.passivity().energy(), 0.0);
}

// ---- motors --------------------------------------------------------------------------------------------------------

/// The wrench of a device after `seconds` under the same load [bone newtons].
Vec6 commanded_after(double seconds, const Vec6& load, const CouplingGains& of) {
    HandPort hand = port(of);
    TickResult result;
    for (double time = 0.0; time < seconds; time += dt) {
        result = {};
        result.limited_on_hand = load;
        hand.command(askew, dt, result);
    }
    return result.command.wrench;
}

TEST(HandPort, WarmTorqueMotorsLimitTheTorqueAlone) {
    CouplingGains of = gains();
    of.continuous_torque = 0.1;
    const Vec6 warm = commanded_after(200.0, {0, 20.0, 0, 0, 0, 4.0}, of);
    EXPECT_NEAR(warm[5], 0.1, 1e-6);
    EXPECT_NEAR(warm[1], 5.0, 1e-12);
}

TEST(HandPort, WarmForceMotorsLimitTheForceAlone) {
    CouplingGains of = gains();
    of.continuous_force = 2.0;
    const Vec6 warm = commanded_after(200.0, {0, 20.0, 0, 0, 0, 4.0}, of);
    EXPECT_NEAR(warm[1], 2.0, 1e-6);
    EXPECT_NEAR(warm[5], 0.2, 1e-12);
}

TEST(HandPort, AMotorAboutTheShaftTurnsTheHandleByTheToolsTorque) {
    // Given a handle that lies in another direction than its tool
    CouplingGains of = gains();
    of.has_torque = false;
    of.shaft = {.torque_limit = 0.35, .stiffness = 3.0, .damping = 3e-3, .resolution = 1e-3};
    HandPort hand = port(of, identity_pose());
    TickResult result;
    result.limited_on_hand = {0, 0, 0, 0.8, 0.4, -0.4};  // the tool's z is the world's x
    hand.command(askew, dt, result);
    expect_near(angular(result.command.wrench), {0, 0, 0.2});
    result = {};
    result.limited_on_hand = {0, 0, 0, -4.0, 0, 0};
    hand.command(askew, dt, result);
    expect_near(angular(result.command.wrench), {0, 0, -0.35});
}

// ---- a new tool ----------------------------------------------------------------------------------------------------

/// How far a hand straightens a tool in one tick that it took 90 mm aside [m].
double straightened(HandPort& hand) {
    const Pose aside{askew.position + Vec3{0, 90.0_mm, 0}, cycled};
    hand.take_tool({.grip_z = grip.z}, aside);
    const Vec3 before = hand.grasp(aside).position;
    hand.realign(dt);
    return length(hand.grasp(aside).position - before);
}

TEST(HandPort, StraightensANewToolAsFastAfterAFaultAsBefore) {
    HandPort hand = port();
    EXPECT_NEAR(straightened(hand), 90.0_mm / 300.0, 1e-9);
    TickResult result;
    for (int i = 0; i < 10; ++i) hand.gate(false, askew, dt, result);
    for (int i = 0; i < 100; ++i) hand.gate(true, askew, dt, result);
    ASSERT_TRUE(result.has_event(TickResult::anchored_again));
    EXPECT_NEAR(straightened(hand), 90.0_mm / 300.0, 1e-9);
}

TEST(HandPort, DividesTheHandsMotionAmongThePartsOfATick) {
    HandPort hand = port();
    (void)hand.read({{askew.position + Vec3{4.0_mm, -8.0_mm, 2.0_mm}, cycled}}, askew, 0.0, dt);
    expect_near(hand.pose_after(1, 4).position - askew.position, {1.0_mm, -2.0_mm, 0.5_mm});
    expect_near(hand.pose_after(3, 4).position - askew.position, {3.0_mm, -6.0_mm, 1.5_mm});
    expect_near(hand.pose_after(4, 4).position - askew.position, {4.0_mm, -8.0_mm, 2.0_mm});
}

}  // namespace
}  // namespace kerf
