// SPDX-License-Identifier: Apache-2.0
// The fixation of a broken femoral neck, run whole.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "kerf/units.hpp"
#include "tests/support/operation.h"

namespace kerf::app {
namespace {

using namespace literals;
using test::metric, test::reasons_of, test::rehearsed, test::WatchedRun;

const char* const procedure_file = KERF_SOURCE_DIR "/procedures/trochanter-fixation.yaml";

run::Scene femur(const std::vector<std::string>& settings = {}, const std::string& variant = "",
                 const std::string& anatomy = "") {
    return test::scene_of(procedure_file, variant, settings, anatomy);
}

class Trochanter : public testing::TestWithParam<const char*> {};

// Tip-apex distance below 25 mm; 5 mm are what experts plunge in normal bone, 8 mm what novices do.
TEST_P(Trochanter, IsFixedByTheExpertOn) {
    const run::Scene scene = femur({std::string("haptics.device=") + GetParam()});
    const WatchedRun run = rehearsed(scene, "expert");
    EXPECT_TRUE(run.is_as_expected) << reasons_of(run);
    const session::RunSummary& s = run.summary;
    EXPECT_LT(metric(s, "reduce.reduction-offset"), 0.5_mm);
    EXPECT_LT(metric(s, "reduce.reduction-angle"), 0.5_deg);
    EXPECT_NEAR(metric(s, "lag.axes-angle.neck"), 125.0_deg, 0.5_deg);
    EXPECT_LT(metric(s, "lag.tip-apex"), 25.0_mm);
    EXPECT_GT(metric(s, "lag.tip-apex"), 10.0_mm);
    for (const char* hole : {"hole-1", "hole-2", "hole-3"})
        EXPECT_LT(metric(s, std::string(hole) + ".plunge"), 8.0_mm) << hole;
    for (const char* screw : {"screw-1", "screw-2", "screw-3"})
        EXPECT_LT(metric(s, std::string(screw) + ".hole-offset"), 1.0_mm) << screw;
    // Two parts of bone, the plate, and four screws.
    EXPECT_EQ(s.pieces.size(), 7u);
    EXPECT_NEAR(metric(s, "bone.balance"), 0.0, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Device, Trochanter, testing::Values("touch", "desktop", "premium-1.5-6dof", "omega.6"),
                         [](const auto& device) {
                             std::string name = device.param;
                             std::replace_if(
                                 name.begin(), name.end(), [](char c) { return c == '-' || c == '.'; }, '_');
                             return name;
                         });

TEST(TrochanterBlunder, FailsForTheReasonThatItNames) {
    const run::Scene scene = femur();
    for (const char* rehearsal : {"malreduction", "plunge"}) {
        const WatchedRun run = rehearsed(scene, rehearsal);
        EXPECT_TRUE(run.is_as_expected) << rehearsal << "\n" << reasons_of(run);
    }
}

TEST(TrochanterVariant, OfOneScrewPasses) {
    const run::Scene scene = femur({}, "screw-alone");
    const WatchedRun run = rehearsed(scene, "expert");
    EXPECT_TRUE(run.is_as_expected) << reasons_of(run);
}

// Its neck is 10 mm shorter than the phantom's: so are the hole and the screw.
TEST(TrochanterOfARealFemur, IsFixedWithOneScrew) {
    if (std::getenv("KERF_DATA") == nullptr) GTEST_SKIP() << "KERF_DATA names no folder of scans";
    const run::Scene scene = femur(
        {"instruments.lag-screw.parameters.shaft_length=54 mm",
         "steps.lag-hole.goals=[{entry: {}}, {depth: {at_least: 70 mm}}]",
         "steps.lag.goals=[{entry: {}}, {depth: {at_least: 67 mm}}]",
         "paths.screw-in-the-neck=[{step: lag-hole, depth: -60 mm}, {depth: -2 mm}, {depth: 71 mm}, {depth: -5 mm}, "
         "{step: lag, depth: -30 mm}, {depth: -1 mm}, "
         "{depth: 71 mm, turn: {by: 26.6 turns, speed: 60 rpm}, do: release}]"},
        "screw-alone", KERF_SOURCE_DIR "/tests/real-data/femur-z013-fractured.yaml");
    const WatchedRun run = rehearsed(scene, "expert");
    EXPECT_TRUE(run.is_as_expected) << reasons_of(run);
    EXPECT_LT(metric(run.summary, "reduce.reduction-offset"), 0.5_mm);
    EXPECT_NEAR(metric(run.summary, "lag.axes-angle.neck"), 123.75_deg, 2.0_deg) << "from the raters' landmarks";
}

// At the drill, 60 mm from the bone, the plate is refused.
TEST(TrochanterPlate, IsMissedWhereAStepFollowsItsHole) {
    const auto scene =
        femur({"rehearsals.expert.path=[{follow: reduction}, {step: lag-hole, depth: -60 mm, insert: plate}, "
               "{depth: -2 mm}, {depth: 5 mm}, {depth: -5 mm}]"});
    const WatchedRun run = rehearsed(scene, "expert");
    EXPECT_EQ(run.summary.verdict, session::Verdict::incomplete);
    EXPECT_NE(reasons_of(run).find("Step `lag-hole`: `plate`, whose hole it follows, was not in the scene."),
              std::string::npos)
        << reasons_of(run);
}

TEST(TrochanterFracture, CannotBeUndone) {
    const run::Scene scene =
        femur({"rehearsals.expert.expect=incomplete",
               "rehearsals.expert.path=[{depth: -60 mm}, {depth: -50 mm, do: undo}, {depth: -60 mm}]"});
    const test::WatchedRun run = [&] {
        run::RunRequest request;
        request.rehearsal = "expert";
        return test::watched_run(scene, test::plugins(), request);
    }();
    EXPECT_EQ(run.summary.pieces.size(), 2u);
    EXPECT_TRUE(std::any_of(run.events.begin(), run.events.end(),
                            [](const session::EventRow& event) { return event.id == "hand.refused"; }));
}

}  // namespace
}  // namespace kerf::app
