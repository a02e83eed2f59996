// SPDX-License-Identifier: Apache-2.0
// Runs with a hand whose aim a scripted mouse moves, on a virtual clock.
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "run/live_run.h"
#include "session/recorder.h"
#include "session/report/read_run.h"
#include "tests/run/device_double.h"
#include "tests/support/operation.h"
#include "tests/support/scripted_mouse.h"
#include "tests/support/short_scene.h"
#include "tests/support/temporary_folder.h"

namespace kerf::run {
namespace {

RunOutcome run_by_mouse(const Scene& scene, const std::string& out, Vec3 off = {}, RunObserver* observer = nullptr) {
    MouseBox box;
    test::ScriptedMouse mouse(scene, box, "", off);
    RunRequest request;
    request.out = out;
    request.observers = {&mouse};
    if (observer != nullptr) request.observers.push_back(observer);
    test::PunctualClock clock;
    return run_on_clock(scene, test::plugins(), request, clock, box);
}

const Scene& awl_scene() {
    static const Scene scene = test::scene_of(KERF_SOURCE_DIR "/procedures/pedicle-awl.yaml");
    return scene;
}

/// Keeps the poses of the tool.
struct Poses final : RunObserver {
    std::vector<Pose> tool;
    void on_tick(const session::TickRow& row) override { tool.push_back(row.world_from_tool); }
};

/// The awl's whole operation by mouse.
struct WholeRun {
    test::TemporaryFolder folder;
    Poses poses;
    RunOutcome outcome = run_by_mouse(awl_scene(), folder / "led", {}, &poses);
};
const WholeRun& whole_run() {
    static const WholeRun run;
    return run;
}

TEST(MouseRun, OpensAPedicleAndReplaysToTheBit) {
    const RunOutcome& led = whole_run().outcome;
    const std::string folder = whole_run().folder / "led";
    ASSERT_EQ(led.error, "");
    EXPECT_EQ(led.summary.verdict, session::Verdict::pass) << test::reasons_of(led);
    EXPECT_EQ(led.summary.hand, "mouse");
    std::string error;
    const auto recorded = session::read_run(folder + "/session.db", error);
    ASSERT_TRUE(recorded) << error;
    EXPECT_EQ(recorded->summary.hand, "mouse");
    EXPECT_EQ(recorded->summary.leader, "mouse");
    EXPECT_EQ(replayed(awl_scene(), inputs_in(folder)).summary.hash, led.summary.hash);
}

bool are_same(const Pose& a, const Pose& b) {
    return a.position == b.position && a.rotation.w == b.rotation.w && a.rotation.x == b.rotation.x &&
           a.rotation.y == b.rotation.y && a.rotation.z == b.rotation.z;
}

/// Returns the first part of a recorded run.
std::shared_ptr<const RunBeginning> beginning_of(const std::string& folder, double part) {
    const session::RecordedInputs inputs = inputs_in(folder);
    auto beginning = std::make_shared<RunBeginning>();
    EXPECT_EQ(app::repeat(inputs, "session.db", beginning->run), "");
    beginning->parent = inputs.uuid;
    beginning->ticks = static_cast<std::uint64_t>(part * static_cast<double>(inputs.device_from_handle.size()));
    return beginning;
}

// The awl goes through bone at 0.6 of the operation.
TEST(MouseRun, ContinuesARecordedRunFromTheSameBits) {
    const test::TemporaryFolder folder;
    const std::vector<Pose>& of_parent = whole_run().poses.tool;
    Poses of_child;
    MouseBox box;
    test::ScriptedMouse mouse(awl_scene(), box);
    RunRequest request;
    request.out = folder / "child";
    request.observers = {&mouse, &of_child};
    request.beginning = beginning_of(whole_run().folder / "led", 0.6);
    const std::size_t ticks = request.beginning->ticks;
    test::PunctualClock clock;
    const RunOutcome child = run_on_clock(awl_scene(), test::plugins(), request, clock, box);
    ASSERT_EQ(child.error, "");
    EXPECT_EQ(child.summary.verdict, session::Verdict::pass) << test::reasons_of(child);
    ASSERT_GT(of_child.tool.size(), ticks);
    for (std::size_t i = 0; i < ticks; ++i) ASSERT_TRUE(are_same(of_child.tool[i], of_parent[i])) << i;
    EXPECT_LT(length(of_child.tool[ticks].position - of_child.tool[ticks - 1].position), 20e-6) << "no jump";

    EXPECT_EQ(child.summary.parent, request.beginning->parent);
    EXPECT_EQ(child.summary.parent_ticks, ticks);
    std::string error;
    const auto recorded = session::read_run(folder / "child/session.db", error);
    ASSERT_TRUE(recorded) << error;
    EXPECT_EQ(recorded->summary.parent, request.beginning->parent);
    EXPECT_EQ(recorded->summary.parent_ticks, ticks);
    EXPECT_EQ(replayed(awl_scene(), inputs_in(folder / "child")).summary.hash, child.summary.hash);
}

TEST(MouseRun, RestsAtTheEndOfARecordedRunWithAStillMouse) {
    const test::TemporaryFolder folder;
    RunRequest expert;
    expert.out = folder / "parent";
    ASSERT_EQ(run_procedure(test::short_scene(), test::plugins(), expert).error, "");
    Poses of_child;
    MouseBox box;
    RunRequest request;
    request.observers = {&of_child};
    request.beginning = beginning_of(folder / "parent", 0.2);
    test::PunctualClock clock;
    static_cast<void>(run_on_clock(test::short_scene(), test::plugins(), request, clock, box));
    const std::size_t ticks = request.beginning->ticks;
    ASSERT_GT(of_child.tool.size(), ticks + 2000);
    EXPECT_GT(length(of_child.tool[ticks - 1].position - of_child.tool[0].position), 1e-3) << "the parent moves";
    EXPECT_LT(length(of_child.tool[ticks + 2000].position - of_child.tool[ticks - 1].position), 0.2e-3);
}

/// Ends a run when the limit of a zone breaks, and keeps the zone.
struct FirstZone final : RunObserver {
    std::string detail;
    void on_event(const session::EventRow& event) override {
        if (event.id == "zone_entered") detail = event.detail;
    }
    std::optional<RunEnd> end() override { return detail.empty() ? std::nullopt : std::optional(RunEnd::interrupted); }
};

TEST(MouseRun, FailsBesideThePlan) {
    FirstZone zone;
    const RunOutcome led = run_by_mouse(awl_scene(), "", 5e-3 * awl_scene().frames.front().medial, &zone);
    EXPECT_EQ(led.summary.verdict, session::Verdict::fail);
    EXPECT_EQ(zone.detail, "canal");
    EXPECT_NE(test::reasons_of(led).find("The awl missed the middle of the pedicle."), std::string::npos)
        << test::reasons_of(led);
}

// ---- a short run ---------------------------------------------------------------------------------------------------

/// Watches the poses of hand and tool, the events, and ends the run after a number of ticks.
struct Watcher final : RunObserver {
    explicit Watcher(std::uint64_t ticks) : last_tick(ticks - 1) {}
    std::uint64_t last_tick;
    std::vector<Vec3> hand, tool;
    std::vector<std::pair<std::uint64_t, std::string>> inputs;
    std::optional<RunEnd> ended;

    void on_event(const session::EventRow& event) override {
        if (event.id == session::hand_input_event) inputs.emplace_back(event.tick, event.detail);
    }
    void on_tick(const session::TickRow& row) override {
        hand.push_back(row.device_from_handle.position);
        tool.push_back(row.world_from_tool.position);
        if (row.tick == last_tick) ended = RunEnd::interrupted;
    }
    std::optional<RunEnd> end() override { return ended; }
};

/// A clock with a mouse: before a period, it puts the totals of the test.
class ScriptedClock final : public TickClock {
public:
    ScriptedClock(MouseBox& box, std::vector<std::pair<std::uint64_t, MouseTotals>> totals)
        : box_(&box), totals_(std::move(totals)) {}
    [[nodiscard]] std::uint32_t wait() noexcept override {
        for (const auto& [period, totals] : totals_)
            if (period == periods_) box_->put(totals);
        return periods_++ % 100 == 50 && late ? 1 : 0;
    }
    bool late = false;

private:
    MouseBox* box_;
    std::vector<std::pair<std::uint64_t, MouseTotals>> totals_;
    std::uint64_t periods_ = 0;
};

RunOutcome run_short(Watcher& watcher, std::vector<std::pair<std::uint64_t, MouseTotals>> totals,
                     const std::string& out = "", bool is_late = false) {
    MouseBox box;
    ScriptedClock clock(box, std::move(totals));
    clock.late = is_late;
    RunRequest request;
    request.observers = {&watcher};
    request.out = out;
    return run_on_clock(test::short_scene(), test::plugins(), request, clock, box);
}

TEST(MouseRun, MovesNothingWithAStillMouse) {
    Watcher watcher(2000);
    static_cast<void>(run_short(watcher, {}));
    ASSERT_EQ(watcher.tool.size(), 2000u);
    EXPECT_EQ(length(watcher.hand.back() - watcher.hand.front()), 0.0);
    EXPECT_LT(length(watcher.tool.back() - watcher.tool.front()), 20e-6) << "the motor's torque, as it stops";
    ASSERT_EQ(watcher.inputs.size(), 1u) << "the motor is off";
    EXPECT_EQ(watcher.inputs[0].second, "spindle_speed 0");
}

TEST(MouseRun, RunsTheDriveWhileItsButtonIsHeld) {
    Watcher watcher(400);
    MouseTotals held;
    held.is_driving = true;
    static_cast<void>(run_short(watcher, {{100, held}, {300, MouseTotals{}}}));
    ASSERT_EQ(watcher.inputs.size(), 3u);
    EXPECT_EQ(watcher.inputs[0].first, 0u);
    EXPECT_EQ(watcher.inputs[1].first, 100u);
    EXPECT_NE(watcher.inputs[1].second, "spindle_speed 0");
    EXPECT_EQ(watcher.inputs[2].first, 300u);
    EXPECT_EQ(watcher.inputs[2].second, "spindle_speed 0");
}

TEST(MouseRun, LetsNoTimePassInAPause) {
    MouseTotals moving, paused, after;
    moving.moved = {1e-3, 0, 0};
    paused = moving;
    paused.is_paused = true;
    after = moving;
    after.moved = {9e-3, 0, 0};  // moved while it was paused
    after.undos = 1;
    MouseTotals still_paused = after;
    still_paused.is_paused = true;
    Watcher with(1000), without(1000);
    const test::TemporaryFolder folder;
    const RunOutcome led =
        run_short(with, {{100, moving}, {150, paused}, {700, still_paused}, {5000, after}}, folder / "led", true);
    static_cast<void>(run_short(without, {{100, moving}}));
    ASSERT_EQ(with.hand.size(), 1000u);
    for (std::size_t i = 0; i < 1000; i += 50) EXPECT_EQ(length(with.hand[i] - without.hand[i]), 0.0) << i;
    ASSERT_EQ(with.inputs.size(), 2u) << "the motor, and one pause; the undo was dropped";
    EXPECT_EQ(with.inputs[1], (std::pair<std::uint64_t, std::string>{150, "pause"}));
    EXPECT_EQ(replayed(test::short_scene(), inputs_in(folder / "led")).summary.hash, led.summary.hash);
}

}  // namespace
}  // namespace kerf::run
