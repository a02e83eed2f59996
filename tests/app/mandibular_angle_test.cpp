// SPDX-License-Identifier: Apache-2.0
// The reduction of the mandibular angles, run whole (validation A.5, E.3, E.5), and jaws that it cannot be done on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/session/summary.h"
#include "kerf/units.hpp"
#include "tests/support/drill_rig.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/watched_run.h"

namespace kerf {
namespace {

using namespace literals;

const char* const procedure_file = KERF_SOURCE_DIR "/procedures/mandibular-angle-reduction.yaml";
const char* const phantom_file = KERF_SOURCE_DIR "/procedures/anatomy/mandible-whole-phantom.yaml";

const Scene& jaw() {
    static const Scene scene = [] {
        Diagnostics diagnostics;
        auto made = make_scene(procedure_file, "", test::plugins(), diagnostics);
        if (!made) throw std::runtime_error(to_text(diagnostics));
        return std::move(*made);
    }();
    return scene;
}
const test::WatchedRun& outcome_of(const std::string& rehearsal) {
    static std::map<std::string, test::WatchedRun> outcomes;
    if (!outcomes.contains(rehearsal)) {
        RunRequest request;
        request.rehearsal = rehearsal;
        outcomes.emplace(rehearsal, test::watched_run(jaw(), test::plugins(), request));
    }
    return outcomes.at(rehearsal);
}
const MetricRow& metric(const RunSummary& summary, const std::string& id) {
    for (const auto& row : summary.metrics)
        if (row.id == id) return row;
    throw std::runtime_error("no metric " + id);
}

constexpr double planned_gonial = 126.0_deg, planned_plane = 28.0_deg;

TEST(MandibularAngle, BeginsAtTheAnglesOfThePaper) {  // 04-13: 115 and 20 deg
    const RunSummary& summary = outcome_of("expert").summary;
    for (const std::string side : {"right", "left"}) {
        const MetricRow &gonial = metric(summary, "measure.gonial_angle_" + side + ".before"),
                        &plane = metric(summary, "measure.mandibular_plane_" + side + ".before");
        EXPECT_NEAR(gonial.value, 115.0_deg, 0.3_deg) << side;
        EXPECT_NEAR(plane.value, 20.0_deg, 0.3_deg) << side;
        EXPECT_GT(gonial.uncertainty, 0.0);
        EXPECT_LT(gonial.uncertainty, 1.0_deg);
    }
}

TEST(MandibularAngle,
     TheExpertComesNearThePlan) {  // 04-14: a scripted cut is within 1 deg; residents within 5.6 and 1.9
    const test::WatchedRun& run = outcome_of("expert");
    std::string reasons;
    for (const std::string& reason : run.summary.reasons) reasons += reason + "\n";
    EXPECT_EQ(run.summary.verdict, Verdict::pass) << reasons;
    double gonial_error = 0.0, plane_error = 0.0;
    for (const std::string side : {"right", "left"}) {
        const MetricRow &gonial = metric(run.summary, "left-anterior.measure.gonial_angle_" + side),
                        &plane = metric(run.summary, "left-anterior.measure.mandibular_plane_" + side);
        RecordProperty("gonial_" + side + "_deg", std::to_string(gonial.value / 1.0_deg));
        RecordProperty("plane_" + side + "_deg", std::to_string(plane.value / 1.0_deg));
        EXPECT_NEAR(gonial.value, planned_gonial, 1.0_deg + gonial.uncertainty) << side;
        EXPECT_NEAR(plane.value, planned_plane, 1.0_deg) << side;
        gonial_error += 0.5 * std::abs(gonial.value - planned_gonial);
        plane_error += 0.5 * std::abs(plane.value - planned_plane);
    }
    EXPECT_LT(gonial_error, 1.0_deg) << "the mean of both sides; one side alone is within 1 deg and its uncertainty";
    EXPECT_LT(plane_error, 1.0_deg);
    EXPECT_LT(metric(run.summary, "left-anterior.measure.asymmetry_lower").value, 1.0_deg);
    EXPECT_LT(metric(run.summary, "left-anterior.measure.asymmetry_posterior").value, 1.0_deg);
}

// The plan is geometry: the ostectomy alone makes 180 + 28 - 85 = 123 deg, the burr the rest.
TEST(MandibularAngle, TheBurrMakesTheLastThreeDegrees) {
    const RunSummary& summary = outcome_of("expert").summary;
    const double cut = metric(summary, "right-take.measure.asymmetry_posterior").value,
                 burred = metric(summary, "right-posterior.measure.asymmetry_posterior").value;
    EXPECT_LT(cut, 0.3_deg) << "the saw leaves the ramus as it was";
    EXPECT_GT(burred, 1.5_deg);
    EXPECT_LT(burred, 3.0_deg + 0.5_deg);
}

TEST(MandibularAngle, IsScoredByAnglesSymmetryRoughnessTimeAndTorque) {
    const std::string json = summary_json(outcome_of("expert").summary);
    for (const char* id :
         {"measure.gonial_angle_right.before", "left-anterior.measure.gonial_angle_right",
          "measure.mandibular_plane_left.before", "left-anterior.measure.mandibular_plane_left",
          "left-anterior.measure.asymmetry_lower", "left-anterior.measure.roughness_right",
          "right-cut.signal.torque_exceedance", "right-cut.clearance.nerve_right", "left-cut.signal.blade_torque"})
        EXPECT_NE(json.find("\"" + std::string(id) + "\""), std::string::npos) << id;
    EXPECT_LT(metric(outcome_of("expert").summary, "right-cut.signal.torque_exceedance").value, 0.01);
}

TEST(MandibularAngle, BothAnglesAreTakenAwayAndNoBoneIsLost) {
    const RunSummary& summary = outcome_of("expert").summary;
    EXPECT_EQ(summary.pieces.size(), 3u);
    EXPECT_LT(std::abs(metric(summary, "bone.balance").value), 1e-4) << "04-17";
    // Half a slice of 8 deg by 56 mm, of a rod whose tip is an ellipse: the two sides are mirror images.
    const double right = metric(summary, "bone.piece-1").value, left = metric(summary, "bone.piece-2").value;
    EXPECT_NEAR(right / left, 1.0, 0.1);
}

TEST(MandibularAngle, EachBlunderFailsForItsOwnReason) {
    for (const char* rehearsal : {"into-the-nerve", "twisted"}) {
        const test::WatchedRun& run = outcome_of(rehearsal);
        EXPECT_EQ(run.summary.verdict, Verdict::fail) << rehearsal;
        EXPECT_TRUE(run.is_as_expected) << rehearsal;
    }
    EXPECT_LT(metric(outcome_of("into-the-nerve").summary, "right-cut.clearance.nerve_right").value, 0.0);
    const auto& events = outcome_of("twisted").events;
    EXPECT_TRUE(std::any_of(events.begin(), events.end(), [](const EventRow& e) { return e.id == "sawing.twisted"; }));
}

// ---- jaws that it cannot be done on --------------------------------------------------------------------------------

/// The phantom with some of its text replaced; what the checks say of it.
std::string said_of(const std::string& pattern, const std::string& by, std::vector<std::string> settings = {}) {
    std::ostringstream text;
    text << std::ifstream(phantom_file).rdbuf();
    const test::TemporaryFolder folder;
    std::ofstream(folder.path() + "/jaw.yaml") << std::regex_replace(text.str(), std::regex(pattern), by);
    Diagnostics diagnostics;
    DocumentRequest request{.procedure = procedure_file, .anatomy = folder.path() + "/jaw.yaml"};
    settings.push_back("accuracy.spacing=1 mm");  // it is refused before anything is cut
    request.changes = {"", settings};
    auto documents = check_documents(request, test::plugins(), diagnostics);
    if (documents) (void)make_scene(std::move(*documents), diagnostics);
    return to_text(diagnostics);
}

TEST(MandibleToReduce, IsRefusedWithOneSideOnly) {
    const std::string said = said_of("    - id: \\w+_left\\w*\n.*\n(      subtract: true\n)?.*\n", "");
    EXPECT_NE(said.find("E0610"), std::string::npos) << said;
    EXPECT_NE(said.find("the axis `left_cut` meets no bone"), std::string::npos) << said;
    EXPECT_EQ(said.find("right_cut` meets"), std::string::npos) << said;
}

TEST(MandibleToReduce, IsRefusedWithoutTheLandmarksOfASide) {
    const std::string said = said_of("    left_cut: .*\n", "");
    EXPECT_NE(said.find("E0501"), std::string::npos) << said;
    EXPECT_NE(said.find("no landmark `left_cut`"), std::string::npos) << said;
}

TEST(MandibleToReduce, IsRefusedWithALandmarkOnNoSurface) {
    const std::string on_bone = said_of("menton: \\{at: 0 -71.16 -25.58 mm", "menton: {at: 0 -71.16 -40 mm");
    EXPECT_NE(on_bone.find("menton"), std::string::npos) << on_bone;
    EXPECT_NE(on_bone.find("E06"), std::string::npos) << on_bone;
    const std::string far = said_of("gonion_right: \\{at: -46 0 0 mm", "gonion_right: {at: -46 0 -60 mm");
    EXPECT_NE(far.find("E0529"), std::string::npos) << far;
    EXPECT_NE(far.find("`gonial_angle_right` cannot be made of this bone"), std::string::npos) << far;
}

TEST(MandibleToReduce, IsRefusedWithABurrOutOfRange) {
    const std::string said = said_of("x{0}", "", {"instruments.burr.parameters.diameter=40 mm"});
    EXPECT_NE(said.find("0.5 mm to 12 mm"), std::string::npos) << said;
}

TEST(MandibleToReduce, IsWarnedOfABurrTooSlowToCut) {
    const std::string said = said_of("x{0}", "", {"instruments.burr.drives.spindle_speed=500 rpm"});
    EXPECT_NE(said.find("W0711"), std::string::npos) << said;
    EXPECT_NE(said.find("got 500 rpm, expected 1000 rpm or more"), std::string::npos) << said;
}

TEST(RealMandible, CanBeReducedOnBothSides) {
    if (std::getenv("KERF_DATA") == nullptr) GTEST_SKIP() << "KERF_DATA names no folder of scans";
    Diagnostics diagnostics;
    DocumentRequest request{.procedure = procedure_file,
                            .anatomy = KERF_SOURCE_DIR "/tests/real-data/mandible-angle.yaml"};
    request.changes = {"", {"accuracy.spacing=1 mm"}};
    auto documents = check_documents(request, test::plugins(), diagnostics);
    auto made = documents ? make_scene(std::move(*documents), diagnostics) : std::nullopt;
    ASSERT_TRUE(made) << to_text(diagnostics);
    // The file of its landmarks states 122.1 and 123.8 deg, by another construction.
    for (const std::string side : {"right", "left"})
        for (std::size_t m = 0; m < made->procedure.measures.size(); ++m)
            if (made->procedure.measures[m].id == "gonial_angle_" + side) {
                ASSERT_TRUE(made->measured_before[m].value);
                EXPECT_NEAR(*made->measured_before[m].value, side == "right" ? 122.1_deg : 123.8_deg, 4.0_deg);
            }
}

}  // namespace
}  // namespace kerf
