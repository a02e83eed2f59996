// SPDX-License-Identifier: Apache-2.0
// Bone, hand and tool, turned and moved together: every force turns with them, and nothing else changes.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/probe.h"
#include "tests/support/rig.h"

namespace kerf {
namespace {

using namespace literals;

const Pose nowhere_special{{0.31, -0.22, 0.54}, quat_from_rotation_vector({0.7, -1.1, 0.4})};

/// A probe that a hand presses on a block, in a world that is `world` of the block's own.
struct PressedIn {
    Pose world;
    Body body = test::block({-10.0_mm, -10.0_mm, -4.0_mm}, {10.0_mm, 10.0_mm, 0}, 0.25_mm, {0.3, 0.1, 0.7});
    ToolSetup setup;
    Simulation simulation;

    PressedIn(const Pose& of_world, double scale, double stiffness = 20.0_N_per_mm)
        : world(of_world),
          setup(test::probe(stiffness)),
          simulation(body, setup, test::outline(setup), test::gains(scale), world * test::at_depth(-0.5_mm)) {
        simulation.place_body(0, world);
    }
    TickResult tick(const Pose& hand, std::uint32_t missed = 0) { return simulation.tick({world * hand, missed}); }
};

/// The hand of tick `t`: it presses beyond the device's force, goes aside, tilts, turns, and backs off twice.
Pose hand_at(double t) {
    const double phase = 2.0 * pi * t / 400.0, depth = -0.5_mm + 20.0_mm * (1.0 - std::cos(phase));
    const Pose straight = test::at_depth(depth, 0.1 * std::sin(phase), {2.0_mm * std::sin(3.0 * phase), 0, 0});
    return {straight.position + Vec3{0, 1.0_mm * std::sin(2.0 * phase), 0},
            straight.rotation * quat_from_rotation_vector({0.1 * std::sin(phase), 0, 0.4 * std::sin(2.0 * phase)})};
}

void expect_turned(const Vec6& here, const Vec6& there, int t, const char* what) {
    const Vec6 wanted = rotated(nowhere_special.rotation, here);
    for (std::size_t i = 0; i < 6; ++i) ASSERT_NEAR(there[i], wanted[i], 1e-6) << what << ' ' << i << ", tick " << t;
}

void expect_same_tick(const TickResult& here, const TickResult& there, int t) {
    expect_turned(here.bone_on_tool, there.bone_on_tool, t, "bone_on_tool");
    expect_turned(here.coupled_on_hand, there.coupled_on_hand, t, "coupled_on_hand");
    expect_turned(here.limited_on_hand, there.limited_on_hand, t, "limited_on_hand");
    expect_turned(here.command.wrench, there.command.wrench, t, "wrench");
    expect_turned(make_vec6(here.released_on_hand, here.command.setpoint.carried),
                  make_vec6(there.released_on_hand, there.command.setpoint.carried), t, "released_on_hand, carried");
    expect_turned(make_vec6(here.command.setpoint.velocity, {}), make_vec6(there.command.setpoint.velocity, {}), t,
                  "velocity");
    const Vec3 to = nowhere_special * here.command.setpoint.position;
    ASSERT_LT(length(there.command.setpoint.position - to), 1e-9) << "position, tick " << t;
    ASSERT_LT(length(there.world_from_tool.position - nowhere_special * here.world_from_tool.position), 1e-9) << t;
    for (std::size_t i = 0; i < 6; ++i) ASSERT_NEAR(there.rate[i], here.rate[i], 1e-7) << "rate, tick " << t;
    ASSERT_NEAR(there.thrust, here.thrust, 1e-6) << t;
    ASSERT_NEAR(there.torque, here.torque, 1e-6) << t;
    ASSERT_NEAR(there.power_hand, here.power_hand, 1e-6) << t;
    ASSERT_EQ(there.parts, here.parts) << t;
}

TEST(TurnedWorld, TurnsEveryForceAndNothingElse) {
    double max_force = 0.0, max_released = 0.0;
    int max_parts = 0;
    for (const double scale : {1.0, 0.25}) {
        PressedIn here(identity_pose(), scale), there(nowhere_special, scale);
        for (int t = 0; t < 800; ++t) {
            const std::uint32_t missed = t % 100 == 50 ? 1 : 0;
            const TickResult a = here.tick(hand_at(t), missed), b = there.tick(hand_at(t), missed);
            ASSERT_NO_FATAL_FAILURE(expect_same_tick(a, b, t));
            max_force = std::max(max_force, length(linear(a.command.wrench)));
            max_released = std::max(max_released, length(a.released_on_hand));
            max_parts = std::max(max_parts, a.parts);
        }
        EXPECT_NEAR(there.simulation.passivity().energy(), here.simulation.passivity().energy(), 1e-8);
        EXPECT_NEAR(there.simulation.passivity().min_energy(), here.simulation.passivity().min_energy(), 1e-8);
    }
    EXPECT_GT(max_force, 8.4) << "the anchor slid";
    EXPECT_GT(max_released, 0.01) << "the tool came loose";
    EXPECT_GT(max_parts, 1) << "a tick had parts";
}

// A probe without mass or friction, on a law without a load of its own: bone and hand balance.
TEST(Tick, BoneAndHandBalanceInATickOfManyParts) {
    // Given a probe that is pressed on the block, and a hand that takes it aside ever faster, up to 0.3 mm a tick
    PressedIn rig(nowhere_special, 1.0);
    for (int t = 0; t < 100; ++t) (void)rig.tick(test::at_depth(0.02_mm * t, 0.0, {-4.0_mm, 0, 0}));
    int in_parts = 0;
    for (double t = 0; t < 30; ++t) {
        const TickResult result = rig.tick(test::at_depth(2.0_mm, 0.0, {-4.0_mm + 0.005_mm * t * t, 0, 0}));
        in_parts += result.parts > 1;
        ASSERT_GT(result.thrust, 0.5);
        ASSERT_LT(length(linear(result.limited_on_hand) - linear(result.bone_on_tool)), 1e-6) << t;
    }
    EXPECT_GT(in_parts, 5);
}

TEST(Tick, TheHandGetsFartherInEachPart) {
    // Given a hand that goes 0.3 mm aside and 0.1 mm deeper in each tick, on a wall that does not give
    PressedIn rig(identity_pose(), 1.0, 1e8);
    const CouplingGains gains = test::gains(1.0);
    TickResult result;
    for (int t = 0; t <= 60; ++t) result = rig.tick(test::at_depth(0.1_mm * t, 0.0, {0.3_mm * (t - 30), 0, 0}));

    // Then its stretch is that of the middle of its parts: 1/3, 2/3 and 3/3 of the tick's motion are 2/3 on average
    ASSERT_EQ(result.parts, 3);
    const double stretch = 6.0_mm - 0.1_mm / 3.0;
    EXPECT_NEAR(result.thrust, gains.stiffness * stretch + gains.damping * 0.1, 1e-3);
}

TEST(Tick, ThrustIsTheForceAlongTheToolAsItWas) {
    PressedIn rig(nowhere_special, 1.0);
    double largest = 0.0;
    for (double t = 0; t < 200; t += 0.1) {
        const Vec3 shaft = rotate(rig.simulation.world_from_tool().rotation, {0, 0, 1});
        const TickResult result = rig.tick(hand_at(t));
        if (result.parts > 1) continue;
        ASSERT_NEAR(result.thrust, -dot(linear(result.bone_on_tool), shaft), 1e-9) << t;
        ASSERT_NEAR(result.torque, -dot(angular(result.bone_on_tool), shaft), 1e-9) << t;
        largest = std::max(largest, result.thrust);
    }
    EXPECT_GT(largest, 1.0);
}

TEST(TickDirect, ThrustIsTheForceAlongTheToolAsItWas) {
    PressedIn rig(nowhere_special, 1.0);
    for (int t = 0; t < 20; ++t) (void)rig.simulation.tick_direct({rig.world * test::at_depth(0.001_mm * t)});
    const Vec3 shaft = rotate(rig.simulation.world_from_tool().rotation, {0, 0, 1});
    const TickResult result = rig.simulation.tick_direct({rig.world * test::at_depth(0.02_mm, 0.3)});
    ASSERT_GT(result.thrust, 0.1);
    EXPECT_NEAR(result.thrust, -dot(linear(result.bone_on_tool), shaft), 1e-9);
}

TEST(Tick, ATurnAboutTheTipIsNoSkid) {
    PressedIn rig(identity_pose(), 1.0);
    for (int t = 0; t < 100; ++t) (void)rig.tick(test::at_depth(0.01_mm * t));
    for (int t = 0; t < 100; ++t) {
        const TickResult result = rig.tick(test::at_depth(1.0_mm, 0.5e-3 * t));  // 50 mm/s at the grip
        ASSERT_GT(result.thrust, 0.1);
        ASSERT_EQ(result.parts, 1) << t;
    }
}

}  // namespace
}  // namespace kerf
