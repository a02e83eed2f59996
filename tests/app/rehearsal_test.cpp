// SPDX-License-Identifier: Apache-2.0
// The shipped procedure, run whole.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "app/run_procedure.h"
#include "tests/support/drill_rig.h"
#include "tests/support/temporary_folder.h"

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

const RunOutcome& outcome_of(const std::string& rehearsal) {
    static std::map<std::string, RunOutcome> outcomes;
    if (!outcomes.contains(rehearsal)) {
        RunRequest request;
        request.rehearsal = rehearsal;
        outcomes.emplace(rehearsal, run_procedure(pedicle(), test::plugins(), request));
    }
    return outcomes.at(rehearsal);
}

double metric(const RunSummary& summary, const std::string& id) {
    for (const auto& row : summary.metrics)
        if (row.id == id) return row.value;
    throw std::runtime_error("no metric " + id);
}

TEST(PedicleScrew, TheExpertPasses) {
    const RunOutcome& run = outcome_of("expert");
    EXPECT_EQ(run.summary.verdict, Verdict::pass);
    EXPECT_TRUE(run.is_as_expected);
    EXPECT_TRUE(run.summary.reasons.empty());
    EXPECT_GT(metric(run.summary, "pilot-hole.clearance.canal"), 2e-3);
}

TEST(PedicleScrew, TheMedialBreachFailsBecauseOfTheCanalAndForThatAlone) {
    const RunOutcome& run = outcome_of("medial-breach");
    EXPECT_EQ(run.summary.verdict, Verdict::fail);
    EXPECT_TRUE(run.is_as_expected);
    ASSERT_EQ(run.summary.reasons.size(), 1u);
    EXPECT_NE(run.summary.reasons[0].find("canal"), std::string::npos);
    EXPECT_LT(metric(run.summary, "pilot-hole.clearance.canal"), 0.0);
}

TEST(PedicleScrew, TwoRunsAreTheSameBits) {
    RunRequest request;
    request.rehearsal = "expert";
    const RunOutcome again = run_procedure(pedicle(), test::plugins(), request);
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
        auto made = make_scene(KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml",
                               std::string(KERF_SOURCE_DIR "/tests/real-data/") + GetParam(), test::plugins(), diagnostics);
        EXPECT_TRUE(made) << to_text(diagnostics);
        return made;
    }
};

TEST_P(RealScan, TheExpertPassesThroughBoneAllTheWay) {
    const auto made = scene();
    ASSERT_TRUE(made);
    const RunOutcome run = run_procedure(*made, test::plugins(), RunRequest{.rehearsal = "expert", .out = {}, .learner = {}, .replay = {}, .progress = {}});
    EXPECT_EQ(run.summary.verdict, Verdict::pass);
    EXPECT_GT(metric(run.summary, "pilot-hole.axis-in-bone"), 0.95);
    EXPECT_GT(metric(run.summary, "pilot-hole.clearance.canal"), 0.0);
}

TEST_P(RealScan, TheMedialBreachFailsBecauseOfTheCanalAndForThatAlone) {
    const auto made = scene();
    ASSERT_TRUE(made);
    const RunOutcome run = run_procedure(*made, test::plugins(), RunRequest{.rehearsal = "medial-breach", .out = {}, .learner = {}, .replay = {}, .progress = {}});
    EXPECT_TRUE(run.is_as_expected);
}

INSTANTIATE_TEST_SUITE_P(Vertebra, RealScan, testing::Values("l3.yaml", "t12.yaml"),
                         [](const auto& scan) { return std::string(scan.param).substr(0, std::string(scan.param).find('.')); });

using test::contents_of;
using test::TemporaryFolder;

TEST(Program, WritesEveryFileAndNoneOfThemNamesAPath) {
    const TemporaryFolder folder;
    const std::string command = KERF_BUILD_DIR "/bin/kerf run " KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml --out " + (folder / "run") +
                                " > " + (folder / "log.txt") + " 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0);
    for (const char* name : {"session.db", "summary.json", "report.html", "bone.stl"}) {
        const std::string bytes = contents_of(folder / "run/" + name);
        EXPECT_GT(bytes.size(), 500u) << name;
        EXPECT_EQ(bytes.find(KERF_SOURCE_DIR), std::string::npos) << name;
        EXPECT_EQ(bytes.find(folder.path()), std::string::npos) << name;
        EXPECT_NE(bytes.find("not for diagnosis"), std::string::npos) << name;
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "run/session.db-wal"));
}

TEST(Program, AReplayEndsInTheSameBits) {
    const TemporaryFolder folder;
    const std::string run = KERF_BUILD_DIR "/bin/kerf run " KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml ";
    ASSERT_EQ(std::system((run + "--out " + (folder / "record") + " > /dev/null").c_str()), 0);
    const std::string log = folder / "replay.txt";
    ASSERT_EQ(std::system((run + "--replay " + (folder / "record/session.db") + " --out " + (folder / "again") + " > " + log).c_str()), 0);
    EXPECT_NE(contents_of(log).find("replay: the same bits"), std::string::npos) << contents_of(log);
}

TEST(Program, BadInputEndsWithTwoAndWritesNothing) {
    const TemporaryFolder folder;
    const std::string out = folder / "bad";
    for (const std::string what : {"run /nowhere.yaml", "run " KERF_SOURCE_DIR "/procedures/anatomy/vertebra-phantom.yaml",
                                   "run " KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml --hand nobody",
                                   "run " KERF_SOURCE_DIR "/procedures/pedicle-screw.yaml --replay " KERF_SOURCE_DIR "/README.md", "fly", "run"}) {
        const std::string command = KERF_BUILD_DIR "/bin/kerf " + what + " --out " + out + " > /dev/null 2>&1";
        EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 2) << what;
        EXPECT_FALSE(std::filesystem::exists(out)) << what;
    }
}

}  // namespace
}  // namespace kerf
