// SPDX-License-Identifier: Apache-2.0
// A tool with mass in the loop: what a hand feels of it in air, and that nothing comes back that was not put in.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/support/drill_rig.h"
#include "tests/support/made_outline.h"

namespace kerf {
namespace {

using namespace literals;

/// A drill in air, well above the bone, that a hand moves about from where it is.
struct InAir {
    Body body = test::block({-5.0_mm, -5.0_mm, -8.0_mm}, {5.0_mm, 5.0_mm, 0}, 0.5_mm);
    ToolSetup setup;
    Simulation simulation;

    explicit InAir(double mass)
        : setup(test::twist_drill({{"mass", mass}})),
          simulation(body, setup, test::outline(setup), test::gains(), start()) {}
    static Pose start() { return test::at_depth(-40.0_mm); }

    TickResult tick(Vec3 moved) {
        Pose hand = start();
        hand.position = hand.position + moved;
        const TickResult result = simulation.tick({hand});
        return result;
    }
    /// What pulls back a hand [bone newtons] that goes along `way` ever faster, after the first swing has died out.
    double felt_at(Vec3 way, double acceleration) {
        constexpr int ticks = 600, counted = 200;
        double sum = 0.0;
        for (int n = 1; n <= ticks; ++n) {
            const double t = n * Simulation::dt;
            const double force = dot(linear(tick(0.5 * acceleration * t * t * way).limited_on_hand), way);
            if (n > ticks - counted) sum -= force / counted;
        }
        return sum;
    }
};

TEST(ToolInAir, AHandThatSpeedsUpAcrossItsAxisFeelsItsMassAndAlongItNone) {
    constexpr double acceleration = 0.1;  // [m/s²]
    constexpr Vec3 across{1, 0, 0}, along{0, 0, 1};
    EXPECT_NEAR(InAir(0.5).felt_at(across, acceleration), 0.5 * acceleration, 0.005 * acceleration);
    EXPECT_NEAR(InAir(1.0).felt_at(across, acceleration), 1.0 * acceleration, 0.01 * acceleration);
    EXPECT_NEAR(InAir(0.0).felt_at(across, acceleration), 0.0, 1e-6);
    EXPECT_NEAR(InAir(1.0).felt_at(along, acceleration), 0.0, 1e-6);
}

TEST(ToolInAir, ShakenItGivesBackNoMoreThanWasPutIn) {
    InAir drill(1.0);
    for (int n = 0; n < 3000; ++n) (void)drill.tick({3.0_mm * std::sin(2.0 * pi * 6.0 * n * Simulation::dt), 0, 0});
    EXPECT_EQ(drill.simulation.passivity().corrections(), 0u);
    EXPECT_GT(drill.simulation.passivity().min_energy(), -1e-4);
}

TEST(ToolInAir, AMassThatNoHandHoldsIsRefused) {
    const auto refused = [](double mass) {
        const ToolSetup setup = test::twist_drill({{"mass", mass}});
        ToolOutline outline;
        std::string error;
        return outline_of(setup, outline, error) ? std::string() : error;
    };
    EXPECT_EQ(refused(0.0), "");
    EXPECT_EQ(refused(0.5), "");
    for (const double mass : {-1.0, 21.0, std::nan("")})
        EXPECT_NE(refused(mass).find("0 to 20 kg"), std::string::npos) << mass;
}

}  // namespace
}  // namespace kerf
