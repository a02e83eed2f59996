// SPDX-License-Identifier: Apache-2.0
// Runs on a clock: on a virtual one the bits are those of lock-step, and missed periods are replayed.
#include "run/live_run.h"

#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <optional>
#include <thread>
#include <utility>

#include "app/replay.h"
#include "run/clock/wall_clock.h"
#include "session/read_session.h"
#include "tests/support/operation.h"
#include "tests/support/short_scene.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/watched_run.h"

namespace kerf::run {
namespace {

using test::short_scene;

/// Misses the periods of a test, before the ticks that it names.
class VirtualClock final : public TickClock {
public:
    explicit VirtualClock(std::map<std::uint64_t, std::uint32_t> missed) : missed_(std::move(missed)) {}
    [[nodiscard]] std::uint32_t wait() noexcept override {
        const auto found = missed_.find(ticks_++);
        return found == missed_.end() ? 0 : found->second;
    }

private:
    std::map<std::uint64_t, std::uint32_t> missed_;
    std::uint64_t ticks_ = 0;
};

RunOutcome on_clock(const RunRequest& request, std::map<std::uint64_t, std::uint32_t> missed) {
    VirtualClock clock(std::move(missed));
    return run_on_clock(short_scene(), test::plugins(), request, clock);
}

TEST(LiveRun, HasTheBitsOfLockStepWithoutLateTicks) {
    const test::WatchedRun lock_step = test::watched_run(short_scene(), test::plugins(), {});
    const RunOutcome live = on_clock({}, {});
    EXPECT_EQ(live.summary.hash, lock_step.summary.hash);
    EXPECT_EQ(live.summary.ticks, lock_step.summary.ticks);
    EXPECT_FALSE(live.summary.clock) << "the figures are those of a wall clock";
}

// A separation, forceps that take the part and remove it, two tools.
TEST(LiveRun, HasTheBitsOfLockStepWhereBodiesChange) {
    const Scene scene = test::scene_of(KERF_SOURCE_DIR "/procedures/amputation.yaml", "", {"accuracy.spacing=1.5 mm"});
    VirtualClock clock({});
    const RunOutcome live = run_on_clock(scene, test::plugins(), {}, clock);
    ASSERT_EQ(live.summary.pieces.size(), 2u);
    EXPECT_EQ(live.summary.hash, run_procedure(scene, test::plugins(), {}).summary.hash);
}

TEST(LiveRun, ReplaysMissedPeriodsToTheBit) {
    const std::map<std::uint64_t, std::uint32_t> missed{{1000, 1}, {4000, 2}, {6000, 5}, {9000, 100}};
    const test::TemporaryFolder folder;
    RunRequest request;
    request.out = folder.path() + "/live";
    const RunOutcome live = on_clock(request, missed);
    ASSERT_EQ(live.error, "");
    EXPECT_NE(live.summary.hash, on_clock({}, {}).summary.hash);

    std::string error;
    const auto inputs = session::read_session(request.out + "/session.db", error);
    ASSERT_TRUE(inputs) << error;
    ASSERT_EQ(inputs->missed.size(), missed.size());
    RunRequest again;
    ASSERT_EQ(app::repeat(*inputs, "session.db", again), "");
    EXPECT_EQ(run_procedure(short_scene(), test::plugins(), again).summary.hash, live.summary.hash);
}

/// Returns the distance of the hand from its start after a number of ticks [m].
double travel_after(std::uint64_t ticks, std::map<std::uint64_t, std::uint32_t> missed) {
    struct Watcher final : RunObserver {
        std::uint64_t last_tick = 0;
        Vec3 first{}, last{};
        std::optional<RunEnd> ended;
        void on_tick(const session::TickRow& row) override {
            if (row.tick == 0) first = row.device_from_handle.position;
            last = row.device_from_handle.position;
            if (row.tick == last_tick) ended = RunEnd::interrupted;
        }
        std::optional<RunEnd> end() override { return ended; }
    } watcher;
    watcher.last_tick = ticks - 1;
    RunRequest request;
    request.observers = {&watcher};
    static_cast<void>(on_clock(request, std::move(missed)));
    return length(watcher.last - watcher.first);
}

// In air the hand is as far after 2901 ticks and 50 missed periods as after 2951 ticks. From then on it aims with the
// tool, which did not move in the pause.
TEST(LiveRun, LetsTheHandMoveDuringAPause) {
    const double without = travel_after(2951, {});
    ASSERT_GT(without, 1e-3);
    ASSERT_GT(without, 1.01 * travel_after(2901, {}));
    EXPECT_NEAR(travel_after(2901, {{2900, 50}}), without, 0.005 * without);
}

// A pause takes the stretch out of the coupling: the tool then lies behind the handle, at an angle to it. A hand that
// aimed with the handle would push less after each pause, in another direction.
TEST(LiveRun, ReachesItsGoalsAfterManyPauses) {
    text::Diagnostics diagnostics;
    const auto scene = [&] {
        DocumentRequest request{.procedure = KERF_SOURCE_DIR "/procedures/pedicle-awl.yaml"};
        // In the law an awl's thin end crushes no bone sideways (docs/limits.md).
        request.changes.settings = {"steps.probe.allow=[drilling.bit_overbent]"};
        auto documents = check_documents(request, test::plugins()).take(diagnostics);
        return documents ? make_scene(std::move(*documents)).take(diagnostics) : std::nullopt;
    }();
    ASSERT_TRUE(scene) << text::to_text(diagnostics);
    std::map<std::uint64_t, std::uint32_t> pauses;
    for (std::uint64_t tick = 1000; tick < 66'000; tick += 6000) pauses[tick] = 5;
    VirtualClock clock(pauses);
    const RunOutcome live = run_on_clock(*scene, test::plugins(), {}, clock);
    EXPECT_EQ(live.summary.verdict, session::Verdict::pass)
        << (live.summary.reasons.empty() ? "" : live.summary.reasons.front());
}

TEST(WallClock, CountsEachPeriodOnce) {
    WallClock clock(1e-3);
    const auto start = std::chrono::steady_clock::now();
    for (int tick = 0; tick < 100; ++tick) {
        static_cast<void>(clock.wait());
        clock.tick_done();
    }
    const double periods = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() * 1e3;
    const TickTimes& times = clock.times();
    EXPECT_EQ(times.ticks, 100u);
    EXPECT_EQ(times.lateness.calls(), 100u);
    EXPECT_EQ(times.compute.calls(), 100u);
    // The last tick began after its due time, which is the sum of all periods.
    EXPECT_GE(periods, static_cast<double>(times.ticks + times.missed));
}

TEST(WallClock, SkipsThePeriodsOfAStall) {
    WallClock clock(1e-3);
    EXPECT_EQ(clock.times().pauses, 0u);
    static_cast<void>(clock.wait());
    std::this_thread::sleep_for(std::chrono::milliseconds(25));
    EXPECT_GE(clock.wait(), 23u) << "25 ms passed since a tick";
    EXPECT_GE(clock.times().pauses, 1u);
    EXPECT_GE(clock.times().late, 1u);
}

}  // namespace
}  // namespace kerf::run
