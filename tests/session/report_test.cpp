// SPDX-License-Identifier: Apache-2.0
#include "session/report/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <ranges>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include "session/recorder.h"
#include "session/report/recorded_procedure.h"
#include "session/report/report_data.h"
#include "session/report/report_page.h"
#include "synthetic_run.h"
#include "tests/support/temporary_folder.h"
#include "text/printable_lines.h"

namespace kerf::session {
namespace {

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string synthetic_report() {
    return report_html(test::synthetic_summary(), test::drawn_run(test::synthetic_ticks(), test::synthetic_events(),
                                                                  drawn_surface(test::synthetic_bone(16))));
}

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

TEST(Base64, GivesThePublishedValues) {
    const auto encoded = [](std::string_view text) {
        return base64({reinterpret_cast<const unsigned char*>(text.data()), text.size()});
    };
    EXPECT_EQ(encoded(""), "");
    EXPECT_EQ(encoded("f"), "Zg==");
    EXPECT_EQ(encoded("fo"), "Zm8=");
    EXPECT_EQ(encoded("foo"), "Zm9v");
    EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
}

TEST(SensibleNumber, StopsWhereTheUncertaintyBegins) {
    EXPECT_EQ(sensible_number(31.23456, 0.5), "31.2");
    EXPECT_EQ(sensible_number(31.23456, 0.13), "31.23");
    EXPECT_EQ(sensible_number(31.23456, 4.0), "31");
}

TEST(SensibleNumber, DiffersFromABoundThatItDoesNotEqual) {
    const std::vector<double> bounds{60.0};
    EXPECT_EQ(sensible_number(59.98, 0.5, bounds), "59.98");
    EXPECT_EQ(sensible_number(59.98, -1.0, bounds), "59.98");
    EXPECT_EQ(sensible_number(60.0, 0.5, bounds), "60.0");
    EXPECT_EQ(sensible_number(58.98, 0.5, bounds), "59.0");
}

TEST(SensibleNumber, HasThreeDigitsWhenNothingIsKnownOfIt) {
    EXPECT_EQ(sensible_number(38.4721), "38.5");
    EXPECT_EQ(sensible_number(0.05), "0.05");
    EXPECT_EQ(sensible_number(1234.56), "1235");
    EXPECT_EQ(sensible_number(-2.5), "−2.5");
    EXPECT_EQ(sensible_number(0.0), "0");
    EXPECT_EQ(sensible_number(std::numeric_limits<double>::infinity()), "–");
}

TEST(LateralForce, IsWhatActsAcrossTheShaft) {
    TickRow row;
    row.world_from_tool.rotation = {1, 0, 0, 0};  // shaft along z
    row.modelled = {3.0, 4.0, 100.0, 0, 0, 0};
    EXPECT_DOUBLE_EQ(lateral_force(row), 5.0);
}

TEST(SentTorque, IsAboutTheHandle) {
    TickRow row;
    row.device_from_handle.rotation = quat_between({0, 0, 1}, {1, 0, 0});  // its z along x
    row.commanded = {0, 0, 0, -0.2, 0.05, 0.07};
    EXPECT_NEAR(sent_torque(row), -0.2, 1e-15);
}

std::vector<TickRow> thinned(const std::vector<TickRow>& rows, std::size_t most, std::size_t expected) {
    Thinning thinning(expected, most);
    for (const TickRow& row : rows) thinning.add(row);
    return thinning.rows();
}

TEST(Thinning, KeepsAllRowsWhenTheyAreFew) { EXPECT_EQ(thinned(test::synthetic_ticks(100), 100, 100).size(), 100u); }

TEST(Thinning, KeepsASpikeOfOneTick) {
    // Given three minutes with one tick that stands out
    auto rows = test::synthetic_ticks(180'000);
    rows[123'457].thrust = 500.0;

    // When they are thinned
    const auto drawn = thinned(rows, 20'000, rows.size());

    // Then it is still there, in order
    const auto by_tick = [](const TickRow& a, const TickRow& b) { return a.tick < b.tick; };
    EXPECT_LE(drawn.size(), 20'000u);
    EXPECT_TRUE(std::ranges::binary_search(drawn, rows[123'457], by_tick));
    EXPECT_TRUE(std::ranges::is_sorted(drawn, by_tick));
    EXPECT_EQ(drawn.front().tick, 0u);
    EXPECT_EQ(drawn.back().tick, 179'999u);
}

TEST(Thinning, KeepsTheExtremesOfEveryStretch) {
    const auto rows = test::synthetic_ticks(30'000);
    const auto drawn = thinned(rows, 1'002, rows.size());  // 125 stretches of 240 rows
    for (std::size_t from = 0; from < rows.size(); from += 240) {
        const auto is_here = [&](const TickRow& row) { return row.tick >= from && row.tick < from + 240; };
        double highest = -1.0, kept = -1.0;
        for (std::size_t i = from; i < from + 240; ++i) highest = std::max(highest, rows[i].thrust);
        for (const TickRow& row : drawn)
            if (is_here(row)) kept = std::max(kept, row.thrust);
        ASSERT_EQ(kept, highest) << from;
    }
}

TEST(Thinning, TakesFewerRowsThanExpected) {
    const auto rows = test::synthetic_ticks(25'000);
    const auto drawn = thinned(rows, 20'000, 180'000);
    EXPECT_EQ(drawn.front().tick, 0u);
    EXPECT_EQ(drawn.back().tick, 24'999u);
    EXPECT_EQ(thinned(rows, 20'000, 24'000).back().tick, 23'999u);
}

TEST(ReportPage, IsEmbeddedByteForByte) {
    const std::string folder = KERF_SOURCE_DIR "/session/report/page/";
    EXPECT_TRUE(report_skeleton == test::contents_of(folder + "report.html"));
    EXPECT_TRUE(report_style == test::contents_of(folder + "report.css"));
    EXPECT_TRUE(report_script == test::contents_of(folder + "report.js"));
}

TEST(Report, IsOnePageThatFetchesNothing) {
    const std::string html = synthetic_report();
    const std::string without_names = std::regex_replace(html, std::regex("http://www\\.w3\\.org/2000/svg"), "");
    EXPECT_FALSE(holds(without_names, "http:"));
    EXPECT_FALSE(holds(without_names, "https:"));
    EXPECT_FALSE(holds(html, "<link"));
    EXPECT_FALSE(holds(html, " src="));
    EXPECT_TRUE(holds(html, "default-src 'none'"));
}

TEST(Report, SaysTheVerdictInAWordAndTheReasons) {
    const std::string html = synthetic_report();
    EXPECT_TRUE(holds(html, "✗ Fail"));
    EXPECT_TRUE(holds(html, "The bit came within 0.4 mm of the spinal canal"));
    EXPECT_TRUE(holds(html, "31.23 ± 0.13\u00a0mm"));
    EXPECT_TRUE(holds(html, notice_line));
}

TEST(Report, AHostileNameStaysText) {
    // Given names that try to leave their place, in every kind of place
    const std::string hostile = "</script><script>alert(1)</script>\"'<img onerror=x>&";
    RunSummary summary = test::synthetic_summary();
    summary.procedure = summary.anatomy = summary.device = hostile;
    summary.reasons = {hostile};
    summary.tissues = {hostile};
    summary.steps[0].title = summary.steps[0].broken_limits[0] = hostile;
    summary.metrics[0].id = summary.metrics[0].help = summary.metrics[0].unit = summary.metrics[0].status = hostile;
    summary.signals[0].id = summary.signals[0].help = hostile;
    summary.versions = {{hostile, hostile}};

    // When the page is made
    summary.metrics[1].scope = summary.metrics[2].scope = summary.steps[1].id = hostile;
    summary.metrics[1].id = hostile + ".clearance." + hostile;
    summary.metrics[2].id = hostile + ".gertzbein-robbins";
    RecordedProcedure procedure{hostile, hostile, hostile, {{hostile, {}, {}}}};
    procedure.steps[0].goals = procedure.steps[0].limits = {{.quantity = hostile, .of = hostile, .unit = hostile}};
    procedure.steps[0].limits[0].at_most = 1.0;
    procedure.steps[0].limits[0].reason = summary.steps[1].broken_limits.emplace_back(hostile);
    const std::string html =
        report_html(summary, test::drawn_run(test::synthetic_ticks(50), {{1, 0.0, hostile, hostile}}), procedure);

    // Then the page has the two scripts it should have, and no element of theirs
    EXPECT_EQ(count_of(html, "<script"), 2u);
    EXPECT_EQ(count_of(html, "</script"), 2u);
    EXPECT_FALSE(holds(html, "<img"));
}

// ---- the procedure's titles and bounds

constexpr const char* drilling_text = R"yaml(
metadata: {id: pilot, title: Pilot hole & more}
steps:
  - id: pilot-hole
    goals: [{entry: {}}, {depth: {at_least: 30 mm}}]
    limits:
      - {depth: {at_most: 31 mm}, reason: Too deep.}
      - {clearance: {zone: canal, at_least: 0 mm}, reason: In the canal.}
      - {breach: {diameter: 6.5 mm, at_most: 2 mm}, reason: Out of the bone.}
  - id: withdraw
    goals: [{entry: {}}]
rehearsals:
  - {id: expert, title: As planned}
  - {id: too-deep, title: One millimetre too deep}
)yaml";

RunSummary drilled(double depth) {
    RunSummary summary;
    summary.procedure = "pilot";
    summary.verdict = Verdict::fail;
    summary.steps = {{"pilot-hole", "Drill", true, 0.0, 12.0, {"depth", "drilling.bit_overbent"}},
                     {"withdraw", "Withdraw", false, 0.0, 12.0, {}}};
    summary.metrics = {{"pilot-hole.depth", 1, "pilot-hole", 1, 1, depth, "mm", 1e-3, 0.13e-3, "info", "how deep"},
                       {"pilot-hole.clearance.canal", 1, "pilot-hole", 1, 1, 2e-3, "mm", 1e-3, -1.0, "ok", ""},
                       {"pilot-hole.hole-angle", 1, "pilot-hole", 1, 1, 0.0, "deg", 0.0174532925, -1.0, "info", ""},
                       {"bone.grooves", 1, "run", 1, 1, 1e-9, "mm3", 1e-9, -1.0, "info", ""},
                       {"bone.balance", 1, simulation_scope, 1, 1, 0.0, "%", 0.01, -1.0, "", ""}};
    return summary;
}

std::string drilled_report(double depth, const std::string& text = drilling_text) {
    return report_html(drilled(depth), test::drawn_run({}, {{1, 8.5, "limit_broken", "drilling.bit_overbent"}}),
                       recorded_procedure(text, "too-deep"));
}

/// The row of a table that holds `part`, without the words between its cells.
std::string row_with(const std::string& html, const std::string& part) {
    const std::size_t at = html.find(part);
    if (at == std::string::npos) return "no row has " + part;
    const std::size_t begin = html.rfind("<tr", at), end = html.find("</tr>", at);
    return std::regex_replace(html.substr(begin, end - begin), std::regex("<[^>]*>"), "|");
}

TEST(RecordedProcedure, ReadsTitlesGoalsAndLimits) {
    const RecordedProcedure procedure = recorded_procedure(drilling_text, "too-deep");
    EXPECT_EQ(procedure.title, "Pilot hole & more");
    EXPECT_EQ(procedure.rehearsal_title, "One millimetre too deep");
    ASSERT_EQ(procedure.steps.size(), 2u);
    const RecordedStep& step = procedure.steps[0];
    ASSERT_EQ(step.goals.size(), 2u);
    EXPECT_EQ(step.goals[1].quantity, "depth");
    EXPECT_DOUBLE_EQ(step.goals[1].at_least.value(), 30e-3);
    ASSERT_EQ(step.limits.size(), 3u);
    EXPECT_EQ(step.limits[1].name(), "canal");
    EXPECT_EQ(step.limits[1].reason, "In the canal.");
    EXPECT_DOUBLE_EQ(step.limits[2].diameter.value(), 6.5e-3);
    EXPECT_EQ(step.limits[2].unit, "mm");
}

TEST(RecordedProcedure, LeavesOutWhatItCannotRead) {
    for (const char* text : {"", "{", "a", "- a", "steps: a", "steps: {a: [b]}", "steps: [a, [b], {goals: {a: b}}]",
                             "metadata: [title]", "steps: [{id: a, limits: [{depth: {at_most: 3}}, depth]}]"})
        EXPECT_EQ(recorded_procedure(text, "").title, "") << text;
    const RecordedProcedure odd =
        recorded_procedure("steps: [{id: a, limits: [{depth: {at_most: 3 parsec, at_least: [1]}}]}]", "");
    EXPECT_FALSE(odd.steps.at(0).limits.at(0).at_most);
    EXPECT_FALSE(odd.steps.at(0).limits.at(0).at_least);
}

TEST(Report, HasTitlesForPeopleAndIdsInSmallPrint) {
    const std::string html = drilled_report(31.5e-3);
    EXPECT_TRUE(holds(html, "<h1>Pilot hole &amp; more</h1>"));
    EXPECT_TRUE(holds(html, "Rehearsal:</span> One millimetre too deep<"));
    EXPECT_TRUE(holds(html, "<p class=\"soft small\">pilot</p>"));
    EXPECT_TRUE(holds(report_html(drilled(0.0), DrawnRun()), "<h1>pilot</h1>")) << "no title was recorded";
}

TEST(Report, ShowsABoundBesideItsValue) {
    const std::string html = drilled_report(31.5e-3);
    EXPECT_TRUE(holds(row_with(html, "at most 31"), "31.50 ± 0.13\u00a0mm|")) << row_with(html, "at most 31");
    EXPECT_TRUE(holds(row_with(html, "at most 31"), "✗ broken"));
    EXPECT_TRUE(holds(row_with(html, "at most 31"), "Too deep."));
    EXPECT_TRUE(holds(row_with(html, "at least 30"), "✓ reached"));
    EXPECT_TRUE(holds(row_with(html, "at least 0"), "✓ kept"));
    EXPECT_TRUE(holds(row_with(html, "at most 2"), "– not measured")) << row_with(html, "at most 2");
    EXPECT_LT(html.find("at most 31"), html.find("at least 30")) << "what failed comes first";
}

TEST(Report, ShowsMeasuresBesideTheirGoalsAndLimits) {
    const std::string text = R"yaml(
metadata: {id: pilot, title: Pilot hole}
steps:
  - id: pilot-hole
    goals: [{measure: {of: gonial_angle, at_least: 120 deg}}]
    limits:
      - {measure: {of: wall, at_least: 2 mm}, reason: The wall is thin.}
      - {measure: {of: floor, at_least: 2 mm}, reason: The floor is thin.}
)yaml";
    RunSummary summary = drilled(30e-3);
    constexpr double degree = 0.0174532925199433;
    summary.steps[0].broken_limits = {"wall"};
    summary.metrics = {{"pilot-hole.measure.gonial_angle", 1, "pilot-hole", 1, 1, 126.0 * degree, "deg", degree,
                        0.3 * degree, "info", "Between both."},
                       {"pilot-hole.measure.wall", 1, "pilot-hole", 1, 1, 1.5e-3, "mm", 1e-3, 0.02e-3, "broken", ""},
                       {"pilot-hole.measure.depth", 1, "pilot-hole", 1, 1, 7e-3, "mm", 1e-3, 0.02e-3, "info", ""},
                       {"measure.wall.before", 1, "run", 1, 1, 5e-3, "mm", 1e-3, 0.02e-3, "info", ""},
                       {"measure.wall.after", 1, "run", 1, 1, 1.5e-3, "mm", 1e-3, 0.02e-3, "broken", ""}};
    const std::string html = report_html(summary, DrawnRun(), recorded_procedure(text, ""));
    const std::string steps = html.substr(html.find("<h2>Steps"));
    const std::string angle = row_with(html, "at least 120"), wall = row_with(steps, "Wall <code");
    EXPECT_TRUE(holds(angle, "Gonial angle")) << angle;
    EXPECT_TRUE(holds(angle, "126.0 ± 0.3")) << angle;
    EXPECT_TRUE(holds(angle, "✓ reached")) << angle;
    EXPECT_TRUE(holds(wall, "1.50 ± 0.02")) << wall;
    EXPECT_TRUE(holds(wall, "at least 2")) << wall;
    EXPECT_TRUE(holds(wall, "✗ broken")) << wall;
    EXPECT_TRUE(holds(wall, "The wall is thin.")) << wall;
    EXPECT_TRUE(holds(row_with(html, "Floor <code"), "– not measured"));
    EXPECT_TRUE(holds(row_with(html, "measure.depth"), "7.00 ± 0.02")) << "a measure without a limit";
    const std::string measure = row_with(html, "<code>wall</code>");
    EXPECT_TRUE(holds(measure, "5.00 ± 0.02")) << measure;
    EXPECT_TRUE(holds(measure, "1.50 ± 0.02")) << measure;
    EXPECT_TRUE(holds(measure, "✗ broken")) << measure;
}

TEST(Report, ShowsTheEndOfASignalThatIsNearerToItsBound) {
    const char* text = R"yaml(
metadata: {title: Cut}
steps:
  - id: pilot-hole
    goals: [{entry: {}}]
    limits:
      - {signal: {id: twist, at_least: -50 N mm, at_most: 50 N mm}, reason: Twisted.}
)yaml";
    RunSummary summary = drilled(30e-3);
    summary.metrics = {{"pilot-hole.signal.twist", 1, "pilot-hole", 1, 1, 7e-3, "N m", 1.0, 0.0, "ok", ""},
                       {"pilot-hole.signal.twist.least", 1, "pilot-hole", 1, 1, -11e-3, "N m", 1.0, 0.0, "ok", ""}};
    const std::string row = row_with(report_html(summary, DrawnRun(), recorded_procedure(text, "")), "signal.twist");
    EXPECT_TRUE(holds(row, "0.011")) << row;
    EXPECT_TRUE(holds(row, "✓ kept")) << row;
}

TEST(Report, ShowsTheDigitsThatTellAValueFromItsBound) {
    EXPECT_TRUE(holds(row_with(drilled_report(31.000004e-3), "at most 31"), "31.000004"));
    EXPECT_TRUE(holds(row_with(drilled_report(31e-3), "at least 30"), "|31.00 ±"));
}

TEST(Report, ListsAnEventThatBrokeAStep) {
    const std::string row = row_with(drilled_report(31.5e-3), "drilling.bit_overbent");
    EXPECT_TRUE(holds(row, "Drilling bit overbent")) << row;
    EXPECT_TRUE(holds(row, "at 8.5\u00a0s")) << row;
    EXPECT_TRUE(holds(row, "✗ broken")) << row;
}

TEST(Report, StepsThatWereNotReachedAreOneLine) {
    RunSummary summary = drilled(31.5e-3);
    summary.steps.push_back({"insert", "Insert", false, 0.0, 14.0, {}});
    const std::string html = report_html(summary, DrawnRun());
    const std::string line = html.substr(html.find("<h3>Not reached"), 200);
    EXPECT_TRUE(holds(line, "</span> Withdraw, Insert</p>")) << line;
    EXPECT_FALSE(holds(html, "<h3>Withdraw"));
    EXPECT_FALSE(holds(html, "<h3>Insert"));
}

TEST(Report, HasOneRowForEachHoleAndScrew) {
    RunSummary summary = drilled(31.5e-3);
    summary.steps.push_back({"insert", "Insert", true, 13.0, 20.0, {}});
    summary.metrics.push_back(
        {"insert.gertzbein-robbins", 1, "insert", 1, 1, 1e-3, "mm", 1e-3, 0.125e-3, "grade A/B", ""});
    summary.metrics.push_back({"insert.left.pull-out", 1, "insert", 1, 1, 490.15, "N", 1.0, -1.0, "info", ""});
    // Four and a half turns [rad]
    summary.metrics.push_back({"insert.left.turned", 1, "insert", 1, 1, 28.274334, "deg", 0.017453293, -1.0, "", ""});
    const std::string html = report_html(summary, DrawnRun());
    const std::string hole = row_with(html, "<th scope=\"row\">Drill<"),
                      screw = row_with(html, "<th scope=\"row\">Insert<");
    EXPECT_TRUE(holds(hole, "✗ 31.50\u00a0mm") || holds(hole, "✗\u00a031.50\u00a0mm")) << hole;
    EXPECT_TRUE(holds(screw, "A/B")) << screw;
    EXPECT_TRUE(holds(screw, "490\u00a0N")) << screw;
    EXPECT_TRUE(holds(screw, "||4.5||")) << screw;
}

TEST(Report, FoldsTheChecksOfTheSimulation) {
    const std::string html = drilled_report(31.5e-3);
    const std::size_t begin = html.find("<details><summary>Checks of the simulation");
    ASSERT_NE(begin, std::string::npos);
    const std::string checks = html.substr(begin, html.find("</details>", begin) - begin);
    EXPECT_TRUE(holds(checks, "bone.balance"));
    EXPECT_FALSE(holds(checks, "bone.grooves"));
    EXPECT_EQ(count_of(html, "<code>bone.balance</code>"), 1u);
    EXPECT_EQ(count_of(html, "<code>bone.grooves</code>"), 1u);
}

TEST(Report, ReasonsShowNamesAsCode) {
    RunSummary summary = drilled(31.5e-3);
    summary.reasons = {"Step `a<b`: deep.", "One ` alone."};
    const std::string html = report_html(summary, DrawnRun());
    EXPECT_TRUE(holds(html, "<li>Step <code>a&lt;b</code>: deep.</li>"));
    EXPECT_TRUE(holds(html, "<li>One ` alone.</li>"));
}

TEST(Report, HasEachPartOfThePageOnce) {
    const std::string html = synthetic_report();
    EXPECT_FALSE(holds(html, "{{"));
    for (const char* part : {"<h1>", "<style>", "id=\"bone\"", "id=\"plot-depth\"", "id=\"run-data\"", "<footer>"})
        EXPECT_EQ(count_of(html, part), 1u) << part;
    const std::vector<std::string> order{"class=\"reasons", "id=\"bone\"", "<h2>Forces", "<h2>Steps", "<h2>The run<"};
    EXPECT_TRUE(std::ranges::is_sorted(order, {}, [&](const std::string& part) { return html.find(part); }));
}

TEST(Report, ANameOfAPartStaysText) {
    RunSummary summary = drilled(31.5e-3);
    summary.procedure = "{{data}}{{";
    EXPECT_TRUE(holds(report_html(summary, DrawnRun()), "<h1>{{data}}{{</h1>"));
}

TEST(Report, TheDataInItIsJsonWithAllRows) {
    const std::string json = report_data_json(
        test::synthetic_summary(),
        test::drawn_run(test::synthetic_ticks(), test::synthetic_events(), drawn_surface(test::synthetic_bone(16))));
    const auto data = nlohmann::json::parse(json);
    EXPECT_EQ(data["rows"]["count"], 14'000);
    EXPECT_EQ(data["rows"]["time"].get<std::string>().size(), (14'000u * 4 + 2) / 3 * 4);
    EXPECT_EQ(data["events"][2]["detail"], "clearance to <spinal-canal>");
    EXPECT_EQ(data["events"][2]["isBad"], true);
    EXPECT_FALSE(holds(json, "<"));
}

TEST(Report, AZoneThatWasEnteredIsBadNewsAndBoneThatWasEnteredIsNot) {
    const std::vector<EventRow> events{{1, 0.0, "entered_bone", "pilot-hole"}, {2, 0.0, "zone_entered", "canal"}};
    const auto data = nlohmann::json::parse(report_data_json({}, test::drawn_run({}, events)));
    EXPECT_EQ(data["events"][0]["isBad"], false);
    EXPECT_EQ(data["events"][1]["isBad"], true);
}

TEST(Report, EachPictureWithColoursHasALegend) {
    const std::string html = report_html(test::synthetic_summary(), test::drawn_run(test::synthetic_ticks(50)));
    EXPECT_TRUE(holds(html, "Tissue first met at each depth:"));
    EXPECT_TRUE(holds(html, "Tissue under the tip:"));
    EXPECT_EQ(count_of(html, "</i>cortical</span>"), 3u);
}

TEST(Report, AForceScaleIsAFraction) {
    EXPECT_TRUE(holds(report_html(test::synthetic_summary(), DrawnRun()), ">1/20 device newton per bone newton<"));
}

TEST(Report, ShowsControlCharactersAsCodePoints) {
    RunSummary summary = test::synthetic_summary();
    summary.procedure = summary.reasons[0] = "a\033]0;b\a\u009b2J\u202ec";
    const std::string html = report_html(summary, test::drawn_run({}, {{1, 0.0, "x", "\u202ed\x7f"}}));
    EXPECT_EQ(text::printable_lines(html), html);
    EXPECT_TRUE(holds(html, "a\\x1b]0;b\\x07\\x9b2J\\u202ec")) << html.substr(0, 2000);
    EXPECT_TRUE(holds(html, "\"\\u202ed\\u007f\""));
}

TEST(Report, ARunOfNothingStillHasAPage) {
    const std::string html = report_html({}, DrawnRun());
    EXPECT_TRUE(holds(html, "No ticks were recorded."));
    EXPECT_TRUE(holds(html, "… Incomplete"));
}

TEST(Report, AMeshWithNumbersOutOfRangeDoesNotHarm) {
    Mesh mesh = test::synthetic_bone(4);
    mesh.triangles.push_back({0, 1, 99'999});
    const auto data = nlohmann::json::parse(report_data_json({}, test::drawn_run({}, {}, drawn_surface(mesh))));
    const auto whole =
        nlohmann::json::parse(report_data_json({}, test::drawn_run({}, {}, drawn_surface(test::synthetic_bone(4)))));
    EXPECT_EQ(data["mesh"], whole["mesh"]);
}

/// What the page's script computes of numbers, as JavaScript would print it; empty where there is no node to run it.
std::string computed_by_script(const std::string& expression) {
    const std::string html = synthetic_report();
    const std::size_t begin = html.find("const clamp ="), numbers = html.find("// ---- numbers"),
                      end = html.find("// ---- plots");
    EXPECT_TRUE(begin < numbers && numbers < end && end != std::string::npos);
    const test::TemporaryFolder folder;
    std::ofstream(folder / "numbers.js") << html.substr(begin, end - begin) << "\nconsole.log(JSON.stringify("
                                         << expression << "));\n";
    if (std::system(("node " + (folder / "numbers.js") + " > " + (folder / "out") + " 2> /dev/null").c_str()) != 0)
        return "";
    return test::contents_of(folder / "out");
}

TEST(Report, TheNumbersOnAnAxisAreShortHoweverSmallOrLarge) {
    if (computed_by_script("1") != "1\n") GTEST_SKIP() << "there is no node here to run the page's script";
    const auto axis = [](const std::string& low, const std::string& high) {
        return computed_by_script("(({texts, power}) => [texts, axisTitle('thrust', 'N', power)])(roundTicks(" + low +
                                  ", " + high + ", 2))");
    };
    EXPECT_EQ(axis("0", "60"), "[[\"0\",\"50\"],\"thrust in N\"]\n");
    EXPECT_EQ(axis("0", "0.0012"), "[[\"0.000\",\"0.001\"],\"thrust in N\"]\n");
    EXPECT_EQ(axis("0", "1.06e-9"), "[[\"0\",\"1\"],\"thrust in 10⁻⁹ N\"]\n");
    EXPECT_EQ(axis("-2e-16", "2e-16"), "[[\"−200\",\"0\",\"200\"],\"thrust in 10⁻¹⁸ N\"]\n");
    EXPECT_EQ(axis("0", "5e7"), "[[\"0\",\"50\"],\"thrust in 10⁶ N\"]\n");
    EXPECT_EQ(computed_by_script("axisTitle('teeth', '', -6)"), "\"teeth in 10⁻⁶\"\n");
    EXPECT_EQ(computed_by_script("[0, 12.345, -0.02, 1.234e-9].map(sensible)"),
              "[\"0\",\"12.3\",\"−0.0200\",\"1.23\u00a0·\u00a010⁻⁹\"]\n");
}

TEST(Report, LoadsOverDepthNeedNoScript) {
    const std::string html = synthetic_report();
    const std::size_t script = html.find("<div class=\"script\">"), chart = html.find("<svg class=\"chart\"");
    EXPECT_LT(html.find("<polyline class=\"inwards\"", chart), script);
    EXPECT_LT(html.find("<polyline class=\"outwards\"", chart), script);
}

}  // namespace
}  // namespace kerf::session
