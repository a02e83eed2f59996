// SPDX-License-Identifier: Apache-2.0
// Measures of a run: before the first cut, as a goal, as a limit and in the results.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <string>

#include "kerf/units.hpp"
#include "run/scene.h"
#include "session/summary.h"
#include "tests/support/drill_rig.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/watched_run.h"

namespace kerf::run {
namespace {

using namespace literals;

// A plate of 20 mm, whose face z = 10 mm is drilled. The wall beside the hole and the floor under it are known.
const char* const anatomy_text = R"(apiVersion: kerf/v1
kind: Anatomy
metadata: {id: block, title: A block of bone}
phantom: {parts: [{id: block, box: {centre: 0 0 0 mm, size: 20 20 20 mm}}]}
tissues: [{id: bone, density: 1.0 g/cm3}]
landmarks:
  points:
    side: {at: 10 0 6 mm, tolerance: 0.5 mm}
    below: {at: 0 0 -9 mm, tolerance: 0.5 mm}
    edge_1: {at: 10 -8 10 mm, tolerance: 0.5 mm}
    edge_2: {at: 10 8 10 mm, tolerance: 0.5 mm}
  axes:
    way: {from: 0 0 15 mm, to: 0 0 -9 mm, tolerance: 0.5 mm}
    inwards: {from: 15 0 6 mm, to: -9 0 6 mm, tolerance: 0.5 mm}
    upwards: {from: 0 0 -15 mm, to: 0 0 9 mm, tolerance: 0.5 mm}
  planes: {level: {at: 0 0 0 mm, normal: 0 0 1, tolerance: 0.5 mm}, front: {at: 0 0 0 mm, normal: 1 0 0, tolerance: 0.5 mm}}
)";

std::string procedure_text(const std::string& goals, const std::string& limits) {
    return R"(apiVersion: kerf/v1
kind: Procedure
metadata: {id: hole, title: A hole, version: 0.1.0, status: draft}
needs: {landmarks: [way, inwards, upwards, side, below, edge_1, edge_2, level, front]}
anatomy: block.yaml
accuracy: {spacing: 0.5 mm}
haptics: {device: touch}
instruments:
  drill:
    plugin: kerf.drilling
    tool: twist_drill
    force: drill_cutting
    parameters: {diameter: 4 mm}
    drives: {spindle_speed: 1000 rpm}
constructions:
  edge: {tangent: {along: [edge_1, edge_2], in: front, side: superior, within: 5 mm}}
measures:
  wall: {thickness: {at: side, along: inwards}}
  floor: {thickness: {at: below, along: upwards}}
  tilt: {angle: {of: edge, to: level}}
steps:
  - id: drill
    title: Drill
    instrument: drill
    axis: way
    goals: [)" +
           goals + R"(]
)" + (limits.empty() ? "" : "    limits: [" + limits + "]\n") +
           R"(rehearsals:
  - id: deeper
    expect: pass
    hand: {push: 200 N, feed: 4 mm/s, approach: 20 mm/s}
    path: [{depth: -3 mm}, {depth: 6 mm}, {depth: -3 mm}, {depth: 12 mm}, {depth: -3 mm}]
)";
}

struct MeasuredRun {
    test::TemporaryFolder folder;
    text::Diagnostics diagnostics;
    std::optional<Scene> scene;
    test::WatchedRun run;

    MeasuredRun(const std::string& goals, const std::string& limits = "") {
        std::ofstream(folder.path() + "/block.yaml") << anatomy_text;
        std::ofstream(folder.path() + "/hole.yaml") << procedure_text(goals, limits);
        scene = make_scene(folder.path() + "/hole.yaml", "", test::plugins()).take(diagnostics);
        EXPECT_TRUE(scene) << to_text(diagnostics);
        if (scene) run = test::watched_run(*scene, test::plugins(), {});
    }
    [[nodiscard]] const session::MetricRow* metric(const std::string& id) const {
        const auto& all = run.summary.metrics;
        const auto found =
            std::find_if(all.begin(), all.end(), [&](const session::MetricRow& row) { return row.id == id; });
        return found != all.end() ? &*found : nullptr;
    }
    [[nodiscard]] std::string reasons() const {
        std::string text;
        for (const std::string& reason : run.summary.reasons) text += reason + "\n";
        return text;
    }
};

TEST(Measures, AreReadBeforeTheFirstCutAndAtTheEndOfAStep) {
    const MeasuredRun hole("{depth: {at_least: 5 mm}}");
    for (const char* id : {"measure.wall.before", "drill.measure.wall"}) ASSERT_NE(hole.metric(id), nullptr) << id;
    const session::MetricRow &before = *hole.metric("measure.wall.before"), &after = *hole.metric("drill.measure.wall");
    EXPECT_NEAR(before.value, 20.0_mm, 2.0 * before.uncertainty);
    EXPECT_NEAR(after.value, 8.0_mm, 0.2_mm /* the drill wanders a little */);
    EXPECT_EQ(after.unit, "mm");
    EXPECT_GT(after.uncertainty, 0.0);
    EXPECT_EQ(after.status, "info");
    const session::MetricRow* tilt = hole.metric("drill.measure.tilt");
    ASSERT_NE(tilt, nullptr);
    EXPECT_EQ(tilt->unit, "deg");
    EXPECT_NEAR(tilt->value, 0.0, 0.5_deg);
    const std::string json = session::summary_json(hole.run.summary);
    EXPECT_NE(json.find("\"drill.measure.wall\""), std::string::npos);
    EXPECT_NE(json.find("\"measure.wall.before\""), std::string::npos);
    ASSERT_NE(hole.metric("measure.wall.after"), nullptr);
    EXPECT_EQ(hole.metric("measure.wall.after")->value, after.value) << "of the last step";
}

TEST(Measures, BreakALimit) {
    const MeasuredRun thin("{depth: {at_least: 5 mm}}",
                           "{measure: {of: wall, at_least: 9 mm}, reason: The wall is thin.}");
    EXPECT_EQ(thin.run.summary.verdict, session::Verdict::fail);
    ASSERT_EQ(thin.run.summary.steps.size(), 1U);
    EXPECT_EQ(thin.run.summary.steps[0].broken_limits, std::vector<std::string>{"wall"});
    EXPECT_NE(thin.reasons().find("The wall is thin. `wall`: "), std::string::npos) << thin.reasons();
    EXPECT_EQ(thin.metric("drill.measure.wall")->status, "broken");

    const MeasuredRun thick("{depth: {at_least: 5 mm}}",
                            "{measure: {of: wall, at_least: 7 mm}, reason: The wall is thin.}");
    EXPECT_EQ(thick.run.summary.verdict, session::Verdict::pass) << thick.reasons();
    EXPECT_EQ(thick.metric("drill.measure.wall")->status, "ok");
}

TEST(Measures, AreReachedAsAGoalWhenTheToolIsOut) {
    // The first time the tool comes out, 14 mm of floor are left, and the second time 8 mm.
    const MeasuredRun deep("{measure: {of: floor, at_most: 10 mm}}");
    EXPECT_EQ(deep.run.summary.verdict, session::Verdict::pass) << deep.reasons();
    EXPECT_GT(deep.metric("drill.depth")->value, 9.0_mm);
    const auto reached = std::count_if(deep.run.events.begin(), deep.run.events.end(),
                                       [](const session::EventRow& event) { return event.id == "goal_reached"; });
    EXPECT_EQ(reached, 1);

    const MeasuredRun deeper("{measure: {of: floor, at_most: 4 mm}}");
    EXPECT_EQ(deeper.run.summary.verdict, session::Verdict::incomplete);
    EXPECT_NE(deeper.reasons().find("`floor` "), std::string::npos) << deeper.reasons();
    EXPECT_NE(deeper.reasons().find("must be at most 4 mm"), std::string::npos) << deeper.reasons();
}

TEST(Measures, SpreadAtAFoldAndLeaveANarrowLimitUndecided) {
    // The border and the level plane are parallel.
    const MeasuredRun hole("{depth: {at_least: 5 mm}}",
                           "{measure: {of: tilt, at_most: 0.1 deg}, reason: The border is tilted.}");
    const session::MetricRow& tilt = *hole.metric("drill.measure.tilt");
    // Each of two contacts is known to half a voxel / √3, about 20 mm apart.
    EXPECT_GT(tilt.uncertainty, 0.3_deg);
    EXPECT_LT(tilt.uncertainty, 1.5_deg);
    EXPECT_EQ(hole.run.summary.verdict, session::Verdict::pass) << hole.reasons();
    EXPECT_NE(hole.reasons().find("undecided, as the bound lies within the uncertainty: `tilt` "), std::string::npos)
        << hole.reasons();
}

TEST(Measures, GiveTheSameBitsAgain) {
    const MeasuredRun one("{depth: {at_least: 5 mm}}"), other("{depth: {at_least: 5 mm}}");
    EXPECT_EQ(one.run.summary.hash, other.run.summary.hash);
    EXPECT_EQ(one.metric("drill.measure.tilt")->value, other.metric("drill.measure.tilt")->value);
    EXPECT_EQ(one.metric("drill.measure.tilt")->uncertainty, other.metric("drill.measure.tilt")->uncertainty);
}

// Two rods at 120°, the lower one sloping by 25°: a jaw from the left. Gonion, condylion and menton lie on their
// borders.
const char* const jaw_text = R"(apiVersion: kerf/v1
kind: Anatomy
metadata: {id: jaw, title: Two rods}
phantom:
  parts:
    - {id: ramus, tube: {from: 40 0.0000 0.0000 mm, to: 40 4.7936 54.7907 mm, radius: 6 mm}}
    - {id: body, tube: {from: 40 -0.0000 -0.0000 mm, to: 40 -63.4415 -29.5833 mm, radius: 6 mm}}
tissues: [{id: bone, density: 1.0 g/cm3}]
landmarks:
  points:
    gonion: {at: 40 5.6753 -3.9739 mm, tolerance: 1 mm}
    condylion: {at: 40 10.7707 54.2678 mm, tolerance: 1 mm}
    menton: {at: 40 -60.9058 -35.0211 mm, tolerance: 1 mm}
    porion_l: {at: 55 0 70 mm, tolerance: 1 mm}
    porion_r: {at: -55 0 70 mm, tolerance: 1 mm}
    orbitale: {at: 30 -70 70 mm, tolerance: 1 mm}
  axes: {way: {from: 40 -60 10 mm, to: 40 -50 -30 mm, tolerance: 1 mm}}
)";

const char* const jaw_procedure_text = R"(apiVersion: kerf/v1
kind: Procedure
metadata: {id: jaw, title: The angles of a jaw, version: 0.1.0, status: draft}
needs: {landmarks: [way, gonion, condylion, menton, porion_l, porion_r, orbitale]}
anatomy: jaw.yaml
accuracy: {spacing: 0.5 mm}
haptics: {device: touch}
instruments: {drill: {plugin: kerf.drilling, tool: twist_drill, force: drill_cutting, parameters: {diameter: 3 mm}, drives: {spindle_speed: 1000 rpm}}}
constructions:
  sagittal: {mirror: {left: [porion_l], right: [porion_r]}}
  ramus: {tangent: {along: [gonion, condylion], in: sagittal, side: posterior}}
  border: {tangent: {along: [gonion, menton], in: sagittal, side: inferior}}
  frankfort: {plane: [porion_l, porion_r, orbitale]}
measures:
  gonial_angle: {angle: {of: ramus, to: border}}
  mandibular_plane: {angle: {of: border, to: frankfort, in: sagittal}}
steps:
  - {id: drill, title: Drill, instrument: drill, axis: way, goals: [{depth: {at_least: 5 mm}}]}
rehearsals:
  - {id: expert, expect: pass, path: [{depth: -3 mm}, {depth: 6 mm}, {depth: -3 mm}]}
)";

TEST(Measures, GiveTheAnglesOfAJaw) {
    const test::TemporaryFolder folder;
    std::ofstream(folder.path() + "/jaw.yaml") << jaw_text;
    std::ofstream(folder.path() + "/procedure.yaml") << jaw_procedure_text;
    text::Diagnostics diagnostics;
    const auto scene = make_scene(folder.path() + "/procedure.yaml", "", test::plugins()).take(diagnostics);
    ASSERT_TRUE(scene) << to_text(diagnostics);
    ASSERT_EQ(scene->measured_before.size(), 2U);
    const documents::MeasureReading &gonial = scene->measured_before[0], &plane = scene->measured_before[1];
    ASSERT_TRUE(gonial.value && plane.value) << gonial.why_not << plane.why_not;
    EXPECT_NEAR(*gonial.value, 120.0_deg, gonial.uncertainty);
    EXPECT_NEAR(*plane.value, 25.0_deg, plane.uncertainty);
    EXPECT_LT(gonial.uncertainty, 1.0_deg);
    EXPECT_LT(plane.uncertainty, 1.5_deg);
}

}  // namespace
}  // namespace kerf::run
