// SPDX-License-Identifier: Apache-2.0
// The pictures of report.html that need no script: loads of each step over depth, and the timeline.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "session/report/force_charts.h"
#include "session/report/place_labels.h"
#include "session/report/report.h"
#include "session/report/report_data.h"
#include "session/report/report_score.h"
#include "session/report/report_zones.h"
#include "session/report/step_series.h"
#include "session/report/timeline.h"
#include "synthetic_run.h"

namespace kerf::session {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

// ---- labels

TEST(PlaceLabels, NoTwoMeetInACrowd) {
    const Rect frame{0, 0, 400, 300};
    const Rect taken{190, 140, 20, 20};
    std::vector<Label> labels;
    for (int i = 0; i < 40; ++i) labels.push_back({200.0 + i % 3, 150.0, 30.0 + i, 14.0});

    const auto places = place_labels(labels, frame, {taken});

    ASSERT_EQ(places.size(), labels.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        ASSERT_TRUE(places[i]) << i;
        EXPECT_FALSE(do_meet(*places[i], taken)) << i;
        EXPECT_GE(places[i]->left, 0.0) << i;
        EXPECT_LE(places[i]->left + places[i]->width, 400.0) << i;
        EXPECT_GE(places[i]->top, 0.0) << i;
        EXPECT_LE(places[i]->top + places[i]->height, 300.0) << i;
        for (std::size_t other = 0; other < i; ++other)
            EXPECT_FALSE(do_meet(*places[i], *places[other])) << i << " and " << other;
    }
}

TEST(PlaceLabels, PutsASingleLabelRightOfItsPoint) {
    const Label label{50, 50, 40, 10};
    const auto places = place_labels({&label, 1}, {0, 0, 200, 100});
    ASSERT_TRUE(places[0]);
    EXPECT_DOUBLE_EQ(places[0]->left, 56.0);
    EXPECT_DOUBLE_EQ(places[0]->top, 45.0);
}

TEST(PlaceLabels, LeavesOutALabelWithoutSpace) {
    const std::vector<Label> labels{{50, 50, 90, 90}, {50, 50, 90, 90}};
    const auto places = place_labels(labels, {0, 0, 200, 100});
    EXPECT_TRUE(places[0]);
    EXPECT_FALSE(places[1]);
}

TEST(PlaceLabels, CountsLettersNotBytes) { EXPECT_DOUBLE_EQ(text_width("µm", 10.0), text_width("mm", 10.0)); }

// ---- strokes

std::vector<TickRow> rows_at(const std::vector<double>& depths_mm, int step = 0) {
    std::vector<TickRow> rows(depths_mm.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].step = step;
        rows[i].time = static_cast<double>(i);
        rows[i].depth = depths_mm[i] * 1e-3;
    }
    return rows;
}

TEST(Strokes, EndAtTheTurningPoint) {
    const std::vector<Stroke> strokes = strokes_of(rows_at({-2, 0, 3, 6, 4, 1, 2, 5}));
    EXPECT_EQ(strokes, (std::vector<Stroke>{{0, 3, true}, {3, 5, false}, {5, 7, true}}));
}

TEST(Strokes, TremorDoesNotEndOne) {
    const std::vector<Stroke> strokes = strokes_of(rows_at({0, 1, 0.8, 2, 1.7, 3, 2.6, 4}));
    EXPECT_EQ(strokes, (std::vector<Stroke>{{0, 7, true}}));
}

TEST(Strokes, BeginOutwardsIfTheToolIsWithdrawn) {
    EXPECT_EQ(strokes_of(rows_at({9, 5, 1})), (std::vector<Stroke>{{0, 2, false}}));
    EXPECT_TRUE(strokes_of({}).empty());
}

TEST(SeriesByStep, HasTheRowsOfEachStepAlone) {
    std::vector<TickRow> rows = rows_at({0, 1, 2}, 0);
    for (const int step : {-1, 1})
        for (const TickRow& row : rows_at({5, 6, 7}, step)) rows.push_back(row);
    const std::vector<StepSeries> series = series_by_step(rows);
    ASSERT_EQ(series.size(), 2u);
    EXPECT_EQ(series[0].rows.size(), 3u);
    EXPECT_EQ(series[1].step, 1u);
    EXPECT_EQ(series[1].first, 7u) << "the tool changes in the first tick of a step";
    EXPECT_EQ(series[1].rows.size(), 2u);
}

// ---- charts

RecordedStep demanding_step() {
    RecordedStep step;
    step.id = "pilot-hole";
    step.goals = {{.quantity = "depth", .at_least = 30e-3, .unit = "mm"}};
    step.limits = {{.quantity = "thrust", .at_most = 40.0, .unit = "N"},
                   {.quantity = "torque", .at_most = 5.0, .unit = "N m"},
                   {.quantity = "depth", .at_most = 38e-3, .unit = "mm"}};
    return step;
}

RunSummary two_steps() {
    RunSummary summary = test::synthetic_summary();
    summary.deductions = {{.step = "pilot-hole", .kind = "limit", .name = "thrust", .at = 5.0, .loss = 4.0},
                          {.step = "pilot-hole", .kind = "limit", .name = "canal", .at = 11.4, .loss = 20.0}};
    return summary;
}

std::string charts_of(const RunSummary& summary, const DrawnRun& run) {
    RecordedProcedure procedure;
    procedure.steps = {demanding_step()};
    return force_charts_html(summary, run, procedure, moments_of(summary));
}

TEST(ForceCharts, EachHasItsOwnLegend) {
    const std::string html = charts_of(two_steps(), test::drawn_run(test::synthetic_ticks()));
    const std::size_t charts = count_of(html, "<svg class=\"chart\"");
    EXPECT_EQ(charts, 4u) << "thrust and torque of two steps";
    EXPECT_EQ(count_of(html, "<figcaption class=\"legend\">"), charts);
    EXPECT_EQ(count_of(html, "></i>moving in</span>"), 2u) << "the bit only goes in during the first step";
    EXPECT_EQ(count_of(html, "></i>moving out</span>"), 2u) << "and only out during the second";
}

TEST(ForceCharts, NameTheirLimits) {
    const std::string html = charts_of(two_steps(), test::drawn_run(test::synthetic_ticks()));
    EXPECT_TRUE(has(html, "<text class=\"name limit\""));
    EXPECT_TRUE(has(html, ">limit 40\u00a0N</text>"));
    EXPECT_TRUE(has(html, ">goal from 30\u00a0mm</text>"));
    EXPECT_TRUE(has(html, ">limit 38\u00a0mm</text>"));
    EXPECT_FALSE(has(html, ">limit 5000\u00a0N·mm</text>")) << "it would flatten the curve";
    EXPECT_TRUE(has(html, "limit 5000\u00a0N·mm, far above the picture</span>"));
}

TEST(ForceCharts, DrawALimitUpToThreeTimesTheGreatestLoad) {
    const std::vector<TickRow> rows = test::synthetic_ticks(3'000);
    double thrust = 0.0, torque = 0.0;
    for (const TickRow& row : rows) {
        if (row.step != 0) continue;
        thrust = std::max(thrust, row.thrust);
        torque = std::max(torque, std::abs(row.torque));
    }
    for (const auto& [times, is_far] : {std::pair{2.0, false}, {4.0, true}}) {
        RecordedProcedure procedure;
        procedure.steps.resize(1);
        procedure.steps[0].id = "pilot-hole";
        procedure.steps[0].limits = {{.quantity = "thrust", .at_most = times * thrust, .unit = "N"},
                                     {.quantity = "torque", .at_most = times * torque, .unit = "N m"}};
        const std::string html = force_charts_html(two_steps(), test::drawn_run(rows), procedure, {});
        EXPECT_EQ(count_of(html, "far above the picture"), is_far ? 2u : 0u) << times;
        EXPECT_EQ(count_of(html, "<text class=\"name limit\""), is_far ? 0u : 2u) << times;
    }
}

TEST(ForceCharts, ShowDeductionsAtTheirMoments) {
    const std::string html = charts_of(two_steps(), test::drawn_run(test::synthetic_ticks()));
    EXPECT_EQ(count_of(html, "<text class=\"number-in\""), 4u) << "two moments in each picture of the first step";
}

TEST(ForceCharts, LeaveOutAStepThatMetNoBone) {
    std::vector<TickRow> rows = test::synthetic_ticks();
    for (TickRow& row : rows)
        if (row.step == 1) row.modelled = {};
    const std::string html = charts_of(two_steps(), test::drawn_run(rows));
    EXPECT_EQ(count_of(html, "<svg class=\"chart\""), 2u);
    EXPECT_TRUE(has(html, "Steps that were not reached: Withdraw the bit."));
}

// ---- zones

RunSummary with_canal(double clearance) {
    RunSummary summary = test::synthetic_summary();
    summary.zones = {{"spinal_canal", drawn_surface(test::synthetic_bone(4))}};
    summary.approaches = {{"pilot-hole", "spinal_canal", clearance, 11.4, {1e-3, 0, 0}},
                          {"withdraw", "spinal_canal", 5e-3, 13.0, {9e-3, 0, 0}}};
    return summary;
}

TEST(Zones, AreInThePictureWithNameColourAndMark) {
    const DrawnSurface bone = drawn_surface(test::synthetic_bone(8));
    const RunSummary summary = with_canal(-0.4e-3);
    const std::string html = report_html(summary, test::drawn_run({}, {}, bone));
    EXPECT_TRUE(has(html, "background:" + std::string(zone_colour(0)) + "\"></i>spinal canal</span>"));
    EXPECT_TRUE(has(html, "✗ 0.4\u00a0mm inside spinal canal</span>"));

    const auto data = nlohmann::json::parse(report_data_json(summary, test::drawn_run({}, {}, bone)));
    ASSERT_EQ(data["zones"].size(), 1u);
    EXPECT_EQ(data["zones"][0]["name"], "spinal canal");
    EXPECT_FALSE(data["zones"][0]["triangles"].get<std::string>().empty());
    ASSERT_EQ(data["approaches"].size(), 1u) << "the step that stayed farther away has no mark";
    EXPECT_NEAR(data["approaches"][0]["at"][0].get<double>(), 1.0 - 1e3 * bone.centre.x, 1e-9);
    EXPECT_EQ(data["approaches"][0]["isBad"], true);
}

TEST(Zones, ShowTheSmallestClearanceIfNoneWasEntered) {
    EXPECT_TRUE(has(approaches_html(with_canal(1.5e-3)), "ok\">○ 1.5\u00a0mm from spinal canal</span>"));
}

TEST(Zones, MarkAnApproachThatBreaksALimitAsBad) {
    RunSummary summary = with_canal(1.5e-3);
    MetricRow clearance;
    clearance.id = "pilot-hole.clearance.spinal_canal";
    clearance.scope = "pilot-hole";
    clearance.value = 1.5e-3;
    clearance.status = "broken";
    summary.metrics.push_back(clearance);
    EXPECT_TRUE(has(approaches_html(summary), "broken\">✗ 1.5\u00a0mm from spinal canal</span>"));
}

TEST(Zones, ARunWithoutThemHasNoLegend) {
    EXPECT_EQ(zone_legend_html(test::synthetic_summary()), "");
    EXPECT_EQ(approaches_html(test::synthetic_summary()), "");
}

// ---- the timeline

TEST(Timeline, NumbersDeductionsByTheirLoss) {
    const std::vector<Moment> moments = moments_of(two_steps());
    ASSERT_EQ(moments.size(), 2u);
    EXPECT_EQ(moments[0].numbers, "1");
    EXPECT_DOUBLE_EQ(moments[0].time, 11.4);
    EXPECT_DOUBLE_EQ(moments[1].time, 5.0);
}

TEST(Timeline, GivesDeductionsAtOneMomentOneMark) {
    RunSummary summary = two_steps();
    for (DeductionRow& row : summary.deductions) row.at = 5.0;
    const std::vector<Moment> moments = moments_of(summary);
    ASSERT_EQ(moments.size(), 1u);
    EXPECT_EQ(moments[0].numbers, "1, 2");
    EXPECT_GT(mark_width(moments[0]), mark_height);
    EXPECT_TRUE(has(timeline_svg(summary, moments, 360), ">1, 2</text>"));
}

// Of 20 s, in a picture of 224 px with margins of 12 px, a second is 10 px.
TEST(Timeline, DrawsStepsFromTheirStartToTheirEnd) {
    RunSummary summary;
    summary.duration = 20.0;
    summary.steps = {
        {"a", "", true, 0.0, 5.0, {}}, {"b", "", false, 5.0, 8.0, {}}, {"c", "", true, 8.0, 20.0, {"depth"}}};
    const std::string svg = timeline_svg(summary, {{"1", 15.0}}, 224);
    EXPECT_TRUE(has(svg, "<rect class=\"step done\" x=\"12.0\" y=\"34.0\" width=\"48.5\""));
    EXPECT_TRUE(has(svg, "<rect class=\"step open\" x=\"62.0\" y=\"34.0\" width=\"28.5\""));
    EXPECT_TRUE(has(svg, "<rect class=\"step broken\" x=\"92.0\" y=\"34.0\" width=\"118.5\""));
    EXPECT_TRUE(has(svg, "<path class=\"moment\" d=\"M162.0 30.0V58.0\"/>"));
}

TEST(Timeline, LeavesOutDeductionsThatRoundToNothing) {
    RunSummary summary;
    summary.deductions = {{.kind = "goal", .loss = 0.04}, {.kind = "goal", .loss = 0.06}, {.kind = "run", .loss = 3.0}};
    const std::vector<DeductionRow> rows = listed_deductions(summary);
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].loss, 3.0);
    EXPECT_EQ(rows[1].loss, 0.06);
}

TEST(Timeline, HasAMarkForEachMomentThatTheTableLinksTo) {
    const RunSummary summary = two_steps();
    const std::string html = score_html(summary, test::drawn_run(test::synthetic_ticks()));
    EXPECT_TRUE(has(html, "id=\"moments\""));
    EXPECT_TRUE(has(html, "href=\"#moments\" data-time=\"11.4\">1</a>"));
    EXPECT_TRUE(has(html, "href=\"#moments\" data-time=\"5\">2</a>"));
    const std::string svg = timeline_svg(summary, moments_of(summary), 360);
    EXPECT_EQ(count_of(svg, "<text class=\"number-in\""), 2u);
    EXPECT_TRUE(has(svg, ">pilot-hole</text>"));
}

TEST(Timeline, ShowsStepsNotReachedAsOneRow) {
    RunSummary summary = two_steps();
    for (const char* id : {"tap", "insert"}) {
        summary.steps.push_back({id, id, false, 0.0, 14.0, {}});
        summary.deductions.push_back({.step = id, .kind = "step", .loss = 1.5});
    }
    const std::string html = score_html(summary, test::drawn_run(test::synthetic_ticks()));
    EXPECT_EQ(count_of(html, "<tr><th scope=\"row\">"), 3u);
    EXPECT_TRUE(has(html, "Steps that were not reached<p class=\"soft small\">tap, insert</p>"));
    EXPECT_TRUE(has(html, ">−3</td>"));
}

}  // namespace
}  // namespace kerf::session
