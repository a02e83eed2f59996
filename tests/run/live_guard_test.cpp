// SPDX-License-Identifier: Apache-2.0
// Whole operations on a clock: whatever the run does meanwhile, the thread of the ticks neither allocates nor locks.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "app/replay.h"
#include "run/clock/tick_clock.h"
#include "run/live_run.h"
#include "session/read_session.h"
#include "tests/support/loop_guard.h"
#include "tests/support/operation.h"
#include "tests/support/scripted_mouse.h"
#include "tests/support/short_scene.h"
#include "tests/support/temporary_folder.h"

namespace kerf::run {
namespace {

/// Ticks faster than time passes, and counts what is forbidden from the end of `wait` to `tick_done`.
class GuardedClock final : public TickClock {
public:
    [[nodiscard]] std::uint32_t wait() noexcept override {
        std::this_thread::sleep_for(std::chrono::microseconds(20));
        before_ = test::forbidden_here();
        return 0;
    }
    void tick_done() noexcept override {
        const test::Forbidden after = test::forbidden_here();
        if (!(after == before_) && ticks_with_.size() < 200)
            ticks_with_ += " " + std::to_string(ticks_) + " (" +
                           std::to_string(after.allocations - before_.allocations) + " allocations, " +
                           std::to_string(after.locks - before_.locks) + " locks)";
        ++ticks_;
    }
    [[nodiscard]] std::uint64_t ticks() const noexcept { return ticks_; }
    [[nodiscard]] const std::string& ticks_with_forbidden() const noexcept { return ticks_with_; }

private:
    test::Forbidden before_;
    std::uint64_t ticks_ = 0;
    std::string ticks_with_;
};

/// Counts the events of each kind.
struct EventCounter final : RunObserver {
    std::map<std::string, int> count;
    void on_event(const session::EventRow& event) override { ++count[event.id]; }
};

/// Carries out an operation on a guarded clock, by the rehearsal or by a scripted mouse, and replays it. Returns its
/// events.
std::map<std::string, int> expect_nothing_forbidden_in(const Scene& scene, bool is_by_mouse = false) {
    const test::TemporaryFolder folder;
    EventCounter events;
    MouseBox box;
    test::ScriptedMouse mouse(scene, box);
    RunRequest request;
    request.out = folder.path() + "/live";
    request.observers = {&events, &mouse};
    GuardedClock clock;
    const RunOutcome live = is_by_mouse ? run_beside_clock(scene, test::plugins(), request, clock, box)
                                        : run_beside_clock(scene, test::plugins(), request, clock);
    EXPECT_EQ(live.error, "");
    EXPECT_GE(clock.ticks(), live.summary.ticks);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    EXPECT_EQ(clock.ticks_with_forbidden(), "");
#endif

    std::string error;
    const auto inputs = session::read_session(request.out + "/session.db", error);
    EXPECT_TRUE(inputs) << error;
    if (!inputs) return events.count;
    RunRequest again;
    EXPECT_EQ(app::repeat(*inputs, "session.db", again), "");
    EXPECT_EQ(run_procedure(scene, test::plugins(), again).summary.hash, live.summary.hash);
    return events.count;
}

std::map<std::string, int> expect_nothing_forbidden_in(const std::string& procedure,
                                                       const std::vector<std::string>& settings) {
    return expect_nothing_forbidden_in(
        test::scene_of(KERF_SOURCE_DIR "/procedures/" + procedure + ".yaml", "", settings));
}

// The drill meets bone. The mouse is moved on the thread of the run.
TEST(LiveGuard, NothingIsForbiddenByMouse) {
    auto events = expect_nothing_forbidden_in(test::short_scene(), true);
    EXPECT_EQ(events["entered_bone"], 1);
}

// The cut bone comes apart, forceps take the part and remove it.
TEST(LiveGuard, NothingIsForbiddenInAnAmputation) {
    auto events = expect_nothing_forbidden_in("amputation", {"accuracy.spacing=1.5 mm"});
    EXPECT_EQ(events["bone.came_apart"], 1);
    EXPECT_EQ(events["tool.taken"], 1);
    EXPECT_EQ(events["goal_reached"], 11) << "of which the last two need the held part";
}

// A plate is placed, and its first hole drilled through a sleeve.
TEST(LiveGuard, NothingIsForbiddenInAPlating) {
    auto events = expect_nothing_forbidden_in("trochanter-fixation", {"accuracy.spacing=1 mm", "time_limit=40 s"});
    EXPECT_GE(events["hand.input"], 1);
    EXPECT_GE(events["tool.taken"], 1);
}

}  // namespace
}  // namespace kerf::run
