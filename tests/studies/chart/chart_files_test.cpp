// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/chart_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <sstream>

#include "tests/studies/papers/as_printed/printed_rig.h"
#include "tests/support/temporary_folder.h"

namespace kerf::chart {
namespace {

constexpr const char* notice = "For training and research; not for diagnosis, planning or deciding treatment";

/// What a chart looks like, without the work: one scene, one method that passes and one that fails.
Chart small_chart() {
    Chart chart{.processor = "a <processor>", .law = test::shared_law()};
    chart.scenes = {{"slab-0", "A slab"}};
    chart.methods = {{"M2", "chip load, \"binary\" voxels", false, 200.0}, {"M9", "Kerf", false, 1400.0}};
    for (const char* method : {"M2", "M9"})
        for (const double spacing : {1e-3, 0.5e-3}) {
            Row row{.scene = "slab-0",
                    .method = method,
                    .knob = spacing > 0.7e-3 ? "1 mm" : "0.5 mm",
                    .fineness = {spacing, 31, {}}};
            row.measured.force_error = 10.0 * spacing;
            row.measured.volume_error = row.measured.peak_step = spacing;
            row.measured.cost = {10.0, 5e-3 / spacing, 100.0};
            if (row.method == "M2") row.fails = {"S-01", "S-12"};
            chart.standings.push_back(
                {.method = row.method, .knob = row.knob, .fails = row.fails, .told = "S-01 pushed: 3 counts"});
            chart.rows.push_back(row);
        }
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
    std::string error;
    int lines = 0;
    const Chart chart = make_chart({&test::own_plugins(), &test::printed_plugins()},
                                   {.is_quick = true, .progress = [&](const std::string&) { ++lines; }}, error);
    ASSERT_EQ(error, "");
    EXPECT_EQ(chart.scenes.size(), 1u);
    EXPECT_EQ(chart.methods.size(), 10u);
    EXPECT_EQ(chart.rows.size(), 20u);
    EXPECT_EQ(chart.standings.size(), 20u);
    EXPECT_EQ(lines, 40);
    EXPECT_FALSE(chart.processor.empty());
    for (const Row& row : chart.rows) {
        EXPECT_TRUE(row.method != "M9" || row.knob != "0.25 mm" || row.fails.empty())
            << "Kerf, where it is fine enough";
        EXPECT_GT(row.measured.cost.longest, 0.0) << row.method;
    }
    EXPECT_EQ(scene_svg(chart, "slab-0").find("nan"), std::string::npos);
}

TEST(Chart, ItsTableIsWellFormed) {
    std::istringstream csv(chart_csv(small_chart()));
    std::string line;
    std::getline(csv, line);
    EXPECT_EQ(line, std::string("# ") + notice + ".");
    std::getline(csv, line);
    std::getline(csv, line);
    const std::size_t columns = fields_of(line);
    int rows = 0;
    for (; std::getline(csv, line); ++rows) EXPECT_EQ(fields_of(line), columns) << line;
    EXPECT_EQ(rows, 4);
}

TEST(Chart, ItsPageNeedsNoNetworkAndSaysWhatItIsNotFor) {
    const std::string html = chart_html(small_chart());
    EXPECT_NE(html.find(notice), std::string::npos);
    EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
    EXPECT_EQ(html.find("<script"), std::string::npos);
    EXPECT_EQ(html.find("src="), html.find("src=", html.size())) << "nothing is fetched";
    std::size_t links = 0, names = 0;
    for (std::size_t at = html.find("http"); at != std::string::npos; at = html.find("http", at + 1)) ++links;
    for (std::size_t at = html.find("http://www.w3.org/2000/svg"); at != std::string::npos;
         at = html.find("http://www.w3.org/2000/svg", at + 1))
        ++names;
    EXPECT_EQ(links - 1, names) << "the name of a format is no address; one http-equiv";
}

TEST(Chart, ItsFilesAreWrittenWhole) {
    const test::TemporaryFolder folder;
    ASSERT_EQ(write_chart(folder / "new", small_chart()), "");
    for (const char* name : {"chart.csv", "chart.html", "tests.csv", "slab-0.svg", "physics.svg", "physics.csv"})
        EXPECT_GT(test::contents_of(folder / ("new/" + std::string(name))).size(), 200u) << name;
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "new"), {}), 6);
    const std::string svg = test::contents_of(folder / "new/slab-0.svg");
    EXPECT_EQ(svg.rfind("<svg", 0), 0u);
    EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n");
    EXPECT_NE(svg.find(notice), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(Chart, WhereKerfsForceIsJudgedByItsThrustAloneThePictureSaysSo) {
    Chart chart = small_chart();
    EXPECT_EQ(scene_svg(chart, "slab-0").find("thrust alone"), std::string::npos);
    chart.scenes.front().is_oblique = true;
    EXPECT_NE(scene_svg(chart, "slab-0").find("M9 walks here: its thrust alone."), std::string::npos);
}

TEST(Chart, AFilledMarkerPassesAndAHollowOneSaysWhatItFails) {
    const Chart chart = small_chart();
    const std::string svg = scene_svg(chart, "slab-0");
    const auto count = [&](const std::string& what) {
        std::size_t n = 0;
        for (std::size_t at = svg.find(what); at != std::string::npos; at = svg.find(what, at + 1)) ++n;
        return n;
    };
    constexpr std::size_t panels = 3, markers = 2, legend = 1;
    EXPECT_EQ(count("class=\"kp-full\""), panels * markers + legend);
    EXPECT_EQ(count("class=\"kp-hollow\""), panels * markers + legend);
    EXPECT_EQ(count("voxels: fails S-01 S-12<"), 1u);
    EXPECT_EQ(count("a &lt;processor&gt;"), 1u);
}

TEST(Chart, TheFrontIsWhatNothingElseBeats) {
    const Row cheap = row_at(1.0, 0.5), good = row_at(3.0, 0.1), beaten = row_at(4.0, 0.2), best = row_at(9.0, 0.01);
    const auto front = pareto_front({&beaten, &best, &cheap, &good});
    ASSERT_EQ(front.size(), 3u);
    EXPECT_EQ(front[0], &cheap);
    EXPECT_EQ(front[1], &good);
    EXPECT_EQ(front[2], &best);
}

TEST(Chart, EnoughIsTheCheapestThatPassesAndIsNotFelt) {
    Row unstable = row_at(1.0, 0.01), rough = row_at(2.0, 0.2), enough = row_at(3.0, 0.06), finer = row_at(9.0, 0.01);
    unstable.fails = {"S-01"};
    EXPECT_EQ(cheapest_enough({&finer, &unstable, &rough, &enough}), &enough);
    EXPECT_EQ(cheapest_enough({&unstable, &rough}), nullptr);
}

TEST(Chart, AnUnknownSceneIsRefusedWithThoseThereAre) {
    std::string error;
    (void)make_chart({&test::own_plugins(), &test::printed_plugins()}, {.scene = "skull"}, error);
    EXPECT_NE(error.find("`skull`"), std::string::npos);
    for (const char* id : {"slab-10", "mandible-twist", "burr-groove", "grazing"})
        EXPECT_NE(error.find(id), std::string::npos) << id;
}

}  // namespace
}  // namespace kerf::chart
