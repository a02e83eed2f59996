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
    // The tip stays 2 mm beside the handle: the handle goes as far to the other side
    SimulatedHand hand({.device_friction = 0.0}, down_to(60.0_mm, 5.0_mm_per_s, 0.5), test::at_depth(0.0), dt);
    for (int i = 0; i < 8000; ++i) hand.step({}, hand.reported().position + Vec3{2.0_mm, 0, 0});
    EXPECT_NEAR(hand.reported().position.x, -2.0_mm, 0.1_mm);
    EXPECT_NEAR(hand.reported().position.y, 0.0, 1e-9);
}

TEST(SimulatedHand, GivesUpWhereItSeesTheTipTooFarAside) {
    const Pose out = test::at_depth(-5.0_mm);
    const Intent intent{
        .legs = {{.target = test::at_depth(20.0_mm), .speed = 5.0_mm_per_s, .push = 0.5, .stop_aside = 1.0_mm},
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
double unrest_on_a_wall(bool asks_setpoint, double stiffness) {
    CouplingGains gains = test::gains(1.0);
    gains.stiffness = stiffness;
    gains.damping = 0.0;
    gains.force_limit = 50.0;
    gains.spare_damping = gains.release_damping = 0.0;  // the spring alone
    test::Rig simulation(test::block({-5.0_mm, -5.0_mm, -8.0_mm}, {5.0_mm, 5.0_mm, 0}, 0.25_mm),
                         test::probe(20000.0_N_per_mm), test::at_depth(-1.0_mm), gains);
    SimulatedHand hand({.asks_setpoint = asks_setpoint}, down_to(20.0_mm, 10.0_mm_per_s, 3.0), test::at_depth(-1.0_mm),
                       dt);
    double low = 1.0, high = -1.0;
    for (int i = 0; i < 12000; ++i) {
        hand.step(simulation.tick({hand.reported()}).command, simulation.world_from_tool().position);
        if (i < 11000) continue;
        low = std::min(low, hand.reported().position.z);
        high = std::max(high, hand.reported().position.z);
    }
    return high - low;
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

}  // namespace
}  // namespace kerf::simulated_hand
