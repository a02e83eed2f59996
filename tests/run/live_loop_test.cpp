// SPDX-License-Identifier: Apache-2.0
// A loop on the clock and the run that follows it: late, refused and contradicted.
#include "run/live/live_loop.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "app/replay.h"
#include "run/live/live_hands.h"
#include "run/run.h"
#include "session/read_session.h"
#include "tests/support/operation.h"
#include "tests/support/short_scene.h"
#include "tests/support/temporary_folder.h"

namespace kerf::run {
namespace {

using test::short_scene;

/// Ticks at which a hand requests an undo, and the tick from which on it draws the tool back.
struct Deviation {
    std::vector<std::uint64_t> undo{};
    std::uint64_t retreat = ~std::uint64_t{0};
};

/// A rehearsal's hand that deviates from it.
class DeviatingHand final : public LiveHand {
public:
    DeviatingHand(const HandPlan& plan, Deviation deviation) : hand_(plan), deviation_(std::move(deviation)) {}
    void act(std::uint32_t missed, const TickResult& last, LoopInputs& inputs) noexcept override {
        hand_.act(missed, last, inputs);
        for (const std::uint64_t tick : deviation_.undo)
            if (tick == ticks_) inputs.undo();
        ++ticks_;
    }
    [[nodiscard]] DeviceSample sample(const HapticLoop& loop) noexcept override {
        if (ticks_ <= deviation_.retreat) last_ = hand_.sample(loop);
        DeviceSample sample = last_;
        if (ticks_ > deviation_.retreat) {
            const double back = 100e-6 * static_cast<double>(ticks_ - deviation_.retreat);  // 100 mm/s
            sample.world_from_handle = sample.world_from_handle * Pose{{0, 0, -back}, {1, 0, 0, 0}};
        }
        return sample;
    }
    void feel(const TickResult& result, const HapticLoop& loop) noexcept override { hand_.feel(result, loop); }
    [[nodiscard]] std::optional<RunEnd> end() const noexcept override { return hand_.end(); }

private:
    LiveRehearsal hand_;
    Deviation deviation_;
    DeviceSample last_;
    std::uint64_t ticks_ = 0;
};

struct Followed {
    RunOutcome outcome;
    std::vector<session::EventRow> events;
    [[nodiscard]] std::vector<session::EventRow> of(const std::string& id) const {
        std::vector<session::EventRow> some;
        for (const session::EventRow& event : events)
            if (event.id == id) some.push_back(event);
        return some;
    }
};

struct EventList final : RunObserver {
    std::vector<session::EventRow> events;
    void on_event(const session::EventRow& event) override { events.push_back(event); }
};

/// Runs the first rehearsal with a run that catches up with its loop only every `lag` ticks.
Followed followed(const Scene& scene, const std::string& out, std::uint64_t lag, Deviation deviation = {},
                  const std::function<void(LoopMessage&)>& change = {}) {
    EventList list;
    RunRequest request;
    request.out = out;
    request.observers = {&list};
    RunOutcome refusal;
    const auto run = Run::create(scene, test::plugins(), request, refusal);
    if (run == nullptr) return {refusal, {}};
    LoopLink link;
    bool has_more = true;
    const auto catch_up = [&] {
        while (const LoopMessage* message = link.messages.front()) {
            LoopMessage taken = *message;
            if (change) change(taken);
            has_more = has_more && run->take(taken);
            link.messages.pop();
        }
        link.should_stop = !has_more;
    };
    std::uint64_t ticks = 0;
    DeviatingHand hand(run->plan(), std::move(deviation));
    LiveLoop loop(run->follow_loop(link), scene, run->plan(), run->rehearsal(), link, hand, [&] {
        if (ticks % lag == 0) catch_up();
    });
    while (loop.step(0)) ++ticks;
    catch_up();
    return {run->finish(), std::move(list.events)};
}

std::string hash_of_replay(const Scene& scene, const std::string& folder) {
    std::string error;
    const auto inputs = session::read_session(folder + "/session.db", error);
    RunRequest again;
    if (!inputs || !app::repeat(*inputs, "session.db", again).empty()) return "not read: " + error;
    return std::to_string(run_procedure(scene, test::plugins(), again).summary.hash);
}

// The bone comes apart, forceps take the part and remove it: all later than in lock-step.
TEST(LiveLoop, ReplaysARunThatFollowsLate) {
    const Scene scene = test::scene_of(KERF_SOURCE_DIR "/procedures/amputation.yaml", "", {"accuracy.spacing=1.5 mm"});
    const test::TemporaryFolder folder;
    const Followed late = followed(scene, folder.path() + "/late", 37);
    EXPECT_EQ(late.of("tool.taken").size(), 1u);
    EXPECT_EQ(late.of("bone.came_apart").size(), 1u);
    EXPECT_GE(late.of("loop.late_change").size(), 4u) << "the steps, the tool, the held points, the removal";
    EXPECT_EQ(hash_of_replay(scene, folder.path() + "/late"), std::to_string(late.outcome.summary.hash));
}

// In bone, and before any cut, an undo is refused. In air it restores the bone, a few ticks late.
TEST(LiveLoop, TakesAnUndoLateOrRefusesIt) {
    const test::TemporaryFolder folder;
    const Deviation deviation{.undo = {2, 13'500, 14'903}, .retreat = 14'000};
    const Followed run = followed(short_scene(), folder.path() + "/undo", 5, deviation);
    EXPECT_EQ(run.of("hand.input").size(), 3u);
    EXPECT_EQ(run.of("hand.refused").size(), 2u);
    EXPECT_EQ(run.of("loop.late_change").size(), 1u);
    EXPECT_EQ(run.outcome.summary.removed, 0.0);
    EXPECT_GT(followed(short_scene(), "", 5, {.retreat = 14'000}).outcome.summary.removed, 1e-11) << "without undo";
    EXPECT_EQ(hash_of_replay(short_scene(), folder.path() + "/undo"), std::to_string(run.outcome.summary.hash));
}

TEST(LiveLoop, EndsWhereTheRunHasOtherBits) {
    const Followed run = followed(short_scene(), "", 1, {}, [](LoopMessage& message) {
        if (message.kind == LoopMessage::Kind::tick && message.sample.missed == 0) message.bits ^= 1u;
    });
    EXPECT_EQ(run.outcome.summary.ticks, 1u);
    EXPECT_EQ(run.outcome.summary.verdict, session::Verdict::invalid);
    ASSERT_FALSE(run.outcome.summary.reasons.empty());
    EXPECT_NE(run.outcome.summary.reasons.front().find("two results"), std::string::npos);
}

}  // namespace
}  // namespace kerf::run
