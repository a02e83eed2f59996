// SPDX-License-Identifier: Apache-2.0
// The loop gives the hand no energy of its own.
#include "core/haptics/loop/passivity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "tests/support/probe.h"
#include "tests/support/rig.h"

namespace kerf {
namespace {

using namespace literals;

TEST(PassivityGuard, SumsWhatGoesInAndOut) {
    PassivityGuard guard(5.0);
    guard.observe({0, 0, 2.0, 0, 0, 0}, {0, 0, -1e-3, 0, 0, 0}, 0.0, 1.0);  // pushed in by 1 mm against 2 N
    EXPECT_DOUBLE_EQ(guard.energy(), 2e-3);
    guard.observe({0, 0, 2.0, 0, 0, 0}, {0, 0, 0.5e-3, 0, 0, 0}, 0.0, 1.0);
    EXPECT_DOUBLE_EQ(guard.energy(), 1e-3);
    guard.observe({0, 0, 0, 0, 0, 0.1}, {0, 0, 0, 0, 0, 0.01}, 0.0, 1.0);  // torque counts
    EXPECT_NEAR(guard.energy(), 0.0, 1e-15);
}

TEST(PassivityGuard, CreditsNoMoreThanTheSpringHolds) {
    PassivityGuard guard(5.0);
    for (int i = 0; i < 1000; ++i)
        guard.observe({0, 0, 8.0, 0, 0, 0}, {0, 0, -1e-4, 0, 0, 0}, 0.0, 0.03);  // 0.8 J of drilling
    EXPECT_DOUBLE_EQ(guard.energy(), 0.03);
}

TEST(PassivityGuard, TakesBackWhatCameOutTooMuchAndNoFasterThanTheDeviceCan) {
    PassivityGuard guard(5.0);
    EXPECT_TRUE((guard.correction(1e-3) == Vec3{}));
    guard.observe({0, 0, 0.4, 0, 0, 0}, {0, 0, 0.5e-3, 0, 0, 0}, 0.0, 1.0);  // 0.2 mJ out of nothing
    EXPECT_NEAR(guard.correction(1e-3).z, -1e-4 / 0.5e-3, 1e-12) << "all of the excess within one tick";
    guard.observe({}, {0, 0, 0.01e-3, 0, 0, 0}, 0.0, 1.0);
    EXPECT_NEAR(guard.correction(1e-3).z, -5.0 * 0.01, 1e-15) << "no more than 5 N·s/m";
    EXPECT_EQ(guard.corrections(), 2u);
}

TEST(PassivityGuard, AHandThatFlickersBetweenTwoCountsIsNotDamped) {
    const double k = 3000.0, count = 10.0_um;
    for (const double unseen : {0.0, k * count * count}) {
        PassivityGuard guard(20.0, unseen, count);
        double at = 1.0_mm;
        std::uint64_t corrected = 0;
        for (int i = 0; i < 3000; ++i) {  // the force is that of the last tick's reading
            const double force = k * at, next = i % 2 == 0 ? 1.0_mm + count : 1.0_mm;
            guard.observe({force, 0, 0, 0, 0, 0}, {at - next, 0, 0, 0, 0, 0}, 0.0, 0.5 * k * next * next);
            corrected += guard.correction(1e-3).x != 0.0;
            at = next;
        }
        if (unseen > 0.0) {
            EXPECT_EQ(corrected, 0u);
        } else {
            EXPECT_GT(corrected, 100u) << "so it would be";
        }
    }
}

/// A bare mass thrown at a wall by nobody, through the whole loop. Returns how fast it comes back, per how fast it
/// came.
double rebound(double spare_damping) {
    CouplingGains gains = test::gains(1.0);
    gains.stiffness = 3000.0;  // far beyond what a bare mass of 45 g can be held by at 1 kHz without damping
    gains.damping = 0.0;
    gains.force_limit = 50.0;
    gains.release_damping = 0.0;  // it would take the energy first
    gains.spare_damping = spare_damping;
    test::Rig simulation(test::block({-5.0_mm, -5.0_mm, -8.0_mm}, {5.0_mm, 5.0_mm, 0}, 0.25_mm),
                         test::probe(20000.0_N_per_mm), test::at_depth(-0.5_mm), gains);
    double depth = -0.5_mm, speed = 0.5;
    const double mass = 0.045, dt = Simulation::dt;
    for (int i = 0; i < 200 && !(depth < -5.0_mm && speed < 0.0); ++i) {
        const TickResult r = simulation.tick({test::at_depth(depth)});
        const double acceleration = -r.command.wrench[2] / mass;  // the force is held for the tick
        depth += speed * dt + 0.5 * acceleration * dt * dt;
        speed += acceleration * dt;
    }
    return -speed / 0.5;
}

TEST(Passivity, AWallTooStiffForTheLoopThrowsBackHarderAndTheControllerTakesItAway) {
    EXPECT_GT(rebound(0.0), 1.02) << "a sampled spring is active";
    EXPECT_LT(rebound(20.0), 1.005);
}

// A9: turn the tip into a wall and let it push the handle back, for many cycles: nothing is to be had from it.
TEST(Passivity, ALeverCycleGivesNoNetWork) {
    const Body body = test::block({-5.0_mm, -5.0_mm, -8.0_mm}, {5.0_mm, 5.0_mm, 0}, 0.25_mm);
    const ToolSetup setup = test::probe(500.0_N_per_mm);
    for (const char* device : {"touch", "premium-1.5-6dof", "touch-driver"}) {
        const CouplingGains gains = gains_for(*find_device(device), 1.0);
        const Vec3 grip{0, 0, -60.0_mm};
        // The tool lies over the edge of the face; the hand tilts it down into the bone, moves aside, tilts back.
        const auto pose = [&](double tilt, double shift) {
            const Vec3 along{std::cos(tilt), 0, -std::sin(tilt)};
            const Vec3 tip{shift + 60.0_mm * (std::cos(tilt) - 1.0), 0, 0.3_mm - 60.0_mm * std::sin(tilt)};
            return test::pointing(tip, along);
        };
        test::Rig simulation(body, setup, pose(0.0, 0.0), gains);
        double work = 0.0;  // of the device on the hand
        Pose last = pose(0.0, 0.0);
        Vec6 wrench{};
        for (int cycle = 0; cycle < 10; ++cycle)
            for (int i = 0; i < 400; ++i) {
                const double phase = 2.0 * pi * i / 400.0;
                const Pose now = pose(0.015 * (1.0 - std::cos(phase)), 1.0_mm * std::sin(phase));
                work += dot(linear(wrench), now * grip - last * grip);
                if (gains.has_torque || gains.shaft.is_driven())
                    work += dot(angular(wrench),
                                rotate(last.rotation, small_rotation_vector(conjugate(last.rotation) * now.rotation)));
                last = now;
                wrench = simulation.tick({now}).command.wrench;
            }
        EXPECT_LT(work, PassivityGuard::tolerance) << device << ", ten cycles; 1 mJ is what is asked";
    }
}

}  // namespace
}  // namespace kerf
