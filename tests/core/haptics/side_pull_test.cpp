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
        Simulation simulation(body, setup, test::outline(setup), gains, test::at_depth(-30.0_mm));
        double largest = 0.0;
        TickResult last, now;
        for (int i = 0; i < 3000; ++i) {
            // A steady pull of 40 N to the tool's side, always from where its grip is; the wrist keeps its aim.
            const Vec3 grip{0, 0, simulation.outline().grip_z};
            Pose hand = test::at_depth(-30.0_mm);
            hand.position = simulation.world_from_tool() * grip - rotate(hand.rotation, grip);
            hand.position.x += 40.0 * gains.force_scale / gains.stiffness;
            last = now;
            now = simulation.tick({hand});
            simulation.after_tick();
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

}  // namespace
}  // namespace kerf
