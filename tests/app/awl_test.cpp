// SPDX-License-Identifier: Apache-2.0
// The shipped procedure of an awl, run whole.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "tests/support/operation.h"

namespace kerf::app {
namespace {

test::WatchedRun outcome_of(const char* rehearsal) {
    return test::rehearsed(test::scene_of(KERF_SOURCE_DIR "/procedures/pedicle-awl.yaml"), rehearsal);
}

auto told(const test::WatchedRun& run, const std::string& id) {
    return std::count_if(run.events.begin(), run.events.end(),
                         [&](const session::EventRow& event) { return event.id == id; });
}

double max_thrust(const test::WatchedRun& run) {
    double most = 0.0;
    for (const session::TickRow& row : run.ticks)
        if (row.step == 1) most = std::max(most, row.thrust);
    return most;
}

TEST(PedicleAwl, AlongTheAxisItGoesInUnderWhatSpongyBoneBears) {
    const test::WatchedRun run = outcome_of("expert");
    EXPECT_TRUE(run.is_as_expected);
    EXPECT_GE(told(run, "drilling.crushing"), 1);
    EXPECT_EQ(told(run, "drilling.wall_broken"), 0);
    EXPECT_NEAR(max_thrust(run), 113.0, 10.0) << "N: 4 mm, 30 degrees, 0.25 g/cm3";
}

TEST(PedicleAwl, AimedAtTheCanalItIsResistedByThePediclesWallAndBreaksThat) {
    const test::WatchedRun run = outcome_of("aimed-at-the-canal");
    EXPECT_TRUE(run.is_as_expected);
    EXPECT_EQ(told(run, "drilling.wall_broken"), 1);
    EXPECT_GT(max_thrust(run), 220.0);
    EXPECT_LT(max_thrust(run), 380.0) << "N: as much as 1 mm of cortex bears";
}

TEST(PedicleAwl, BesideTheMidlineItMissesThePediclesMiddle) { EXPECT_TRUE(outcome_of("lateral").is_as_expected); }

}  // namespace
}  // namespace kerf::app
