// SPDX-License-Identifier: Apache-2.0
// Constructions and measures as they are written, and what is refused.
#include "documents/read_measures.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <utility>

#include "documents/check_needs.h"
#include "documents/read_anatomy.h"
#include "documents/read_procedure.h"
#include "kerf/units.hpp"
#include "tests/documents/catalog.h"
#include "tests/documents/marked_text.h"
#include "text/codes.h"

namespace kerf::documents {
namespace {

using namespace literals;

const std::string faultless = R"(apiVersion: kerf/v1
kind: Procedure
metadata: {id: hole, title: A hole, version: 0.1.0, status: draft}
needs: {landmarks: [way, gonion, condylion, menton, ear_l, ear_r, sagittal]}
anatomy: bone.yaml
haptics: {device: touch}
instruments: {pilot: {plugin: kerf.drilling, tool: twist_drill, force: drill_cutting}}
constructions:
  middle_of_ears: {middle: [ear_l, ear_r]}
  symmetry: {mirror: {left: [ear_l], right: [ear_r]}}
  ramus: {tangent: {along: [gonion, condylion], in: sagittal, side: posterior}}
  border: {tangent: {along: [gonion, menton], in: symmetry, side: inferior, within: 20 mm}}
  chord: {line: [gonion, menton]}
  base: {plane: [gonion, menton, middle_of_ears]}
  skin: {entry: {of: way}}
measures:
  gonial_angle: {angle: {of: ramus, to: border}}
  slope: {angle: {of: border, to: base, in: sagittal}}
  height: {distance: {of: skin, to: base}}
  wall: {thickness: {at: gonion, along: way}}
  depth: {surface_distance: {of: menton}}
  steps: {roughness: {of: border}}
  steeper: {difference: {of: gonial_angle, from: slope}}
  thicker: {difference: {of: wall, from: height}}
steps:
  - id: drill
    title: Drill
    instrument: pilot
    axis: way
    goals: [{entry: {}}, {measure: {of: gonial_angle, at_least: 120 deg}}]
    limits:
      - {measure: {of: wall, at_least: 2 mm, at_most: 8 mm}, reason: The wall is thin.}
rehearsals:
  - {id: breach, expect: {fail: wall}, path: [{depth: -5 mm}, {depth: 32 mm}]}
)";

std::optional<Procedure> read(const std::string& text, text::Diagnostics& diagnostics) {
    return read_procedure_text("hole.yaml", text, drilling_catalog()).take(diagnostics);
}

void expect_refused(text::Code code, std::string_view from, std::string_view to) {
    SCOPED_TRACE(std::string(to));
    const MarkedText marked(replaced(faultless, from, to));
    text::Diagnostics diagnostics;
    EXPECT_FALSE(read(marked.text, diagnostics));
    expect_only(code, marked, diagnostics);
}

TEST(ReadMeasures, GivesWhatIsWritten) {
    text::Diagnostics diagnostics;
    const auto procedure = read(faultless, diagnostics);
    ASSERT_TRUE(procedure) << to_text(diagnostics);
    EXPECT_TRUE(diagnostics.empty()) << to_text(diagnostics);
    ASSERT_EQ(procedure->constructions.size(), 7U);
    const Construction& border = procedure->constructions[3];
    EXPECT_EQ(border.id, "border");
    EXPECT_EQ(border.kind, Construction::Kind::tangent);
    EXPECT_EQ(border.of, (std::vector<std::string>{"gonion", "menton"}));
    EXPECT_EQ(border.in, "symmetry");
    EXPECT_TRUE((border.side_direction() == Vec3{0, 0, -1}));
    EXPECT_EQ(border.within, 20.0_mm);
    EXPECT_EQ(procedure->constructions[2].within, 15.0_mm);
    EXPECT_EQ(procedure->constructions[1].sort(), Sort::plane);
    ASSERT_EQ(procedure->measures.size(), 8U);
    EXPECT_EQ(procedure->measures[1].in, "sagittal");
    EXPECT_EQ(std::string(procedure->measures[0].unit()), "deg");
    EXPECT_EQ(std::string(procedure->measures[3].unit()), "mm");
    EXPECT_EQ(procedure->measures[6].of, "gonial_angle");
    EXPECT_EQ(procedure->measures[6].to, "slope");
    EXPECT_EQ(std::string(procedure->measures[6].unit()), "deg");
    EXPECT_EQ(std::string(procedure->measures[7].unit()), "mm");
    const Step& step = procedure->steps.at(0);
    EXPECT_EQ(step.goals.at(1).measure, "gonial_angle");
    EXPECT_EQ(step.goals.at(1).name(), "gonial_angle");
    EXPECT_NEAR(step.goals.at(1).bound.at_least.value(), 120.0_deg, 1e-12);
    EXPECT_EQ(step.limits.at(0).name(), "wall");
    EXPECT_EQ(step.limits.at(0).bound.at_most, 8.0_mm);
}

TEST(ReadMeasures, RefusesTheUnitOfAnotherKind) {
    expect_refused(text::Code::wrong_dimension, "at_least: 120 deg", "at_least: «120 mm»");
    expect_refused(text::Code::wrong_dimension, "at_least: 2 mm", "at_least: «2 deg»");
    expect_refused(text::Code::missing_unit, "at_least: 120 deg", "at_least: «120»");
    expect_refused(text::Code::out_of_range, "at_least: 120 deg", "at_least: «200 deg»");
    text::Diagnostics diagnostics;
    static_cast<void>(read(replaced(faultless, "at_least: 120 deg", "at_least: 120 mm"), diagnostics));
    EXPECT_NE(to_text(diagnostics).find("deg"), std::string::npos) << to_text(diagnostics);
}

TEST(ReadMeasures, RefusesUnknownNames) {
    expect_refused(text::Code::unknown_measure, "of: gonial_angle, at", "of: «gonial_angel», at");
    expect_refused(text::Code::unknown_construction, "of: ramus, to", "of: «ramuss», to");
    expect_refused(text::Code::unknown_construction, "in: symmetry", "in: «skin»");
    expect_refused(text::Code::unknown_construction, "chord: {line: [gonion,", "chord: {line: [«chord»,");
    expect_refused(text::Code::unknown_limit, "fail: wall", "fail: «walls»");
    text::Diagnostics diagnostics;
    static_cast<void>(read(replaced(faultless, "of: ramus, to", "of: ramuss, to"), diagnostics));
    EXPECT_NE(to_text(diagnostics).find("Write `ramus`."), std::string::npos) << to_text(diagnostics);
}

TEST(ReadMeasures, RefusesMalformedConstructions) {
    expect_refused(text::Code::degenerate, "{line: [gonion, menton]}", "{«line»: [gonion]}");
    expect_refused(text::Code::degenerate, "plane: [gonion, menton, middle_of_ears]", "«plane»: [gonion, menton]");
    expect_refused(text::Code::degenerate, "mirror: {left: [ear_l], right: [ear_r]}",
                   "«mirror»: {left: [ear_l], right: [ear_r, menton]}");
    expect_refused(text::Code::duplicate_id, "  chord:", "  «way»:");
    expect_refused(text::Code::unknown_word, "side: posterior", "side: «behind»");
    expect_refused(text::Code::one_of, "chord: {line: [gonion, menton]}",
                   "chord: {«line»: [gonion, menton], middle: [gonion]}");
    expect_refused(text::Code::unknown_key, "to: border}}", "to: border, «from»: ramus}}");
    expect_refused(text::Code::missing_key, "{angle: {of: ramus, to: border}}", "{«angle»: {of: ramus}}");
    expect_refused(text::Code::empty_bound, "measure: {of: wall, at_least: 2 mm, at_most: 8 mm}",
                   "«measure»: {of: wall}");
}

TEST(ReadMeasures, RefusesADifferenceOfWhatIsNotThere) {
    expect_refused(text::Code::unknown_measure, "of: gonial_angle, from", "of: «gonial_angel», from");
    expect_refused(text::Code::unknown_measure, "from: slope", "from: «thicker»");  // below it
    expect_refused(text::Code::unknown_measure, "from: slope", "from: «ramus»");
    expect_refused(text::Code::other_sort, "steeper: {difference: {of: gonial_angle, from: slope}}",
                   "steeper: {difference: {of: gonial_angle, from: «wall»}}");
    expect_refused(text::Code::missing_key, "{difference: {of: gonial_angle, from: slope}}",
                   "{«difference»: {of: gonial_angle}}");
}

TEST(ReadMeasures, SaysThatAMeasureStandsBelowItsDifference) {
    text::Diagnostics diagnostics;
    static_cast<void>(read(replaced(faultless, "from: slope", "from: thicker"), diagnostics));
    EXPECT_NE(to_text(diagnostics).find("Move it up"), std::string::npos) << to_text(diagnostics);
}

TEST(ReadMeasures, ADifferenceMayBeNegative) {
    const auto bound = [](const std::string& text) {
        text::Diagnostics diagnostics;
        const auto procedure = read(
            replaced(faultless, "measure: {of: gonial_angle, at_least: 120 deg}", "measure: " + text), diagnostics);
        return procedure ? std::string() : to_text(diagnostics);
    };
    EXPECT_EQ(bound("{of: steeper, at_least: -5 deg}"), "");
    EXPECT_EQ(bound("{of: thicker, at_least: -5 mm}"), "");
    EXPECT_NE(bound("{of: gonial_angle, at_least: -5 deg}"), "") << "an angle itself may not";
}

TEST(ReadMeasures, RefusesMoreThanThereIsRoomFor) {
    std::string many;
    for (std::size_t i = 0; i <= max_measures; ++i)
        many += "  m" + std::to_string(i) + ": {surface_distance: {of: menton}}\n";
    text::Diagnostics diagnostics;
    EXPECT_FALSE(read(replaced(faultless, "measures:\n", "measures:\n" + many), diagnostics));
    EXPECT_NE(to_text(diagnostics).find("too many measures"), std::string::npos) << to_text(diagnostics);
}

TEST(ReadMeasures, RefusesMorePointsThanAConstructionTakes) {
    std::string names = "way";
    for (std::size_t i = 0; i <= max_construction_points; ++i) names += ", p" + std::to_string(i);
    const std::string declared = replaced(faultless, "[way,", "[" + names + ",");
    const MarkedText marked(replaced(declared, "line: [gonion, menton]", "«line»: [" + names + "]"));
    text::Diagnostics diagnostics;
    EXPECT_FALSE(read(marked.text, diagnostics));
    expect_only(text::Code::out_of_range, marked, diagnostics);
}

TEST(ReadMeasures, ChecksTheSortsOfTheAnatomy) {
    const std::string anatomy_text = R"(apiVersion: kerf/v1
kind: Anatomy
metadata: {id: bone, title: A bone}
phantom: {parts: [{id: body, box: {centre: 0 0 0 mm, size: 20 20 20 mm}}]}
tissues: [{id: bone, density: 1 g/cm3}]
landmarks:
  points:
    gonion: {at: 0 0 0 mm, tolerance: 1 mm}
    condylion: {at: 0 0 5 mm, tolerance: 1 mm}
    menton: {at: 0 5 0 mm, tolerance: 1 mm}
    ear_l: {at: 5 0 0 mm, tolerance: 1 mm}
    ear_r: {at: -5 0 0 mm, tolerance: 1 mm}
  axes: {way: {from: 0 0 15 mm, to: 0 0 -9 mm, tolerance: 1 mm}}
  planes: {sagittal: {at: 0 0 0 mm, normal: 1 0 0, tolerance: 1 mm}}
)";
    text::Diagnostics ignored;
    const auto anatomy = read_anatomy_text("bone.yaml", anatomy_text).take(ignored);
    ASSERT_TRUE(anatomy) << to_text(ignored);
    const auto expect_sorts = [&](std::string_view from, std::string_view to, int errors) {
        SCOPED_TRACE(std::string(to));
        const MarkedText marked(from.empty() ? faultless : replaced(faultless, from, to));
        text::Diagnostics diagnostics;
        const auto procedure = read(marked.text, diagnostics);
        ASSERT_TRUE(procedure) << to_text(diagnostics);
        check_needs(*procedure, *anatomy, diagnostics);
        if (errors == 0)
            EXPECT_TRUE(diagnostics.empty()) << to_text(diagnostics);
        else
            expect_only(text::Code::other_sort, marked, diagnostics);
    };
    expect_sorts("", "", 0);
    expect_sorts("{entry: {of: way}}", "{entry: {of: «sagittal»}}", 1);
    expect_sorts("in: symmetry", "in: «way»", 1);
    expect_sorts("of: ramus, to", "of: «gonion», to", 1);
    expect_sorts("of: skin, to: base", "of: «chord», to: base", 1);
    expect_sorts("at: gonion, along", "at: «way», along", 1);
    expect_sorts("{roughness: {of: border}}", "{roughness: {of: «chord»}}", 1);
}

}  // namespace
}  // namespace kerf::documents
