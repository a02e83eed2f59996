// SPDX-License-Identifier: Apache-2.0
// A screw that a hand turns into a bored block: limits of torque, felt ends, and regripping.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "run/run.h"
#include "session/read_session.h"
#include "session/recorder.h"
#include "session/report/drawn_run.h"
#include "tests/run/seat_a_screw.h"
#include "tests/support/drill_rig.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/watched_run.h"

namespace kerf::run {
namespace {

using namespace literals;

std::optional<Scene> seat_with(const std::string& turn, const std::string& device = "touch-driver") {
    const test::TemporaryFolder folder;
    text::Diagnostics diagnostics;
    auto scene = make_scene(write_seat_a_screw(folder.path(), turn, device), "", test::plugins()).take(diagnostics);
    if (!scene) ADD_FAILURE() << to_text(diagnostics);
    return scene;
}

test::WatchedRun run_of(const Scene& scene, RunRequest request = {}) {
    return test::watched_run(scene, test::plugins(), std::move(request));
}

double max_torque(const std::vector<session::TickRow>& ticks) {
    double most = 0.0;
    for (const session::TickRow& row : ticks) most = std::max(most, row.torque);
    return most;
}

std::vector<std::uint64_t> ticks_of(const test::WatchedRun& run, const std::string& id, const std::string& detail) {
    std::vector<std::uint64_t> ticks;
    for (const session::EventRow& event : run.events)
        if (event.id == id && (detail.empty() || event.detail == detail)) ticks.push_back(event.tick);
    return ticks;
}

constexpr double wrist = 10.0;  // [N·m/rad]

// ---- what the device is sent -------------------------------------------------------------------------------------

TEST(Turning, SendsTheBonesTorqueTimesTheForceScale) {
    const auto scene = seat_with("by: 5 turns, speed: 60 rpm");
    ASSERT_TRUE(scene);
    const test::WatchedRun run = run_of(*scene);
    const session::TickRow& last = run.ticks.back();
    EXPECT_GT(last.torque, 0.4);
    EXPECT_NEAR(session::sent_torque(last), -0.1 * last.torque, 1e-6);
    const Vec3 shaft = rotate(last.device_from_handle.rotation, {0, 0, 1}), sent = angular(last.commanded);
    EXPECT_LT(length(sent - dot(sent, shaft) * shaft), 1e-12) << "none across";
}

TEST(Turning, FeelsTheSameOnADeviceWithoutAMotor) {
    const auto with = seat_with("by: 7 turns, speed: 60 rpm, until: {torque: 0.5 N*m}"),
               without = seat_with("by: 7 turns, speed: 60 rpm, until: {torque: 0.5 N*m}", "touch");
    ASSERT_TRUE(with && without);
    const test::WatchedRun a = run_of(*with), b = run_of(*without);
    EXPECT_NEAR(turned_by(a.ticks, &session::TickRow::world_from_tool),
                turned_by(b.ticks, &session::TickRow::world_from_tool), 0.02)
        << "counts of 0.09 degrees";
}

// ---- how a turn ends ---------------------------------------------------------------------------------------------

TEST(Turning, StallsAtTheHandsTorque) {
    const auto free = seat_with("by: 7 turns, speed: 60 rpm"),
               weak = seat_with("by: 7 turns, speed: 60 rpm, torque: 0.5 N*m");
    ASSERT_TRUE(free && weak);
    const test::WatchedRun strong = run_of(*free), stalled = run_of(*weak);
    EXPECT_GT(max_torque(strong.ticks), 1.0);
    // In one reaction the wrist turns by 0.15 of a turn, in which this bone asks for 0.04 N·m more; its flutes add some
    EXPECT_LT(max_torque(stalled.ticks), 0.75);
    EXPECT_LT(turned_by(stalled.ticks, &session::TickRow::device_from_handle), 6.5 * 2.0 * pi);
    EXPECT_EQ(stalled.ticks.size(), 60000u) << "until the time is over";
}

TEST(Turning, EndsAtItsTorqueAndThenReleases) {
    const auto scene = seat_with("by: 7 turns, speed: 60 rpm, until: {torque: 0.5 N*m}");
    ASSERT_TRUE(scene);
    const test::WatchedRun run = run_of(*scene);
    const auto released = ticks_of(run, session::hand_input_event, "release");
    ASSERT_EQ(released.size(), 1u);
    const std::size_t reached =
        static_cast<std::size_t>(std::find_if(run.ticks.begin(), run.ticks.end(),
                                              [](const session::TickRow& row) { return row.torque >= 0.5; }) -
                                 run.ticks.begin());
    EXPECT_NEAR(static_cast<double>(released.front()), static_cast<double>(reached) + 151.0, 1.0) << "one reaction";
}

TEST(Turning, EndsWhenItFeelsTheHeadSeat) {
    const auto scene = seat_with("by: 12 turns, speed: 60 rpm, until: {event: implant.head_contact}");
    ASSERT_TRUE(scene);
    const test::WatchedRun run = run_of(*scene);
    const auto seated = ticks_of(run, "implant.head_contact", ""),
               released = ticks_of(run, session::hand_input_event, "release");
    ASSERT_EQ(seated.size(), 1u);
    ASSERT_EQ(released.size(), 1u);
    EXPECT_NEAR(static_cast<double>(released.front()), static_cast<double>(seated.front()) + 151.0, 1.0);
    EXPECT_LT(turned_by(run.ticks, &session::TickRow::device_from_handle), 8.0 * 2.0 * pi) << "`by` is the most";
}

// ---- regripping --------------------------------------------------------------------------------------------------

TEST(Turning, RegrippingEndsAtTheSameAngle) {
    const auto whole = seat_with("by: 7 turns, speed: 60 rpm"),
               gripped = seat_with("by: 7 turns, speed: 60 rpm, regrip: 180 deg");
    ASSERT_TRUE(whole && gripped);
    const test::WatchedRun a = run_of(*whole), b = run_of(*gripped);
    const double driver = turned_by(a.ticks, &session::TickRow::world_from_tool);
    EXPECT_NEAR(turned_by(b.ticks, &session::TickRow::world_from_tool), driver, max_torque(a.ticks) / wrist);
    EXPECT_NEAR(driver, 7.0 * 2.0 * pi - a.ticks.back().torque / wrist, 5e-3);
    const auto releases = ticks_of(b, session::hand_input_event, "regrip:1"),
               hold = ticks_of(b, session::hand_input_event, "regrip:0");
    EXPECT_GE(releases.size(), 13u);
    ASSERT_EQ(releases.size(), hold.size());
    for (const session::EventRow& event : b.events)
        EXPECT_FALSE(event.id == "hand.refused" && event.detail.starts_with("regrip"));
    for (std::size_t i = 0; i < releases.size(); ++i)
        for (std::uint64_t tick = releases[i]; tick < hold[i]; ++tick) {
            ASSERT_LT(std::abs(session::sent_torque(b.ticks[tick])), 1e-4) << tick << ": the hand makes no torque";
            ASSERT_NEAR(turned_by({b.ticks[releases[i]], b.ticks[tick]}, &session::TickRow::world_from_tool), 0.0, 1e-3)
                << tick;
        }
}

TEST(Turning, RegripsReplayToTheBit) {
    const auto scene = seat_with("by: 3 turns, speed: 60 rpm, regrip: 180 deg");
    ASSERT_TRUE(scene);
    const test::TemporaryFolder folder;
    RunRequest request;
    request.out = folder / "run";
    const test::WatchedRun first = run_of(*scene, request);
    ASSERT_EQ(first.error, "");
    std::string error;
    auto inputs = session::read_session(request.out + "/session.db", error);
    ASSERT_TRUE(inputs) << error;
    EXPECT_GE(inputs->hand_inputs.size(), 10u);
    RunRequest again;
    again.replay = inputs->device_from_handle;
    for (const auto& [tick, text] : inputs->hand_inputs)
        again.hand_inputs.emplace_back(tick, *documents::hand_input(text));
    EXPECT_EQ(run_of(*scene, again).summary.hash, first.summary.hash);
    again.hand_inputs.clear();
    EXPECT_NE(run_of(*scene, again).summary.hash, first.summary.hash) << "without them it turns back and forth";
}

// A live device turns on with a clutch: the screw stays where it is while the handle turns back.
TEST(Turning, ALiveDeviceHasAClutch) {
    const auto scene = seat_with("by: 2 turns, speed: 60 rpm");
    ASSERT_TRUE(scene);
    const test::WatchedRun led = run_of(*scene);
    RunOutcome refusal;
    const auto run = Run::create(*scene, test::plugins(), {}, refusal);
    ASSERT_NE(run, nullptr) << refusal.error;
    for (const session::TickRow& row : led.ticks) (void)run->step({row.device_from_handle});
    const Pose before = run->simulation().world_from_tool();
    run->request({documents::HandInput::Kind::regrip, {}, 1.0});
    Pose handle = led.ticks.back().device_from_handle;
    for (int i = 0; i < 1000; ++i) {
        handle.rotation = normalized(handle.rotation * quat_from_rotation_vector({0, 0, -1e-3}));
        (void)run->step({handle});
    }
    const auto turned_since = [&](const Pose& from) {
        return small_rotation_vector(conjugate(from.rotation) * run->simulation().world_from_tool().rotation).z;
    };
    EXPECT_NEAR(turned_since(before), 0.0, 5e-3);
    run->request({documents::HandInput::Kind::regrip, {}, 0.0});
    for (int i = 0; i < 500; ++i) {
        handle.rotation = normalized(handle.rotation * quat_from_rotation_vector({0, 0, 1e-3}));
        (void)run->step({handle});
    }
    EXPECT_NEAR(turned_since(before), 0.5, 0.03) << "less what the wrist gives way by";
}

}  // namespace
}  // namespace kerf::run
