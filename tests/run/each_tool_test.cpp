// SPDX-License-Identifier: Apache-2.0
// Each tool once in bone: a run of a second, saved and replayed. What the tools do in whole operations is judged
// elsewhere; here a fault that touches every tool is found in seconds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <ostream>
#include <string>
#include <vector>

#include "app/replay.h"
#include "session/content_hash.h"
#include "session/read_session.h"
#include "tests/support/operation.h"
#include "tests/support/temporary_folder.h"

namespace kerf::run {
namespace {

/// How a tool is used in the block.
struct Use {
    std::string plugin, tool, force;
    std::string instrument;  ///< further keys of the instrument
    std::string path;        ///< of its step
    bool needs_hole = false;
    bool removes_bone = true;  ///< not a thread: its grooves are counted apart
    session::Verdict verdict = session::Verdict::pass;
};
void PrintTo(const Use& use, std::ostream* out) { *out << use.plugin << "/" << use.tool; }

std::vector<Use> uses() {
    const std::string in_and_out = "{step: work, depth: -1 mm}, {depth: 1.5 mm}, {depth: -1 mm}";
    const std::string turned_in = "{step: work, depth: -1 mm}, {depth: 3 mm, turn: {by: 4 turns, speed: 120 rpm}";
    const std::string released = turned_in + ", do: release}";
    const std::string turned_out = turned_in + "}, {depth: -2 mm, turn: {by: -5 turns, speed: 120 rpm}}";
    const std::string thread =
        "parameters: {outer_diameter: 4 mm, core_diameter: 3 mm, pitch: 1.75 mm, thread_length: 12 mm}";
    return {
        {"kerf.drilling", "twist_drill", "drill_cutting", "drives: {spindle_speed: 1000 rpm}", in_and_out},
        {"kerf.drilling", "step_drill", "drill_cutting", "drives: {spindle_speed: 1000 rpm}", in_and_out},
        {"kerf.drilling", "profile_drill", "drill_cutting", "drives: {spindle_speed: 1000 rpm}", in_and_out},
        {"kerf.sawing", "oscillating_blade", "saw_cutting", "drives: {stroke_rate: 12000 1/min}", in_and_out},
        {"kerf.sawing", "reciprocating_blade", "reciprocating_cutting", "drives: {stroke_rate: 15000 1/min}",
         in_and_out},
        {"kerf.burring", "round_burr", "burr_cutting", "drives: {spindle_speed: 50000 rpm}", in_and_out},
        {"kerf.burring", "cylindrical_burr", "burr_cutting", "drives: {spindle_speed: 50000 rpm}", in_and_out},
        {"kerf.burring", "pear_burr", "burr_cutting", "drives: {spindle_speed: 50000 rpm}", in_and_out},
        {"kerf.implant", "tap", "screw_insertion", thread, turned_out, true, false},
        {"kerf.implant", "pedicle_screw", "screw_insertion", thread, released, true, false},
        {"kerf.implant", "bone_screw", "screw_insertion", thread, released, true, false},
        {"kerf.implant", "dental_implant", "screw_insertion", thread, released, true, false},
        {"kerf.core", "forceps", "grasp", "drives: {jaws: 0}",
         "{step: work, depth: -1 mm}, {depth: 0.3 mm, drives: {jaws: 1}}, {depth: 0.2 mm, drives: {jaws: 0}}", false,
         false, session::Verdict::incomplete},
    };
}

std::string procedure_with(const Use& use) {
    const std::string tool =
        "{plugin: " + use.plugin + ", tool: " + use.tool + ", force: " + use.force + ", " + use.instrument + "}";
    const std::string drill =
        "  drill: {plugin: kerf.drilling, tool: twist_drill, force: drill_cutting, parameters: {diameter: 3 mm},\n"
        "          drives: {spindle_speed: 1000 rpm}}\n";
    const std::string step = "  - {id: work, title: Work, instrument: tool, axis: down,\n     " +
                             std::string(use.needs_hole ? "" : "feed: 2 mm/s, ") +
                             "goals: [{depth: {at_least: 0.1 mm}}]}\n";
    const std::string hole = "  - {id: hole, title: Drill a hole, instrument: drill, axis: down, feed: 2 mm/s,\n"
                             "     goals: [{depth: {at_least: 4 mm}}]}\n";
    return "apiVersion: kerf/v1\nkind: Procedure\n"
           "metadata: {id: trial, title: One tool in a block, version: 0.1.0, status: draft}\n"
           "needs: {landmarks: [down], tissues: [bone]}\n"
           "anatomy: block.yaml\naccuracy: {spacing: 0.5 mm}\n"
           "haptics: {device: premium-1.5-6dof, working_force: 20 N}\ninstruments:\n" +
           (use.needs_hole ? drill : "") + "  tool: " + tool + "\nsteps:\n" + (use.needs_hole ? hole : "") + step +
           "rehearsals:\n  - id: expert\n    expect: " + std::string(to_text(use.verdict)) +
           "\n"
           "    hand: {feed: 4 mm/s, approach: 30 mm/s, push: 60 N, reaction: 150 ms}\n    path: [" +
           (use.needs_hole ? "{step: hole, depth: -1 mm}, {depth: 5 mm}, {depth: -1 mm}, " : "") + use.path + "]\n";
}

constexpr const char* block = "apiVersion: kerf/v1\nkind: Anatomy\nmetadata: {id: block, title: A block of bone}\n"
                              "phantom: {parts: [{id: block, box: {centre: 0 0 0 mm, size: 30 30 16 mm}}]}\n"
                              "tissues: [{id: bone, density: 0.4 g/cm3}]\n"
                              "landmarks: {axes: {down: {from: 0 0 15 mm, to: 0 0 -7 mm, tolerance: 1 mm}}}\n";

class EachTool : public testing::TestWithParam<Use> {};

TEST_P(EachTool, WorksIsSavedAndReplays) {
    // Given a block of bone and the tool
    const Use& use = GetParam();
    const test::TemporaryFolder folder;
    std::ofstream(folder / "block.yaml") << block;
    std::ofstream(folder / "trial.yaml") << procedure_with(use);
    const Scene scene = test::scene_of(folder / "trial.yaml");

    // When a hand goes in and out again, and its session is replayed
    RunRequest request;
    request.rehearsal = "expert";
    request.out = folder / "run";
    const test::WatchedRun run = test::watched_run(scene, test::plugins(), request);
    ASSERT_EQ(run.error, "");
    std::string error;
    const auto recorded = session::read_session(request.out + "/session.db", error);
    ASSERT_TRUE(recorded) << error;
    RunRequest again;
    ASSERT_EQ(app::repeat(*recorded, "session.db", again), "");
    const test::WatchedRun replayed = test::watched_run(scene, test::plugins(), again);

    // Then it met bone, the record is whole, and the replay ends in the same bits
    EXPECT_EQ(run.summary.verdict, use.verdict) << test::reasons_of(run);
    double force = 0.0, torque = 0.0, removed_before = 0.0;
    const std::int32_t work = use.needs_hole ? 1 : 0;  // the step
    for (const session::TickRow& row : run.ticks) {
        if (use.needs_hole && row.step == 0) removed_before = row.removed;
        if (row.step != work) continue;
        force = std::max(force, length(linear(row.modelled)));
        torque = std::max(torque, std::abs(row.torque));
    }
    EXPECT_TRUE(force > 0.1 || torque > 1e-4) << force << " N, " << torque << " N m";
    EXPECT_EQ(run.summary.removed > removed_before, use.removes_bone);
    EXPECT_EQ(recorded->rows, session::RecordCheck::same);
    EXPECT_EQ(recorded->hash, session::hex16(run.summary.hash));
    EXPECT_EQ(recorded->device_from_handle.size(), run.ticks.size());
    EXPECT_EQ(replayed.summary.hash, run.summary.hash);
}

INSTANTIATE_TEST_SUITE_P(Of, EachTool, testing::ValuesIn(uses()), [](const auto& of) { return of.param.tool; });

TEST(EachToolOfThePlugins, IsTriedHere) {
    for (const ComponentInfo& component : test::plugins().catalog()) {
        if (component.kind != KERF_KIND_TOOL) continue;
        const auto all = uses();
        EXPECT_TRUE(
            std::any_of(all.begin(), all.end(),
                        [&](const Use& use) { return use.plugin == component.plugin && use.tool == component.id; }))
            << component.plugin << "/" << component.id << ": add a row to uses()";
    }
}

}  // namespace
}  // namespace kerf::run
