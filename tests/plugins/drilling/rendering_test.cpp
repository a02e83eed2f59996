// SPDX-License-Identifier: Apache-2.0
// S-01: the cutting law is a damper far stiffer than a sampled loop can render; solved for the motion it is harmless.
#include <gtest/gtest.h>

#include <cmath>

#include "devices/simulated_hand/simulated_hand.h"
#include "tests/support/drill_rig.h"
#include "tests/support/rig.h"

namespace kerf {
namespace {

using namespace literals;
using simulated_hand::Plant;

struct Felt {
    double unrest = 0.0;      ///< [N] RMS of the force's step from tick to tick, the tip 2 mm … 25 mm deep
    double min_energy = 0.0;  ///< [J] of the port
    double depth = 0.0;       ///< [m]
};

/// An arm that goes along with the handle and pushes 5 N, on the device's side, into a block for three seconds.
Felt push_into_bone(const Plant& arm, bool is_direct) {
    test::Rig simulation(test::block({-5.0_mm, -5.0_mm, -30.0_mm}, {5.0_mm, 5.0_mm, 0}, 0.5_mm, {0.3, 0.1, 0.7}),
                         test::twist_drill(), test::at_depth(-0.5_mm), test::gains(1.0 / 40.0));
    const double mass = arm.arm_mass + arm.device_mass, push = 5.0;
    double depth = -0.5_mm, speed = 0.0, aim = depth, last = 0.0, sum = 0.0, count = 0.0;
    for (int i = 0; i < 3000; ++i) {
        const DeviceSample sample{test::at_depth(std::floor(depth / arm.resolution + 0.5) * arm.resolution)};
        const TickResult result = is_direct ? simulation.tick_direct(sample) : simulation.tick(sample);
        const double force = result.command.wrench[2];
        if (const double tip = -result.world_from_tool.position.z; tip > 2.0_mm && tip < 25.0_mm) {
            sum += (force - last) * (force - last);
            count += 1.0;
        }
        last = force;
        constexpr int substeps = 20;
        const double h = Simulation::dt / substeps;
        for (int k = 0; k < substeps; ++k) {
            aim += h / 0.2 * (depth - aim);
            speed +=
                h / mass *
                (push + arm.arm_stiffness * (aim - depth) - (arm.arm_damping + arm.device_viscosity) * speed - force);
            depth += h * speed;
        }
    }
    return {std::sqrt(sum / count), simulation.passivity().min_energy(), -simulation.world_from_tool().position.z};
}

const Plant light{.arm_mass = 0.05, .arm_damping = 1.0, .arm_stiffness = 50.0};
const Plant nominal{};
const Plant stiff{.arm_mass = 1.0, .arm_damping = 30.0, .arm_stiffness = 2000.0};

TEST(Rendering, DirectlyTheCuttingLawChattersAtDeviceScale) {
    for (const Plant& arm : {light, nominal, stiff}) {
        const Felt felt = push_into_bone(arm, true);
        EXPECT_GT(felt.unrest, 5.0) << "arm of " << arm.arm_stiffness
                                    << " N/m: the push itself, up and down, every millisecond";
    }
}

TEST(Rendering, SolvedItIsQuietForEveryHand) {
    for (const Plant& arm : {light, nominal, stiff}) {
        const Felt felt = push_into_bone(arm, false);
        EXPECT_LT(felt.unrest, 0.025) << "arm of " << arm.arm_stiffness << " N/m: one count of the encoder is 0.014 N";
        EXPECT_GT(felt.min_energy, -1e-4) << "arm of " << arm.arm_stiffness << " N/m";
        EXPECT_GT(felt.depth, 2.0_mm) << "and it drills";
    }
}

}  // namespace
}  // namespace kerf
