// SPDX-License-Identifier: Apache-2.0
// A run as another program has it: tick by tick.
#include "run/run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "app/replay.h"
#include "session/read_session.h"
#include "tests/support/short_scene.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/watched_run.h"

namespace kerf::run {
namespace {

using namespace literals;

using test::scene_with;
using test::short_scene;

std::unique_ptr<Run> new_run(const RunRequest& request = {}) {
    RunOutcome refusal;
    auto run = Run::create(short_scene(), test::plugins(), request, refusal);
    EXPECT_EQ(refusal.error, "");
    return run;
}

TEST(Run, StepByStepItIsTheSameRunToTheBit) {
    const test::WatchedRun whole = test::watched_run(short_scene(), test::plugins(), {});
    const auto run = new_run();
    ASSERT_NE(run, nullptr);
    std::size_t ticks = 1;
    while (run->step()) ++ticks;
    const RunOutcome outcome = run->finish();
    EXPECT_EQ(ticks, whole.ticks.size());
    EXPECT_EQ(outcome.summary.hash, whole.summary.hash);
    EXPECT_EQ(outcome.summary.verdict, session::Verdict::incomplete) << "the time was over";
    EXPECT_GT(outcome.summary.removed, 0.0);
}

// A shallow cut, then the tool in air, where an undo restores the bone.
TEST(Run, HasNoUndoInAnExamination) {
    const Scene scene = scene_with({"rehearsals.expert.path=[{depth: -3 mm, speed: 10 mm/s}, {depth: 0.5 mm, speed: 1 "
                                    "mm/s}, {depth: -10 mm, speed: 10 mm/s, do: undo}, {depth: -11 mm}]",
                                    "rehearsals.expert.hand.push=40 N"});
    const auto refusals = [](const test::WatchedRun& run) {
        std::string all;
        for (const session::EventRow& event : run.events)
            if (event.id == "hand.refused") all += event.detail + "\n";
        return all;
    };
    const test::TemporaryFolder folder;
    RunRequest request;
    const test::WatchedRun practice = test::watched_run(scene, test::plugins(), request);
    EXPECT_EQ(refusals(practice), "");
    EXPECT_NEAR(practice.summary.removed, 0.0, 1e-15);
    request.mode = "exam";
    request.out = folder / "exam";
    const test::WatchedRun exam = test::watched_run(scene, test::plugins(), request);
    EXPECT_EQ(refusals(exam), "undo: an examination has no undo\n");
    EXPECT_GT(exam.summary.removed, 0.05e-9);

    // A replay is an examination, too.
    std::string error;
    const auto recorded = session::read_session(request.out + "/session.db", error);
    ASSERT_TRUE(recorded) << error;
    EXPECT_TRUE(recorded->is_examination);
    RunRequest again;
    ASSERT_EQ(app::repeat(*recorded, "session.db", again), "");
    EXPECT_EQ(run_procedure(scene, test::plugins(), again).summary.hash, exam.summary.hash);
}

// A device that is led as the simulated hand was meets the same bone with the same force.
TEST(Run, ADeviceThatReportsTheSamePosesFeelsTheSame) {
    const test::WatchedRun whole = test::watched_run(short_scene(), test::plugins(), {});
    const auto run = new_run();
    ASSERT_NE(run, nullptr);
    for (const session::TickRow& row : whole.ticks) {
        const bool goes_on = run->step({row.device_from_handle});
        ASSERT_EQ(run->last().command.wrench, row.commanded) << row.tick;
        ASSERT_EQ(goes_on, &row != &whole.ticks.back()) << row.tick;
    }
    EXPECT_EQ(run->finish().summary.hash, whole.summary.hash);
}

// ---- what a step may ask of each tick

const session::MetricRow* metric_of(const session::RunSummary& summary, const std::string& id) {
    for (const session::MetricRow& row : summary.metrics)
        if (row.id == id) return &row;
    return nullptr;
}

RunRequest pushed_hard() {
    RunRequest request;
    request.rehearsal = "medial-breach";
    return request;
}

TEST(Run, MeasuresWhatLimitsOfAStepAreOn) {
    // Given a limit on every quantity that the ticks show, two of them too low
    const Scene scene =
        scene_with({"steps.pilot-hole.limits=[{torque: {at_most: 3 N m}, reason: A.}, "
                    "{lateral_force: {at_most: 0.5 N}, reason: Levered.}, {speed: {at_most: 500 mm/s}, reason: A.}, "
                    "{removed_volume: {at_most: 1e5 mm3}, reason: A.}, {duration: {at_most: 10 s}, reason: Slow.}, "
                    "{signal: {id: drive_power, at_most: 500 W}, reason: A.}]"});

    // When the drill is pushed hard for fifteen seconds
    const test::WatchedRun run = test::watched_run(scene, test::plugins(), pushed_hard());

    // Then each metric is the greatest of what the session has of it, in newtons of the bone
    double torque = 0.0, across = 0.0, power = 0.0;
    const auto column = std::find_if(run.summary.signals.begin(), run.summary.signals.end(),
                                     [](const session::SignalColumn& c) { return c.id == "drive_power"; });
    ASSERT_NE(column, run.summary.signals.end());
    for (const session::TickRow& row : run.ticks) {
        const Vec3 shaft = rotate(row.world_from_tool.rotation, {0, 0, 1});
        torque = std::max(torque, std::abs(row.torque));
        across = std::max(across, length(linear(row.modelled) - dot(linear(row.modelled), shaft) * shaft));
        power = std::max(power, row.signals[static_cast<std::size_t>(column - run.summary.signals.begin())]);
    }
    const auto value_of = [&](const char* id) {
        const session::MetricRow* row = metric_of(run.summary, std::string("pilot-hole.") + id);
        return row != nullptr ? row->value : -1.0;
    };
    EXPECT_GT(torque, 1e-3);
    EXPECT_GT(power, 1.0);
    EXPECT_EQ(value_of("torque"), torque);
    EXPECT_EQ(value_of("lateral-force"), across);
    EXPECT_EQ(value_of("signal.drive_power"), power);
    EXPECT_NEAR(value_of("duration"), 14.999, 1e-9 /* from the first tick to the last */);
    EXPECT_GT(value_of("speed"), 0.0);
    EXPECT_LT(value_of("speed"), 0.5);
    EXPECT_NEAR(value_of("removed-volume"), run.summary.removed, 0.05 * run.summary.removed /* of the last count */);

    // And the two limits are broken, each with its sentence and its value
    EXPECT_EQ(run.summary.verdict, session::Verdict::fail);
    EXPECT_EQ(run.summary.steps.at(0).broken_limits, (std::vector<std::string>{"lateral_force", "duration"}));
    EXPECT_TRUE(run.summary.reasons.at(0).starts_with("Step `pilot-hole`: Levered. Across the shaft: "));
    EXPECT_EQ(run.summary.reasons.at(1), "Step `pilot-hole`: Slow. Duration: 15 s.");
    EXPECT_EQ(metric_of(run.summary, "pilot-hole.lateral-force")->status, "broken");
    EXPECT_EQ(metric_of(run.summary, "pilot-hole.signal.drive_power")->status, "ok");
}

// Help is requested three times: twice in one step.
TEST(Run, CountsTheStepsForWhichHelpWasRequested) {
    const std::string path =
        "rehearsals.expert.path=[{depth: -3 mm, do: assist}, {depth: -4 mm, do: assist}, {depth: -5 mm}]";
    const Scene scene = scene_with({"assist=on-request", path});
    const auto count = [](const test::WatchedRun& run, const char* id) {
        return std::ranges::count(run.events, id, &session::EventRow::id);
    };
    const test::WatchedRun run = test::watched_run(scene, test::plugins(), {});
    EXPECT_EQ(count(run, "assist.used"), 1);
    EXPECT_EQ(count(run, "hand.refused"), 1);
    ASSERT_NE(metric_of(run.summary, "assist.uses"), nullptr);
    EXPECT_EQ(metric_of(run.summary, "assist.uses")->value, 1.0);

    // A replay, with the help of its record, requests the same; another level of help is another run.
    RunRequest again;
    again.hand_inputs = {};
    for (const session::TickRow& row : run.ticks) again.replay.push_back(row.device_from_handle);
    for (const session::EventRow& event : run.events)
        if (event.id == session::hand_input_event)
            again.hand_inputs.emplace_back(event.tick, documents::hand_input(event.detail).value());
    const test::WatchedRun repeated = test::watched_run(scene, test::plugins(), again);
    EXPECT_EQ(count(repeated, "assist.used"), 1);
    EXPECT_EQ(repeated.summary.hash, run.summary.hash);
    again.assist = documents::Assist::off;
    const test::WatchedRun without = test::watched_run(scene, test::plugins(), again);
    EXPECT_EQ(count(without, "assist.used"), 0);
    EXPECT_EQ(metric_of(without.summary, "assist.uses"), nullptr);
    EXPECT_NE(without.summary.hash, run.summary.hash);
    again.assist = documents::Assist::on_request;  // as the procedure states
    EXPECT_EQ(test::watched_run(scene, test::plugins(), again).summary.hash, run.summary.hash);
}

TEST(Run, ReachesGoalsOnSignalsAndRemovedBone) {
    const Scene scene = scene_with({"steps.pilot-hole.goals=[{entry: {}}, {signal: {id: drive_power, at_least: 1 W}}, "
                                    "{removed_volume: {at_least: 1 mm3}}, "
                                    "{signal: {id: spindle_speed, at_least: 2000 rpm}}]",
                                    "steps.pilot-hole.limits=~"});
    const test::WatchedRun run = test::watched_run(scene, test::plugins(), pushed_hard());
    std::vector<std::string> reached;
    for (const session::EventRow& event : run.events)
        if (event.id == "goal_reached") reached.push_back(event.detail);
    EXPECT_EQ(reached,
              (std::vector<std::string>{"pilot-hole: entry", "pilot-hole: drive_power", "pilot-hole: removed_volume"}));
    ASSERT_FALSE(run.summary.reasons.empty());
    EXPECT_EQ(run.summary.verdict, session::Verdict::incomplete);
    EXPECT_TRUE(run.summary.reasons.at(0).ends_with("must be at least 2000 rpm.")) << run.summary.reasons.at(0);
    EXPECT_NE(metric_of(run.summary, "pilot-hole.signal.spindle_speed"), nullptr);
}

TEST(Run, ADeviceMayGoAnotherWay) {
    const auto run = new_run();
    ASSERT_NE(run, nullptr);
    const AxisFrame& frame = short_scene().frames.front();
    for (int tick = 0; tick < 2000; ++tick)  // it comes near and stays in air
        ASSERT_TRUE(run->step({frame.pose_at({.depth = -20.0_mm + 5.0_um * tick})}));
    EXPECT_EQ(run->monitor().steps().front().deepest, -1.0) << "no bone was cut";
    const RunOutcome outcome = run->finish();
    EXPECT_EQ(outcome.summary.ticks, 2000u);
    EXPECT_EQ(outcome.summary.removed, 0.0);
}

// The device missed ticks twice: the motion differs from then on, and a replay must know of it.
TEST(Run, RecordsMissedTicksAndReplaysThemToTheBit) {
    const test::WatchedRun whole = test::watched_run(short_scene(), test::plugins(), {});
    const test::TemporaryFolder folder;
    const auto ended = [&](bool misses, RunRequest request) {
        const auto run = new_run(request);
        for (const session::TickRow& row : whole.ticks)
            if (!run->step({row.device_from_handle, misses && (row.tick == 4000 || row.tick == 9000) ? 2u : 0u})) break;
        return run->finish().summary;
    };
    RunRequest request;
    request.out = folder.path() + "/missed";
    const session::RunSummary with = ended(true, request), without = ended(false, {});
    EXPECT_EQ(without.hash, whole.summary.hash);
    EXPECT_NE(with.hash, without.hash);

    std::string error;
    auto inputs = session::read_session(request.out + "/session.db", error);
    ASSERT_TRUE(inputs) << error;
    ASSERT_EQ(inputs->missed, (std::vector<std::pair<std::uint64_t, std::uint32_t>>{{4000, 2}, {9000, 2}}));
    RunRequest again;
    again.replay = std::move(inputs->device_from_handle);
    again.adoptions = std::move(inputs->adoptions);
    again.missed = std::move(inputs->missed);
    EXPECT_EQ(test::watched_run(short_scene(), test::plugins(), again).summary.hash, with.hash);
    again.missed.clear();
    EXPECT_NE(test::watched_run(short_scene(), test::plugins(), again).summary.hash, with.hash);
}

TEST(Run, CallsItsObserversInOrderAndEndsWhenOneSaysSo) {
    struct Witness final : RunObserver {
        std::vector<std::string> calls;
        std::size_t ticks = 0;
        void on_tick(const session::TickRow& row) override { EXPECT_EQ(row.tick, ticks++); }
        void on_progress(double, const std::string&) override { calls.emplace_back("progress"); }
        std::optional<RunEnd> end() override {
            return ticks == 300 ? std::optional(RunEnd::interrupted) : std::nullopt;
        }
        std::string on_result(const session::RunSummary& summary, const Simulation&) override {
            calls.emplace_back(to_text(summary.verdict));
            return "the disk is full";
        }
    } witness;
    RunRequest request;
    request.observers = {&witness};
    const RunOutcome outcome = run_procedure(short_scene(), test::plugins(), request);
    EXPECT_TRUE(outcome.was_interrupted);
    EXPECT_EQ(outcome.summary.ticks, 300u);
    EXPECT_EQ(witness.ticks, 300u);
    EXPECT_EQ(witness.calls, (std::vector<std::string>{"progress", "incomplete"}));
    EXPECT_EQ(outcome.error, "the disk is full");
}

// The folder of the results is renamed during the run, and another one gets its name.
TEST(Run, WritesNothingIntoAFolderThatReplacedItsOwn) {
    const test::TemporaryFolder own;
    const std::string folder = own / "run", foreign = folder + "/summary.json";
    struct Replacer final : RunObserver {
        std::string folder, foreign;
        std::size_t ticks = 0;
        std::vector<std::string> work;
        void on_tick(const session::TickRow&) override {
            if (++ticks != 300) return;
            std::filesystem::rename(folder, folder + "-moved");
            std::filesystem::create_directory(folder);
            std::ofstream(foreign) << "mine";
        }
        void on_progress(double fraction, const std::string& what) override {
            if (fraction >= 1.0) work.push_back(what);
        }
        std::optional<RunEnd> end() override {
            return ticks == 600 ? std::optional(RunEnd::interrupted) : std::nullopt;
        }
    } replacer;
    replacer.folder = folder;
    replacer.foreign = foreign;
    RunRequest request;
    request.out = folder;
    request.observers = {&replacer};
    const RunOutcome outcome = run_procedure(short_scene(), test::plugins(), request);

    EXPECT_TRUE(outcome.error.starts_with(folder + " is no longer there: it was removed, renamed")) << outcome.error;
    EXPECT_EQ(outcome.error.find("complete"), std::string::npos) << outcome.error;
    EXPECT_EQ(test::contents_of(foreign), "mine");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
    EXPECT_EQ(replacer.work, (std::vector<std::string>{"measuring the bone", "writing the session"}));
    std::string error;
    const auto moved = session::read_session(folder + "-moved/session.db", error);
    ASSERT_TRUE(moved) << error;
    EXPECT_EQ(moved->device_from_handle.size(), 600u);
}

TEST(Run, NamesItsWorkAfterTheLastTick) {
    const test::TemporaryFolder own;
    struct Witness final : RunObserver {
        std::vector<std::string> work;
        void on_progress(double fraction, const std::string& what) override {
            if (fraction >= 1.0) work.push_back(what);
        }
        std::optional<RunEnd> end() override { return RunEnd::interrupted; }
    } witness;
    RunRequest request;
    request.out = own / "run";
    request.observers = {&witness};
    EXPECT_EQ(run_procedure(short_scene(), test::plugins(), request).error, "");
    EXPECT_EQ(witness.work, (std::vector<std::string>{"measuring the bone", "writing the session", "writing the report",
                                                      "writing the surfaces"}));
}

TEST(Run, IsRefusedWithTheReason) {
    RunRequest request;
    request.rehearsal = "nobody";
    RunOutcome refusal;
    EXPECT_EQ(Run::create(short_scene(), test::plugins(), request, refusal), nullptr);
    EXPECT_TRUE(refusal.is_bad_input);
    EXPECT_NE(refusal.error.find("there is no rehearsal `nobody`"), std::string::npos);
}

}  // namespace
}  // namespace kerf::run
