// SPDX-License-Identifier: Apache-2.0
#include "run/run_result.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "kerf/units.hpp"

namespace kerf::run {
namespace {

using namespace literals;

/// A procedure of one step with these goals and limits, judged after what was shown.
struct Judged {
    documents::Procedure procedure;
    documents::Anatomy anatomy;
    ToolSolid drill{{{0.0, 0.0}, {-1e-3, 1.5e-3}, {-2e-3, 1.5e-3}}};
    std::vector<Observation> shown;

    Judged(std::vector<documents::Goal> goals, std::vector<documents::Limit> limits) {
        documents::Step step;
        step.id = "insert";
        step.goals = std::move(goals);
        step.limits = std::move(limits);
        procedure.steps = {step};
    }
    [[nodiscard]] StepMonitor monitor() const {
        StepMonitor monitor(procedure, anatomy,
                            std::vector<AxisFrame>(procedure.steps.size(), {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}));
        for (const Observation& one : shown) monitor.observe(one, drill);
        return monitor;
    }
    [[nodiscard]] session::RunSummary summary(RunEnd end = RunEnd::path_ended) const {
        session::RunSummary summary;
        judge(monitor(), end, 1.0, 120.0, summary);
        return summary;
    }
    [[nodiscard]] bool is_as(const documents::Rehearsal& rehearsal) const {
        return ended_as_expected(rehearsal, monitor(), summary().verdict);
    }
};

Observation in_bone(double depth) {
    return {.time = 0.25, .world_from_tool = {{0, 0, depth}, {1, 0, 0, 0}}, .is_running = true, .is_resisted = true};
}
Observation in_air() { return {.time = 0.5, .world_from_tool = {{0, 0, -1e-3}, {1, 0, 0, 0}}}; }

documents::Rehearsal expecting(const char* verdict, const char* limit = "", const char* step = "",
                               bool others = false) {
    documents::Rehearsal rehearsal;
    rehearsal.expect = verdict;
    rehearsal.expect_limit = limit;
    rehearsal.expect_step = step;
    rehearsal.expects_others = others;
    return rehearsal;
}

const documents::Goal entry{"entry", {}, {}};

// ---- what a trainee reads

std::string only_reason(const session::RunSummary& summary) {
    EXPECT_EQ(summary.reasons.size(), 1u);
    return summary.reasons.empty() ? "" : summary.reasons.front();
}

TEST(RunResult, NamesTheValueThatBrokeALimit) {
    Observation now = in_bone(1e-3);
    now.torque = -3.25;
    now.lateral_force = 21.5;
    now.removed = 5.5e-7;
    const auto reason = [&](const char* quantity, double at_most) {
        Judged judged({entry}, {{.quantity = quantity, .bound = {{}, at_most}, .reason = "Careful."}});
        judged.shown = {now, in_air()};
        EXPECT_EQ(judged.summary().verdict, session::Verdict::fail);
        EXPECT_EQ(judged.summary().steps.at(0).broken_limits, std::vector<std::string>{quantity});
        return only_reason(judged.summary());
    };
    EXPECT_EQ(reason("torque", 3.0), "Step `insert`: Careful. Torque: 3.25 N m.");
    EXPECT_EQ(reason("lateral_force", 20.0), "Step `insert`: Careful. Across the shaft: 21.5 N.");
    EXPECT_EQ(reason("removed_volume", 5e-7), "Step `insert`: Careful. Removed: 550 mm3.");
    EXPECT_EQ(reason("duration", 0.125), "Step `insert`: Careful. Duration: 0.25 s.");
}

TEST(RunResult, NamesTheSpeedOfATipInBone) {
    Judged judged({entry}, {{.quantity = "speed", .bound = {{}, 5e-3}, .reason = "Careful."}});
    for (int tick = 1; tick <= 40; ++tick) {
        judged.shown.push_back(in_bone(6.125e-6 * tick));
        judged.shown.back().time = 1e-3 * tick;
    }
    judged.shown.push_back(in_air());
    EXPECT_EQ(only_reason(judged.summary()), "Step `insert`: Careful. Speed: 6.125 mm/s.");
}

TEST(RunResult, PassesWithinEveryLimit) {
    Observation now = in_bone(1e-3);
    now.torque = 3.0;
    now.lateral_force = 20.0;
    now.removed = 5e-7;
    Judged judged({entry}, {});
    for (const auto& [quantity, at_most] : {std::pair{"torque", 3.0},
                                            {"lateral_force", 20.0},
                                            {"speed", 5e-3},
                                            {"removed_volume", 5e-7},
                                            {"duration", 1.0}})
        judged.procedure.steps[0].limits.push_back({.quantity = quantity, .bound = {{}, at_most}});
    judged.shown = {now, in_air()};
    EXPECT_EQ(judged.summary().verdict, session::Verdict::pass);
}

/// Judges one measure of a step at its end.
session::RunSummary judged(documents::Measure::Kind kind, const documents::Bound& bound,
                           const documents::MeasureReading& reading) {
    Judged judged({entry}, {{.quantity = "measure", .bound = bound, .reason = "Not so.", .measure = "m"}});
    judged.procedure.measures = {{.id = "m", .kind = kind, .is_of_angles = true}};
    judged.shown = {in_bone(1e-3), in_air()};
    StepMonitor monitor = judged.monitor();
    monitor.judge_measures(0, {reading}, 1.0);
    session::RunSummary summary;
    judge(monitor, RunEnd::steps_done, 1.0, 120.0, summary);
    return summary;
}

TEST(RunResult, StatesThatParallelIsUndecidedWithinTheUncertainty) {
    constexpr auto angle = documents::Measure::Kind::angle;
    const documents::MeasureReading parallel{.value = 0.0, .uncertainty = 1.14_deg};
    const session::RunSummary narrow = judged(angle, {{}, 1.0_deg}, parallel);
    EXPECT_EQ(narrow.verdict, session::Verdict::pass) << "the value alone decides";
    EXPECT_EQ(
        only_reason(narrow),
        "Step `insert`: undecided, as the bound lies within the uncertainty: `m` 0.0 ± 1.1 deg, must be at most 1 "
        "deg.");
    EXPECT_TRUE(judged(angle, {{}, 2.0_deg}, parallel).reasons.empty()) << "twice the uncertainty is enough";
    EXPECT_TRUE(judged(angle, {0.0_deg, 2.0_deg}, parallel).reasons.empty()) << "no angle is negative";
    EXPECT_TRUE(judged(angle, {{}, 1.0_deg}, {.value = 0.0}).reasons.empty()) << "known exactly";
}

TEST(RunResult, StatesThatABrokenBoundIsUndecided) {
    constexpr auto angle = documents::Measure::Kind::angle;
    // Parallel lines read about so where each landmark is known to 0.1 mm.
    const documents::MeasureReading biased{.value = 1.04_deg, .uncertainty = 0.7_deg};
    const session::RunSummary broken = judged(angle, {{}, 1.0_deg}, biased);
    EXPECT_EQ(broken.verdict, session::Verdict::fail);
    ASSERT_EQ(broken.reasons.size(), 2U);
    EXPECT_EQ(
        broken.reasons[1],
        "Step `insert`: undecided, as the bound lies within the uncertainty: `m` 1.04 ± 0.70 deg, must be at most "
        "1 deg.");
    EXPECT_EQ(judged(angle, {{}, 0.3_deg}, biased).reasons.size(), 1U) << "clearly beyond";
}

TEST(RunResult, StatesThatASignedDifferenceIsUndecided) {
    constexpr auto difference = documents::Measure::Kind::difference;
    const documents::Bound symmetric{-1.0_deg, 1.0_deg};
    EXPECT_TRUE(judged(difference, symmetric, {.value = 0.0, .uncertainty = 0.9_deg}).reasons.empty());
    EXPECT_EQ(judged(difference, symmetric, {.value = -0.5_deg, .uncertainty = 0.9_deg}).reasons.size(), 1U);
    EXPECT_EQ(judged(difference, symmetric, {.value = 3.0_deg, .uncertainty = 5.0_deg}).reasons.size(), 2U)
        << "both ends of a narrow bound lie within the uncertainty";
}

TEST(RunResult, NamesASignalByItsId) {
    const documents::NamedSignal clamp{"clamp", 0, "N"};
    const std::vector<double> signals{105.25};
    Observation now = in_bone(1e-3);
    now.signals = signals;
    Judged limited({entry}, {{.quantity = "signal", .bound = {{}, 100.0}, .reason = "Too tight.", .signal = clamp}});
    limited.shown = {now, in_air()};
    EXPECT_EQ(only_reason(limited.summary()), "Step `insert`: Too tight. `clamp`: 105.2 N.");
    EXPECT_EQ(limited.summary().steps.at(0).broken_limits, std::vector<std::string>{"clamp"});
    EXPECT_TRUE(limited.is_as(expecting("fail", "clamp")));
    EXPECT_FALSE(limited.is_as(expecting("fail", "signal")));
}

TEST(RunResult, DescribesAMissedGoal) {
    const std::vector<double> low{2.0}, high{80.0};
    Observation first = in_bone(1e-3), then = in_bone(1e-3);
    first.signals = low;
    then.signals = high;
    then.removed = 3e-7;
    const auto reason = [&](const documents::Goal& goal) {
        Judged judged({goal}, {});
        judged.shown = {first, then};
        EXPECT_EQ(judged.summary().verdict, session::Verdict::incomplete);
        return only_reason(judged.summary());
    };
    EXPECT_EQ(reason({.quantity = "signal", .bound = {100.0, {}}, .signal = {"clamp", 0, "N"}}),
              "Step `insert`: the signal `clamp` was between 2 N and 80 N, must be at least 100 N.");
    EXPECT_EQ(reason({.quantity = "signal", .bound = {10.0, 20.0}, .signal = {"clamp", 0, "N"}}),
              "Step `insert`: the signal `clamp` was between 2 N and 80 N, must be at least 10 N and at most 20 N.");
    EXPECT_EQ(reason({.quantity = "signal", .bound = {1.0, {}}, .signal = {"slip", 3, "mm"}}),
              "Step `insert`: the signal `slip` was never reported.");
    EXPECT_EQ(reason({.quantity = "removed_volume", .bound = {5e-7, {}}}),
              "Step `insert`: removed 300 mm3, must be at least 500 mm3.");
}

TEST(RunResult, TellsAValueFromItsBound) {
    const auto missed = [](const char* quantity, double at_least, double reached) {
        Judged judged({{quantity, {at_least, {}}, {}}}, {});
        judged.shown = {in_bone(reached), in_air()};
        return only_reason(judged.summary());
    };
    EXPECT_EQ(missed("depth", 60e-3, 59.98e-3), "Step `insert`: depth 59.98 mm, must be at least 60.00 mm.");
    EXPECT_EQ(missed("depth", 60e-3, 59.8e-3), "Step `insert`: depth 59.8 mm, must be at least 60.0 mm.");

    const auto broken = [](const char* quantity, double at_most, const Observation& now) {
        Judged judged({entry}, {{.quantity = quantity, .bound = {{}, at_most}, .reason = "Careful."}});
        judged.shown = {now, in_air()};
        return only_reason(judged.summary());
    };
    Observation now = in_bone(38.04e-3);
    now.thrust = 60.2;
    now.torque = 3.00004;
    EXPECT_EQ(broken("depth", 38e-3, now), "Step `insert`: Careful. Depth: 38.04 mm.");
    EXPECT_EQ(broken("thrust", 60.0, now), "Step `insert`: Careful. Thrust: 60.2 N.");
    EXPECT_EQ(broken("thrust", 50.0, now), "Step `insert`: Careful. Thrust: 60 N.");
    EXPECT_EQ(broken("torque", 3.0, now), "Step `insert`: Careful. Torque: 3.00004 N m.");
}

TEST(RunResult, NamesStepsNotReachedInOneReason) {
    Judged judged({entry, {"depth", {5e-3, {}}, {}}}, {});
    for (const char* id : {"second", "third"}) {
        judged.procedure.steps.push_back(judged.procedure.steps[0]);
        judged.procedure.steps.back().id = id;
    }
    judged.shown = {in_bone(6e-3), in_air(), in_air()};
    const session::RunSummary summary = judged.summary();
    EXPECT_EQ(only_reason(summary), "Steps `second` and `third` were not reached.");
    EXPECT_EQ(summary.verdict, session::Verdict::incomplete);
    EXPECT_TRUE(summary.is_missing);

    judged.shown = {in_air()};
    EXPECT_EQ(judged.summary().reasons.front(), "Step `insert`: the tool never met bone.") << "a run begins in it";
}

// ---- what a rehearsal expects

TEST(RunResult, IncompleteIsExpectedOnlyWhereGoalsAreMissed) {
    Judged judged({entry, {"depth", {5e-3, {}}, {}}}, {{.quantity = "thrust", .bound = {{}, 60.0}}});
    judged.shown = {in_bone(1e-3), in_air()};
    EXPECT_TRUE(judged.is_as(expecting("incomplete")));
    EXPECT_FALSE(judged.is_as(expecting("pass")));
    judged.shown = {in_bone(6e-3), in_air()};
    EXPECT_FALSE(judged.is_as(expecting("incomplete"))) << "every goal is reached";
    judged.shown = {in_bone(1e-3), in_air()};
    judged.shown[0].thrust = 61.0;
    EXPECT_FALSE(judged.is_as(expecting("incomplete"))) << "a limit is broken";
}

TEST(RunResult, ALimitIsExpectedToBreakInTheNamedStep) {
    // Given two steps with the same limit, broken in the second
    Judged judged({entry}, {{.quantity = "thrust", .bound = {{}, 60.0}}});
    judged.procedure.steps.push_back(judged.procedure.steps[0]);
    judged.procedure.steps[1].id = "second";
    judged.shown = {in_bone(1e-3), in_air(), in_bone(1e-3), in_air()};
    judged.shown[2].thrust = 61.0;

    EXPECT_TRUE(judged.is_as(expecting("fail", "thrust"))) << "in any step";
    EXPECT_TRUE(judged.is_as(expecting("fail", "thrust", "second")));
    EXPECT_FALSE(judged.is_as(expecting("fail", "thrust", "insert")));

    // When it breaks in both, it does not break in one step alone
    judged.shown[0].thrust = 61.0;
    EXPECT_FALSE(judged.is_as(expecting("fail", "thrust", "second")));
    EXPECT_TRUE(judged.is_as(expecting("fail", "thrust", "second", true)));
}

}  // namespace
}  // namespace kerf::run
