// SPDX-License-Identifier: Apache-2.0
// The whole tick, with the drilling plugin as the host loads it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "core/haptics/loop/work_force.h"
#include "tests/support/drill_rig.h"

namespace kerf {
namespace {

using namespace literals;

/// A drill in a block, held through the coupling by a hand that is where it is told.
struct Rig {
    Body body = test::block({-5.0_mm, -5.0_mm, -8.0_mm}, {5.0_mm, 5.0_mm, 0}, 0.25_mm, {0.3, 0.1, 0.7});
    ToolSetup setup;
    Simulation simulation;

    explicit Rig(const std::map<std::string, double>& set = {}, const CouplingGains& gains = test::gains())
        : setup(test::twist_drill(set)),
          simulation(body, setup, test::outline(setup), gains, test::at_depth(-0.2_mm)) {}

    TickResult tick(const Pose& hand) {
        const TickResult result = simulation.tick({hand});
        return result;
    }
    /// The hand pushes `push` [N] past where the tool is.
    TickResult push(double push_force) {
        const CouplingGains g = test::gains();
        const double stretch = push_force * g.force_scale / g.stiffness;
        const double depth = -simulation.world_from_tool().position.z;
        return tick(test::at_depth(depth + stretch));
    }
};

TEST(Tick, AskingForTheLawLeavesTheStateAsItWas) {
    Rig rig;
    for (int i = 0; i < 800; ++i) (void)rig.push(120.0);
    const kerf_force& force = *rig.setup.force->force;
    std::vector<std::byte> before(rig.simulation.state(), rig.simulation.state() + rig.simulation.state_size());
    kerf_channel channels[KERF_MAX_CHANNELS];
    kerf_law law{sizeof(kerf_law), 0, channels, {}, {}};
    const kerf_tick_in in = tick_in_of(rig.setup, rig.simulation.bone().query(), Simulation::dt);
    for (int asked = 0; asked < 3; ++asked) ASSERT_EQ(force.resist(&in, rig.simulation.state(), &law), KERF_OK);
    EXPECT_GT(law.count, 0u);
    EXPECT_EQ(before,
              std::vector<std::byte>(rig.simulation.state(), rig.simulation.state() + rig.simulation.state_size()));
}

TEST(Tick, TwoSimulationsInTurnAreEachAsAlone) {
    const auto run_alone = [](double push) {
        Rig rig;
        for (int i = 0; i < 1500; ++i) (void)rig.push(push);
        rig.simulation.finish();
        return rig.simulation.exact().hash();
    };
    Rig a, b;
    for (int i = 0; i < 1500; ++i) {
        (void)a.push(150.0);
        (void)b.push(90.0);
    }
    a.simulation.finish();
    b.simulation.finish();
    EXPECT_EQ(a.simulation.exact().hash(), run_alone(150.0));
    EXPECT_EQ(b.simulation.exact().hash(), run_alone(90.0));
    EXPECT_NE(a.simulation.exact().hash(), b.simulation.exact().hash());
}

TEST(Tick, AfterTheEndBothFieldsHoldTheSameBits) {
    Rig rig;
    for (int i = 0; i < 2000; ++i) (void)rig.push(i % 500 < 400 ? 150.0 : -20.0);
    rig.simulation.finish();
    EXPECT_TRUE(rig.simulation.committed().same_bits(rig.simulation.exact()));
}

// P9
TEST(Tick, NoPushNoThrust) {
    Rig rig;
    for (int i = 0; i < 1000; ++i) (void)rig.push(150.0);
    double thrust = 1.0;
    for (int i = 0; i < 50; ++i) thrust = rig.push(0.0).thrust;
    EXPECT_LT(thrust, 0.05);
}

TEST(Tick, WithTheSpindleOffTheTipRestsOnTheBoneThatItsPointPricks) {
    Rig rig({{"spindle_speed", 0.0}});
    TickResult result;
    for (int i = 0; i < 1000; ++i) result = rig.push(std::min(50.0, 0.1 * i));
    EXPECT_NEAR(result.thrust, 50.0, 5.0);
    const double pricked = -rig.simulation.world_from_tool().position.z;
    EXPECT_NEAR(pricked, 0.144_mm, 0.03_mm)
        << "where 233 MPa and friction on its cone bear so much; it goes in ring by ring";
    for (int i = 0; i < 2000; ++i) result = rig.push(50.0);
    EXPECT_NEAR(-rig.simulation.world_from_tool().position.z, pricked, 10.0_um);
    rig.simulation.finish();
    const double wide = pricked * std::tan(59.0_deg);
    const double cone = pi / 3.0 * wide * wide * pricked;
    EXPECT_LT(rig.simulation.present().removed(), 2.0 * cone) << "its cone and no more, of under a voxel";
    EXPECT_GT(rig.simulation.present().removed(), 0.2 * cone);
}

TEST(Tick, AHarderPushFeedsFaster) {
    double last = 0.0;
    for (const double push : {60.0, 120.0, 180.0, 240.0}) {
        Rig rig;
        for (int i = 0; i < 1500; ++i) (void)rig.push(push);
        const double depth = -rig.simulation.world_from_tool().position.z;
        EXPECT_GT(depth, last) << push;
        last = depth;
    }
}

TEST(Tick, TheHandIsNeverPushedHarderThanTheDeviceCan) {
    Rig rig;
    double largest = 0.0;
    for (int i = 0; i < 2000; ++i) {
        const double ahead = std::min<double>(30.0_mm, 3.0_mm * i);  // faster than 20 mm in a tick would be no hand
        largest = std::max(largest, length(linear(rig.tick(test::at_depth(ahead)).command.wrench)));
    }
    EXPECT_LE(largest, 8.5 * (1.0 + 1e-9));
    EXPECT_GT(largest, 4.0) << "the limit was reached for";
}

TEST(Tick, ABadPoseIsTakenForTheLastGoodOne) {
    Rig rig;
    for (int i = 0; i < 500; ++i) (void)rig.push(100.0);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Pose bad = test::at_depth(0.0);
    bad.position.y = nan;
    for (int i = 0; i < 5; ++i) {
        const TickResult result = rig.tick(bad);
        EXPECT_TRUE(is_finite(result.world_from_tool));
        for (const double component : result.command.wrench) EXPECT_TRUE(std::isfinite(component));
    }
}

TEST(WorkForce, IsTheThrustInTheHardestTissue) {
    Rig rig;
    EXPECT_NEAR(work_force(rig.setup, rig.body, 2.0_mm_per_s), 198.0, 2.0);  // [macavelia-2012] at 1000 rpm
}

}  // namespace
}  // namespace kerf
