// SPDX-License-Identifier: Apache-2.0
#include "devices/simulated_hand/simulated_hand.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/layered_slab.h"
#include "tests/support/probe.h"
#include "tests/support/rig.h"

namespace kerf::simulated_hand {
namespace {

using namespace literals;

constexpr double dt = 1e-3;

Intent down_to(double depth, double speed, double push) {
    return {.legs = {{.target = test::at_depth(depth), .speed = speed, .push = push}}};
}

TEST(SimulatedHand, InAirItArrivesAtItsSpeed) {
    SimulatedHand hand({}, down_to(20.0_mm, 10.0_mm_per_s, 0.5), test::at_depth(0.0), dt);
    int ticks = 0;
    while (!hand.is_done() && ticks < 10000) {
        hand.step({});
        ++ticks;
    }
    EXPECT_NEAR(ticks * dt, 2.0, 0.5 /* it starts from rest */);
    EXPECT_NEAR(-hand.reported().position.z, 20.0_mm, 0.5_mm);
}

/// By which one rotation is ahead of another about z [rad].
double ahead_about_z(Quat from, Quat to) {
    const Quat turn = conjugate(from) * to;
    EXPECT_NEAR(turn.x, 0.0, 1e-12);
    EXPECT_NEAR(turn.y, 0.0, 1e-12);
    return 2.0 * std::atan2(turn.z, turn.w);
}

TEST(SimulatedHand, TurnsADriverManyTimesAtItsSpeedAndEndsThere) {
    for (const double turns : {5.25, -3.0}) {
        Intent intent = down_to(14.0_mm, 7.0_mm_per_s, 0.5);
        intent.legs[0].turn = turns * 2.0 * pi;
        intent.legs[0].turning = 2.0 * pi;
        SimulatedHand hand({}, intent, test::at_depth(0.0), dt);
        double turned = 0.0;
        Quat before = hand.reported().rotation;
        int ticks = 0;
        for (; !hand.is_done() && ticks < 10000; ++ticks) {
            hand.step({});
            const Quat now = hand.reported().rotation;
            const double step = ahead_about_z(before, now);
            EXPECT_LT(std::abs(step), 2.0 * pi * dt + 1e-9) << "and no jump of its sign";
            turned += step;
            before = now;
        }
        EXPECT_NEAR(turned, turns * 2.0 * pi, 1e-6);
        EXPECT_NEAR(ticks * dt, std::abs(turns), 0.01) << "one turn in a second";
    }
}

// ---- a driver that resists ---------------------------------------------------------------------------------------

/// A leg that turns in place.
Intent turn_in_place(double by, double turning) {
    return {.legs = {{.target = test::at_depth(0.0), .push = 0.5, .turn = by, .turning = turning}}};
}

/// A hand and a driver that its wrist of 10 N·m/rad turns: bone asks for a torque that depends on the driver's angle.
struct Driving {
    SimulatedHand hand;
    double friction = 1.0;                            ///< [N·m] of the bone now
    double handle = 0.0, driver = 0.0, anchor = 0.0;  ///< [rad], and by how much the handle is ahead when it is slack
    double torque = 0.0;                              ///< [N·m] of the hand on the driver

    explicit Driving(const Intent& intent, const Plant& plant = {}) : hand(plant, intent, test::at_depth(0.0), dt) {}
    void step(bool has_event = false) {
        const Quat before = hand.reported().rotation;
        Pose tool = test::at_depth(0.0);
        tool.rotation = tool.rotation * quat_from_rotation_vector({0, 0, std::remainder(driver, 4.0 * pi)});
        const Pose now = hand.step({}, SensedTool{.world_from_tool = tool, .torque = torque, .has_event = has_event});
        handle += ahead_about_z(before, now.rotation);
        if (hand.is_regripping()) {
            anchor = handle - driver;
            torque = 0.0;
            return;
        }
        torque = 10.0 * (handle - driver - anchor);
        if (std::abs(torque) <= friction) return;
        torque = std::copysign(friction, torque);
        driver = handle - anchor - torque / 10.0;
    }
};

TEST(SimulatedHand, StopsTurningWhileTheBoneAsksForMoreTorque) {
    Intent intent = turn_in_place(1.0_turns, 1.0);
    intent.legs[0].torque = 3.0;
    Driving driving(intent);
    for (int i = 0; i < 1000; ++i) driving.step();
    EXPECT_NEAR(driving.handle, 1.0, 2e-3) << "1 N·m: it turns";

    // When the bone holds the driver fast, the twist grows until the hand feels 3 N·m, and goes on for its reaction
    driving.friction = 10.0;
    for (int i = 0; i < 2000; ++i) driving.step();
    const double stopped = driving.handle;
    EXPECT_NEAR(driving.torque, 3.0 + 10.0 * 0.15, 0.03);
    for (int i = 0; i < 1000; ++i) driving.step();
    EXPECT_EQ(driving.handle, stopped);

    // Then it goes on when the bone asks for less
    driving.friction = 2.0;
    for (int i = 0; i < 1150; ++i) driving.step();
    EXPECT_NEAR(driving.handle, stopped + 1.0, 5e-3);
    EXPECT_FALSE(driving.hand.is_done());
}

TEST(SimulatedHand, FeelsTheTorqueAgainstItsTurnEitherWay) {
    for (const double sign : {1.0, -1.0}) {
        Intent intent = turn_in_place(sign * 1.0_turns, 1.0);
        intent.legs[0].torque = 0.5;
        Driving driving(intent);
        for (int i = 0; i < 3000; ++i) driving.step();
        EXPECT_NEAR(sign * driving.handle, 0.05 + 0.15, 5e-3) << "0.5 N·m of twist, and one reaction";
    }
}

TEST(SimulatedHand, EndsATurnAtItsTorque) {
    Intent intent = turn_in_place(1.0_turns, 1.0);
    intent.legs[0].until_torque = 2.0;
    intent.legs.push_back({.target = test::at_depth(-5.0_mm), .speed = 10.0_mm_per_s, .push = 0.5});
    Driving driving(intent);
    for (int i = 0; i < 1000; ++i) driving.step();
    EXPECT_EQ(driving.hand.leg(), 0u) << "1 N·m is less";
    driving.friction = 10.0;
    int ticks = 0;
    for (; driving.hand.leg() == 0 && ticks < 3000; ++ticks) driving.step();
    EXPECT_NEAR(ticks, 100 + 150, 2) << "0.1 rad to 2 N·m, and one reaction";
    const double ended = driving.handle;
    for (int i = 0; i < 200; ++i) driving.step();
    EXPECT_EQ(driving.handle, ended);
}

TEST(SimulatedHand, EndsATurnWithItsEvent) {
    Intent intent = turn_in_place(1.0_turns, 1.0);
    intent.legs[0].until_event = "implant.head_contact";
    intent.legs.push_back({.target = test::at_depth(0.0), .push = 0.5, .turn = 1.0, .turning = 1.0});
    Driving driving(intent);
    EXPECT_EQ(driving.hand.awaited_event(), "implant.head_contact");
    for (int i = 0; i < 1000; ++i) driving.step(i == 700);
    EXPECT_EQ(driving.hand.leg(), 1u);
    EXPECT_EQ(driving.hand.awaited_event(), "");

    Driving without(intent);
    for (int i = 0; i < 6200; ++i) without.step();
    EXPECT_EQ(without.hand.leg(), 0u) << "`by` is the most";
    for (int i = 0; i < 200; ++i) without.step();
    EXPECT_EQ(without.hand.leg(), 1u);
}

// Half a turn of the wrist at a time, each less the 0.1 rad by which the wrist gives way: the driver's angle is not
// lost.
TEST(SimulatedHand, RegripsAndLosesNoAngle) {
    for (const double turns : {13.5, -3.0}) {
        Intent intent = turn_in_place(turns * 1.0_turns, pi);
        Driving straight(intent);
        while (!straight.hand.is_done()) straight.step();
        intent.legs[0].regrip = 180.0_deg;
        Driving driving(intent);
        int grips = 1, ticks = 0;
        double least = 0.0, most = 0.0;
        bool was_regripping = false;
        for (; !driving.hand.is_done() && ticks < 100000; ++ticks) {
            driving.step();
            grips += was_regripping && !driving.hand.is_regripping();
            was_regripping = driving.hand.is_regripping();
            least = std::min(least, driving.handle);
            most = std::max(most, driving.handle);
        }
        EXPECT_NEAR(driving.driver, straight.driver, 1e-6);
        EXPECT_NEAR(driving.driver, turns * 1.0_turns - std::copysign(0.1, turns), 1e-6);
        EXPECT_NEAR(most - least, pi, 1e-3) << "within the wrist";
        EXPECT_EQ(grips, std::ceil(std::abs(turns) * 2.0 * pi / (pi - 0.1))) << turns;
        EXPECT_NEAR(ticks * dt, std::abs(turns) * 2.0 + (grips - 1) * (0.5 * pi + 0.1 / pi), 0.1);
    }
}

TEST(SimulatedHand, MovesNotInTheTickInWhichItLetsGoOrTakesHold) {
    Intent intent = turn_in_place(2.0_turns, pi);
    intent.legs[0].regrip = 180.0_deg;
    Driving driving(intent);
    bool was_regripping = false;
    int changes = 0;
    for (int i = 0; i < 5000; ++i) {
        const double before = driving.handle;
        driving.step();
        if (driving.hand.is_regripping() != was_regripping) {
            ++changes;
            EXPECT_EQ(driving.handle, before) << i;
        }
        was_regripping = driving.hand.is_regripping();
    }
    EXPECT_GE(changes, 3);
}

TEST(SimulatedHand, ReportsItsTurnInCounts) {
    const double count = 0.09_deg;
    Driving driving(turn_in_place(0.1_turns, 0.3), {.turn_resolution = count});
    for (int i = 0; i < 1000; ++i) {
        driving.step();
        EXPECT_NEAR(std::remainder(driving.handle, count), 0.0, 1e-9);
    }
    EXPECT_NEAR(driving.handle, 0.3, 0.51 * count);
}

TEST(SimulatedHand, ArrivesInEveryDirection) {
    for (int i = 1; i <= 100; ++i) {
        const Quat rotation = normalized(Quat{0.7, -0.7 + 0.003 * i, 0.01 * i, -0.007 * i});
        const Pose start{{}, i % 2 == 0 ? Quat{1, 0, 0, 0} : rotation}, end{rotate(rotation, {0, 0, 5.0_mm}), rotation};
        SimulatedHand hand({}, {.legs = {{.target = end, .speed = 10.0_mm_per_s, .push = 0.5}}}, start, dt);
        for (int tick = 0; tick < 5000 && !hand.is_done(); ++tick) hand.step({});
        EXPECT_TRUE(hand.is_done()) << i;
    }
}

TEST(SimulatedHand, AgainstAWallItLeansInAndNeverBeyondItsPush) {
    // A wall of 1 N/mm at 5 mm
    const double push = 0.6;
    SimulatedHand hand({}, down_to(20.0_mm, 10.0_mm_per_s, push), test::at_depth(0.0), dt);
    double mean = 0.0;
    for (int i = 0; i < 20000; ++i) {
        const double force = std::max(0.0, 1000.0 * (-hand.reported().position.z - 5.0_mm));
        if (i >= 18000) mean += force / 2000.0;
        hand.step({.wrench = {0, 0, force}, .setpoint = {}});
    }
    // What friction takes is made up for: at rest it may hold back as much, or nothing
    EXPECT_GT(mean, push - 0.02 /* half a count of the encoder */);
    EXPECT_LT(mean, push + 2.0 * Plant{}.device_friction + 0.02);
    EXPECT_FALSE(hand.is_done());
}

TEST(SimulatedHand, InBoneItPushesAlikeOnEveryDevice) {
    // 20 N of bone, against a wall of 100 N/mm of bone; whatever the scale, and the device's friction on top
    for (const char* id : {"touch", "desktop", "premium-1.5-6dof", "omega.6"})
        for (const double scale : {1.0 / 300.0, 1.0 / 100.0}) {
            const DeviceRecord& device = *find_device(id);
            const Plant plant = in_bone({.device_mass = device.mass,
                                         .device_viscosity = device.viscosity,
                                         .device_friction = device.friction,
                                         .resolution = 0.0},
                                        scale);
            SimulatedHand hand(plant, down_to(20.0_mm, 1.0_mm_per_s, 20.0 * scale), test::at_depth(0.0), dt);
            double force = 0.0;
            for (int i = 0; i < 15000; ++i) {
                force = std::max(0.0, scale * 1e5 * -hand.reported().position.z);
                hand.step({.wrench = {0, 0, force}, .setpoint = {}});
            }
            EXPECT_GT(force / scale, 19.5) << id << " at " << scale;
            EXPECT_LT(force / scale, 20.5 + 2.0 * device.friction / scale) << id << ": friction may hold it in";
        }
}

TEST(SimulatedHand, BringsBackATipThatItSeesBesideItsWay) {
    // The tip stays 2 mm off the handle, and the aim goes twice as far to the other side as the tip is off.
    SimulatedHand hand({.device_friction = 0.0}, down_to(60.0_mm, 5.0_mm_per_s, 0.5), test::at_depth(0.0), dt);
    for (int i = 0; i < 8000; ++i) hand.step({}, hand.reported().position + Vec3{2.0_mm, 0, 0});
    EXPECT_NEAR(hand.reported().position.x, -4.0_mm / 3.0, 0.05_mm);
    EXPECT_NEAR(hand.reported().position.y, 0.0, 1e-9);
}

TEST(SimulatedHand, DoesNotPushEverHarderAgainstAHoleThatIsALittleAside) {
    SimulatedHand hand({.device_friction = 0.0}, down_to(60.0_mm, 1.0_mm_per_s, 0.5), test::at_depth(0.0), dt);
    for (int i = 0; i < 40000; ++i) hand.step({}, Vec3{0.2_mm, 0, hand.reported().position.z});
    EXPECT_NEAR(hand.reported().position.x, -0.4_mm, 0.03_mm) << "twice as far as the hole is aside, also after 40 s";
}

TEST(SimulatedHand, GivesUpWhereItSeesTheTipTooFarAside) {
    const Pose out = test::at_depth(-5.0_mm);
    const Intent intent{
        .legs = {{.target = test::at_depth(20.0_mm), .speed = 5.0_mm_per_s, .push = 0.5, .skip_distance = 1.0_mm},
                 {.target = test::at_depth(40.0_mm), .speed = 5.0_mm_per_s, .push = 0.5},
                 {.target = out, .speed = 5.0_mm_per_s, .push = 0.5}}};
    for (const double aside : {0.9_mm, 1.1_mm}) {
        SimulatedHand hand({}, intent, test::at_depth(0.0), dt);
        for (int i = 0; i < 1000; ++i) hand.step({}, hand.reported().position + Vec3{aside, 0, 0});
        EXPECT_EQ(hand.leg(), aside > 1.0_mm ? 2u : 0u);
    }
}

TEST(SimulatedHand, TurnsInPlaceWhereALegHasNoLength) {
    const Pose start = test::at_depth(3.0_mm), turned = test::at_depth(3.0_mm, 0.5);
    SimulatedHand hand({}, {.legs = {{.target = {start.position, turned.rotation}, .push = 0.5}}}, start, dt);
    int ticks = 0;
    for (; !hand.is_done() && ticks < 2000; ++ticks) hand.step({});
    EXPECT_NEAR(ticks * dt, 0.5, 0.05) << "at 1 rad/s";
    EXPECT_LT(length(hand.reported().position - start.position), 0.05_mm);
}

/// Peak to peak of the handle [m] in the last second of twelve, pressed on a wall by a coupling of `stiffness`.
double unrest_on_a_wall(bool renders_setpoint, double stiffness) {
    CouplingGains gains = test::gains(1.0);
    gains.stiffness = stiffness;
    gains.damping = 0.0;
    gains.force_limit = 50.0;
    gains.spare_damping = gains.release_damping = 0.0;  // the spring alone
    test::Rig simulation(test::block({-5.0_mm, -5.0_mm, -8.0_mm}, {5.0_mm, 5.0_mm, 0}, 0.25_mm),
                         test::probe(20000.0_N_per_mm), test::at_depth(-1.0_mm), gains);
    SimulatedHand hand({.renders_setpoint = renders_setpoint}, down_to(20.0_mm, 10.0_mm_per_s, 3.0),
                       test::at_depth(-1.0_mm), dt);
    double low = 1.0, high = -1.0;
    for (int i = 0; i < 12000; ++i) {
        hand.step(simulation.tick({hand.reported()}).command, simulation.world_from_tool().position);
        if (i < 11000) continue;
        low = std::min(low, hand.reported().position.z);
        high = std::max(high, hand.reported().position.z);
    }
    return high - low;
}

// After a pause the tool is 3 mm behind the handle and 1 mm next to it, and tilted by 2 degrees.
TEST(SimulatedHand, AimsWithTheToolAsItLiesInTheHand) {
    SimulatedHand hand({}, down_to(20.0_mm, 10.0_mm_per_s, 0.5), test::at_depth(0.0), dt);
    const Pose handle_from_tool{{1.0_mm, 0.0, 3.0_mm}, quat_from_rotation_vector({0.0, 2.0_deg, 0.0})};
    hand.regrasp(handle_from_tool);
    for (int tick = 0; tick < 10000 && !hand.is_done(); ++tick)
        hand.step({}, SensedTool{.world_from_tool = hand.reported() * handle_from_tool});
    ASSERT_TRUE(hand.is_done());
    const Pose tool = hand.reported() * handle_from_tool, goal = test::at_depth(20.0_mm);
    EXPECT_NEAR(length(tool.position - goal.position), 0.0, 0.5_mm);
    EXPECT_NEAR(length(small_rotation_vector(conjugate(goal.rotation) * tool.rotation)), 0.0, 1e-3);
}

TEST(SimulatedHand, ADeviceThatAsksForSetpointsHoldsASpringTheLoopCannot) {
    const double soft = 1000.0, stiff = 60000.0;  // [N/m]; the loop alone can hold some b/(T/2) = 13 N/mm
    EXPECT_LT(unrest_on_a_wall(false, soft), 3.0 * Plant{}.resolution);
    EXPECT_LT(unrest_on_a_wall(true, soft), 3.0 * Plant{}.resolution);
    EXPECT_GT(unrest_on_a_wall(false, stiff), 10.0 * Plant{}.resolution);
    EXPECT_LT(unrest_on_a_wall(true, stiff), 3.0 * Plant{}.resolution);
}

/// How far the tip runs past the far face of the layered slab [m].
double plunge(double push, double reaction) {
    const CouplingGains gains = test::gains(1.0 / 100.0);
    test::Rig simulation(test::Slab::make(0.25_mm, {0.2, 0.3, 0.4}), test::twist_drill(), test::at_depth(-1.0_mm),
                         gains);
    // Up to the middle of the far cortex by hand and clockwork, so that only the breakthrough is compared.
    (void)simulation.feed(-1.0_mm, 15.0_mm, 4.0_um);
    const Pose start = simulation.world_from_tool();
    SimulatedHand hand(
        {},
        {.legs = {{.target = test::at_depth(60.0_mm), .speed = 1.0_mm_per_s, .push = push * gains.force_scale}},
         .reaction = reaction},
        start, dt);
    double deepest = 0.0;
    int after_clearing = 0;
    while (after_clearing < 1500 && simulation.ticks() < 60000) {
        const TickResult result = simulation.tick({hand.reported()});
        hand.step(result.command, result.world_from_tool.position);
        const double depth = -result.world_from_tool.position.z;
        if (depth > test::Slab::third + 0.96_mm) ++after_clearing;
        deepest = std::max(deepest, depth - test::Slab::third - 0.96_mm);
    }
    EXPECT_GT(after_clearing, 0) << "it never got through";
    return deepest;
}

TEST(SimulatedHand, AHastyHandPlungesFartherThanACarefulOne) {
    const double careful = plunge(110.0, 0.10), hasty = plunge(200.0, 0.35);
    EXPECT_GT(hasty, careful + 2.0_mm);
    RecordProperty("careful_mm", std::to_string(careful * 1e3));
    RecordProperty("hasty_mm", std::to_string(hasty * 1e3));
}

// ---- an aim from outside -----------------------------------------------------------------------------------------

/// Returns the hand's position along x after some time, while a constant force pushes it back.
double after_aiming(double aim, double max_push, double force, double seconds) {
    SimulatedHand hand({}, {}, identity_pose(), dt);
    hand.aim_at({{aim, 0, 0}, {1, 0, 0, 0}}, max_push);
    DeviceCommand command;
    command.wrench = make_vec6({-force, 0, 0}, {});
    for (int i = 0; i < seconds / dt; ++i) hand.step(command);
    return hand.reported().position.x;
}

TEST(SimulatedHand, GoesToAnAimWithoutLegs) { EXPECT_NEAR(after_aiming(50.0_mm, 30.0, 0.0, 3.0), 50.0_mm, 0.5_mm); }

TEST(SimulatedHand, PushesToAnAimWithItsMaximum) {
    constexpr double far = 1e3;  // [m]
    EXPECT_GT(after_aiming(far, 5.0, 4.8, 2.0), 0.0);
    EXPECT_LT(after_aiming(far, 5.0, 5.2, 2.0), 0.0) << "a push of 5 N does not hold 5.2 N";
}

TEST(SimulatedHand, TurnsTheWristToAnAim) {
    SimulatedHand hand({}, {}, identity_pose(), dt);
    const Quat target = quat_from_rotation_vector({0, 1.0, 0});
    hand.aim_at({{}, target}, 5.0);
    for (int i = 0; i < 500; ++i) hand.step({});
    EXPECT_NEAR(small_rotation_vector(hand.reported().rotation).y, 0.5, 0.05) << "at most 1 rad/s";
    for (int i = 0; i < 700; ++i) hand.step({});
    EXPECT_NEAR(length(small_rotation_vector(conjugate(target) * hand.reported().rotation)), 0.0, 1e-9);
}

TEST(SimulatedHand, IgnoresAnAimThatIsNotFinite) {
    SimulatedHand hand({}, {}, identity_pose(), dt);
    hand.aim_at({{10.0_mm, 0, 0}, {1, 0, 0, 0}}, 5.0);
    hand.aim_at({{std::nan(""), 0, 0}, {1, 0, 0, 0}}, 5.0);
    hand.aim_at({{1.0_m, 0, 0}, {1, 0, 0, 0}}, HUGE_VAL);
    for (int i = 0; i < 3000; ++i) hand.step({});
    EXPECT_NEAR(hand.reported().position.x, 10.0_mm, 0.5_mm);
}

}  // namespace
}  // namespace kerf::simulated_hand
