// SPDX-License-Identifier: Apache-2.0
#include "run/run_checks.h"

#include <gtest/gtest.h>

#include <string>

namespace kerf::run {
namespace {

constexpr const char* text = "haptics: {device: tuoch}\n"
                             "instruments:\n"
                             "  pilot: {plugin: kerf.drilling}\n"
                             "steps:\n"
                             "  - {id: first, instrument: pilot, axis: left}\n"
                             "  - {id: second, instrument: pilot, axis: right}\n"
                             "rehearsals:\n"
                             "  - {id: short, path: [{depth: -5 mm}]}\n"
                             "  - {id: deep, path: [{depth: 1 mm}, {depth: 5 mm}]}\n";

documents::Procedure procedure() {
    documents::Procedure p;
    p.file = "hole.yaml";
    p.text = text;
    p.device = "touch";
    p.steps = {{.id = "first", .title = "", .instrument = "pilot", .axis = "left", .goals = {}, .limits = {}}};
    return p;
}

void expect_one(const text::Diagnostics& found, const char* code, int line, int column) {
    ASSERT_EQ(found.size(), 1u) << to_text(found);
    EXPECT_EQ(found[0].code, code);
    EXPECT_EQ(found[0].place.line, line);
    EXPECT_EQ(found[0].place.column, column);
}

TEST(RunChecks, HasNothingAgainstARunThatCanBe) {
    text::Diagnostics found;
    check_run(procedure(), found);
    EXPECT_TRUE(found.empty()) << to_text(found);
}

TEST(RunChecks, ReportsAShallowWaypointOnceInItsPath) {
    documents::Procedure p = procedure();
    p.text = "paths:\n"
             "  shallow: [{depth: -5 mm}, {depth: 5 mm}]\n"
             "rehearsals:\n"
             "  - {id: expert, path: [{follow: shallow}, {depth: -5 mm}]}\n"
             "  - {id: again, path: [{follow: shallow}, {depth: -5 mm}]}\n";
    p.steps[0].goals = {{"depth", {10e-3, {}}, {}}};
    p.rehearsals.emplace_back();
    p.rehearsals[0].expect = "pass";
    for (const double depth : {-5e-3, 5e-3, -5e-3}) p.rehearsals[0].path.push_back({.depth = depth});
    p.rehearsals.push_back(p.rehearsals[0]);
    text::Diagnostics found;
    check_run(p, found);
    expect_one(found, "W0712", 2, 37);
}

TEST(RunChecks, NamesTheDeviceThatWasMeantWhereItStands) {
    documents::Procedure p = procedure();
    p.device = "tuoch";
    text::Diagnostics found;
    check_run(p, found);
    expect_one(found, "E0701", 1, 19);
    EXPECT_NE(to_text(found).find("Write `touch`"), std::string::npos) << to_text(found);
}

TEST(RunChecks, TheNinthInstrumentIsOneTooMany) {
    documents::Procedure p = procedure();
    text::Diagnostics found;
    for (int n = 1; n < 8; ++n) {
        p.steps.push_back(p.steps[0]);
        p.steps.back().instrument = "saw-" + std::to_string(n);
    }
    check_run(p, found);
    EXPECT_TRUE(found.empty()) << to_text(found);
    p.steps.push_back(p.steps[0]);
    p.steps.back().instrument = "saw-8";
    check_run(p, found);
    ASSERT_EQ(found.size(), 1u) << to_text(found);
    EXPECT_EQ(found[0].code, "E0702");
}

TEST(RunChecks, PointsAtRehearsalsThatCannotBeCarriedOut) {
    documents::Procedure p = procedure();
    p.rehearsals.resize(2);
    p.rehearsals[0].path = {{.depth = -5e-3, .medial = 0.0}};
    p.rehearsals[1].path = {{.depth = 1e-3, .medial = 0.0}, {.depth = 5e-3, .medial = 0.0}};
    text::Diagnostics found;
    check_run(p, found);
    ASSERT_EQ(found.size(), 2u) << to_text(found);
    EXPECT_EQ(found[0].code, "E0704");
    EXPECT_EQ(found[0].place.line, 8);
    EXPECT_EQ(found[1].code, "E0705");
    EXPECT_EQ(found[1].place.line, 9);
}

TEST(RunChecks, ABladeThickerThanTheRegionIsRefused) {
    const auto told = [](double kerf, double thickness_of_region) {
        text::Diagnostics found;
        const ToolSolid blade = ToolSolid::prism({{0.0, 5e-3}, {-1e-3, 5e-3}}, kerf);
        check_blade_fits(procedure(), "pilot", blade, {{0, 0, 0}, {30e-3, thickness_of_region, 54e-3}}, found);
        return found.empty() ? "" : found[0].code + " " + found[0].message;
    };
    EXPECT_EQ(told(3e-3, 3.5e-3), "");
    EXPECT_EQ(told(4e-3, 3.5e-3), "E0707 The blade is too thick for the region in which bone can be cut: got 4 mm, "
                                  "expected less than 3.5 mm of 30 mm × 3.5 mm × 54 mm. Take a smaller blade, or plan "
                                  "the axis so that the region is larger.");
}

TEST(RunChecks, AToolThatIsRefusedIsShownWithTheReason) {
    text::Diagnostics found;
    refuse_tool(procedure(), "pilot", "it cannot be made.", found);
    expect_one(found, "E0703", 3, 10);
}

TEST(RunChecks, AHoleIsAsWideAsItsNarrowestBore) {
    documents::Procedure p = procedure();
    p.spacing = 0.8e-3;
    text::Diagnostics found;
    const ToolSolid drill({{0.0, 0.0}, {-1e-3, 1.6e-3}, {-50e-3, 1.6e-3}});
    check_width_of_cut(p, "pilot", drill, found);
    EXPECT_TRUE(found.empty()) << to_text(found);
    // A wide shoulder does not make its pilot's hole wider; a cone has no bore of its own.
    const ToolSolid step({{0.0, 0.0}, {-1e-3, 1.5e-3}, {-20e-3, 1.5e-3}, {-22e-3, 3e-3}, {-50e-3, 3e-3}});
    check_width_of_cut(p, "pilot", step, found);
    expect_one(found, "W0708", 3, 10);
    EXPECT_NE(to_text(found).find("0.75 mm"), std::string::npos) << to_text(found);
    found.clear();
    check_width_of_cut(p, "pilot", ToolSolid({{0.0, 0.0}, {-6e-3, 3e-3}}), found);
    EXPECT_TRUE(found.empty()) << to_text(found);
}

}  // namespace
}  // namespace kerf::run
