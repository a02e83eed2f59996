// SPDX-License-Identifier: Apache-2.0
// Radiographs of a run: pictures for the viewer, events in the record, and the same again in a replay.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <thread>

#include "run/arm_views.h"
#include "run/live_run.h"
#include "run/run_procedure.h"
#include "run/view/run_view.h"
#include "tests/support/short_scene.h"
#include "tests/support/watched_run.h"

namespace kerf::run {
namespace {

using Radiographs = std::vector<std::shared_ptr<const ViewedRadiograph>>;

/// Requests radiographs after ticks 100 and 300, as a viewer would, and ends the run after 500.
class Radiographer final : public RunObserver {
public:
    explicit Radiographer(RunView& view) : view_(&view) {}
    void on_event(const session::EventRow& event) override { events.push_back(event); }
    void on_tick(const session::TickRow& row) override {
        if (row.tick == 100) view_->request_radiograph(0.0, 0.0);
        if (row.tick == 300) {
            wait_for(1);
            view_->request_radiograph(0.5 * std::numbers::pi, 0.0);
        }
        handles.push_back(row.device_from_handle);
    }
    [[nodiscard]] std::optional<RunEnd> end() override {
        return handles.size() >= 500 ? std::optional(RunEnd::interrupted) : std::nullopt;
    }
    /// Waits for this number of radiographs; for ten seconds, if they do not come.
    void wait_for(std::size_t count) {
        for (int i = 0; i < 2000 && made.size() < count; ++i) {
            view_->take(made);
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
    }
    [[nodiscard]] std::vector<session::EventRow> of(const std::string& id) const {
        std::vector<session::EventRow> some;
        for (const session::EventRow& event : events)
            if (event.id == id) some.push_back(event);
        return some;
    }

    std::vector<session::EventRow> events;
    std::vector<Pose> handles;
    Radiographs made;

private:
    RunView* view_;
};

/// Waits until all radiographs are made; for ten seconds, if they are not.
void wait_until_idle(const RadiographWorker& worker) {
    for (int i = 0; i < 2000 && !worker.is_idle(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

/// Lets each period of the clock begin at once.
class EveryPeriod final : public TickClock {
public:
    [[nodiscard]] std::uint32_t wait() noexcept override { return 0; }
};

/// A run on a virtual clock with two radiographs.
struct Taken {
    RunView view{test::short_scene(), {.mode = "practice"}};
    Radiographer by{view};
    RunOutcome outcome;

    Taken() {
        RunRequest request;
        request.observers = {&by, &view};
        EveryPeriod clock;
        outcome = run_on_clock(test::short_scene(), test::plugins(), request, clock);
        by.wait_for(2);
    }
};
const Taken& taken() {
    static const Taken one;
    return one;
}

/// Repeats the run with the inputs of its record.
RunRequest again(const Radiographer& by) {
    RunRequest request;
    request.replay = by.handles;
    for (const session::EventRow& event : by.of("hand.input"))
        request.hand_inputs.emplace_back(event.tick, documents::hand_input(event.detail).value());
    return request;
}

TEST(RunRadiographs, AreEventsOfTheTickAfterTheRequest) {
    const auto images = taken().by.of("image.taken");
    ASSERT_EQ(images.size(), 2u);
    EXPECT_EQ(images[0].tick, 101u);
    EXPECT_EQ(images[0].detail, "AP 1");
    EXPECT_EQ(images[1].tick, 301u);
    EXPECT_EQ(images[1].detail, "lateral 2");
    EXPECT_EQ(taken().by.of("hand.input")[0].detail, "image:0 0");
    const auto& metrics = taken().outcome.summary.metrics;
    const auto shots = std::ranges::find(metrics, "image.shots", &session::MetricRow::id);
    ASSERT_NE(shots, metrics.end());
    EXPECT_EQ(shots->value, 2.0);
}

TEST(RunRadiographs, ShowBoneInTheCircleOfTheCollimator) {
    ASSERT_EQ(taken().by.made.size(), 2u);
    for (const auto& one : taken().by.made) {
        ASSERT_EQ(one->error, "");
        ASSERT_EQ(one->columns, 512);
        ASSERT_EQ(one->rows, 512);
        EXPECT_EQ(one->grey.front(), 0) << "a corner is outside the circle";
        const auto at = [&](std::size_t row, std::size_t column) { return one->grey[512 * row + column]; };
        double middle = 0.0, side = 0.0;
        for (std::size_t i = 0; i < 40; ++i)
            for (std::size_t j = 0; j < 40; ++j) middle += at(236 + i, 236 + j), side += at(30 + i, 236 + j);
        EXPECT_LT(middle / 1600.0, 0.9 * side / 1600.0) << "bone on the axis is darker than soft tissue";
    }
    EXPECT_EQ(taken().by.made[0]->words, "AP");
    EXPECT_EQ(taken().by.made[0]->shot, 1);
    EXPECT_NEAR(taken().by.made[0]->time, 0.101, 1e-12);
    EXPECT_EQ(taken().by.made[1]->words, "lateral");
    EXPECT_NE(taken().by.made[0]->grey, taken().by.made[1]->grey);
    EXPECT_EQ(taken().view.radiograph(), taken().by.made[1]);
}

TEST(RunRadiographs, AreRepeatedByAReplay) {
    RunView view(test::short_scene(), {.mode = "debrief"}, 0.5);
    Radiographer by(view);
    RunRequest request = again(taken().by);
    request.observers = {&by, &view};
    const RunOutcome replay = run_procedure(test::short_scene(), test::plugins(), request);
    by.wait_for(2);
    EXPECT_EQ(replay.summary.hash, taken().outcome.summary.hash);
    ASSERT_EQ(by.events.size(), taken().by.events.size());
    for (std::size_t i = 0; i < by.events.size(); ++i) {
        EXPECT_EQ(by.events[i].tick, taken().by.events[i].tick);
        EXPECT_EQ(by.events[i].id, taken().by.events[i].id);
        EXPECT_EQ(by.events[i].detail, taken().by.events[i].detail);
    }
    ASSERT_EQ(by.made.size(), 2u) << "the requests of its own viewer are ignored";
    for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(by.made[i]->grey, taken().by.made[i]->grey);
}

TEST(RunRadiographs, ChangeTheHashButNoOtherBit) {
    RunRequest request = again(taken().by);
    request.hand_inputs.clear();
    const test::WatchedRun without = test::watched_run(test::short_scene(), test::plugins(), request);
    EXPECT_NE(without.summary.hash, taken().outcome.summary.hash);
    EXPECT_EQ(without.summary.removed, taken().outcome.summary.removed);
    EXPECT_EQ(without.ticks.size(), taken().by.handles.size());
}

TEST(RunRadiographs, AreRefusedBeyondATurn) {
    RunRequest request = again(taken().by);
    request.replay.resize(3);
    request.hand_inputs = {{1, {documents::HandInput::Kind::image, {}, 7.0, 0.0}}};
    const test::WatchedRun run = test::watched_run(test::short_scene(), test::plugins(), request);
    ASSERT_EQ(std::ranges::count(run.events, "hand.refused", &session::EventRow::id), 1);
    EXPECT_EQ(std::ranges::count(run.events, "image.taken", &session::EventRow::id), 0);
    RunView view(test::short_scene(), {.mode = "practice"});
    view.request_radiograph(std::numeric_limits<double>::quiet_NaN(), 0.0);
    request = {};
    struct EndAtOnce final : RunObserver {
        std::size_t ticks = 0;
        void on_tick(const session::TickRow&) override { ++ticks; }
        [[nodiscard]] std::optional<RunEnd> end() override {
            return ticks > 2 ? std::optional(RunEnd::interrupted) : std::nullopt;
        }
    } end;
    request.observers = {&view, &end};
    const test::WatchedRun ignored = test::watched_run(test::short_scene(), test::plugins(), request);
    EXPECT_EQ(std::ranges::count(ignored.events, "hand.input", &session::EventRow::id), 0);
}

TEST(RunRadiographs, AreMadeOnAnotherThreadInOrder) {
    const ViewedScene scene;
    const Scene& short_scene = test::short_scene();
    const PresentBone bone(short_scene.body, 1);
    std::vector<int> shots;
    std::vector<std::thread::id> threads;
    {
        RadiographWorker worker(scene, [&](const auto& made) {
            shots.push_back(made->shot);
            threads.push_back(std::this_thread::get_id());
        });
        EXPECT_TRUE(worker.is_idle());
        for (int shot = 1; shot <= 7; ++shot)
            worker.make({.bone = picture_of(bone), .target = {0, 0, 0}, .radiograph = {.shot = shot}});
        wait_until_idle(worker);
    }
    EXPECT_EQ(shots, (std::vector<int>{1, 2, 3, 4, 5, 6, 7}));
    for (const std::thread::id thread : threads) {
        EXPECT_NE(thread, std::this_thread::get_id());
        EXPECT_EQ(thread, threads.front());
    }
}

/// Takes radiographs of the short scene's bone at these heights, one after the other. Returns the last one.
ViewedRadiograph last_of(const std::vector<double>& heights) {
    const Scene& scene = test::short_scene();
    const ViewedScene viewed;
    const PresentBone bone(scene.body, 1);
    ViewedRadiograph last;
    {
        RadiographWorker worker(viewed, [&](const auto& made) { last = *made; });
        for (const double height : heights) {
            ViewedState state;
            state.is_tool_in_hand = false;
            state.body_count = 1;
            state.bodies[0] = {ViewedBody::Kind::bone, 0, {{0, 0, height}, {1, 0, 0, 0}}};
            worker.make({.bone = picture_of(bone), .state = state, .target = scene.frames[0].entry});
        }
        wait_until_idle(worker);
    }
    return last;
}

/// Returns the mean difference of two pictures [–] of white.
double difference(const ViewedRadiograph& a, const ViewedRadiograph& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.grey.size(); ++i) sum += std::abs(a.grey[i] - b.grey[i]) / 255.0;
    return sum / static_cast<double>(a.grey.size());
}

TEST(RunRadiographs, ShowBoneThatHasMovedAway) {
    const ViewedRadiograph moved = last_of({0.0, 40e-3}), placed = last_of({40e-3}), not_moved = last_of({0.0});
    ASSERT_EQ(moved.grey.size(), 512u * 512u);
    EXPECT_LT(difference(moved, placed), 0.01);
    EXPECT_GT(difference(moved, not_moved), 0.03);
}

TEST(ArmWords, NameAViewOrItsAngles) {
    EXPECT_EQ(arm_words(0.0, 0.0), "AP");
    EXPECT_EQ(arm_words(0.5 * std::numbers::pi, 0.0), "lateral");
    EXPECT_EQ(arm_words(std::numbers::pi / 6.0, 0.0), "oblique 30 deg");
    EXPECT_EQ(arm_words(std::numbers::pi / 9.0, -std::numbers::pi / 18.0), "20 deg, tilted -10 deg");
}

}  // namespace
}  // namespace kerf::run
