// SPDX-License-Identifier: Apache-2.0
// Waypoints that several rehearsals follow: what is read, and where errors are reported.
#include "documents/waypoint_nodes.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "documents/check_needs.h"
#include "documents/read_procedure.h"
#include "kerf/units.hpp"
#include "tests/documents/catalog.h"
#include "tests/documents/marked_text.h"
#include "text/codes.h"

namespace kerf::documents {
namespace {

using namespace literals;

// Two rehearsals follow the same two paths. Each test changes one thing.
const std::string faultless = R"(apiVersion: kerf/v1
kind: Procedure
metadata: {id: hole, title: A hole, version: 0.1.0, status: draft}
needs: {landmarks: [pedicle, midline]}
anatomy: anatomy/bone.yaml
haptics: {device: touch}
instruments:
  pilot: {plugin: kerf.drilling, tool: twist_drill, force: drill_cutting}
steps:
  - {id: first, title: Drill, instrument: pilot, axis: pedicle, goals: [{entry: {}}]}
  - {id: second, title: Drill on, instrument: pilot, axis: pedicle, goals: [{entry: {}}]}
paths:
  drill:
    - {depth: -5 mm}
    - {depth: 32 mm, drives: {spindle_speed: 500 rpm}}
  leave: [{step: second, depth: -20 mm}, {depth: -30 mm}]
rehearsals:
  - id: expert
    expect: pass
    path: [{follow: drill}, {depth: 3 mm}, {follow: leave}, {depth: -40 mm}]
  - id: again
    expect: pass
    path: [{follow: drill}, {follow: drill}]
variants:
  deep: {patch: {paths.drill: [{depth: -5 mm}, {depth: 50 mm}]}}
)";

std::optional<Procedure> read(const std::string& text, text::Diagnostics& diagnostics,
                              const ProcedureChanges& changes = {}) {
    return read_procedure_text("hole.yaml", text, drilling_catalog(), changes).take(diagnostics);
}

std::vector<double> depths(const Rehearsal& rehearsal) {
    std::vector<double> all;
    for (const Waypoint& waypoint : rehearsal.path) all.push_back(waypoint.depth);
    return all;
}

void expect_refused(text::Code code, const std::string& from, const std::string& to) {
    SCOPED_TRACE(to);
    const MarkedText marked(replaced(faultless, from, to));
    text::Diagnostics diagnostics;
    EXPECT_FALSE(read(marked.text, diagnostics));
    expect_only(code, marked, diagnostics);
}

TEST(Paths, StandForTheirWaypointsWhereTheyAreFollowed) {
    text::Diagnostics diagnostics;
    const auto procedure = read(faultless, diagnostics);
    ASSERT_TRUE(procedure) << to_text(diagnostics);
    EXPECT_TRUE(diagnostics.empty()) << to_text(diagnostics);
    EXPECT_EQ(depths(procedure->rehearsals[0]),
              (std::vector<double>{-5.0_mm, 32.0_mm, 3.0_mm, -20.0_mm, -30.0_mm, -40.0_mm}));
    EXPECT_EQ(depths(procedure->rehearsals[1]), (std::vector<double>{-5.0_mm, 32.0_mm, -5.0_mm, 32.0_mm}));
    EXPECT_EQ(procedure->rehearsals[1].path[3].inputs.size(), 1u);
}

TEST(Paths, PassTheStepOnToTheWaypointsBehind) {
    text::Diagnostics diagnostics;
    const auto procedure = read(faultless, diagnostics);
    ASSERT_TRUE(procedure) << to_text(diagnostics);
    std::vector<std::size_t> steps;
    for (const Waypoint& waypoint : procedure->rehearsals[0].path) steps.push_back(waypoint.step);
    EXPECT_EQ(steps, (std::vector<std::size_t>{0, 0, 0, 1, 1, 1}));
}

TEST(Paths, LeadEachWaypointToItsNode) {
    text::Diagnostics diagnostics;
    const auto procedure = read(faultless, diagnostics);
    ASSERT_TRUE(procedure) << to_text(diagnostics);
    const std::vector<const Node*> nodes = waypoint_nodes(*procedure->document, std::size_t{0});
    ASSERT_EQ(nodes.size(), procedure->rehearsals[0].path.size());
    std::vector<std::string> texts;
    for (const Node* node : nodes) texts.push_back(node->find("depth")->text);
    EXPECT_EQ(texts, (std::vector<std::string>{"-5 mm", "32 mm", "3 mm", "-20 mm", "-30 mm", "-40 mm"}));
    EXPECT_TRUE(waypoint_nodes(*procedure->document, std::size_t{2}).empty()) << "there is no third rehearsal";
}

TEST(Paths, AreChangedByAVariant) {
    text::Diagnostics diagnostics;
    const auto procedure = read(faultless, diagnostics, {.variant = "deep", .settings = {}});
    ASSERT_TRUE(procedure) << to_text(diagnostics);
    EXPECT_EQ(procedure->rehearsals[0].path[1].depth, 50.0_mm);
    EXPECT_EQ(procedure->rehearsals[1].path[3].depth, 50.0_mm);
}

TEST(Paths, ReportAnErrorOnceAtTheirOwnLine) {
    expect_refused(text::Code::missing_unit, "{depth: 32 mm, drives", "{depth: «32», drives");
    expect_refused(text::Code::unknown_key, "{depth: 32 mm, drives", "{depth: 32 mm, «medail»: 1 mm, drives");
    expect_refused(text::Code::unknown_drive, "{spindle_speed: 500 rpm}", "{«jaws»: 1}");
    expect_refused(text::Code::unknown_step, "{step: second,", "{step: «secnd»,");
}

TEST(Paths, ReportAnErrorThatNoRehearsalFollows) {
    const MarkedText marked(replaced(replaced(faultless, "{follow: leave}, ", ""), "{step: second, depth: -20 mm}",
                                     "{step: second, depth: «-20 N»}"));
    text::Diagnostics diagnostics;
    EXPECT_FALSE(read(marked.text, diagnostics));
    ASSERT_EQ(diagnostics.size(), 2u) << to_text(diagnostics);
    EXPECT_EQ(diagnostics[0].code, "E0404");
    EXPECT_EQ(diagnostics[0].place.line, marked.line);
    EXPECT_EQ(diagnostics[0].place.column, marked.column);
    EXPECT_EQ(diagnostics[1].code, "W0316");
}

TEST(Paths, ListTheNamesThatThereAre) {
    const MarkedText marked(replaced(faultless, "{follow: leave}", "{follow: «leve»}"));
    text::Diagnostics diagnostics;
    EXPECT_FALSE(read(marked.text, diagnostics));
    expect_only(text::Code::unknown_path, marked, diagnostics);
    EXPECT_EQ(diagnostics[0].message, "The path `leve` is unknown: expected `drill` or `leave`.");
    EXPECT_EQ(diagnostics[0].write, "leave");
}

TEST(Paths, AreNamedInAWarningIfNothingFollowsThem) {
    const MarkedText marked(replaced(replaced(faultless, "{follow: leave}, ", ""), "  leave: [", "  «leave»: ["));
    text::Diagnostics diagnostics;
    EXPECT_TRUE(read(marked.text, diagnostics));
    ASSERT_EQ(diagnostics.size(), 1u) << to_text(diagnostics);
    EXPECT_EQ(diagnostics[0].code, "W0316");
    EXPECT_EQ(diagnostics[0].place.line, marked.line);
}

TEST(Paths, MayBeUnusedWithoutRehearsals) {
    text::Diagnostics diagnostics;
    EXPECT_TRUE(read(faultless, diagnostics, {.variant = "", .settings = {"rehearsals=~"}}));
    EXPECT_TRUE(diagnostics.empty()) << to_text(diagnostics);
}

TEST(Paths, CannotFollowOneAnother) {
    expect_refused(text::Code::unknown_key, "{depth: -30 mm}]", "{depth: -30 mm}, {«follow»: drill}]");
}

TEST(Paths, AFollowedPathHasNoOtherKeys) {
    expect_refused(text::Code::unknown_key, "[{follow: drill}, {depth: 3 mm}",
                   "[{follow: drill, «push»: 20 N}, {depth: 3 mm}");
}

TEST(Paths, AMisspeltFollowIsCorrected) {
    const MarkedText marked(replaced(faultless, "{follow: leave}", "{«folow»: leave}"));
    text::Diagnostics diagnostics;
    EXPECT_FALSE(read(marked.text, diagnostics));
    expect_only(text::Code::unknown_key, marked, diagnostics);
    EXPECT_EQ(diagnostics[0].write, "follow:");
}

TEST(Paths, AMapOfListsIsNeeded) {
    expect_refused(text::Code::wrong_shape, "  leave: [{step: second, depth: -20 mm}, {depth: -30 mm}]",
                   "  leave: «{»step: second, depth: -20 mm}");
    expect_refused(text::Code::malformed_word, "  leave: [", "  leave: [{depth: 1 mm}]\n  «to leave»: [");
}

// A document of a few hundred lines must not become millions of waypoints.
TEST(Paths, RefuseToBecomeAHugeRehearsal) {
    std::string waypoints, follows;
    for (int i = 0; i < 200; ++i) {
        waypoints += "{depth: 1 mm}, ";
        follows += "{follow: drill}, ";
    }
    const std::string text =
        replaced(replaced(faultless, "    - {depth: -5 mm}\n    - {depth: 32 mm, drives: {spindle_speed: 500 rpm}}\n",
                          "    [" + waypoints + "{depth: 2 mm}]\n"),
                 "    path: [{follow: drill}, {follow: drill}]", "    path: [" + follows + "{depth: 2 mm}]");
    text::Diagnostics diagnostics;
    EXPECT_FALSE(read(text, diagnostics));
    ASSERT_EQ(diagnostics.size(), 1u) << to_text(diagnostics);
    EXPECT_EQ(diagnostics[0].code, "E0412");
    EXPECT_EQ(diagnostics[0].place.line, 22);
}

TEST(Paths, AnUnmetNeedIsReportedInThePath) {
    // `aside` needs the plane of a step; the anatomy has no midline
    const MarkedText marked(replaced(faultless, "{depth: -30 mm}]", "{depth: -30 mm, «aside»: 2 mm}]"));
    text::Diagnostics diagnostics;
    const auto procedure = read(marked.text, diagnostics);
    ASSERT_TRUE(procedure) << to_text(diagnostics);
    Anatomy anatomy;
    anatomy.axes = {{"pedicle", {}, {0, 0, 1}, 0.0}};
    anatomy.points = {{"midline", {}, 0.0}};
    check_needs(*procedure, anatomy, diagnostics);
    expect_only(text::Code::needs_plane, marked, diagnostics);
}

}  // namespace
}  // namespace kerf::documents
