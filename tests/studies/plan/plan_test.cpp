// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/plan/plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

#include "studies/plan/plan_text.h"
#include "studies/scenes/bone_block.h"
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
        return kerf::make(
            {.thickness = 6.0_mm, .spacing = spacing, .density = 1850.0, .shell = 2.0_mm, .inner = 400.0});
    };
    task.setup = test::twist_drill();
    task.tool = info("twist_drill");
    task.force = info("drill_cutting");
    task.gains = test::gains();
    task.way = {test::at_depth(-0.5_mm), {0, 0, 1}, 4.0_mm, 4.0_mm_per_s};
    return task;
}

StepPlan planned(const Task& task) {
    std::string error;
    const auto plan = plan_step(task, {}, error);
    if (!plan) throw std::runtime_error(error);
    return *plan;
}

const FeatureFound& found(const StepPlan& plan, const std::string& id) {
    const auto at =
        std::find_if(plan.features.begin(), plan.features.end(), [&](const FeatureFound& f) { return f.id == id; });
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
    EXPECT_GT(loose.chosen.cost->p999, 0.0);
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

// ---- torque ---------------------------------------------------------------------------------------------------------

/// Something to leave out of the force: as many per cent of the lips' cutting force, which nearly only the torque is
/// made of.
void add_cutting_feature(Task& task, double share) {
    const auto& parameters = task.force.parameters;
    const auto at = std::find_if(parameters.begin(), parameters.end(),
                                 [](const ParameterInfo& p) { return p.id == "cutting_chip"; });
    const auto param = static_cast<std::size_t>(at - parameters.begin());
    task.force.features.push_back({"some_torque", "Only there to be left out.", KERF_FEATURE_EFFECT, param,
                                   (1.0 - share) * task.setup.force_parameters[param]});
}

TEST(Plan, WhatChangesOnlyTheTorqueIsKeptWhereThatIsMoreThanAskedFor) {
    Task task = drilling();
    add_cutting_feature(task, 0.2);
    const StepPlan plan = planned(task);
    EXPECT_TRUE(plan.torque_counts);
    EXPECT_LT(found(plan, "some_torque").change.force, 0.01);
    EXPECT_GT(found(plan, "some_torque").change.torque, 0.07);
    EXPECT_FALSE(found(plan, "some_torque").is_left_out);
    EXPECT_LE(plan.chosen.error.torque, task.accuracy.force);
}

TEST(Plan, WhatChangesTheTorqueByLessThanAskedForIsLeftOut) {
    Task task = drilling();
    add_cutting_feature(task, 0.05);
    const StepPlan plan = planned(task);
    EXPECT_GT(found(plan, "some_torque").change.torque, 0.01);
    EXPECT_TRUE(found(plan, "some_torque").is_left_out);
    EXPECT_LE(plan.chosen.error.torque, task.accuracy.force);
}

// As of a saw, whose teeth cancel about its shaft.
TEST(Plan, WhereThereIsNextToNoTorqueItDoesNotCount) {
    Task task = drilling();
    task.setup = test::twist_drill({{"cutting_edge", 100.0 /* N/m */}, {"cutting_chip", 10.0_N_per_mm2}});
    add_cutting_feature(task, 0.5);
    const StepPlan plan = planned(task);
    EXPECT_FALSE(plan.torque_counts) << plan.reference_torque << " N m beside " << plan.reference_force << " N";
    EXPECT_GT(found(plan, "some_torque").change.torque, 0.07);
    EXPECT_TRUE(found(plan, "some_torque").is_left_out);
    EXPECT_NE(plan_text(task, plan).find("so little torque does not count"), std::string::npos);
}

// ---- budget ---------------------------------------------------------------------------------------------------------

bool is_left_out(const Task& task, const ToolSetup& setup, const char* id) {
    for (const FeatureInfo& f : task.force.features)
        if (f.id == id) return setup.force_parameters[f.param] == f.off;
    throw std::runtime_error(id);
}

TEST(Plan, WithoutABudgetNothingThatIsChosenDependsOnTheClock) {
    Task cheap = drilling(), dear = drilling();
    cheap.cost_of = [](const auto&...) { return Cost{5.0, 10.0, 20.0}; };
    dear.cost_of = [](const auto&...) { return Cost{900.0, 1000.0, 2000.0}; };
    const StepPlan once = planned(cheap), again = planned(dear);
    EXPECT_EQ(plan_csv(std::span(&once, 1)), plan_csv(std::span(&again, 1)));
    EXPECT_TRUE(once.keeps(cheap.budget));
    EXPECT_FALSE(again.keeps(dear.budget));
    EXPECT_NE(plan_text(dear, again).find("OVER 300 us"), std::string::npos);
    // Nor where the first choice keeps the budget that there is.
    cheap.budget = {50e-6, true};
    const StepPlan kept = planned(cheap);
    EXPECT_EQ(plan_csv(std::span(&once, 1)), plan_csv(std::span(&kept, 1)));
}

TEST(Plan, WhereACoarseGridIsOverTheBudgetAFinerOneIsLookedFor) {
    Task task = drilling();
    const StepPlan first = planned(task);
    ASSERT_GT(first.chosen.spacing, 0.4_mm);
    task.budget = {30e-6, true};
    task.cost_of = [](const Body& body, const auto&...) {
        return body.grid().spacing > 0.4_mm ? Cost{20.0, 50.0, 60.0} : Cost{10.0, 25.0, 30.0};
    };
    const StepPlan plan = planned(task);
    EXPECT_NEAR(plan.chosen.spacing, 0.35_mm, 1e-12) << "the coarsest that keeps both";
    EXPECT_TRUE(plan.keeps_accuracy);
    EXPECT_TRUE(plan.keeps(task.budget));
    EXPECT_TRUE(plan.cheaper.empty());
    const FeatureFound& kept = found(plan, "chisel");
    EXPECT_FALSE(kept.is_left_out);
    EXPECT_NE(kept.change.force, found(first, "chisel").change.force) << "changes are of what is chosen";
    EXPECT_TRUE(found(plan, "friction").is_left_out);
    const std::string text = plan_text(task, plan);
    EXPECT_NE(text.find("over the budget\n"), std::string::npos) << text;
    EXPECT_NE(text.find("within the budget"), std::string::npos) << text;
    EXPECT_EQ(text.find("NOTHING"), std::string::npos) << text;
}

TEST(Plan, WhatIsWithinTheBudgetOnlyWithoutWhatCanBeLeftOutIsChosen) {
    Task task = drilling();
    task.budget = {30e-6, true};
    task.cost_of = [&](const Body&, const ToolSetup& setup, const auto&...) {
        return is_left_out(task, setup, "friction") ? Cost{10.0, 25.0, 30.0} : Cost{20.0, 50.0, 60.0};
    };
    const StepPlan plan = planned(task);
    EXPECT_EQ(plan.chosen.spacing, planned(drilling()).chosen.spacing);
    EXPECT_TRUE(plan.keeps(task.budget));
}

TEST(Plan, WhereNothingKeepsBothItSaysWhatComesNearestFromEitherSide) {
    Task task = drilling();
    task.budget = {30e-6, true};
    task.cost_of = [&](const Body& body, const ToolSetup& setup, const auto&...) {
        if (is_left_out(task, setup, "chisel")) return Cost{5.0, 12.0, 20.0};
        return body.grid().spacing > 0.2_mm ? Cost{20.0, 60.0, 70.0} : Cost{20.0, 45.0, 70.0};
    };
    const StepPlan plan = planned(task);
    EXPECT_TRUE(plan.keeps_accuracy) << "what is chosen is what is accurate";
    EXPECT_FALSE(plan.keeps(task.budget));
    EXPECT_NEAR(plan.chosen.spacing, 0.18_mm, 1e-12) << "the first of the cheapest";
    const std::string text = plan_text(task, plan);
    EXPECT_NE(text.find("OVER the budget"), std::string::npos) << text;
    EXPECT_NE(text.find("NOTHING that was tried keeps both"), std::string::npos) << text;
    EXPECT_NE(text.find("45 us in 999 of 1000, 15 us (50 %) over the budget"), std::string::npos) << text;
    const auto at = text.find("in budget   0.18 mm");
    ASSERT_NE(at, std::string::npos) << text;
    EXPECT_NE(text.find("without chisel: 12 us in 999 of 1000; force ", at), std::string::npos) << text;
    EXPECT_NE(text.find(" times what may be\n", at), std::string::npos) << text;
    for (const Cheaper& c : plan.cheaper) EXPECT_GT(c.choice.miss(task.accuracy, plan.torque_counts), 1.0) << c.without;
}

TEST(Plan, ABudgetThatNothingCouldKeepIsSaidToBeSuch) {
    Task task = drilling();
    task.budget = {1e-9, true};
    const StepPlan plan = planned(task);
    EXPECT_TRUE(plan.keeps_accuracy);
    const std::string text = plan_text(task, plan);
    EXPECT_NE(text.find("    accurate    "), std::string::npos) << text;
    EXPECT_NE(text.find(" over the budget\n"), std::string::npos) << text;
    EXPECT_NE(text.find("    in budget   nothing"), std::string::npos) << text;
}

TEST(Plan, TextAndTableSayWhatTheyAreNotForAndWhatToWrite) {
    const Task task = drilling();
    const StepPlan plan = planned(task);
    EXPECT_EQ(plan_csv(std::span(&plan, 1)).rfind("# For training and research; not for diagnosis", 0), 0u);
    const std::string text = plan_text(task, plan);
    EXPECT_NE(text.find("as accurate as required"), std::string::npos) << text;
    EXPECT_NE(text.find("        instruments.pilot.parameters.friction: 0\n"), std::string::npos) << text;
    EXPECT_NE(text.find("        accuracy.spacing: "), std::string::npos) << text;
}

}  // namespace
}  // namespace kerf::plan
