// SPDX-License-Identifier: Apache-2.0
// The row of a tick, each field with a number of its own.
#include "run/tick_row.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "tests/support/probe.h"
#include "tests/support/rig.h"

namespace kerf::run {
namespace {

using namespace literals;

const Pose askew{{0.1, -0.2, 0.3}, quat_from_rotation_vector({0.4, -0.9, 0.5})};
constexpr double spacing = 0.25_mm;

/// A probe in front of a block, and two steps along different axes.
struct Probed {
    ToolSetup setup = test::probe(20.0_N_per_mm);
    Body block = test::block({-5.0_mm, -5.0_mm, -8.0_mm}, {5.0_mm, 5.0_mm, 0}, spacing, {0.3, 0.1, 0.7});
    Simulation simulation{block, setup, test::outline(setup), test::gains(1.0), test::at_depth(-20.0_mm)};
    Scene scene;
    StepMonitor monitor;
    SignalTable signals{{Tool{setup, test::outline(setup)}}};

    Probed() : monitor(prepare()) {
        for (int t = 0; t < 5; ++t) (void)simulation.tick({test::at_depth(-20.0_mm)});
    }
    StepMonitor prepare() {
        scene.procedure.spacing = spacing;
        scene.procedure.steps.resize(2);
        scene.frames = {{.entry = {0, 0, 1.0}, .along = {1, 0, 0}}, {.entry = {0, 2.0, 0}, .along = {0, 1, 0}}};
        return {scene.procedure, scene.anatomy, scene.frames};
    }
    [[nodiscard]] session::TickRow row(const TickResult& result, const Pose& handle = {}, std::int32_t tissue = -1,
                                       double removed = 0.0) const {
        return row_of(result, scene, simulation, monitor, signals, handle, tissue, removed);
    }
};

void expect_same(const Pose& is, const Pose& wanted) {
    EXPECT_TRUE(is.position == wanted.position);
    EXPECT_EQ(is.rotation.w, wanted.rotation.w);
    EXPECT_EQ(is.rotation.x, wanted.rotation.x);
}

TEST(TickRow, HasEachFieldOfTheResult) {
    TickResult result;
    result.world_from_tool = askew;
    result.rate = {1, 2, 3, 4, 5, 6};
    result.bone_on_tool = {11, 12, 13, 14, 15, 16};
    result.coupled_on_hand = {21, 22, 23, 24, 25, 26};
    result.limited_on_hand = {31, 32, 33, 34, 35, 36};
    result.released_on_hand = {41, 42, 43};
    result.command.wrench = {51, 52, 53, 54, 55, 56};
    result.thrust = 61;
    result.torque = -62;
    result.power_hand = 63;
    result.iterations = 64;
    const Pose handle{{7, 8, 9}, {0.6, 0.8, 0, 0}};
    const Probed probed;
    const session::TickRow row = probed.row(result, handle, 3, 65);

    EXPECT_EQ(row.tick, 4u) << "five ticks are over";
    EXPECT_EQ(row.time, 4e-3);
    EXPECT_EQ(row.step, 0);
    expect_same(row.device_from_handle, handle);
    expect_same(row.world_from_tool, askew);
    EXPECT_EQ(row.modelled, (Vec6{11, 12, 13, 14, 15, 16}));
    EXPECT_EQ(row.coupled, (Vec6{21, 22, 23, 24, 25, 26}));
    EXPECT_EQ(row.limited, (Vec6{31, 32, 33, 34, 35, 36}));
    EXPECT_EQ(row.commanded, (Vec6{51, 52, 53, 54, 55, 56}));
    EXPECT_EQ(row.thrust, 61);
    EXPECT_EQ(row.torque, -62);
    EXPECT_EQ(row.feed_rate, 3);
    EXPECT_EQ(row.tissue, 3);
    EXPECT_EQ(row.iterations, 64);
    EXPECT_EQ(row.power_hand, 63);
    EXPECT_EQ(row.removed, 65);
}

TEST(TickRow, HasTheDepthAlongTheAxisOfItsStep) {
    Probed probed;
    TickResult result;
    result.world_from_tool.position = {0.25, 2.5, 0};
    const ToolSolid& solid = probed.simulation.outline().cutting;
    const auto end_step = [&] {  // a step without goals is over outside of bone
        probed.monitor.observe({.world_from_tool = {{-1.0, 1.0, 0}, {1, 0, 0, 0}}}, solid);
    };
    EXPECT_EQ(probed.row(result).depth, 0.25);
    end_step();
    EXPECT_EQ(probed.row(result).step, 1);
    EXPECT_EQ(probed.row(result).depth, 0.5);
    end_step();
    EXPECT_EQ(probed.row(result).step, -1);
    EXPECT_EQ(probed.row(result).depth, 0.5) << "the axis of the last step stays";
}

// ---- what lies at the tip ------------------------------------------------------------------------------------------

TEST(TissueAt, IsThatOneVoxelAheadInAMovedBone) {
    // Given a bone that lies askew, and a tool that points into its face
    Probed probed;
    probed.simulation.place_body(0, askew);
    for (int t = 0; t < 400; ++t) (void)probed.simulation.tick({askew * test::at_depth(-15.0_mm, 0.1)});
    const Quat shaft = probed.simulation.world_from_tool().rotation;
    const auto tissue_behind = [&](double behind) {
        return tissue_at(probed.scene, probed.simulation, askew * Vec3{} - behind * rotate(shaft, {0, 0, 1}));
    };
    EXPECT_EQ(tissue_behind(0.8 * spacing), 0);
    EXPECT_EQ(tissue_behind(1.2 * spacing), -1);
    probed.simulation.show_body(0, false);
    EXPECT_EQ(tissue_behind(0.8 * spacing), -1);
}

TEST(TipInside, IsTheDepthInABoneWhereverItLies) {
    Probed probed;
    probed.simulation.place_body(0, askew);
    const auto inside = [&](Vec3 in_bone) { return tip_inside(probed.simulation, probed.monitor, askew * in_bone); };
    EXPECT_NEAR(inside({1.0_mm, 2.0_mm, -0.4_mm}), 0.4_mm, 0.02_mm);
    EXPECT_NEAR(inside({1.0_mm, 2.0_mm, 0.4_mm}), -0.4_mm, 0.02_mm);
}

TEST(TipInside, CountsAnotherBoneButNoMetal) {
    Probed probed;
    Body other = probed.block, metal = probed.block;
    ASSERT_EQ(probed.simulation.insert(other, {{0, 0, 20.0_mm}, {1, 0, 0, 0}}, true), "");
    ASSERT_EQ(probed.simulation.insert(metal, {{0, 0, 40.0_mm}, {1, 0, 0, 0}}, false), "");
    const auto inside = [&](double z) { return tip_inside(probed.simulation, probed.monitor, {0, 0, z}); };
    EXPECT_NEAR(inside(20.0_mm - 0.4_mm), 0.4_mm, 0.02_mm);
    EXPECT_LT(inside(40.0_mm - 0.4_mm), 0.0);
    probed.simulation.show_body(1, false);
    EXPECT_LT(inside(20.0_mm - 0.4_mm), 0.0);
}

}  // namespace
}  // namespace kerf::run
