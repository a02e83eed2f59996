// SPDX-License-Identifier: Apache-2.0
// The shipped procedure of an awl, run whole.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "tests/support/operation.h"

namespace kerf::app {
namespace {

constexpr const char* procedure = KERF_SOURCE_DIR "/procedures/pedicle-awl.yaml";

auto reported(const test::WatchedRun& run, const std::string& id) {
    return std::count_if(run.events.begin(), run.events.end(),
                         [&](const session::EventRow& event) { return event.id == id; });
}

double max_thrust(const test::WatchedRun& run) {
    double max = 0.0;
    for (const session::TickRow& row : run.ticks)
        if (row.step == 1) max = std::max(max, row.thrust);
    return max;
}

TEST(PedicleAwl, EndsAsExpectedAlongTheAxisIntoTheCanalAndBesideThePedicle) {
    const run::Scene scene = test::scene_of(procedure);
    const test::WatchedRun expert = test::rehearsed(scene, "expert");
    EXPECT_TRUE(expert.is_as_expected);
    EXPECT_GE(reported(expert, "drilling.crushing"), 1);
    EXPECT_EQ(reported(expert, "drilling.wall_broken"), 0);
    EXPECT_TRUE(test::rehearsed(scene, "aimed-at-the-canal").is_as_expected);
    EXPECT_TRUE(test::rehearsed(scene, "lateral").is_as_expected);
}

TEST(PedicleAwl, InThePhantomItTakesTheForceOfItsDensityAndTheWallThatOfCortex) {
    const run::Scene phantom = test::scene_of(
        procedure, "",
        {"rehearsals.aimed-at-the-canal.path=[{follow: open}, {step: probe, depth: -5 mm, medial_angle: 30 deg}, "
         "{depth: 26 mm, medial_angle: 30 deg}, {depth: -5 mm, medial_angle: 30 deg}]"},
        KERF_SOURCE_DIR "/procedures/anatomy/vertebra-l4-phantom.yaml");
    const test::WatchedRun along = test::rehearsed(phantom, "expert");
    EXPECT_TRUE(along.is_as_expected);
    EXPECT_NEAR(max_thrust(along), 113.0, 10.0) << "N: 4 mm, 30 degrees, 0.25 g/cm3";
    const test::WatchedRun aimed = test::rehearsed(phantom, "aimed-at-the-canal");
    EXPECT_TRUE(aimed.is_as_expected);
    EXPECT_EQ(reported(aimed, "drilling.wall_broken"), 1);
    EXPECT_GT(max_thrust(aimed), 220.0);
    EXPECT_LT(max_thrust(aimed), 380.0) << "N: as much as 1 mm of cortex bears";
}

}  // namespace
}  // namespace kerf::app
