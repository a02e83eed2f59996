// SPDX-License-Identifier: Apache-2.0
// The shipped amputation, run whole: bone comes apart.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "bone/surface/edges.h"
#include "bone/surface/read_surface.h"
#include "bone/surface/repair.h"
#include "kerf/units.hpp"
#include "session/output_folder.h"
#include "session/read_session.h"
#include "session/recorder.h"
#include "tests/support/operation.h"
#include "tests/support/temporary_folder.h"

namespace kerf::app {
namespace {

using namespace literals;
using test::metric;

const char* const procedure_file = KERF_SOURCE_DIR "/procedures/amputation.yaml";

const run::Scene& knee() {
    static const run::Scene scene = test::scene_of(procedure_file);
    return scene;
}
test::Rehearsals& rehearsals() {
    static test::Rehearsals all(&knee, "amputation");
    return all;
}
const test::WatchedRun& outcome_of(const std::string& rehearsal) { return rehearsals()[rehearsal]; }

TEST(Amputation, TheExpertPassesAndTheBoneIsInTwo) {
    const test::WatchedRun& run = outcome_of("expert");
    EXPECT_EQ(run.summary.verdict, session::Verdict::pass);
    EXPECT_TRUE(run.summary.reasons.empty());
    ASSERT_EQ(run.summary.pieces.size(), 2u);
    for (const char* cut : {"cut-1", "cut-2", "cut-3", "cut-4"}) {
        EXPECT_LT(metric(run.summary, std::string(cut) + ".plane-angle"), 3.0_deg) << cut;
        EXPECT_LT(metric(run.summary, std::string(cut) + ".flatness"), 1.0_mm) << cut;
        EXPECT_GT(metric(run.summary, std::string(cut) + ".removed"), 0.0) << cut;
    }
}

TEST(Amputation, NoBoneIsLostOrMade) {
    for (const char* rehearsal : {"expert", "hasty", "tilted", "into-the-artery"})
        EXPECT_LT(std::abs(metric(outcome_of(rehearsal).summary, "bone.balance")), 1e-5) << rehearsal;
}

TEST(Amputation, EachBlunderFailsForWhatItSaysAlone) {
    for (const char* rehearsal : {"hasty", "tilted", "into-the-artery"}) {
        const test::WatchedRun& run = outcome_of(rehearsal);
        EXPECT_EQ(run.summary.verdict, session::Verdict::fail) << rehearsal;
        EXPECT_TRUE(run.is_as_expected) << rehearsal;
        EXPECT_EQ(run.summary.pieces.size(), 2u) << rehearsal;
    }
}

TEST(Amputation, ATiltedCutIsMeasuredAsTiltedAndItsNeighboursAreNot) {
    const session::RunSummary& run = outcome_of("tilted").summary;
    EXPECT_NEAR(metric(run, "cut-3.plane-angle"), 8.0_deg, 0.5_deg /* the coupling gives way in the slot */);
    for (const char* cut : {"cut-1", "cut-2"})
        EXPECT_LT(metric(run, std::string(cut) + ".plane-angle"), 0.5_deg) << cut;
    EXPECT_LT(metric(run, "cut-4.plane-angle"), 1.5_deg) << "the hands give way where it meets the tilted slot";
}

TEST(Amputation, ItComesApartOnceAndInTheLastCut) {
    const test::WatchedRun& run = rehearsals().with_ticks("expert");
    const auto apart = [](const session::EventRow& event) { return event.id == session::came_apart_event; };
    ASSERT_EQ(std::count_if(run.events.begin(), run.events.end(), apart), 1);
    const auto event = std::find_if(run.events.begin(), run.events.end(), apart);
    EXPECT_EQ(run.ticks[event->tick].step, 3);
}

TEST(Amputation, ACutTakenBackAndDoneAgainEndsAsIfNothingHadBeen) {
    // Given the expert's way, with the last cut taken back once it is out of the bone, and done again
    run::Scene scene = knee();
    std::vector<documents::Waypoint>& path = scene.procedure.rehearsals[0].path;
    const auto away =
        std::find_if(path.begin(), path.end(), [](const documents::Waypoint& w) { return w.depth < -50e-3; });
    ASSERT_NE(away, path.end());
    for (const auto kind : {documents::HandInput::Kind::undo, documents::HandInput::Kind::redo})
        away->inputs.push_back({kind});
    run::RunRequest request;
    request.rehearsal = "expert";
    const test::WatchedRun run = test::watched_run(scene, test::plugins(), request);
    ASSERT_EQ(run.error, "");
    EXPECT_EQ(run.summary.verdict, session::Verdict::pass);
    // Then it ends with the same pieces
    const session::RunSummary& plain = outcome_of("expert").summary;
    ASSERT_EQ(run.summary.pieces.size(), plain.pieces.size());
    for (std::size_t n = 0; n < plain.pieces.size(); ++n)
        EXPECT_NEAR(run.summary.pieces[n].volume, plain.pieces[n].volume,
                    1e-11 * plain.pieces[n].volume /* a session has twelve digits of it */);
    EXPECT_EQ(run.summary.removed, plain.removed);
}

TEST(Amputation, WithTheLastCutTakenBackThereIsOnePieceAndNothingToTakeAway) {
    run::Scene scene = knee();
    std::vector<documents::Waypoint>& path = scene.procedure.rehearsals[0].path;
    const auto away =
        std::find_if(path.begin(), path.end(), [](const documents::Waypoint& w) { return w.depth < -50e-3; });
    ASSERT_NE(away, path.end());
    away->inputs.push_back({documents::HandInput::Kind::undo});
    run::RunRequest request;
    request.rehearsal = "expert";
    const test::WatchedRun run = test::watched_run(scene, test::plugins(), request);
    ASSERT_EQ(run.error, "");
    EXPECT_EQ(run.summary.pieces.size(), 1u);
    const auto undone = std::find_if(run.events.begin(), run.events.end(), [](const session::EventRow& e) {
        return e.id == session::hand_input_event && e.detail == "undo";
    });
    ASSERT_NE(undone, run.events.end());
    // What is left is what three cuts leave: the bone that was there before the fourth
    double three = 0.0;
    for (const char* cut : {"cut-1", "cut-2", "cut-3"})
        three += metric(outcome_of("expert").summary, std::string(cut) + ".removed");
    EXPECT_NEAR(run.summary.removed, three, 1e-4 * three) << "but for what the blade grazed between two steps";
}

TEST(Amputation, AReplayTakesThePiecesOverAtTheSameTicksAndEndsInTheSameBits) {
    // Given a recorded run, and another that would take its pieces over later than lock-step does
    const test::TemporaryFolder folder;
    const std::string first = folder / "first";
    if (const std::string made = test::recorded_folder("amputation/expert"); !made.empty()) {
        std::filesystem::copy(made, first);
    } else {
        run::RunRequest request;
        request.rehearsal = "expert";
        request.out = first;
        const test::WatchedRun recorded = test::watched_run(knee(), test::plugins(), request);
        ASSERT_TRUE(recorded.error.empty()) << recorded.error;
    }
    std::string error;
    auto inputs = session::read_session(first + "/session.db", error);
    ASSERT_TRUE(inputs) << error;
    ASSERT_EQ(inputs->adoptions.size(), 1u);
    ASSERT_EQ(inputs->hand_inputs.size(), 2u);

    // When it is replayed
    run::RunRequest again;
    again.rehearsal = "expert";
    again.replay = inputs->device_from_handle;
    again.adoptions = inputs->adoptions;
    for (const auto& [tick, text] : inputs->hand_inputs)
        again.hand_inputs.emplace_back(tick, *documents::hand_input(text));
    const test::WatchedRun same = test::watched_run(knee(), test::plugins(), again);
    again.adoptions = {inputs->adoptions[0] + 300};
    const test::WatchedRun later = test::watched_run(knee(), test::plugins(), again);

    // Then only the ticks that were recorded give the recorded run
    const std::uint64_t recorded = outcome_of("expert").summary.hash;
    EXPECT_EQ(same.summary.hash, recorded);
    EXPECT_NE(later.summary.hash, recorded);

    // and each piece has a surface of its own, which a second run may write over.
    EXPECT_TRUE(std::filesystem::exists(first + "/bone.stl"));
    EXPECT_TRUE(std::filesystem::exists(first + "/bone-1.stl"));
    text::OutputLock lock;
    text::MadeFolders made;
    EXPECT_EQ(session::prepare_output(first, lock, made), "");
}

TEST(TranstibialAmputation, ThreeCutsPartThePhantomAndABlunderMeetsTheArtery) {
    const run::Scene leg = test::scene_of(procedure_file, "transtibial");
    ASSERT_EQ(leg.procedure.rehearsals.size(), 2u);
    for (const documents::Rehearsal& rehearsal : leg.procedure.rehearsals) {
        const test::WatchedRun run = test::rehearsed(leg, rehearsal.id);
        EXPECT_TRUE(run.is_as_expected) << rehearsal.id;
        EXPECT_EQ(run.summary.pieces.size(), 2u) << rehearsal.id;
        EXPECT_LT(std::abs(metric(run.summary, "bone.balance")), 1e-3) << rehearsal.id;
    }
}

TEST(ReciprocatingAmputation, OneCutPartsThePhantomAndATwistFails) {
    const run::Scene leg = test::scene_of(procedure_file, "reciprocating");
    ASSERT_EQ(leg.procedure.rehearsals.size(), 3u);
    for (const documents::Rehearsal& rehearsal : leg.procedure.rehearsals) {
        const test::WatchedRun run = test::rehearsed(leg, rehearsal.id);
        EXPECT_TRUE(run.is_as_expected) << rehearsal.id;
        EXPECT_EQ(run.summary.pieces.size(), 2u) << rehearsal.id;
        EXPECT_LT(std::abs(metric(run.summary, "bone.balance")), 1e-3) << rehearsal.id;
        const double torque = metric(run.summary, "cut-1.signal.blade_torque"),
                     least = metric(run.summary, "cut-1.signal.blade_torque.least");
        if (rehearsal.id == "twisted") {
            EXPECT_GT(std::max(torque, -least), 0.05) << "N m";
        } else {
            EXPECT_LT(std::max(torque, -least), 0.04) << "N m, " << rehearsal.id;
        }
    }
}

/// On real bone, when there is some: a femur out of a surface, a tibia out of a scan.
struct RealBone {
    const char *name, *anatomy, *data, *variant;
    int last_cut;
    std::vector<std::string> settings;  ///< what the shipped plan needs on it
};
class AmputationOfRealBone : public testing::TestWithParam<RealBone> {};

TEST_P(AmputationOfRealBone, EndsInTwoClosedPiecesAndReplaysToTheSameBits) {
    // Given the shipped procedure on that bone
    const RealBone& bone = GetParam();
    if (const char* data = std::getenv("KERF_DATA");
        !data || !std::filesystem::exists(std::string(data) + "/" + bone.data))
        GTEST_SKIP() << "KERF_DATA names no folder with " << bone.data;
    const run::Scene scene = test::scene_of(procedure_file, bone.variant, bone.settings,
                                            std::string(KERF_SOURCE_DIR "/tests/real-data/") + bone.anatomy);

    // When the expert works on it
    const test::TemporaryFolder folder;
    run::RunRequest request;
    request.rehearsal = "expert";
    request.out = folder / "first";
    const test::WatchedRun run = test::watched_run(scene, test::plugins(), request);

    // Then it comes apart in the last cut, the piece is taken away, and no bone is lost or made
    EXPECT_EQ(run.summary.verdict, session::Verdict::pass);
    ASSERT_EQ(run.summary.pieces.size(), 2u);
    EXPECT_LT(std::abs(metric(run.summary, "bone.balance")), 1e-3);
    EXPECT_GT(metric(run.summary, "remove.moved"), 60.0_mm);
    const auto event = std::find_if(run.events.begin(), run.events.end(),
                                    [](const session::EventRow& e) { return e.id == session::came_apart_event; });
    ASSERT_NE(event, run.events.end());
    EXPECT_EQ(run.ticks[event->tick].step, bone.last_cut);
    for (const char* name : {"bone.stl", "bone-1.stl"}) {
        text::Diagnostics diagnostics;
        auto surface = bone::read_surface(request.out + "/" + name).take(diagnostics);
        ASSERT_TRUE(surface) << to_text(diagnostics);
        bone::weld(surface->mesh);
        EXPECT_TRUE(bone::border_loops_of(bone::half_edges_of(surface->mesh)).empty()) << name;
    }

    // and its record gives the same bits again.
    std::string error;
    const auto inputs = session::read_session(request.out + "/session.db", error);
    ASSERT_TRUE(inputs) << error;
    run::RunRequest again;
    again.rehearsal = "expert";
    again.replay = inputs->device_from_handle;
    again.adoptions = inputs->adoptions;
    for (const auto& [tick, text] : inputs->hand_inputs)
        again.hand_inputs.emplace_back(tick, *documents::hand_input(text));
    EXPECT_EQ(test::watched_run(scene, test::plugins(), again).summary.hash, run.summary.hash);
}

INSTANTIATE_TEST_SUITE_P(
    Of, AmputationOfRealBone,
    testing::Values(RealBone{"femur",
                             "femur-z013-amputation.yaml",
                             "meshes/femur_left_vsd_z013.stl",
                             "",
                             3,
                             {"paths.cut-1=[{step: cut-1, depth: -8 mm}, {depth: 26 mm}, {depth: -8 mm}]",
                              "paths.cut-4=[{step: cut-4, depth: -8 mm}, {depth: 26 mm}, {depth: -8 mm}]"}},
                    RealBone{
                        "tibia", "leg-transtibial.yaml", "volumes/leg_right_vhp_female.mha", "transtibial", 2, {}}),
    [](const auto& of) { return of.param.name; });

}  // namespace
}  // namespace kerf::app
