// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "conformance/plan/plan.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "conformance/plan/plan_text.h"
#include "conformance/stability/bone_block.h"
#include "tests/support/drill_rig.h"

namespace kerf::plan {
namespace {

using namespace literals;

ComponentInfo info(const char* id) {
    for (const ComponentInfo& c : test::plugins().catalog())
        if (c.id == id) return c;
    throw std::runtime_error(id);
}

/// A drill through 2 mm of cortex into cancellous bone.
Task drilling() {
    Task task;
    task.step = "hole";
    task.instrument = "pilot";
    task.bone_at = [](double spacing) {
        return stability::make({.thickness = 6.0_mm, .spacing = spacing, .density = 1850.0, .shell = 2.0_mm, .inner = 400.0});
    };
    task.setup = test::twist_drill();
    task.tool = info("twist_drill");
    task.force = info("drill_cutting");
    task.gains = test::gains();
    task.way = {test::at_depth(-0.5_mm), 4.0_mm, 4.0_mm_per_s};
    return task;
}

StepPlan planned(const Task& task) {
    std::string error;
    const auto plan = plan_step(task, {}, error);
    if (!plan) throw std::runtime_error(error);
    return *plan;
}

const FeatureFound& found(const StepPlan& plan, const std::string& id) {
    const auto at = std::find_if(plan.features.begin(), plan.features.end(), [&](const FeatureFound& f) { return f.id == id; });
    if (at == plan.features.end()) throw std::runtime_error(id);
    return *at;
}

TEST(Plan, WhoAsksForLessGetsACoarserModelAndBothGetWhatTheyAskedFor) {
    Task task = drilling();
    const StepPlan loose = planned(task);
    task.accuracy = {0.01, 0.005};
    const StepPlan tight = planned(task);
    for (const StepPlan* plan : {&loose, &tight}) EXPECT_TRUE(plan->keeps_accuracy);
    EXPECT_LE(loose.chosen.error.force, 0.07);
    EXPECT_LE(tight.chosen.error.force, 0.01);
    EXPECT_GT(loose.chosen.spacing, tight.chosen.spacing);
    EXPECT_GE(loose.chosen.pitch, tight.chosen.pitch);
    EXPECT_GT(loose.cost.p999, 0.0);
}

TEST(Plan, TriesNoSpacingAtWhichTheToolsOwnCutIsNotKnown) {
    Task task = drilling();
    task.coarsest = 0.4_mm;
    const StepPlan plan = planned(task);
    EXPECT_EQ(plan.tried.front().spacing, 0.35_mm);
    EXPECT_LE(plan.chosen.spacing, 0.4_mm);
}

TEST(Plan, LeavesOutWhatChangesNothingAndKeepsWhatMakesTheForce) {
    const StepPlan plan = planned(drilling());
    EXPECT_TRUE(found(plan, "friction").is_left_out);
    EXPECT_LT(found(plan, "friction").change.force, 0.001);
    for (const char* needed : {"edge_term", "chisel", "second_tissue"}) {
        EXPECT_FALSE(found(plan, needed).is_left_out) << needed;
        EXPECT_GT(found(plan, needed).change.force, 0.07) << needed;
    }
    // What is off already is no feature.
    EXPECT_THROW((void)found(plan, "runout"), std::runtime_error);
}

TEST(Plan, LeavingOutTogetherStaysWithinWhatWasAskedFor) {
    Task task = drilling();
    task.setup = test::twist_drill({{"runout", 0.05_mm}});
    const StepPlan plan = planned(task);
    EXPECT_NO_THROW((void)found(plan, "runout"));
    EXPECT_LE(plan.chosen.error.force, task.accuracy.force);
    EXPECT_LE(plan.chosen.error.volume, task.accuracy.volume);
}

TEST(Plan, SaysSoWhereABoneCannotBeMadeSoCoarsely) {
    Task task = drilling();
    const BoneAt any = task.bone_at;
    task.bone_at = [&](double spacing) { return spacing > 0.4_mm ? std::nullopt : any(spacing); };
    const StepPlan plan = planned(task);
    EXPECT_FALSE(plan.tried.front().has_bone);
    EXPECT_NEAR(plan.chosen.spacing, 0.35_mm, 1e-12);
    EXPECT_NE(plan_text(task, plan).find("the bone cannot be made so coarsely"), std::string::npos);
}

TEST(Plan, AWayThroughAirHasNoPlan) {
    Task task = drilling();
    task.way.start = test::at_depth(-40.0_mm);
    std::string error;
    EXPECT_FALSE(plan_step(task, {}, error));
    EXPECT_NE(error.find("step `hole`: its tool meets no bone"), std::string::npos) << error;
    task = drilling();
    task.bone_at = [](double) { return std::nullopt; };
    EXPECT_FALSE(plan_step(task, {}, error));
    EXPECT_NE(error.find("cannot be made"), std::string::npos) << error;
}

TEST(Plan, ThePlanIsTheSameEveryTimeButForItsCost) {
    const StepPlan once = planned(drilling()), again = planned(drilling());
    EXPECT_EQ(plan_csv(std::span(&once, 1)), plan_csv(std::span(&again, 1)));
}

TEST(Plan, TextAndTableSayWhatTheyAreNotForAndWhatToWrite) {
    const Task task = drilling();
    const StepPlan plan = planned(task);
    EXPECT_EQ(plan_csv(std::span(&plan, 1)).rfind("# For training and research; not for diagnosis", 0), 0u);
    const std::string text = plan_text(task, plan);
    EXPECT_NE(text.find("as accurate as asked for"), std::string::npos) << text;
    EXPECT_NE(text.find("        instruments.pilot.parameters.friction: 0\n"), std::string::npos) << text;
    EXPECT_NE(text.find("        accuracy.spacing: "), std::string::npos) << text;
}

}  // namespace
}  // namespace kerf::plan
