// SPDX-License-Identifier: Apache-2.0
// The dental implant, run whole in both jaws.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "kerf/units.hpp"
#include "tests/support/operation.h"

namespace kerf::app {
namespace {

using namespace literals;

run::Scene jaw(const std::string& variant, const std::vector<std::string>& settings = {},
               const std::string& anatomy = "") {
    return test::scene_of(KERF_SOURCE_DIR "/procedures/dental-implant.yaml", variant, settings, anatomy);
}

struct Ending {
    const char *variant, *rehearsal, *device;
};

class DentalImplant : public testing::TestWithParam<Ending> {};

TEST_P(DentalImplant, EndsAsExpected) {
    const auto& [variant, rehearsal, device] = GetParam();
    const run::Scene scene = jaw(variant, {std::string("haptics.device=") + device});
    const test::WatchedRun run = test::rehearsed(scene, rehearsal);
    EXPECT_TRUE(run.is_as_expected) << test::reasons_of(run);
}

INSTANTIATE_TEST_SUITE_P(
    With, DentalImplant,
    testing::Values(Ending{"", "expert", "premium-1.5-6dof"}, Ending{"", "expert", "touch"},
                    Ending{"", "expert", "desktop"}, Ending{"", "expert", "omega.6"},
                    Ending{"", "overtightened", "premium-1.5-6dof"}, Ending{"", "too-deep", "touch"},
                    Ending{"upper-jaw", "expert", "premium-1.5-6dof"}, Ending{"upper-jaw", "expert", "touch"},
                    Ending{"upper-jaw", "expert", "desktop"}, Ending{"upper-jaw", "expert", "omega.6"},
                    Ending{"upper-jaw", "stripped", "omega.6"}, Ending{"upper-jaw", "sinus", "desktop"}),
    [](const auto& ending) {
        std::string name = std::string(ending.param.variant) + "_" + ending.param.rehearsal + "_" + ending.param.device;
        std::replace_if(
            name.begin(), name.end(), [](char c) { return c == '-' || c == '.'; }, '_');
        return name;
    });

/// The largest torque about the shaft in the last step, before a time.
double largest_torque(const run::Scene& scene, const test::WatchedRun& run, double before) {
    const auto last = static_cast<std::int32_t>(scene.procedure.steps.size()) - 1;
    double largest = 0.0;
    for (const session::TickRow& row : run.ticks)
        if (row.step == last && row.time < before) largest = std::max(largest, std::abs(row.torque));
    return largest;
}

// 20 to 60 N·cm without a torque stop; 35 to 45 N·cm is where the expert stops. Nothing of the law was fitted to it.
TEST(DentalImplantTorque, IsThatOfImplantsInALowerJaw) {
    const run::Scene scene = jaw("");
    const test::WatchedRun run = test::rehearsed(scene, "expert");
    const auto seats = std::find_if(run.events.begin(), run.events.end(),
                                    [](const session::EventRow& event) { return event.id == "implant.head_contact"; });
    ASSERT_NE(seats, run.events.end());
    const double going_in = largest_torque(scene, run, seats->time), at_the_end = largest_torque(scene, run, 1e9);
    EXPECT_GT(going_in, 0.20);
    EXPECT_LT(going_in, 0.60);
    EXPECT_GT(at_the_end, 0.35);
    EXPECT_LT(at_the_end, 0.45);
}

// 02-08: a sudden rise at the crest, less in the cancellous bone, an abrupt rise at the floor of the sinus, and nothing
// behind it.
TEST(DentalImplantThrust, RisesAtBothCorticesAndIsGoneBehindTheSinusFloor) {
    // In the box of the phantom: its floor is flat, so all of the bit is through at once.
    const run::Scene scene = jaw("upper-jaw", {}, KERF_SOURCE_DIR "/procedures/anatomy/maxilla-phantom.yaml");
    const test::WatchedRun run = test::rehearsed(scene, "sinus");
    const auto mean_between = [&](double from, double to) {
        double sum = 0.0;
        int count = 0;
        for (const session::TickRow& row : run.ticks) {
            if (row.step != 0 || row.depth < from || row.depth >= to || row.feed_rate <= 0.0) continue;
            sum += row.thrust;
            ++count;
        }
        return count > 0 ? sum / count : -1.0;
    };
    constexpr double point = 0.6_mm;  // of a bit of 2 mm
    const double crest = mean_between(point, 1.0_mm), inside = mean_between(3.0_mm, 11.0_mm),
                 floor = mean_between(12.0_mm + point, 13.0_mm), behind = mean_between(13.0_mm + point, 14.0_mm);
    EXPECT_GT(crest, 2.0 * inside);
    EXPECT_GT(floor, 2.0 * inside);
    EXPECT_GT(inside, 0.1);
    EXPECT_NEAR(behind, 0.0, 0.05);
}

TEST(DentalImplantInARealJaw, IsInsertedByTheExpert) {
    if (std::getenv("KERF_DATA") == nullptr) GTEST_SKIP() << "KERF_DATA names no folder of scans";
    const run::Scene scene = jaw("", {}, KERF_SOURCE_DIR "/tests/real-data/mandible.yaml");
    const test::WatchedRun run = test::rehearsed(scene, "expert");
    EXPECT_EQ(run.summary.verdict, session::Verdict::pass);
    EXPECT_LT(largest_torque(scene, run, 1e9), 0.45);
}

TEST(DentalImplantHole, IsRefusedWhereItIsWiderThanTheThread) {
    text::Diagnostics diagnostics;
    run::DocumentRequest request{.procedure = KERF_SOURCE_DIR "/procedures/dental-implant.yaml"};
    request.changes = {"", {"instruments.final.parameters.diameter=4.2 mm"}};
    static_cast<void>(run::check_documents(request, test::plugins()).take(diagnostics));
    EXPECT_NE(to_text(diagnostics).find("E0517"), std::string::npos) << to_text(diagnostics);
}

}  // namespace
}  // namespace kerf::app
