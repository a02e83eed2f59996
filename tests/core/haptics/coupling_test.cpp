// SPDX-License-Identifier: Apache-2.0
// Signs, bounds and clamps of the coupling, with round numbers. Each test changes one of them.
#include "core/haptics/loop/coupling.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kerf/math.hpp"
#include "kerf/units.hpp"

namespace kerf {
namespace {

using namespace literals;

constexpr Vec3 grip{0, 0, -100e-3};
constexpr ToolGrip at_grip{.grip_z = grip.z};
constexpr double dt = 1e-3;
const Pose origin = identity_pose();

CouplingGains gains() {
    CouplingGains g;
    g.stiffness = 1000.0;
    g.damping = 2.0;
    g.force_limit = 8.0;
    g.torque_limit = 0.2;  // reached at 80 mrad: 1000 N/m · (50 mm)² = 2.5 N·m/rad
    g.has_torque = true;
    g.release_damping = 50.0;
    return g;
}

Pose moved(Vec3 by) { return {by, {1, 0, 0, 0}}; }
/// Turned about the grip, which stays where it is.
Pose turned_about_grip(Vec3 by) {
    const Quat turn = quat_from_rotation_vector(by);
    return {grip - rotate(turn, grip), turn};
}

Balance held(const Coupling& coupling, const Pose& handle, const Vec6& hand_rate = {}, const Pose& tool = origin) {
    Balance balance;
    coupling.hold(handle, hand_rate, tool, dt, balance);
    return balance;
}

void expect_near(Vec3 is, Vec3 wanted, double tolerance = 1e-9) {
    EXPECT_NEAR(is.x, wanted.x, tolerance);
    EXPECT_NEAR(is.y, wanted.y, tolerance);
    EXPECT_NEAR(is.z, wanted.z, tolerance);
}

// ---- what the solve gets -----------------------------------------------------------------------------------------

TEST(Coupling, PullsTheToolTowardsTheHand) {
    for (const Vec3 way : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        const Balance b = held({gains(), at_grip}, moved(1.0_mm * way));
        expect_near(b.force.pull, 1.0 * way);
        expect_near(b.torque.pull, {});
        EXPECT_DOUBLE_EQ(b.force.drag.across, 2.0 + 1.0) << "damping, and what the spring gains in a tick";
        EXPECT_DOUBLE_EQ(b.force.limit.across, 8.0);
        EXPECT_DOUBLE_EQ(b.dt, dt);
        EXPECT_TRUE(b.centre == grip);
    }
}

TEST(Coupling, StatesItsPullInTheToolsFrame) {
    const Pose tool{{}, quat_from_rotation_vector({0, 0, 0.5 * pi})};
    const Pose handle{{1.0_mm, 0, 0}, tool.rotation};
    expect_near(held({gains(), at_grip}, handle, {}, tool).force.pull, {0, -1.0, 0});
}

TEST(Coupling, TurnsTheToolAfterTheHand) {
    for (const Vec3 about : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        const Balance b = held({gains(), at_grip}, turned_about_grip(0.04 * about));
        expect_near(b.torque.pull, 0.1 * about, 1e-6 /* sine for angle */);
        expect_near(b.force.pull, {});
        EXPECT_DOUBLE_EQ(b.torque.drag.across, 2.5e-3 * 3.0);
        EXPECT_DOUBLE_EQ(b.torque.limit.across, 0.2);
    }
}

TEST(Coupling, DampsTheMotionOfTheGrip) {
    // ω × grip: 0.5 rad/s about y move a grip 100 mm behind by −50 mm/s along x
    const Vec6 rate = make_vec6({0.1, 0.02, 0.03}, {0, 0.5, 0});
    const Balance b = held({gains(), at_grip}, origin, rate);
    expect_near(b.hand_velocity, {0.05, 0.02, 0.03});
    expect_near(b.hand_turn, {0, 0.5, 0});
    expect_near(b.force.pull, {0.1, 0.04, 0.06});
    expect_near(b.torque.pull, {0, 2.5e-3 * 2.0 * 0.5, 0});
}

TEST(Coupling, ScalesGainsToTheBonesSide) {
    CouplingGains scaled = gains();
    scaled.force_scale = 0.25;
    const Balance b = held({scaled, at_grip}, moved({0, 0, 1.0_mm}));
    EXPECT_DOUBLE_EQ(b.force.pull.z, 4.0);
    EXPECT_DOUBLE_EQ(b.force.drag.across, 12.0);
    EXPECT_DOUBLE_EQ(b.force.limit.across, 32.0);
    EXPECT_DOUBLE_EQ(b.torque.limit.across, 0.8);
    EXPECT_DOUBLE_EQ(b.release_damping, 200.0);
}

// ---- a new tool --------------------------------------------------------------------------------------------------

TEST(Coupling, AHandTakesAToolStraightAgainInAir) {
    // Given a tool that it took 2 mm aside and turned by 50 mrad
    Coupling coupling(gains(), at_grip);
    const Pose tool{{2.0_mm, 0, 0}, quat_from_rotation_vector({0, 0.05, 0})};
    coupling.relax(origin, tool);
    expect_near(held(coupling, origin, {}, tool).force.pull, {});

    // When it straightens it, a hundredth at a time
    EXPECT_TRUE(coupling.straighten(0.01));
    const Balance first = held(coupling, origin, {}, tool);
    EXPECT_GT(length(first.force.pull), 0.0);
    int left = 1;
    while (coupling.straighten(0.01) && left < 10000) ++left;

    // Then it pulls as if it had never been taken otherwise
    EXPECT_LT(left, 2000);
    const Balance fresh = held({gains(), at_grip}, origin, {}, tool), last = held(coupling, origin, {}, tool);
    EXPECT_TRUE(last.force.pull == fresh.force.pull);
    EXPECT_TRUE(last.torque.pull == fresh.torque.pull);
    EXPECT_LT(length(first.force.pull), 0.02 * length(last.force.pull));
}

// ---- release -----------------------------------------------------------------------------------------------------

TEST(Release, BeginsFiveMillimetresASecondBeyondTheHand) {
    const Coupling coupling(gains(), at_grip);
    const Pose ahead = moved({0, 0, 2.0_mm});
    const Balance rest = held(coupling, ahead), towards = held(coupling, ahead, make_vec6({0, 0, 50.0_mm_per_s}, {}));
    expect_near(rest.release_along, {0, 0, 1});
    EXPECT_DOUBLE_EQ(rest.release_damping, 50.0);
    EXPECT_DOUBLE_EQ(rest.release_from, 5.0_mm_per_s);
    EXPECT_NEAR(towards.release_from, 55.0_mm_per_s, 1e-12);
}

TEST(Release, LeavesAHandThatBacksOffAlone) {
    // Given a hand that is 2 mm ahead of its tool, and backs off at 50 mm/s
    const Balance b = held({gains(), at_grip}, moved({0, 0, 2.0_mm}), make_vec6({0, 0, -50.0_mm_per_s}, {}));

    // Then a tool at rest is not released, nor one that follows by 5 mm/s; one that is faster is
    EXPECT_DOUBLE_EQ(b.release_from, 5.0_mm_per_s);
    EXPECT_EQ(at_rate(b, {}).release, 0.0);
    EXPECT_EQ(at_rate(b, {0, 0, 5.0_mm_per_s, 0, 0, 0}).release, 0.0);
    EXPECT_NEAR(at_rate(b, {0, 0, 15.0_mm_per_s, 0, 0, 0}).release, 50.0 * 10.0_mm_per_s, 1e-12);
}

TEST(Release, ActsAlongTheShaftOnly) {
    const Balance b = held({gains(), at_grip}, moved({5.0_mm, 0, -2.0_mm}));
    expect_near(b.release_along, {0, 0, -1});
    EXPECT_EQ(held({gains(), at_grip}, moved({5.0_mm, 0, 0})).release_damping, 0.0);
}

TEST(Release, NeedsAPull) {
    const Coupling coupling(gains(), at_grip);
    Balance b;
    coupling.hold(moved({0, 0, 2.0_mm}), {}, origin, dt, b);
    EXPECT_EQ(b.release_damping, 50.0);
    coupling.hold(origin, {}, origin, dt, b);
    EXPECT_EQ(b.release_damping, 0.0) << "nothing is left of the tick before";
}

// ---- the anchor --------------------------------------------------------------------------------------------------

TEST(Anchor, StaysWhileTheStretchIsWithinTheLimit) {
    Coupling coupling(gains(), at_grip);
    const Pose handle = moved({3.0_mm, -2.0_mm, 5.0_mm});
    coupling.slide(handle, origin);
    expect_near(held(coupling, handle).force.pull, {3.0, -2.0, 5.0});
    expect_near(held(coupling, origin).force.pull, {});
}

TEST(Anchor, SlidesByWhatIsBeyondTheLimit) {
    Coupling coupling(gains(), at_grip);
    const Pose handle = moved({0, 20.0_mm, 0});
    coupling.slide(handle, origin);
    expect_near(held(coupling, handle).force.pull, {0, 8.0, 0});
    expect_near(held(coupling, moved({0, 12.0_mm, 0})).force.pull, {});

    // A second time it is at its limit, and stays
    coupling.slide(handle, origin);
    expect_near(held(coupling, moved({0, 12.0_mm, 0})).force.pull, {});

    // On the way back the spring is slack where the anchor is
    expect_near(held(coupling, moved({0, 10.0_mm, 0})).force.pull, {0, -2.0, 0});
}

TEST(Anchor, SlipsInRotationBeyondTheLimit) {
    Coupling coupling(gains(), at_grip);
    const Pose handle = turned_about_grip({0.3, 0, 0});
    coupling.slide(handle, origin);
    expect_near(held(coupling, handle).torque.pull, {0.2, 0, 0}, 1e-3 /* sine for angle */);
    EXPECT_LT(held(coupling, turned_about_grip({0.1, 0, 0})).torque.pull.x, 0.0) << "it has slipped by 0.22 rad";

    Coupling within(gains(), at_grip);
    within.slide(turned_about_grip({0.07, 0, 0}), origin);
    expect_near(held(within, origin).torque.pull, {});
}

TEST(Anchor, LetGoNothingIsStored) {
    Coupling coupling(gains(), at_grip);
    const Pose handle{{1.0_mm, 2.0_mm, 3.0_mm}, quat_from_rotation_vector({0.02, -0.03, 0.01})};
    const Pose tool{{-4.0_mm, 1.0_mm, 0.0}, quat_from_rotation_vector({0.1, 0.2, 0.3})};
    coupling.relax(handle, tool);
    const Balance b = held(coupling, handle, {}, tool);
    expect_near(b.force.pull, {});
    expect_near(b.torque.pull, {});
    EXPECT_NEAR(coupling.stored(handle, tool), 0.0, 1e-15);
}

TEST(Anchor, StoresWhatSpringsDo) {
    const Coupling coupling(gains(), at_grip);
    EXPECT_NEAR(coupling.stored(moved({0, 0, 2.0_mm}), origin), 0.5 * 1000.0 * 4e-6, 1e-12);
    EXPECT_NEAR(coupling.stored(turned_about_grip({0, 0.04, 0}), origin), 0.5 * 2.5 * 1.6e-3, 1e-6);
    EXPECT_NEAR(coupling.stored(moved({0, 0, 50.0_mm}), origin), 0.5 * 1000.0 * 64e-6, 1e-12) << "no more than 8 mm";
    EXPECT_NEAR(coupling.stored(turned_about_grip({0.5, 0, 0}), origin), 0.5 * 2.5 * 6.4e-3, 1e-12) << "or 80 mrad";

    CouplingGains without = gains();
    without.has_torque = false;
    EXPECT_NEAR(Coupling(without, at_grip).stored(turned_about_grip({0, 0.04, 0}), origin), 0.0, 1e-15)
        << "a device without torque gives nothing back";
}

TEST(Anchor, IsAllowedAShareOfEachLimit) {
    Coupling coupling(gains(), at_grip);
    coupling.set_allowed_fractions(0.5, 0.25);
    EXPECT_DOUBLE_EQ(coupling.force_limit(), 4.0);
    EXPECT_DOUBLE_EQ(coupling.torque_limit(), 0.05);
    const Pose handle = moved({20.0_mm, 0, 0});
    coupling.slide(handle, origin);
    const Balance b = held(coupling, handle);
    expect_near(b.force.pull, {4.0, 0, 0});
    EXPECT_DOUBLE_EQ(b.force.limit.across, 4.0);
    EXPECT_DOUBLE_EQ(b.torque.limit.across, 0.05);
}

// ---- the anchor of a tool that lies askew --------------------------------------------------------------------------

/// Takes x to y, y to z and z to x.
const Quat cycled{0.5, 0.5, 0.5, 0.5};

TEST(Anchor, SlidesInTheWorldAndNotInTheTool) {
    // Given a tool whose z is the world's x, and a hand 20 mm ahead of it
    Coupling coupling(gains(), at_grip);
    const Pose tool{{}, cycled};
    const auto hand_at = [&](double x) { return Pose{{x, 0, 0}, cycled}; };
    coupling.slide(hand_at(20.0_mm), tool);

    // Then the anchor is 8 mm behind the hand, along the shaft
    expect_near(held(coupling, hand_at(20.0_mm), {}, tool).force.pull, {0, 0, 8.0});
    expect_near(held(coupling, hand_at(12.0_mm), {}, tool).force.pull, {});

    // And stays there in the world if both turn
    const Pose back{{}, {1, 0, 0, 0}};
    expect_near(held(coupling, {{12.0_mm, 0, 0}, {1, 0, 0, 0}}, {}, back).force.pull, {});
}

TEST(Anchor, SlipsToItsLimitAboutASecondLine) {
    Coupling coupling(gains(), at_grip);
    coupling.slide(turned_about_grip({0.5, 0, 0}), origin);
    const Pose handle = turned_about_grip({0.4, 0.5, 0.3});
    const Vec3 wanted = clamped(coupling.at(handle, origin).twist, Split{0.08});  // 0.2 N·m / 2.5 N·m/rad
    coupling.slide(handle, origin);
    expect_near(coupling.at(handle, origin).twist, wanted, 1e-6 /* sine for angle */);
}

TEST(Anchor, StoresTurnsUpToTheLimitOnTheBonesSide) {
    // 10 N·m/rad and 0.8 N·m in bone: 60 mrad are within it
    CouplingGains scaled = gains();
    scaled.force_scale = 0.25;
    EXPECT_NEAR(Coupling(scaled, at_grip).stored(turned_about_grip({0, 0.06, 0}), origin), 0.25 * 0.5 * 10.0 * 3.6e-3,
                1e-7);
}

TEST(Anchor, AMotorAboutTheShaftStoresTurnsOfBothSenses) {
    CouplingGains driven = gains();
    driven.has_torque = false;
    driven.force_scale = 0.25;
    driven.shaft = {.torque_limit = 0.2, .stiffness = 1.0, .damping = 1e-3, .resolution = 1e-3};
    for (const double sense : {1.0, -1.0}) {  // 4 N·m/rad up to 0.8 N·m in bone: up to 0.2 rad
        const Coupling coupling(driven, at_grip);
        const auto stored = [&](Vec3 turn) { return coupling.stored(turned_about_grip(sense * turn), origin); };
        EXPECT_NEAR(stored({0, 0, 0.05}), 0.25 * 0.5 * 4.0 * 0.0025, 1e-7) << sense;
        EXPECT_NEAR(stored({0, 0, 0.3}), 0.25 * 0.5 * 4.0 * 0.04, 1e-9) << sense;
        EXPECT_NEAR(stored({0.05, 0, 0}), 0.0, 1e-15) << "no motor across";
    }
}

// ---- gains -------------------------------------------------------------------------------------------------------

DeviceRecord device() {
    return {.id = "round",
            .peak_force = 8.0,
            .continuous_force = 2.0,
            .peak_torque = 0.1,
            .largest_stiffness = 1000.0,
            .largest_damping = 5.0,
            .mass = 0.1,
            .viscosity = 0.1,
            .friction = 0.1,
            .resolution = 10e-6,
            .stiffest_wall = {2000.0, 1000.0, 500.0},
            .source = ""};
}

TEST(Gains, KeepToTheDeviceAndItsWall) {
    EXPECT_DOUBLE_EQ(gains_for(device(), 1.0, 0).stiffness, 600.0) << "0.6 of the device's";
    EXPECT_DOUBLE_EQ(gains_for(device(), 1.0, 1).stiffness, 500.0) << "half of the wall's";
    EXPECT_DOUBLE_EQ(gains_for(device(), 1.0, 2).stiffness, 250.0);
}

TEST(Gains, ClampDampingToZeroAndHalfTheDevices) {
    DeviceRecord fine = device(), middle = device(), coarse = device();
    fine.resolution = 10e-6;     // T (0.08 N / Δ − K) = 7.4 N·s/m
    middle.resolution = 0.1_mm;  // 0.2 N·s/m
    coarse.resolution = 1.0_mm;  // −0.52 N·s/m
    EXPECT_DOUBLE_EQ(gains_for(fine, 1.0).damping, 2.5);
    EXPECT_DOUBLE_EQ(gains_for(fine, 1.0).spare_damping, 2.5);
    EXPECT_NEAR(gains_for(middle, 1.0).damping, 0.2, 1e-12);
    EXPECT_NEAR(gains_for(middle, 1.0).spare_damping, 4.8, 1e-12);
    EXPECT_EQ(gains_for(coarse, 1.0).damping, 0.0);
}

TEST(Gains, BoundReleaseByTheHandlesMass) {
    DeviceRecord heavy = device();
    heavy.mass = 1.0;
    EXPECT_NEAR(gains_for(device(), 1.0).release_damping, 0.22 * 0.1 / 1e-3, 1e-9);
    EXPECT_NEAR(gains_for(heavy, 1.0).release_damping, 0.15 * 600.0, 1e-9);
}

TEST(Gains, WithoutActuatedTorqueTheRotationSlips) {
    DeviceRecord without = device();
    without.peak_torque = 0.0;
    EXPECT_TRUE(gains_for(device(), 1.0).has_torque);
    EXPECT_DOUBLE_EQ(gains_for(device(), 1.0).torque_limit, 0.1);
    EXPECT_FALSE(gains_for(without, 1.0).has_torque);
    EXPECT_DOUBLE_EQ(gains_for(without, 1.0).torque_limit, 0.01);
    EXPECT_DOUBLE_EQ(gains_for(without, 0.5).force_limit, 8.0);
    EXPECT_DOUBLE_EQ(gains_for(without, 0.5).force_scale, 0.5);
    EXPECT_DOUBLE_EQ(gains_for(without, 0.5).resolution, 10e-6);
}

TEST(Gains, TheForceScaleIsAtMostOne) {
    EXPECT_DOUBLE_EQ(force_scale_for(device(), 60.0), 0.02) << "0.6 · 2 N of 60 N";
    EXPECT_DOUBLE_EQ(force_scale_for(device(), 1.2), 1.0);
    EXPECT_DOUBLE_EQ(force_scale_for(device(), 0.5), 1.0);
    EXPECT_DOUBLE_EQ(force_scale_for(device(), 0.0), 1.0);
}

TEST(Clamped, KeepsTheDirectionAndTheLimit) {
    expect_near(clamped({3.0, 0, 4.0}, 5.0), {3.0, 0, 4.0});
    expect_near(clamped({-6.0, 0, 8.0}, 5.0), {-3.0, 0, 4.0});
    expect_near(clamped({}, 0.0), {});
}

}  // namespace
}  // namespace kerf
