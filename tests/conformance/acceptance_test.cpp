// SPDX-License-Identifier: Apache-2.0
#include "conformance/acceptance.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "conformance/acceptance_file.h"
#include "tests/support/temporary_folder.h"

namespace kerf::conformance {
namespace {

using test::contents_of;
using test::TemporaryFolder;

std::string animal(const std::string& name) { return KERF_BUILD_DIR "/zoo/" + name + ".so"; }

AcceptanceRequest request_of(const std::string& name, const std::string& file, const std::string& folder = "") {
    return {.child = KERF_BUILD_DIR "/libexec/kerf/kerf-check-child",
            .plugin = animal(name),
            .file = file,
            .folder = folder};
}

TEST(Acceptance, WhatWasRecordedIsAccepted) {
    const TemporaryFolder folder;
    const AcceptanceOutcome recorded = record(request_of("saint", folder / "burr.csv"));
    ASSERT_EQ(recorded.error, "");
    const AcceptanceOutcome accepted = accept(request_of("saint", folder / "burr.csv"));
    EXPECT_EQ(accepted.error, "");
    EXPECT_TRUE(accepted.is_accepted) << accepted.text;
}

TEST(Acceptance, NamesTheLargestDifferenceAndWritesAll) {
    const TemporaryFolder folder;
    ASSERT_EQ(record(request_of("saint", folder / "burr.csv")).error, "");
    const AcceptanceOutcome refused =
        accept(request_of("does_not_touch_at_rest", folder / "burr.csv", folder / "differences"));
    EXPECT_FALSE(refused.is_accepted);
    EXPECT_NE(refused.text.find("force z at tick"), std::string::npos) << refused.text;
    const std::string csv = contents_of(folder / "differences/burr-difference.csv");
    EXPECT_NE(csv.find("not for diagnosis"), std::string::npos);
    EXPECT_NE(csv.find("tick,component,recorded,found,difference\n"), std::string::npos);
    EXPECT_NE(contents_of(folder / "differences/burr-difference.svg").find("</svg>"), std::string::npos);
}

TEST(Acceptance, TakesAScriptWithoutForces) {
    const TemporaryFolder folder;
    std::ofstream(folder / "mine.csv") << "# kerf acceptance 1\n# law: round_burr with burring\n"
                                          "# tolerance: 5 % 0.1 N\n"
                                          "0,0,0,0.5,0,0,0,1\n600,0,0,0.5,0,0,0,1\n1100,0,0,-0.5,0,0,0,1\n";
    const AcceptanceOutcome too_early = accept(request_of("saint", folder / "mine.csv"));
    EXPECT_TRUE(too_early.is_bad_input);
    EXPECT_NE(too_early.error.find("--record"), std::string::npos) << too_early.error;
    ASSERT_EQ(record(request_of("saint", folder / "mine.csv")).error, "");
    std::string error;
    const auto file = read_acceptance(folder / "mine.csv", error);
    ASSERT_TRUE(file) << error;
    ASSERT_EQ(file->rows.size(), 3u);
    EXPECT_EQ(file->tolerance, 0.05);
    EXPECT_EQ((*file->rows[1].wrench)[2], 0.0) << "in air";
    EXPECT_GT((*file->rows[2].wrench)[2], 0.05) << "in bone";
    EXPECT_TRUE(accept(request_of("saint", folder / "mine.csv")).is_accepted);
}

TEST(Acceptance, ComparesRowByRow) {
    AcceptanceFile file{.subject = "", .tolerance = 0.1, .floor = 1.0, .rows = {{}, {}}};
    file.rows[0].wrench = {0, 0, 10, 0, 0, 0};
    file.rows[1].wrench = {0, 0, 100, 0, 0, 0};
    auto found = file.rows;
    (*found[0].wrench)[2] = 12.0;  // 2 N of 1 N + 10 % of 10 N
    const Comparison exact = compare(file, found);
    EXPECT_DOUBLE_EQ(exact.worst, 1.0);
    EXPECT_EQ(exact.worst_row, 0u);
    (*found[1].wrench)[0] = 22.0;  // of 1 N + 10 % of 100 N
    const Comparison more = compare(file, found);
    EXPECT_DOUBLE_EQ(more.worst, 2.0);
    EXPECT_EQ(more.worst_row, 1u);
    EXPECT_EQ(more.worst_component, 0u);
}

TEST(Acceptance, RefusesFilesWithLineAndRemedy) {
    const struct {
        const char *text, *says;
    } rows[] = {
        {"0,0,0,0,0,0,0,1\n1,0,0,0,0,0,0,1\n", "no acceptance file"},
        {"# kerf acceptance 1\n0,0,0,0,0,0,0,1\n", "fewer than two rows"},
        {"# kerf acceptance 1\n0,0,0\n", "f.csv:2: has 3 columns"},
        {"# kerf acceptance 1\n0,0,0,nan,0,0,0,1\n", "column 4"},
        {"# kerf acceptance 1\n0,0,0,999,0,0,0,1\n", "beyond 100 mm"},
        {"# kerf acceptance 1\n5,0,0,0,0,0,0,1\n5,0,0,0,0,0,0,1\n", "time order"},
        {"# kerf acceptance 1\n-5,0,0,0,0,0,0,1\n", "whole number"},
        {"# kerf acceptance 1\n# tolerance: 2\n", "write `# tolerance: 2 % 0.05 N`"},
    };
    for (const auto& [text, says] : rows) {
        std::istringstream in(text);
        std::string error;
        EXPECT_FALSE(parse_acceptance(in, "f.csv", error)) << text;
        EXPECT_NE(error.find(says), std::string::npos) << error;
    }
    const TemporaryFolder folder;
    EXPECT_TRUE(accept(request_of("saint", folder / "nothing.csv")).is_bad_input);
    AcceptanceRequest other = request_of("saint", folder / "burr.csv");
    other.law = "nobody with nothing";
    EXPECT_NE(record(other).error.find("it has `round_burr with burring`"), std::string::npos) << record(other).error;
}

}  // namespace
}  // namespace kerf::conformance
