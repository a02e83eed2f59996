// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/stability/atlas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "studies/stability/suite.h"
#include "tests/support/temporary_folder.h"

namespace kerf::stability {
namespace {

std::vector<Finding> some_findings() {
    Finding good{.test = "S-02", .scene = "a \"stiff\" wall", .method = Method::as_printed, .device = "touch"};
    good.measured = "1 N, 2 turns";
    good.criterion = "< 3";
    good.outcome = Outcome::pass;
    Finding bad = good;
    bad.method = Method::kerf;
    bad.outcome = Outcome::fail;
    Finding neither = good;
    neither.test = "S-15";
    neither.outcome = Outcome::not_applicable;
    neither.reason = "there is no hand";
    return {good, bad, neither};
}

using test::contents_of;

std::size_t count(const std::string& text, const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
    return n;
}

constexpr const char* line = "For training and research; not for diagnosis, planning or deciding treatment";

TEST(Atlas, IsWrittenWholeAndSaysWhatItIsNotFor) {
    const test::TemporaryFolder folder;
    const std::string out = folder / "new/folder";
    ASSERT_EQ(write_atlas(out, some_findings()), "");
    const std::string csv = contents_of(out + "/stability.csv"), svg = contents_of(out + "/stability.svg");
    EXPECT_EQ(csv, atlas_csv(some_findings()));
    EXPECT_EQ(svg, atlas_svg(some_findings()));
    EXPECT_EQ(csv.rfind(std::string("# ") + line, 0), 0u);
    EXPECT_NE(svg.find(line), std::string::npos);
    EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(out), {}), 2) << "and nothing half";
}

TEST(Atlas, TheTableHasARowPerFindingAndQuotesItsFields) {
    const std::string csv = atlas_csv(some_findings());
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 2 + 3);
    EXPECT_NE(
        csv.find("\"S-02\",\"a \"\"stiff\"\" wall\",\"touch\",\"none\",\"0\",\"as printed\",\"1 N, 2 turns\",\"< 3\","
                 "\"pass\",\"\"\n"),
        std::string::npos)
        << csv;
}

TEST(Atlas, TheGridFillsWhatPassesAndHollowsWhatFails) {
    const std::string svg = atlas_svg(some_findings());
    const std::size_t legend = 1;  // of each kind
    EXPECT_EQ(count(svg, "class=\"bad\""), 1 + legend);
    EXPECT_EQ(count(svg, "class=\"theirs\""), 1 + legend);
    EXPECT_EQ(count(svg, "class=\"ours\""), 0 + legend);
    EXPECT_EQ(count(svg, "class=\"na\""), 1 + legend);
}

TEST(Atlas, OnlyWhatKerfFailsCountsAgainstIt) {
    std::vector<Finding> findings = some_findings();
    EXPECT_FALSE(is_kerf_stable(findings));
    findings[0].outcome = Outcome::fail;
    findings[1].outcome = Outcome::pass;
    EXPECT_TRUE(is_kerf_stable(findings));
}

TEST(Atlas, ReportsAFolderThatCannotBeMade) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "file") << "x";
    EXPECT_NE(write_atlas(folder / "file/below", some_findings()).find("`" + (folder / "file") + "` is a file"),
              std::string::npos);
}

}  // namespace
}  // namespace kerf::stability
