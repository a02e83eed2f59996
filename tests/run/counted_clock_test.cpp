// SPDX-License-Identifier: Apache-2.0
// The clock of a device whose own servo thread runs the ticks.
#include "run/clock/counted_clock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <thread>

#include "run/live/followed_run.h"
#include "run/live/live_hands.h"
#include "tests/support/drill_rig.h"
#include "tests/support/short_scene.h"

namespace kerf::run {
namespace {

TEST(CountedClock, CountsWhatWasMissed) {
    CountedClock clock(1e-3);
    EXPECT_EQ(clock.missed_before(5.000), 0u);
    EXPECT_EQ(clock.missed_before(5.001), 0u);
    EXPECT_EQ(clock.missed_before(5.0043), 2u);
    EXPECT_EQ(clock.missed_before(5.0047), 0u) << "late before, and now on time";
    EXPECT_EQ(clock.missed_before(5.1052), 99u);
}

TEST(CountedClock, MissesNothingIfTheClockOnlyJittersOrDrifts) {
    CountedClock clock(1e-3);
    std::uint64_t missed = 0;
    for (int i = 0; i < 100'000; ++i) {
        const double jitter = 0.4e-3 * std::sin(1.7 * i), drift = 1.0003;
        missed += clock.missed_before(drift * 1e-3 * i + jitter);
    }
    EXPECT_EQ(missed, 0u);
}

TEST(CountedClock, MissesNothingIfTheClockStandsStillOrGoesBack) {
    CountedClock clock(1e-3);
    EXPECT_EQ(clock.missed_before(7.0), 0u);
    EXPECT_EQ(clock.missed_before(7.0), 0u);
    EXPECT_EQ(clock.missed_before(3.0), 0u);
    EXPECT_EQ(clock.missed_before(3.001), 0u);
    EXPECT_EQ(clock.missed_before(std::numeric_limits<double>::quiet_NaN()), 0u);
    EXPECT_EQ(clock.missed_before(3.002), 0u);
}

// A servo thread calls the tick; the run follows on this one.
TEST(CountedClock, PacesARunFromAServoCallback) {
    RunOutcome refusal;
    const auto followed = FollowedRun::create(test::short_scene(), test::plugins(), {}, refusal);
    ASSERT_NE(followed, nullptr) << refusal.error;
    LiveRehearsal hand(followed->run().plan());
    followed->begin(hand, false);
    std::thread servo([&] {
        CountedClock clock(1e-3);
        double time = 0.0;
        for (int i = 0; followed->tick(clock.missed_before(time)); ++i) time += i == 3000 ? 3e-3 : 1e-3;
    });
    while (!followed->has_ended()) followed->follow();
    servo.join();
    const RunOutcome outcome = followed->finish();
    EXPECT_EQ(outcome.error, "");
    EXPECT_GE(outcome.summary.ticks, 14'000u);
}

}  // namespace
}  // namespace kerf::run
