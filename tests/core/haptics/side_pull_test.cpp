// SPDX-License-Identifier: Apache-2.0
// What follows a law without working against it (a burr that climbs, a drill's reaction) must not run away with the
// tool.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "kerf/plugin.hpp"
#include "tests/support/drill_rig.h"
#include "tests/support/rig.h"

namespace kerf {
namespace {

using namespace literals;

/// Two dampers across each other, each pulling the tool sideways with μ times its own force: crossed, the worst case.
struct CrossedPull {
    double mu;

    static constexpr auto about() {
        return describe("crossed_pull", "Two dampers, each with a pull across.",
                        param(&CrossedPull::mu, {.id = "mu",
                                                 .help = "Pull per force of its damper.",
                                                 .min = 0.0,
                                                 .max = 1e3,
                                                 .def = 1.0,
                                                 .source = "the test's"}));
    }
    void resist(const Held<AnyTool>&, const BoneQuery&, Channels& channels) const noexcept {
        for (const double way : {1.0, -1.0})
            for (std::uint32_t axis = 0; axis < 2; ++axis) {
                kerf_channel* c = channels.add(KERF_CUT, 1 + axis + (way > 0.0 ? 0u : 2u));
                c->d[axis] = way;
                c->eta = 5000.0;
                c->follow[1 - axis] = (axis == 0 ? 1.0 : -1.0) * way * mu;
            }
    }
};

ToolSetup crossed_pull(double mu) {
    static constexpr kerf_component component = component_of<CrossedPull>();
    ToolSetup setup = test::twist_drill();
    setup.force = &component;
    setup.force_parameters = {mu};
    setup.drives = {};
    return setup;
}

TEST(SidePull, CrossedAndStrongItSettlesWhereItBalances) {
    const Body body = test::block({-2.0_mm, -2.0_mm, -4.0_mm}, {2.0_mm, 2.0_mm, 0}, 0.5_mm);
    for (const double mu : {0.5, 1.0, 1.5, 2.0}) {
        const ToolSetup setup = crossed_pull(mu);
        const CouplingGains gains = test::gains();
        Simulation simulation(body, setup, test::rigid_outline(setup), gains, test::at_depth(-30.0_mm));
        double largest = 0.0;
        TickResult last, now;
        for (int i = 0; i < 3000; ++i) {
            // A steady pull of 40 N to the tool's side, always from where its grip is; the wrist keeps its aim.
            const Vec3 grip{0, 0, simulation.outline().handling.grip_z};
            Pose hand = test::at_depth(-30.0_mm);
            hand.position = simulation.world_from_tool() * grip - rotate(hand.rotation, grip);
            hand.position.x += 40.0 * gains.force_scale / gains.stiffness;
            last = now;
            now = simulation.tick({hand});
            largest = std::max(largest, std::hypot(now.rate[0], now.rate[1]));
            ASSERT_FALSE(now.is_quarantined);
        }
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_NEAR(now.rate[k], last.rate[k], 1e-6) << "mu " << mu << ": it has settled";

        // In the balance λ_x, λ_y with η u = λ: pull − λ_x − μ λ_y·… ; the side pull turns the motion by atan μ and
        // slows it.
        EXPECT_NEAR(std::abs(now.rate[1] / now.rate[0]), mu, 0.15 * mu) << "turned by the side pull, mu " << mu;
        EXPECT_LT(largest, 40.0 / 5000.0 * 2.0) << "mu " << mu << ": it never ran away";
    }
}

// ---- in a hand ---------------------------------------------------------------------------------------------------

/// A force across the shaft, at the tip.
struct Pushed {
    double force;

    static constexpr auto about() {
        return describe("pushed", "A force across the shaft.",
                        param(&Pushed::force, {.id = "force",
                                               .help = "At the tip.",
                                               .unit = unit::N,
                                               .min = 0.0_N,
                                               .max = 1000.0_N,
                                               .def = 1.0_N,
                                               .source = "the test's"}));
    }
    void resist(const Held<AnyTool>&, const BoneQuery&, Channels& channels) const noexcept {
        channels.push({force, 0, 0}, {});
    }
};

ToolSetup pushed(double force) {
    static constexpr kerf_component component = component_of<Pushed>();
    ToolSetup setup = test::twist_drill();
    setup.force = &component;
    setup.force_parameters = {force};
    setup.drives = {};
    return setup;
}

/// [N/m] of 10 N·m/rad, 120 mm behind the tip, and of a bit of 3.2 × 80 mm, 0.497 N·m² stiff: 694 and 2912 in series.
constexpr double tip_stiffness = 561.0;
constexpr const char* devices[] = {"touch", "desktop", "premium-1.5-6dof", "omega.6"};

struct Deflected {
    double by = 0.0;      ///< [m] of the tip, after 2 s
    double turned = 0.0;  ///< [rad] in the second half of that
};
/// A drill in a hand that holds its handle still, in air.
Deflected deflected(const char* device, double scale, double force) {
    const CouplingGains gains = in_hands(gains_for(*find_device(device), scale));
    const Pose handle = test::at_depth(-30.0_mm);
    test::Rig simulation(test::block({-2.0_mm, -2.0_mm, -4.0_mm}, {2.0_mm, 2.0_mm, 0}, 0.5_mm), pushed(force), handle,
                         gains);
    Quat half_way{};
    for (int i = 0; i < 2000; ++i) {
        (void)simulation.tick({handle});
        if (i == 1000) half_way = simulation.world_from_tool().rotation;
    }
    const Pose tool = simulation.world_from_tool();
    return {length(tool.position - handle.position),
            length(small_rotation_vector(conjugate(half_way) * tool.rotation))};
}

TEST(InAHand, APushAtTheTipDeflectsItAlikeOnEveryDevice) {
    for (const char* device : devices)
        for (const double scale : {1.0 / 300.0, 1.0 / 100.0, 1.0 / 40.0}) {
            const Deflected tip = deflected(device, scale, 10.0);
            EXPECT_NEAR(tip.by, 10.0 / tip_stiffness, 0.1 * 10.0 / tip_stiffness) << device << " at " << scale;
            EXPECT_LT(tip.turned, 1e-6) << device << ": it stands";
        }
}

TEST(InAHand, ATorqueBeyondTheWristTurnsTheToolInIt) {
    // 7 N·m, 120 mm behind the tip: 58 N. What follows a law gets half of that, so the hand pulls instead: it turns
    // the handle against a tip that stands.
    for (const char* device : devices)
        for (const double turn : {0.5, 1.0}) {
            Coupling coupling(in_hands(gains_for(*find_device(device), 0.01)), {.grip_z = -120.0_mm});
            const Pose handle{{}, quat_from_rotation_vector({0, turn, 0})};
            coupling.slide(handle, identity_pose());
            Balance balance;
            coupling.hold(handle, {}, identity_pose(), Simulation::dt, balance);
            const double torque = length(balance.torque.pull);
            const double wrist = combined_spring(coupling.gains(), one_hand, -120.0_mm, {}).turn_stiffness.across;
            EXPECT_LE(torque, 7.0 * (1.0 + 1e-3)) << device;
            EXPECT_NEAR(torque, std::min(7.0, wrist * 2.0 * std::sin(0.5 * turn)), 0.15) << device << ", " << turn;
        }
}

}  // namespace
}  // namespace kerf
