// SPDX-License-Identifier: Apache-2.0
// A run as another program has it: tick by tick.
#include "run/run.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/session/read_session.h"
#include "tests/support/drill_rig.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/watched_run.h"

namespace kerf {
namespace {

using namespace literals;

/// The shipped procedure on a coarse grid, over after fifteen seconds: the drill has met bone.
const Scene& short_scene() {
    static const Scene scene = [] {
        Diagnostics diagnostics;
        DocumentRequest request{.procedure = KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml"};
        request.changes.settings = {"accuracy.spacing=0.5 mm", "time_limit=15 s"};
        auto documents = check_documents(request, test::plugins(), diagnostics);
        auto made = documents ? make_scene(std::move(*documents), diagnostics) : std::nullopt;
        if (!made) throw std::runtime_error(to_text(diagnostics));
        return std::move(*made);
    }();
    return scene;
}

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
    EXPECT_EQ(outcome.summary.verdict, Verdict::incomplete) << "the time was over";
    EXPECT_GT(outcome.summary.removed, 0.0);
}

// A device that is led as the simulated hand was meets the same bone with the same force.
TEST(Run, ADeviceThatReportsTheSamePosesFeelsTheSame) {
    const test::WatchedRun whole = test::watched_run(short_scene(), test::plugins(), {});
    const auto run = new_run();
    ASSERT_NE(run, nullptr);
    for (const TickRow& row : whole.ticks) {
        const bool goes_on = run->step({row.device_from_handle});
        ASSERT_EQ(run->last().command.wrench, row.commanded) << row.tick;
        ASSERT_EQ(goes_on, &row != &whole.ticks.back()) << row.tick;
    }
    EXPECT_EQ(run->finish().summary.hash, whole.summary.hash);
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
        for (const TickRow& row : whole.ticks)
            if (!run->step({row.device_from_handle, misses && (row.tick == 4000 || row.tick == 9000) ? 2u : 0u})) break;
        return run->finish().summary;
    };
    RunRequest request;
    request.out = folder.path() + "/missed";
    const RunSummary with = ended(true, request), without = ended(false, {});
    EXPECT_EQ(without.hash, whole.summary.hash);
    EXPECT_NE(with.hash, without.hash);

    std::string error;
    auto inputs = read_session(request.out + "/session.db", error);
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
        void on_tick(const TickRow& row) override { EXPECT_EQ(row.tick, ticks++); }
        void on_progress(double, const std::string&) override { calls.emplace_back("progress"); }
        std::optional<RunEnd> end() override {
            return ticks == 300 ? std::optional(RunEnd::interrupted) : std::nullopt;
        }
        std::string on_result(const RunSummary& summary, const Simulation&) override {
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

TEST(Run, IsRefusedWithTheReason) {
    RunRequest request;
    request.rehearsal = "nobody";
    RunOutcome refusal;
    EXPECT_EQ(Run::create(short_scene(), test::plugins(), request, refusal), nullptr);
    EXPECT_TRUE(refusal.is_bad_input);
    EXPECT_NE(refusal.error.find("there is no rehearsal `nobody`"), std::string::npos);
}

}  // namespace
}  // namespace kerf
