// SPDX-License-Identifier: Apache-2.0
#include "app/window/timeline.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/app/window/made_run.h"

namespace kerf::window {
namespace {

TEST(Timeline, FollowsTheNewestState) {
    MadeRun run;
    Timeline timeline;
    run.pass_to(2.0);
    timeline.take(run, 0.0);
    EXPECT_NEAR(timeline.state().time, 2.0, 1e-9);
    run.pass_to(3.0);
    timeline.take(run, 0.0);
    EXPECT_NEAR(timeline.state().time, 3.0, 1e-9);
}

TEST(Timeline, ShowsAnEarlierTimeWhileTheRunGoesOn) {
    MadeRun run;
    Timeline timeline;
    run.pass_to(8.0);
    timeline.take(run, 0.0);
    timeline.show_at(4.0);
    run.pass_to(9.0);
    timeline.take(run, 1.0);
    EXPECT_NEAR(timeline.state().time, 4.0, 16e-3);
    EXPECT_NEAR(timeline.newest(), 9.0, 1e-9);
    ASSERT_FALSE(timeline.recent().empty());
    EXPECT_NEAR(timeline.recent().back().time, timeline.state().time, 1e-9);
    EXPECT_EQ(timeline.recent().size(), static_cast<std::size_t>(std::lround(1e3 * timeline.state().time)));
    timeline.follow();
    EXPECT_NEAR(timeline.state().time, 9.0, 1e-9);
    EXPECT_NEAR(timeline.recent().front().time, 4.0, 2e-3) << "five seconds";
}

TEST(Timeline, PlaysAtItsSpeedAndStopsAtTheEnd) {
    MadeRun run;
    Timeline timeline;
    run.pass_to(10.0);
    run.state_.is_over = true;
    timeline.take(run, 0.0);
    timeline.show_at(1.0);
    timeline.play(true);
    timeline.change_speed(2.0);
    timeline.take(run, 0.5);
    EXPECT_NEAR(timeline.state().time, 2.0, 17e-3);
    timeline.change_speed(100.0);
    EXPECT_EQ(timeline.speed(), 8.0);
    timeline.take(run, 2.0);
    EXPECT_NEAR(timeline.state().time, 10.0, 17e-3);
    EXPECT_FALSE(timeline.is_playing());
}

TEST(Timeline, WaitsForATimeThatIsStillToCome) {
    MadeRun run;
    Timeline timeline;
    timeline.show_at(5.0);
    run.pass_to(2.0);
    timeline.take(run, 0.1);
    EXPECT_NEAR(timeline.state().time, 2.0, 17e-3);
    run.pass_to(7.0);
    timeline.take(run, 0.1);
    EXPECT_NEAR(timeline.state().time, 5.0, 17e-3);
}

TEST(Timeline, StepsByMoments) {
    MadeRun run;
    Timeline timeline;
    run.pass_to(1.0);
    timeline.take(run, 0.0);
    timeline.show_at(0.5);
    const double from = timeline.state().time;
    timeline.step(2);
    EXPECT_NEAR(timeline.state().time, from + 32e-3, 1e-9);
    timeline.take(run, 0.0);
    EXPECT_NEAR(timeline.state().time, from + 32e-3, 1e-9) << "in the next frame too";
    timeline.step(-1000);
    EXPECT_NEAR(timeline.state().time, 16e-3, 1e-9);
}

TEST(Timeline, KeepsTurnsOfTheRunningStepOnly) {
    MadeRun run;
    Timeline timeline;
    run.pass_to(1.0);
    run.state_.step = 1;
    run.pass_to(2.0);
    timeline.take(run, 0.0);
    ASSERT_FALSE(timeline.turns().empty());
    EXPECT_GT(timeline.turns().front().time, 1.0);
    timeline.show_at(0.8);
    EXPECT_LT(timeline.turns().back().time, 0.81);
}

TEST(RealTimeFactor, IsTheRatioOfBothClocks) {
    RealTimeFactor factor;
    factor.show(0.0, 100.0);
    factor.show(0.9, 101.2);
    EXPECT_NEAR(factor.value(), 0.75, 1e-12);
}

}  // namespace
}  // namespace kerf::window
