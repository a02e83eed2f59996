// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "conformance/chart/chart_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "tests/bench/as_printed/printed_rig.h"
#include "tests/support/temporary_folder.h"

namespace kerf::chart {
namespace {

constexpr const char* notice = "For training and research; not for diagnosis, planning or deciding treatment";

/// One real, quick chart for all tests.
const Chart& quick_chart() {
    static const Chart chart = [] {
        std::string error;
        Chart made = make_chart({&test::own_plugins(), &test::printed_plugins()}, {.is_quick = true}, error);
        EXPECT_EQ(error, "");
        return made;
    }();
    return chart;
}

std::size_t fields_of(const std::string& line) {
    std::size_t count = 1;
    bool is_quoted = false;
    for (const char c : line) {
        if (c == '"') is_quoted = !is_quoted;
        if (c == ',' && !is_quoted) ++count;
    }
    return count;
}

Row row_at(double cost, double error) {
    Row row{.scene = "s", .method = "m"};
    row.measured.cost.p999 = cost;
    row.measured.force_error = error;
    return row;
}

TEST(Chart, AQuickOneHasEveryMethodOnOneScene) {
    const Chart& chart = quick_chart();
    EXPECT_EQ(chart.scenes.size(), 1u);
    EXPECT_EQ(chart.methods.size(), 10u);
    EXPECT_EQ(chart.rows.size(), 20u);
    EXPECT_EQ(chart.standings.size(), 20u);
    EXPECT_FALSE(chart.processor.empty());
}

TEST(Chart, ItsTableIsWellFormed) {
    std::istringstream csv(chart_csv(quick_chart()));
    std::string line;
    std::getline(csv, line);
    EXPECT_EQ(line, std::string("# ") + notice + ".");
    std::getline(csv, line);
    std::getline(csv, line);
    const std::size_t columns = fields_of(line);
    int rows = 0;
    for (; std::getline(csv, line); ++rows) EXPECT_EQ(fields_of(line), columns) << line;
    EXPECT_EQ(rows, 20);
}

TEST(Chart, ItsPageNeedsNoNetworkAndSaysWhatItIsNotFor) {
    const std::string html = chart_html(quick_chart());
    EXPECT_NE(html.find(notice), std::string::npos);
    EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
    EXPECT_EQ(html.find("<script"), std::string::npos);
    EXPECT_EQ(html.find("src="), html.find("src=", html.size())) << "nothing is fetched";
    std::size_t links = 0, names = 0;
    for (std::size_t at = html.find("http"); at != std::string::npos; at = html.find("http", at + 1)) ++links;
    for (std::size_t at = html.find("http://www.w3.org/2000/svg"); at != std::string::npos; at = html.find("http://www.w3.org/2000/svg", at + 1)) ++names;
    EXPECT_EQ(links - 1, names) << "the name of a format is no address; one http-equiv";
}

TEST(Chart, ItsFilesAreWrittenWhole) {
    const test::TemporaryFolder folder;
    ASSERT_EQ(write_chart(folder / "new", quick_chart()), "");
    for (const char* name : {"chart.csv", "chart.html", "slab-0.svg", "physics.svg", "physics.csv"})
        EXPECT_GT(test::contents_of(folder / ("new/" + std::string(name))).size(), 500u) << name;
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "new"), {}), 5);
    const std::string svg = test::contents_of(folder / "new/slab-0.svg");
    EXPECT_EQ(svg.rfind("<svg", 0), 0u);
    EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n");
    EXPECT_NE(svg.find(notice), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(Chart, AFilledMarkerPassesAndAHollowOneSaysWhatItFails) {
    const std::string svg = scene_svg(quick_chart(), "slab-0");
    EXPECT_NE(svg.find("kp-full"), std::string::npos);
    EXPECT_NE(svg.find("fails S-01"), std::string::npos);
    for (const Row& row : quick_chart().rows)
        if (row.method == "M9") {
            EXPECT_TRUE(row.fails.empty()) << row.knob;
        }
}

TEST(Chart, TheFrontIsWhatNothingElseBeats) {
    const Row cheap = row_at(1.0, 0.5), good = row_at(3.0, 0.1), beaten = row_at(4.0, 0.2), best = row_at(9.0, 0.01);
    const auto front = pareto_front({&beaten, &best, &cheap, &good});
    ASSERT_EQ(front.size(), 3u);
    EXPECT_EQ(front[0], &cheap);
    EXPECT_EQ(front[1], &good);
    EXPECT_EQ(front[2], &best);
}

TEST(Chart, AnUnknownSceneIsRefusedWithThoseThereAre) {
    std::string error;
    (void)make_chart({&test::own_plugins(), &test::printed_plugins()}, {.scene = "skull"}, error);
    EXPECT_NE(error.find("`skull`"), std::string::npos);
    EXPECT_NE(error.find("slab-10"), std::string::npos);
}

}  // namespace
}  // namespace kerf::chart
