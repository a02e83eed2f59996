// SPDX-License-Identifier: Apache-2.0
// Values and uncertainties of the metrics of a step, by numbers worked out by hand.
#include "run/verdict/run_metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "kerf/units.hpp"

namespace kerf::run {
namespace {

using namespace literals;

/// A step along +z, in bone of 0.4 mm spacing, that has reached its depth of 10 mm and was left.
struct DoneStep {
    Scene scene;
    ToolSolid drill{{{0.0, 0.0}, {-1.0_mm, 1.6_mm}, {-2.0_mm, 1.6_mm}}};
    StepMonitor monitor;

    explicit DoneStep(Vec3 across = {}) : monitor(prepare(across)) {
        monitor.observe(
            {.time = 1.0, .world_from_tool = {{0, 0, 10.0_mm}, {1, 0, 0, 0}}, .is_running = true, .is_resisted = true},
            drill);
        monitor.observe({.time = 2.0, .world_from_tool = {{0, 0, -(1.0_mm)}, {1, 0, 0, 0}}}, drill);
    }
    StepMonitor prepare(Vec3 across) {
        documents::Step step;
        step.id = "cut";
        step.goals = {{"depth", {10.0_mm, {}}, {}}};
        scene.procedure.spacing = 0.4_mm;
        scene.procedure.steps = {step};
        scene.frames = {{.entry = {}, .along = {0, 0, 1}, .medial = {1, 0, 0}, .across = across}};
        scene.fraction_in_bone = {0.75};
        ToolOutline outline;
        outline.cutting = drill;
        scene.tools = {{{}, outline}};
        scene.tool_of_step = {0};
        return {scene.procedure, scene.anatomy, scene.frames};
    }
    [[nodiscard]] session::MetricRow row(const std::string& id) const {
        const std::vector<session::MetricRow> rows = metrics_of(monitor, scene);
        const auto found = std::find_if(rows.begin(), rows.end(), [&](const auto& one) { return one.id == id; });
        if (found != rows.end()) return *found;
        ADD_FAILURE() << "no " << id;
        return {};
    }
};

// The field resolves a wall to a twentieth of a voxel. Flatness is the difference of two such points.
TEST(RunMetrics, OfAWallHaveTheUncertaintyOfItsPoints) {
    DoneStep step({0, 1, 0});
    step.monitor.judge_cut(0, bone::CutWall{.angle = 4.0_deg, .offset = -(3.0_mm), .flatness = 2.0_mm, .points = 9},
                           1e-8, 3.0);
    EXPECT_DOUBLE_EQ(step.row("cut.plane-angle").value, 4.0_deg);
    EXPECT_DOUBLE_EQ(step.row("cut.plane-offset").value, -(3.0_mm));
    EXPECT_NEAR(step.row("cut.plane-offset").uncertainty, 0.02_mm, 1e-15);
    EXPECT_DOUBLE_EQ(step.row("cut.flatness").value, 2.0_mm);
    EXPECT_NEAR(step.row("cut.flatness").uncertainty, 0.04_mm, 1e-15);
    EXPECT_EQ(step.row("cut.removed").value, 1e-8);
}

TEST(RunMetrics, OfADepthAreKnownToHalfAVoxel) {
    const DoneStep step;
    EXPECT_DOUBLE_EQ(step.row("cut.depth").value, 10.0_mm);
    EXPECT_NEAR(step.row("cut.depth").uncertainty, 0.2_mm, 1e-15);
    EXPECT_EQ(step.row("cut.axis-in-bone").value, 0.75);
}

// A drill of 3.2 mm has 8 voxels across: 1.5 % of the whole hole, which is twice the planned one.
TEST(RunMetrics, OfAHoleCountItsExcessAndTheUncertaintyOfTheWhole) {
    DoneStep step;
    HoleResult result;
    result.hole = bone::DrilledHole{
        .entry_offset = 0.5_mm, .end_offset = 1.5_mm, .angle = 5.0_deg, .drilled = 3e-7, .ideal = 2e-7, .whole = 4e-7};
    step.monitor.judge_hole(0, result, 3.0);
    EXPECT_NEAR(step.row("cut.excess-removal").value, 0.5, 1e-12);
    EXPECT_NEAR(step.row("cut.excess-removal").uncertainty, 0.03, 1e-12);
    EXPECT_DOUBLE_EQ(step.row("cut.entry-offset").value, 0.5_mm);
    EXPECT_NEAR(step.row("cut.entry-offset").uncertainty, 0.02_mm, 1e-15);
    EXPECT_DOUBLE_EQ(step.row("cut.end-offset").value, 1.5_mm);
    EXPECT_DOUBLE_EQ(step.row("cut.hole-angle").value, 5.0_deg);
}

}  // namespace
}  // namespace kerf::run
