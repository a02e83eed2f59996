// SPDX-License-Identifier: Apache-2.0
// A motor about the shaft, from the law of a driver to the torque that the device is sent.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "tests/support/loop_guard.h"
#include "tests/support/probe.h"
#include "tests/support/rig.h"

namespace kerf {
namespace {

using namespace literals;

constexpr double resolution = 0.09_deg, friction = 0.01, peak = 0.35;  // of the record `touch-driver`

/// A driver in a tight hole, which rubs about every line; bone gives way about the shaft before it slips.
struct TightHole {
    double rubbing, give;

    struct State {
        double stretch = 0.0;  ///< [rad]
    };
    static constexpr auto about() {
        return describe("tight_hole", "Friction about the tip.",
                        param(&TightHole::rubbing, {.id = "rubbing",
                                                    .help = "Torque [N·m].",
                                                    .min = 0.0,
                                                    .max = 10.0,
                                                    .def = 0.8,
                                                    .source = "the test's"}),
                        param(&TightHole::give, {.id = "give",
                                                 .help = "Stiffness about the shaft [N·m/rad]; 0: it slips at once.",
                                                 .min = 0.0,
                                                 .max = 100.0,
                                                 .def = 0.0,
                                                 .source = "the test's"}));
    }
    void resist(const Held<test::BluntProbe>&, const BoneQuery&, const State& state,
                Channels& channels) const noexcept {
        for (std::uint32_t axis = 0; axis < 3; ++axis) {
            Vec6 about{};
            about[3 + axis] = 1.0;
            if (axis == 2 && give > 0.0) {
                channels.hold({.id = axis, .d = about, .stiffness = give, .stretch = state.stretch, .limit = rubbing});
            } else if (kerf_channel* c = channels.add(KERF_FRICTION, axis, about)) {
                c->tau = rubbing;
                c->w = 1e-6;
            }
        }
    }
    void commit(const Held<test::BluntProbe>&, const BoneQuery&, const Advance& advance, State& state,
                Actions&) const noexcept {
        if (give > 0.0)
            state.stretch =
                std::clamp(state.stretch + advance.rate[5] * Simulation::dt, -rubbing / give, rubbing / give);
    }
};

ToolSetup driver(double rubbing, double give = 0.0) {
    using Components = PluginTables<test::BluntProbe, TightHole>;
    return {.tool = &Components::components[0],
            .force = &Components::components[1],
            .tool_parameters = {},
            .force_parameters = {rubbing, give},
            .drives = {},
            .bound = {}};
}

CouplingGains driver_gains(double scale) { return in_hands(gains_for(*find_device("touch-driver"), scale)); }

/// A driver in air, upright over the origin.
struct DriverRig : test::Rig {
    DriverRig(const ToolSetup& setup, const CouplingGains& gains)
        : Rig(test::block({-5.0_mm, -5.0_mm, -8.0_mm}, {5.0_mm, 5.0_mm, 0}, 0.5_mm), setup, pose(0.0), gains) {}
    static Pose pose(double angle) {
        const Pose start = test::at_depth(-20.0_mm);
        return {start.position, start.rotation * quat_from_rotation_vector({0, 0, std::remainder(angle, 2.0 * pi)})};
    }
    /// Turns the handle at `rate` [rad/s] for `time` [s].
    TickResult turn(double rate, double time) {
        TickResult result;
        for (int i = 0; i < static_cast<int>(std::lround(time / dt)); ++i) {
            angle += rate * dt;
            const Quat before = world_from_tool().rotation;
            result = tick({pose(angle)});
            turned += small_rotation_vector(conjugate(before) * result.world_from_tool.rotation).z;
        }
        return result;
    }
    double angle = 0.0;   ///< [rad] of the handle
    double turned = 0.0;  ///< [rad] of the driver
};

/// On the hand about the shaft [N·m], device side.
double sent_about(const TickResult& result, const Pose& handle) {
    return dot(angular(result.command.wrench), rotate(handle.rotation, {0, 0, 1}));
}

TEST(TorqueAxis, GainsKeepOneCountUnderItsFriction) {
    const CouplingGains gains = driver_gains(1.0);
    EXPECT_FALSE(gains.has_torque);
    EXPECT_DOUBLE_EQ(gains.shaft.torque_limit, peak);
    EXPECT_NEAR(gains.shaft.stiffness, 3.183, 1e-3) << "0.01 N·m / 2 · 1.571 mrad";
    EXPECT_DOUBLE_EQ(gains.shaft.damping, 1e-3 * gains.shaft.stiffness);
    EXPECT_NEAR((gains.shaft.stiffness + gains.shaft.damping / Simulation::dt) * resolution, friction, 1e-12);
    EXPECT_FALSE(gains_for(*find_device("touch"), 1.0).shaft.is_driven());
}

TEST(TorqueAxis, OnlyAtALargeScaleIsSofterThanTheWrist) {
    const ToolGrip held{.grip_z = -60.0_mm};
    EXPECT_DOUBLE_EQ(Coupling(driver_gains(0.25), held).spring().turn_stiffness.along, 10.0) << "12.7 N·m/rad allowed";
    EXPECT_NEAR(Coupling(driver_gains(1.0), held).spring().turn_stiffness.along, 3.183, 1e-3);
    EXPECT_NEAR(Coupling(driver_gains(1.0), held).spring().turn_stiffness.across,
                Coupling(in_hands(gains_for(*find_device("touch"), 1.0)), held).spring().turn_stiffness.across, 1e-12);
}

TEST(TorqueAxis, SendsFrictionTimesTheForceScale) {
    for (const double rate : {3.0, -3.0}) {
        DriverRig rig(driver(0.8), driver_gains(0.25));
        const TickResult result = rig.turn(rate, 0.5);
        EXPECT_NEAR(std::abs(result.torque), 0.8, 1e-9) << "unscaled";
        EXPECT_NEAR(sent_about(result, rig.pose(rig.angle)), std::copysign(0.2, -rate), 1e-8 /* of the solve */);
        EXPECT_NEAR(std::abs(rig.angle - rig.turned), 0.08, 1e-4) << "0.8 N·m on a wrist of 10 N·m/rad";
    }
}

TEST(TorqueAxis, SendsNoMoreThanItsPeak) {
    DriverRig rig(driver(0.8), driver_gains(1.0));
    const TickResult result = rig.turn(3.0, 0.5);
    EXPECT_NEAR(result.torque, 0.8, 1e-9) << "scores see all of it";
    EXPECT_NEAR(sent_about(result, rig.pose(rig.angle)), -peak, 1e-12);
}

TEST(TorqueAxis, SendsNothingAcrossTheShaft) {
    for (const char* device : {"touch", "touch-driver"}) {
        DriverRig rig(driver(0.8), in_hands(gains_for(*find_device(device), 0.25)));
        Pose handle = rig.pose(0.0);
        TickResult result;
        for (int i = 0; i < 200; ++i) {
            handle.rotation = normalized(handle.rotation * quat_from_rotation_vector({1e-3, 0, 1e-3}));
            result = rig.tick({handle});
        }
        const Vec3 shaft = rotate(handle.rotation, {0, 0, 1}), sent = angular(result.command.wrench);
        const double across = length(sent - dot(sent, shaft) * shaft);
        if (std::string(device) == "touch") {
            EXPECT_NEAR(length(sent), 0.01, 1e-9) << "as much as drags its gimbal along";
        } else {
            EXPECT_LT(across, 1e-12);
            EXPECT_GT(length(sent), 0.1);
        }
    }
}

/// What the device does on a hand that turns it to and fro by `most` [rad], in counts, and how far the balance fell. A
/// spring that is sampled in counts φ gives K φ² a count; the axis' own friction takes twice as much.
struct ToAndFro {
    double work = 0.0, moved = 0.0, least = 0.0;  ///< [J] on the hand; of the motor to and fro; of the guard
};
ToAndFro turned_to_and_fro(double scale, double give, double most, double cycles_per_second) {
    DriverRig rig(driver(0.8, give), driver_gains(scale));
    ToAndFro done;
    double last = 0.0, sent = 0.0;
    for (int i = 0; i < 4000; ++i) {
        const double swing = most * std::sin(2.0 * pi * cycles_per_second * i * Simulation::dt);
        const double angle = resolution * std::round(swing / resolution);
        done.work += sent * (angle - last) - friction * std::abs(angle - last);
        done.moved += std::abs(sent * (angle - last));
        last = angle;
        sent = sent_about(rig.tick({rig.pose(angle)}), rig.pose(angle));
    }
    done.least = rig.passivity().min_energy();
    return done;
}

// Bone that slips, and bone that springs back by 20 mrad before it does.
TEST(TorqueAxis, TurningToAndFroGivesTheHandNoEnergy) {
    for (const double scale : {1.0, 0.25, 0.02})
        for (const double give : {0.0, 40.0})
            for (const double most : {0.6, 0.015})
                for (const double rate : {0.5, 4.0}) {
                    const ToAndFro done = turned_to_and_fro(scale, give, most, rate);
                    EXPECT_LT(done.work, PassivityGuard::tolerance)
                        << scale << ", " << give << ", " << most << ", " << rate;
                    EXPECT_GT(done.moved, 0.0) << "it was felt";
                    if (give == 0.0) {
                        EXPECT_GT(done.least, -2.0 * PassivityGuard::tolerance)
                            << scale << ", " << most << ", " << rate;
                    }
                }
}

/// A bare stylus of 100 g cm² thrown against bone that springs back, through the whole loop. Returns how fast it comes
/// back, per how fast it came.
double rebound(double damping) {
    CouplingGains gains = driver_gains(1.0);
    gains.shaft.damping = damping;
    DriverRig rig(driver(10.0, 100.0), gains);
    const double inertia = 1e-5, dt = Simulation::dt;
    double angle = -0.005, speed = 2.0;
    for (int i = 0; i < 400 && !(angle < -0.01 && speed < 0.0); ++i) {
        const double acceleration = sent_about(rig.tick({rig.pose(angle)}), rig.pose(angle)) / inertia;
        angle += speed * dt + 0.5 * acceleration * dt * dt;
        speed += acceleration * dt;
    }
    return -speed / 2.0;
}

TEST(TorqueAxis, ItsDampingTakesAwayWhatASampledSpringAdds) {
    EXPECT_GT(rebound(0.0), 1.02) << "a sampled spring is active";
    EXPECT_LT(rebound(driver_gains(1.0).shaft.damping), 1.0);
}

TEST(TorqueAxis, TheGuardDampsATurnThatGaveTooMuch) {
    PassivityGuard guard({}, {.largest_damping = 2e-3});
    EXPECT_EQ(guard.shaft_correction(1e-3), 0.0);
    // 0.02 N·m turn the hand by 10 mrad: 0.2 mJ out of nothing, of which 0.1 mJ is too much
    guard.observe({0, 0, 0, 0, 0, 0.02}, {0, 0, 0, 0, 0, 0.01}, 0.0, 1.0, 0.01);
    EXPECT_TRUE((guard.correction(1e-3) == Vec3{}));
    EXPECT_NEAR(guard.shaft_correction(1e-3), -1e-4 / 0.01, 1e-12) << "within one tick";
    guard.observe({}, {0, 0, 0, 0, 0, 0.001}, 0.0, 1.0, 0.001);
    (void)guard.correction(1e-3);
    EXPECT_NEAR(guard.shaft_correction(1e-3), -2e-3 * 1.0, 1e-15) << "no more than 2 mN·m·s/rad";
    EXPECT_EQ(guard.corrections(), 2u);
}

TEST(TorqueAxis, AHandThatFlickersBetweenTwoCountsIsNotDamped) {
    DriverRig rig(driver(10.0, 100.0), driver_gains(1.0));
    (void)rig.turn(0.5, 0.1);
    const std::uint64_t before = rig.passivity().corrections();
    for (int i = 0; i < 3000; ++i) (void)rig.tick({rig.pose(rig.angle + (i % 2 == 0 ? resolution : 0.0))});
    EXPECT_EQ(rig.passivity().corrections(), before);
}

TEST(TorqueAxis, LooseItCarriesNoTorqueAndTheDriverStays) {
    DriverRig rig(driver(0.8), driver_gains(0.25));
    (void)rig.turn(3.0, 0.5);
    const double held_at = rig.turned;

    // When the hand lets go and turns back by half a turn
    rig.loosen_about_shaft(true);
    TickResult result = rig.turn(-2.0, 0.5 * pi);
    EXPECT_NEAR(result.torque, 0.0, 1e-6);
    EXPECT_NEAR(sent_about(result, rig.pose(rig.angle)), 0.0, 1e-6);
    EXPECT_NEAR(rig.turned, held_at, 1e-6) << "friction holds it";

    // Then it takes hold without a twist, and turns on from there
    rig.loosen_about_shaft(false);
    (void)rig.turn(0.0, 0.1);
    EXPECT_NEAR(rig.turned, held_at, 1e-6);
    const double from = rig.angle;
    (void)rig.turn(3.0, 0.5);
    EXPECT_NEAR(rig.turned, held_at + (rig.angle - from) - 0.08, 2e-4) << "less what the wrist gives way by";
}

TEST(TorqueAxis, NeitherAllocatesNorLocksWhileTheHandRegrips) {
    DriverRig rig(driver(0.8), driver_gains(1.0));
    for (int i = 0; i < 600; ++i) {
        rig.angle += i < 200 || i >= 400 ? 2e-3 : -2e-3;
        const DeviceSample sample{rig.pose(rig.angle)};
        const test::Forbidden before = test::forbidden_here();
        rig.loop().loosen_about_shaft(i >= 200 && i < 400);
        (void)rig.loop().tick(sample);
        EXPECT_EQ(test::forbidden_here(), before) << i;
        rig.follow();
    }
}

}  // namespace
}  // namespace kerf
