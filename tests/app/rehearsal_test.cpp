// SPDX-License-Identifier: Apache-2.0
// The shipped procedure, run whole.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/drill_rig.h"
#include "tests/support/watched_run.h"

namespace kerf {
namespace {

const Scene& pedicle() {
    static const Scene scene = [] {
        Diagnostics diagnostics;
        auto made = make_scene(KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml", "", test::plugins(), diagnostics);
        if (!made) throw std::runtime_error(to_text(diagnostics));
        return std::move(*made);
    }();
    return scene;
}

RunRequest following(const std::string& rehearsal) {
    RunRequest request;
    request.rehearsal = rehearsal;
    return request;
}

/// The procedure with other values, as `--set` gives them.
std::optional<Scene> pedicle_with(const std::vector<std::string>& settings) {
    Diagnostics diagnostics;
    DocumentRequest request{.procedure = KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml"};
    request.changes.settings = settings;
    auto documents = check_documents(request, test::plugins(), diagnostics);
    auto made = documents ? make_scene(std::move(*documents), diagnostics) : std::nullopt;
    if (!made) ADD_FAILURE() << to_text(diagnostics);
    return made;
}

const test::WatchedRun& outcome_of(const std::string& rehearsal) {
    static std::map<std::string, test::WatchedRun> outcomes;
    if (!outcomes.contains(rehearsal)) {
        outcomes.emplace(rehearsal, test::watched_run(pedicle(), test::plugins(), following(rehearsal)));
    }
    return outcomes.at(rehearsal);
}

double metric(const RunSummary& summary, const std::string& id) {
    for (const auto& row : summary.metrics)
        if (row.id == id) return row.value;
    throw std::runtime_error("no metric " + id);
}

TEST(PedicleScrew, TheExpertPasses) {
    const test::WatchedRun& run = outcome_of("expert");
    EXPECT_EQ(run.summary.verdict, Verdict::pass);
    EXPECT_TRUE(run.is_as_expected);
    EXPECT_TRUE(run.summary.reasons.empty());
    EXPECT_GT(metric(run.summary, "pilot-hole.clearance.canal"), 2e-3);
}

TEST(PedicleScrew, TheMedialBreachFailsBecauseOfTheCanalAndForThatAlone) {
    const test::WatchedRun& run = outcome_of("medial-breach");
    EXPECT_EQ(run.summary.verdict, Verdict::fail);
    EXPECT_TRUE(run.is_as_expected);
    ASSERT_EQ(run.summary.reasons.size(), 1u);
    EXPECT_NE(run.summary.reasons[0].find("canal"), std::string::npos);
    EXPECT_LT(metric(run.summary, "pilot-hole.clearance.canal"), 0.0);
}

// Its start lies across the surface, whose direction each grid knows for itself. Once turned onto the axis the drill
// passes the canal at the same distance.
TEST(PedicleScrew, TheHolePassesTheCanalAlikeOnACoarserGrid) {
    const auto coarse = pedicle_with({"accuracy.spacing=0.5 mm"});
    ASSERT_TRUE(coarse);
    const double fine = metric(outcome_of("expert").summary, "pilot-hole.clearance.canal");
    const test::WatchedRun rough = test::watched_run(*coarse, test::plugins(), following("expert"));
    EXPECT_EQ(rough.summary.verdict, Verdict::pass);
    EXPECT_NEAR(metric(rough.summary, "pilot-hole.clearance.canal"), fine, 0.1e-3);
}

TEST(PedicleScrew, TwoRunsAreTheSameBits) {
    const test::WatchedRun again = test::watched_run(pedicle(), test::plugins(), following("expert"));
    EXPECT_EQ(again.summary.hash, outcome_of("expert").summary.hash);
    EXPECT_NE(again.summary.hash, outcome_of("medial-breach").summary.hash);
}

TEST(PedicleScrew, NobodyIsPushedHarderThanTheDeviceAllows) {
    for (const char* rehearsal : {"expert", "medial-breach"})
        for (const TickRow& row : outcome_of(rehearsal).ticks)
            ASSERT_LE(length(linear(row.commanded)), pedicle().device->peak_force * (1.0 + 1e-9)) << row.tick;
}

TEST(PedicleScrew, TheSolveSettlesInEveryTick) {
    for (const char* rehearsal : {"expert", "medial-breach"})
        for (const TickRow& row : outcome_of(rehearsal).ticks) ASSERT_LT(row.iterations, iteration_cap) << row.tick;
}

TEST(PedicleScrew, WhatIsRemovedIsCountedByTissue) {
    const RunSummary& s = outcome_of("expert").summary;
    double sum = 0.0;
    for (const auto& [tissue, volume] : s.removed_by_tissue) {
        EXPECT_GT(volume, 0.0) << tissue;
        sum += volume;
    }
    EXPECT_NEAR(sum, s.removed, 1e-15);
}

/// The same procedure on a real scan, when there is one.
class RealScan : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        if (std::getenv("KERF_DATA") == nullptr) GTEST_SKIP() << "KERF_DATA names no folder of scans";
    }
    [[nodiscard]] std::optional<Scene> scene() const {
        Diagnostics diagnostics;
        auto made =
            make_scene(KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml",
                       std::string(KERF_SOURCE_DIR "/tests/real-data/") + GetParam(), test::plugins(), diagnostics);
        EXPECT_TRUE(made) << to_text(diagnostics);
        return made;
    }
};

TEST_P(RealScan, TheExpertPassesThroughBoneAllTheWay) {
    const auto made = scene();
    ASSERT_TRUE(made);
    const test::WatchedRun run = test::watched_run(*made, test::plugins(), following("expert"));
    EXPECT_EQ(run.summary.verdict, Verdict::pass);
    EXPECT_GT(metric(run.summary, "pilot-hole.axis-in-bone"), 0.95);
    EXPECT_GT(metric(run.summary, "pilot-hole.clearance.canal"), 0.0);
}

TEST_P(RealScan, TheMedialBreachFailsBecauseOfTheCanalAndForThatAlone) {
    const auto made = scene();
    ASSERT_TRUE(made);
    const test::WatchedRun run = test::watched_run(*made, test::plugins(), following("medial-breach"));
    EXPECT_TRUE(run.is_as_expected);
}

INSTANTIATE_TEST_SUITE_P(Vertebra, RealScan, testing::Values("l3.yaml", "t12.yaml"), [](const auto& scan) {
    return std::string(scan.param).substr(0, std::string(scan.param).find('.'));
});

/// A bone out of a surface, when there is one.
TEST(RealSurface, AHoleAlongTheNeckOfTheFemurEndsAsItSays) {
    if (const char* data = std::getenv("KERF_DATA"); !data || !std::filesystem::exists(std::string(data) + "/meshes"))
        GTEST_SKIP() << "KERF_DATA names no folder with meshes/";
    Diagnostics diagnostics;
    const auto made = make_scene(KERF_SOURCE_DIR "/tests/real-data/neck-hole.yaml", "", test::plugins(), diagnostics);
    ASSERT_TRUE(made) << to_text(diagnostics);
    const test::WatchedRun run = test::watched_run(*made, test::plugins(), following("straight"));
    EXPECT_EQ(run.summary.verdict, Verdict::pass);
    for (const auto& [tissue, volume] : run.summary.removed_by_tissue) EXPECT_GT(volume, 1e-9) << tissue;
}

}  // namespace
}  // namespace kerf
