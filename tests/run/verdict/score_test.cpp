// SPDX-License-Identifier: Apache-2.0
#include "run/verdict/score.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "run/run_result.h"

namespace kerf::run {
namespace {

using documents::Severity;

/// An operation of two steps, each a hole of 10 mm with limits on thrust.
struct Operation {
    documents::Procedure procedure;
    documents::Anatomy anatomy;
    ToolSolid drill{{{0.0, 0.0}, {-1e-3, 1.5e-3}, {-2e-3, 1.5e-3}}};
    std::vector<session::MetricRow> metrics;
    std::vector<Observation> shown;

    Operation() {
        documents::Step step;
        step.goals = {{"entry", {}, {}}, {"depth", {10e-3, {}}, {}}};
        step.limits = {{.quantity = "thrust", .bound = {{}, 50.0}, .reason = "Too hard.", .severity = Severity::minor},
                       {.quantity = "torque", .bound = {{}, 2.0}, .reason = "Twisted."},
                       {.quantity = "lateral_force",
                        .bound = {{}, 20.0},
                        .reason = "Into the canal.",
                        .severity = Severity::critical}};
        step.id = "pilot";
        procedure.steps.push_back(step);
        step.id = "widen";
        procedure.steps.push_back(step);
    }
    void drill_to(double depth) {
        shown.push_back({.time = 1e-3 * static_cast<double>(shown.size()),
                         .world_from_tool = {{0, 0, depth}, {1, 0, 0, 0}},
                         .is_running = true,
                         .is_resisted = true});
    }
    void withdraw() {
        shown.push_back(
            {.time = 1e-3 * static_cast<double>(shown.size()), .world_from_tool = {{0, 0, -1e-3}, {1, 0, 0, 0}}});
    }
    void drill_both() {
        drill_to(10e-3);
        withdraw();
        drill_to(10e-3);
        withdraw();
    }
    void add_metric(const std::string& id, double value) {
        metrics.emplace_back();
        metrics.back().id = id;
        metrics.back().value = value;
    }
    [[nodiscard]] session::RunSummary summary() const {
        StepMonitor monitor(procedure, anatomy, std::vector<AxisFrame>(2, {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}));
        for (const Observation& one : shown) monitor.observe(one, drill);
        session::RunSummary summary;
        judge(monitor, RunEnd::path_ended, 1.0, 120.0, summary);
        summary.metrics = metrics;
        score(monitor, procedure, summary);
        double lost = 0.0;
        for (const session::DeductionRow& row : summary.deductions) lost += row.loss;
        EXPECT_NEAR(lost, 100.0 - summary.score, 1e-9) << "the deductions add up";
        return summary;
    }
};

TEST(Score, IsZeroForAHandThatDoesNothing) {
    Operation idle;
    idle.withdraw();
    EXPECT_EQ(idle.summary().score, 0.0);
    idle.procedure.scoring = {{.metric = "pilot.offset", .step = "pilot", .unit = "mm", .full = 0.0, .none = 1e-3}};
    idle.add_metric("pilot.offset", 0.0);
    EXPECT_EQ(idle.summary().score, 0.0) << "an offset of 0 was not earned";
}

TEST(Score, CountsStepsAndLimitsInEqualPartsWithoutScoring) {
    Operation half;
    half.drill_to(5e-3);
    // Of 8 parts: half of the first step, and of its three limits.
    const session::RunSummary summary = half.summary();
    EXPECT_EQ(summary.verdict, session::Verdict::incomplete);
    EXPECT_EQ(summary.score_band, "incomplete");
    EXPECT_NEAR(summary.score, 5.0 + 15.0 * 2.0 / 8.0, 1e-12);

    Operation all;
    all.drill_both();
    EXPECT_EQ(all.summary().score, 100.0);
    EXPECT_TRUE(all.summary().deductions.empty());
}

TEST(Score, OrdersOutcomesByTheirSeverity) {
    const auto with = [](auto&& spoil) {
        Operation operation;
        operation.drill_both();
        spoil(operation.shown[2]);
        return operation.summary();
    };
    const session::RunSummary minor = with([](Observation& now) { now.thrust = 60.0; });
    const session::RunSummary serious = with([](Observation& now) { now.torque = 3.0; });
    const session::RunSummary critical = with([](Observation& now) { now.lateral_force = 30.0; });
    const session::RunSummary both = with([](Observation& now) { now.torque = 3.0, now.lateral_force = 30.0; });
    Operation halfway;
    halfway.drill_to(10e-3);
    halfway.withdraw();
    halfway.drill_to(9.9e-3);

    // One of 8 parts is lost.
    EXPECT_NEAR(minor.score, 40.0 + 20.0 * 7.0 / 8.0, 1e-12);
    EXPECT_NEAR(serious.score, 20.0 + 20.0 * 7.0 / 8.0, 1e-12);
    EXPECT_NEAR(halfway.summary().score, 5.0 + 15.0 * 7.96 / 8.0, 1e-9);
    EXPECT_NEAR(critical.score, 5.0 * 7.0 / 8.0, 1e-12);
    EXPECT_EQ(both.score_band, "critical");
    ASSERT_FALSE(serious.deductions.empty());
    EXPECT_EQ(serious.deductions[0].name, "torque");
    EXPECT_EQ(serious.deductions[0].detail, "Twisted. Torque: 3 N m.");
    EXPECT_EQ(serious.deductions[0].at, 2e-3);
    EXPECT_EQ(serious.deductions[0].loss, 60.0);
}

TEST(Score, NamesTheLimitThatBrokeFirst) {
    Operation operation;
    operation.drill_both();
    operation.shown[0].thrust = operation.shown[2].thrust = 60.0;
    const session::RunSummary summary = operation.summary();
    ASSERT_FALSE(summary.deductions.empty());
    EXPECT_EQ(summary.deductions[0].name, "thrust");
    EXPECT_EQ(summary.deductions[0].step, "pilot");
    EXPECT_EQ(summary.deductions[0].at, 0.0);

    operation.shown[2].torque = 3.0;
    EXPECT_EQ(operation.summary().deductions[0].name, "torque") << "of those that are as severe as the band";
}

TEST(Score, FallsWithTheMeasuredErrorAndWeighsIt) {
    Operation operation;
    operation.drill_both();
    operation.procedure.scoring = {
        {.metric = "pilot.offset", .step = "pilot", .unit = "mm", .full = 1e-3, .none = 4e-3, .weight = 3.0},
        {.metric = "pilot.depth", .step = "pilot", .unit = "mm", .full = 1e-3, .none = 3e-3, .target = 12e-3},
        {.metric = "widen.grip", .step = "widen", .unit = "N", .full = 200.0, .none = 100.0}};
    operation.add_metric("pilot.offset", 2e-3);  // q = 2/3
    operation.add_metric("pilot.depth", 10e-3);  // 2 mm off its target: q = 1/2
    operation.add_metric("widen.grip", 175.0);   // the more the better: q = 3/4
    EXPECT_NEAR(operation.summary().score, 60.0 + 40.0 * (3.0 * 2.0 / 3.0 + 0.5 + 0.75) / 5.0, 1e-9);

    operation.metrics.pop_back();
    const session::RunSummary summary = operation.summary();
    EXPECT_NEAR(summary.score, 60.0 + 40.0 * 2.5 / 5.0, 1e-9) << "what was not measured is not earned";
    const auto grip = std::find_if(summary.deductions.begin(), summary.deductions.end(),
                                   [](const auto& row) { return row.name == "widen.grip"; });
    ASSERT_NE(grip, summary.deductions.end());
    EXPECT_EQ(grip->detail, "not measured; full 200 N, none 100 N");
}

TEST(Score, OfARunThatPassesIsNeverBelowItsBand) {
    Operation poor;
    poor.drill_both();
    poor.procedure.scoring = {{.metric = "pilot.offset", .step = "pilot", .unit = "mm", .full = 0.0, .none = 1e-3},
                              {.metric = "widen.offset", .step = "widen", .unit = "mm", .full = 0.0, .none = 1e-3}};
    poor.add_metric("pilot.offset", 2e-3);
    poor.add_metric("widen.offset", std::nan(""));
    EXPECT_EQ(poor.summary().score, 60.0);
}

TEST(Score, OfARunWithALimitThatCouldNotBeMeasuredIsThatOfAnIncompleteOne) {
    Operation unmeasured;
    unmeasured.procedure.steps[1].limits.push_back({.quantity = "hole_angle", .bound = {{}, 0.1}, .reason = "Askew."});
    unmeasured.drill_both();
    EXPECT_EQ(unmeasured.summary().score_band, "incomplete");
    const double whole = unmeasured.summary().score;
    unmeasured.shown[2].torque = 3.0;
    EXPECT_EQ(unmeasured.summary().score_band, "incomplete") << "a broken limit raises no score";
    EXPECT_LT(unmeasured.summary().score, whole);
}

TEST(Score, OfAMeasureOfTheRunCountsWithAllGoals) {
    Operation operation;
    operation.drill_to(10e-3);
    operation.withdraw();
    operation.procedure.scoring = {
        {.metric = "measure.angle.after", .step = "", .unit = "deg", .full = 0.0, .none = 1.0}};
    operation.add_metric("measure.angle.after", 0.0);
    // Parts: both steps without a metric, 1 and 0; the measure with the mean of both.
    EXPECT_NEAR(operation.summary().score, 5.0 + 15.0 * (1.0 + 0.5) / 3.0, 1e-12);
}

}  // namespace
}  // namespace kerf::run
