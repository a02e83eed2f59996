// SPDX-License-Identifier: Apache-2.0
// The exact surface that a run makes while it goes on: the same as afterwards, and never in its way.
#include "bone/exact/exact_follower.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "bone/remesh/accept.h"
#include "run/exact/exact_strategies.h"
#include "run/run.h"
#include "tests/support/drill_rig.h"
#include "tests/support/temporary_folder.h"

namespace kerf::run {
namespace {

using namespace std::chrono_literals;

constexpr const char* program = KERF_BUILD_DIR "/libexec/kerf/kerf-remesh";

/// The strategies of Kerf's plugins, and the animals.
const ComponentCatalog& catalog() {
    static const ComponentCatalog all = [] {
        PluginRegistry zoo;
        zoo.scan({KERF_BUILD_DIR "/lib/kerf-remesh-zoo"});
        ComponentCatalog both = test::plugins().catalog();
        std::copy_if(zoo.catalog().begin(), zoo.catalog().end(), std::back_inserter(both),
                     [](const ComponentInfo& c) { return c.kind == KERF_KIND_REMESHER; });
        return both;
    }();
    return all;
}
StrategyHost host() { return {program, &catalog()}; }
/// A full id by its last word; an unknown word as it is.
std::string full_id(const std::string& word) {
    for (const ComponentInfo& one : catalog())
        if (one.kind == KERF_KIND_REMESHER && one.matches_id(word)) return one.full_id();
    return word;
}

const Scene& leg() {
    static const Scene scene = [] {
        text::Diagnostics diagnostics;
        auto documents = check_documents({KERF_SOURCE_DIR "/procedures/amputation.yaml",
                                          "",
                                          {"reciprocating", {"accuracy.spacing=0.6 mm"}},
                                          KERF_SOURCE_DIR "/procedures"},
                                         test::plugins())
                             .take(diagnostics);
        auto made = documents ? make_scene(std::move(*documents)).take(diagnostics) : std::nullopt;
        if (!made) throw std::runtime_error(to_text(diagnostics));
        return std::move(*made);
    }();
    return scene;
}
Scene leg_with(const std::string& strategy, const std::string& instrument = "saw") {
    Scene scene = leg();
    for (documents::Instrument& one : scene.procedure.instruments)
        if (one.id == instrument) one.remeshing = full_id(strategy);
    return scene;
}

/// The surface as it is made afterwards, by the strategy of the run.
struct Afterwards final : RunObserver {
    Afterwards(const Scene& of, const ExactStrategies& with) : scene(&of), strategies(&with) {}
    std::string on_result(const session::RunSummary& /*summary*/, const Simulation& simulation) override {
        made = bone::exact_surface(simulation, strategies->tools(*scene));
        return {};
    }
    const Scene* scene;
    const ExactStrategies* strategies;
    bone::ExactSurface made;
};

struct Ended {
    session::RunSummary summary;
    bone::ExactSurface afterwards;
};
enum class Makes { once, again_afterwards };
Ended run_with(const Scene& scene, Makes makes = Makes::again_afterwards) {
    ExactStrategies strategies(host());
    EXPECT_EQ(strategies.start(scene.procedure), "");
    Afterwards afterwards(scene, strategies);
    RunRequest request;
    request.rehearsal = "expert";
    request.strategies = &strategies;
    if (makes == Makes::again_afterwards) request.observers = {&afterwards};
    const RunOutcome outcome = run_procedure(scene, test::plugins(), request);
    EXPECT_EQ(outcome.error, "");
    return {outcome.summary, afterwards.made};
}
const Ended& plain_run(const std::string& strategy) {
    static std::map<std::string, Ended> runs;
    if (!runs.contains(strategy)) runs.emplace(strategy, run_with(leg_with(strategy)));
    return runs.at(strategy);
}
/// The run without strategies: what a run with strategies must not change.
const session::RunSummary& run_without() {
    static const session::RunSummary summary = [] {
        RunRequest request;
        request.rehearsal = "expert";
        return run_procedure(leg(), test::plugins(), request).summary;
    }();
    return summary;
}
/// The expert's path, with inputs once the last cut is out of the bone.
Scene leg_with_inputs(const std::string& strategy, const std::vector<documents::HandInput::Kind>& kinds) {
    Scene scene = leg_with(strategy);
    std::vector<documents::Waypoint>& path = scene.procedure.rehearsals[0].path;
    const auto away =
        std::find_if(path.begin(), path.end(), [](const documents::Waypoint& w) { return w.depth < -50e-3; });
    if (away == path.end()) throw std::runtime_error("the path never leaves the bone");
    for (const documents::HandInput::Kind kind : kinds) away->inputs.push_back({kind});
    return scene;
}

class ExactFollowing : public testing::TestWithParam<const char*> {};

TEST_P(ExactFollowing, EndsWithTheSurfaceThatIsMadeAfterwards) {
    const Ended& run = plain_run(GetParam());
    ASSERT_TRUE(run.summary.exact.has_value());
    EXPECT_EQ(run.summary.exact->why_not, "");
    ASSERT_EQ(run.afterwards.error, "");
    EXPECT_EQ(run.summary.exact->digest, run.afterwards.digest);
    ASSERT_EQ(run.summary.exact->pieces.size(), 2u);
    EXPECT_LT(std::abs(run.summary.exact->removed - run.summary.exact->field_removed), run.summary.exact->allowed);
    for (const bone::ExactPiece& piece : run.afterwards.pieces) {
        bone::RemeshRequest itself;
        itself.base = piece.mesh;
        EXPECT_EQ(bone::flaw_of_result(itself, piece.mesh), "") << "body " << piece.body;
    }
}

TEST_P(ExactFollowing, LeavesTheRunAsItIs) {
    EXPECT_EQ(plain_run(GetParam()).summary.hash, run_without().hash);
    EXPECT_FALSE(run_without().exact.has_value());
}

TEST_P(ExactFollowing, ACutTakenBackAndDoneAgainGivesTheSameSurface) {
    const Ended run = run_with(
        leg_with_inputs(GetParam(), {documents::HandInput::Kind::undo, documents::HandInput::Kind::redo}), Makes::once);
    ASSERT_TRUE(run.summary.exact.has_value());
    EXPECT_EQ(run.summary.exact->why_not, "");
    EXPECT_EQ(run.summary.exact->digest, plain_run(GetParam()).summary.exact->digest);
}

TEST_P(ExactFollowing, ACutTakenBackLeavesTheUncutSurface) {
    const Ended run = run_with(leg_with_inputs(GetParam(), {documents::HandInput::Kind::undo}));
    ASSERT_TRUE(run.summary.exact.has_value());
    EXPECT_EQ(run.summary.exact->why_not, "");
    ASSERT_EQ(run.summary.exact->pieces.size(), 1u);
    EXPECT_EQ(run.summary.exact->removed, 0.0);
    EXPECT_EQ(run.summary.exact->digest, run.afterwards.digest);
}

TEST_P(ExactFollowing, ABodyTakenAwayIsCutAndLeftOut) {
    // Given the expert's way, with the piece removed from the scene while it is held
    Scene scene = leg_with(GetParam());
    std::vector<documents::Waypoint>& path = scene.procedure.rehearsals[0].path;
    documents::Waypoint lifted = path[path.size() - 3];  // where the forceps close
    lifted.depth = -30e-3;
    lifted.inputs.push_back({documents::HandInput::Kind::remove});
    path.insert(path.end() - 2, lifted);
    const Ended run = run_with(scene);
    ASSERT_TRUE(run.summary.exact.has_value());
    EXPECT_EQ(run.summary.exact->why_not, "");
    ASSERT_EQ(run.summary.exact->pieces.size(), 1u);
    EXPECT_EQ(run.summary.exact->crumbs, 0u);
    EXPECT_LT(std::abs(run.summary.exact->removed - run.summary.exact->field_removed), run.summary.exact->allowed);
    EXPECT_EQ(run.summary.exact->digest, run.afterwards.digest);
}

INSTANTIATE_TEST_SUITE_P(Strategies, ExactFollowing, testing::Values("local", "exact"),
                         [](const auto& strategy) { return std::string(strategy.param); });

TEST(ExactFollower, BothStrategiesFindTheSameWalls) {
    const auto &local = *plain_run("local").summary.exact, &exact = *plain_run("exact").summary.exact;
    ASSERT_EQ(local.pieces.size(), exact.pieces.size());
    for (std::size_t n = 0; n < local.pieces.size(); ++n) {
        EXPECT_NEAR(local.pieces[n].volume, exact.pieces[n].volume, 1e-4 * exact.pieces[n].volume);
        ASSERT_EQ(local.pieces[n].wall_areas.size(), exact.pieces[n].wall_areas.size());
        for (std::size_t m = 0; m < local.pieces[n].wall_areas.size(); ++m) {
            EXPECT_EQ(local.pieces[n].wall_areas[m].first, exact.pieces[n].wall_areas[m].first);
            EXPECT_NEAR(local.pieces[n].wall_areas[m].second, exact.pieces[n].wall_areas[m].second,
                        0.01 * exact.pieces[n].wall_areas[m].second);
        }
    }
}

TEST(ExactFollower, AnInstrumentWithoutAStrategyLeavesNoSurfaceAndSaysSo) {
    Scene scene = leg_with("local", "forceps");
    for (documents::Instrument& one : scene.procedure.instruments)
        if (one.id == "saw") one.remeshing.clear();
    const Ended run = run_with(scene, Makes::once);
    ASSERT_TRUE(run.summary.exact.has_value());
    EXPECT_NE(run.summary.exact->why_not.find("its instrument leaves no exact surface"), std::string::npos)
        << run.summary.exact->why_not;
    EXPECT_TRUE(run.summary.exact->pieces.empty());
    EXPECT_EQ(run.summary.hash, run_without().hash);
}

TEST(ExactFollower, AnUnknownStrategyIsRefusedByName) {
    ExactStrategies strategies(host());
    Scene scene = leg_with("nobody.has.this");
    scene.procedure.instruments[0].tool = "no_tool";  // whose plugin would name a replacement
    const std::string why = strategies.start(scene.procedure);
    EXPECT_NE(why.find("`nobody.has.this`"), std::string::npos) << why;
    EXPECT_EQ(strategies.why_not(), "instrument `saw`: " + why);
    EXPECT_EQ(strategies.instrument_without(), "saw");
    EXPECT_FALSE(strategies.are_any());
}

TEST(ExactFollower, ARunThatIsDroppedEndsItsThread) {
    const Scene scene = leg_with("local");
    ExactStrategies strategies(host());
    ASSERT_EQ(strategies.start(scene.procedure), "");
    for (const int ticks : {0, 1, 6000, 12'000}) {
        RunRequest request;
        request.rehearsal = "expert";
        request.strategies = &strategies;
        RunOutcome outcome;
        const auto run = Run::create(scene, test::plugins(), request, outcome);
        ASSERT_NE(run, nullptr) << outcome.error;
        for (int n = 0; n < ticks; ++n) run->step();
    }
}

/// As it is where the package with the GPL's strategies is not installed.
class WithoutCgal : public testing::Test {
protected:
    WithoutCgal() {
        std::copy_if(catalog().begin(), catalog().end(), std::back_inserter(without_),
                     [](const ComponentInfo& c) { return c.plugin != "kerf.remesh_cgal"; });
    }
    [[nodiscard]] StrategyHost own() const { return {program, &without_}; }
    /// What a run with this strategy says of its exact surface; its verdict and its hash are those of any run.
    [[nodiscard]] static session::ExactRow run_with(const Scene& scene, const ExactStrategies& strategies) {
        RunRequest request;
        request.rehearsal = "expert";
        request.strategies = &strategies;
        const RunOutcome outcome = run_procedure(scene, test::plugins(), request);
        EXPECT_EQ(outcome.error, "");
        EXPECT_EQ(outcome.summary.hash, run_without().hash);
        return outcome.summary.exact.value_or(session::ExactRow{});
    }

private:
    ComponentCatalog without_;
};

TEST_F(WithoutCgal, TheRunContinuesWithoutASurface) {
    const Scene scene = leg_with("local");
    ExactStrategies strategies(own());
    const std::string why = strategies.start(scene.procedure);
    EXPECT_NE(why.find("Install the package `kerf-remesh-cgal`"), std::string::npos) << why;
    EXPECT_NE(why.find("`kerf.remesh_cgal.local`"), std::string::npos) << why;
    const std::string recorded = run_with(scene, strategies).why_not;
    EXPECT_NE(recorded.find("Install the package `kerf-remesh-cgal`"), std::string::npos) << recorded;
}

TEST_F(WithoutCgal, WhatDisplaceDeclinesNamesThePackage) {
    const Scene scene = leg_with("displace");  // a blade, which it always declines
    ExactStrategies strategies(own());
    ASSERT_EQ(strategies.start(scene.procedure), "");
    const std::string recorded = run_with(scene, strategies).why_not;
    EXPECT_NE(recorded.find("Install the package `kerf-remesh-cgal`"), std::string::npos) << recorded;
}

TEST(ExactFollower, AMissingStrategyIsReplacedByTheNextThatSuitsTheTool) {
    const Scene scene = leg_with("example.missing.strategy");
    ExactStrategies strategies(host());
    ASSERT_EQ(strategies.start(scene.procedure), "");
    ASSERT_EQ(strategies.notes().size(), 1u);
    EXPECT_NE(strategies.notes()[0].find("`kerf.remesh_cgal.local` replaces it"), std::string::npos)
        << strategies.notes()[0];
    EXPECT_NE(strategies.notes()[0].find("name its folder in KERF_PLUGIN_PATH"), std::string::npos)
        << strategies.notes()[0];
}

/// The surface of the leg by some of its strategies.
/// @param tolerance   [m] of the first; 0: its default
bone::ExactSurface leg_cut_by(const std::vector<std::string>& words, double tolerance = 0.0) {
    Scene scene = leg_with(words.front());
    if (tolerance > 0.0)
        for (documents::Instrument& one : scene.procedure.instruments)
            one.remeshing_parameters = {{"tolerance", tolerance}};
    ExactStrategies strategies(host());
    EXPECT_EQ(strategies.start(scene.procedure), "");
    bone::ExactTools tools = strategies.tools(scene);
    for (auto& of_solid : tools.strategies)
        std::erase_if(of_solid, [&](const bone::ExactStrategy& one) {
            return std::none_of(words.begin(), words.end(),
                                [&](const std::string& word) { return one.id == full_id(word); });
        });
    RunRequest request;
    request.rehearsal = "expert";
    RunOutcome outcome;
    const auto run = Run::create(scene, test::plugins(), request, outcome);
    if (run == nullptr) throw std::runtime_error(outcome.error);
    while (run->step()) {
    }
    return bone::exact_surface(run->simulation(), std::move(tools));
}

TEST(ExactFollower, AStrategyForWholeMeshesCutsWhatOneForPatchesDeclines) {
    const bone::ExactSurface made = leg_cut_by({"displace", "exact"}), exact = plain_run("exact").afterwards;
    EXPECT_EQ(made.error, "");
    EXPECT_GE(made.handed_over, 1);
    EXPECT_NEAR(made.removed, exact.removed, 2e-3 * exact.removed) << "`displace` moves vertices: 0.15 % here";
    ASSERT_FALSE(made.notes.empty());
    EXPECT_NE(made.notes.back().find("`kerf.burring.displace` declined"), std::string::npos) << made.notes.back();
}

TEST(ExactFollower, OneForPatchesCutsWhatOneForWholeMeshesDoesNot) {
    const bone::ExactSurface made = leg_cut_by({"stays_as_it_was", "local"}), exact = plain_run("exact").afterwards;
    EXPECT_EQ(made.error, "");
    EXPECT_NEAR(made.removed, exact.removed, 1e-3 * exact.removed);
}

TEST(ExactFollower, ALargeToleranceHidesNoBoneThatIsLeft) {
    const bone::ExactSurface fine = plain_run("local").afterwards, coarse = leg_cut_by({"local"}, 0.1e-3);
    double walls = 0.0;
    for (const bone::ExactPiece& piece : coarse.pieces)
        for (const auto& [tissue, area] : piece.wall_areas) walls += area;
    const double accuracy = leg().procedure.accuracy.volume * coarse.field_removed;
    EXPECT_GT(0.08e-3 * walls, 2.0 * accuracy) << "on all walls it would hide more than the procedure bears";
    EXPECT_GT(coarse.allowed, fine.allowed);
    EXPECT_LE(coarse.allowed, fine.allowed + 1.1 * accuracy);
}

constexpr const char* exact_animals[] = {"dies",     "hangs",   "flips_a_face",     "drops_a_face", "stays_as_it_was",
                                         "declines", "shrinks", "splits_every_face"};

/// Follows a run by a strategy.
class Followed {
public:
    /// @param is_replaced  what the strategy does not cut is cut by others
    Followed(const std::string& word, bool is_replaced) : scene_(leg_with(word)), strategies_(host()) {
        EXPECT_EQ(strategies_.start(scene_.procedure), "");
        bone::ExactTools tools = strategies_.tools(scene_);
        for (auto& of_solid : tools.strategies)
            if (!is_replaced && of_solid.size() > 1) of_solid.resize(1);
        if (!is_replaced) tools.limit = 100ms;
        follower_ = std::make_unique<bone::ExactFollower>(std::move(tools));
    }
    void follow(const Simulation& simulation) { follower_->follow(simulation); }
    [[nodiscard]] bone::ExactSurface finish(const Simulation& simulation) {
        return follower_->finish(simulation, {}, {});
    }

private:
    Scene scene_;
    ExactStrategies strategies_;
    std::unique_ptr<bone::ExactFollower> follower_;
};

struct FollowedRun {
    std::uint64_t hash = 0;
    std::vector<bone::ExactSurface> made;  ///< by each follower
};
FollowedRun run_followed_by(const std::vector<std::unique_ptr<Followed>>& followers) {
    RunRequest request;
    request.rehearsal = "expert";
    RunOutcome outcome;
    const auto run = Run::create(leg(), test::plugins(), request, outcome);
    if (run == nullptr) throw std::runtime_error(outcome.error);
    while (run->step())
        for (const auto& one : followers) one->follow(run->simulation());
    FollowedRun ended;
    for (const auto& one : followers) ended.made.push_back(one->finish(run->simulation()));
    ended.hash = run->finish().summary.hash;
    return ended;
}

/// One run that all animals follow. Each has its own surface.
const FollowedRun& run_of_animals() {
    static const FollowedRun ended = [] {
        std::vector<std::unique_ptr<Followed>> followers;
        for (const char* animal : exact_animals) followers.push_back(std::make_unique<Followed>(animal, false));
        return run_followed_by(followers);
    }();
    return ended;
}

class ExactAnimals : public testing::TestWithParam<std::size_t> {};

TEST_P(ExactAnimals, CostTheSurfaceAndNotTheRun) {
    const bone::ExactSurface& made = run_of_animals().made[GetParam()];
    EXPECT_NE(made.error.find("no exact surface could be made"), std::string::npos) << made.error;
    EXPECT_EQ(run_of_animals().hash, run_without().hash);
}

INSTANTIATE_TEST_SUITE_P(Zoo, ExactAnimals, testing::Range(std::size_t{0}, std::size(exact_animals)),
                         [](const auto& animal) { return std::string(exact_animals[animal.param]); });

TEST(ExactReplacement, CutsWhatAnAnimalLeavesAndNamesIt) {
    std::vector<std::unique_ptr<Followed>> follower;
    follower.push_back(std::make_unique<Followed>("stays_as_it_was", true));
    const FollowedRun run = run_followed_by(follower);
    EXPECT_EQ(run.hash, run_without().hash);
    const bone::ExactSurface& made = run.made.front();
    EXPECT_EQ(made.error, "");
    EXPECT_EQ(made.digest, plain_run("exact").afterwards.digest);
    EXPECT_GE(made.handed_over, 1);
    const auto names_it = [](const std::string& note) {
        return note.find("`test.animals.stays_as_it_was`") != std::string::npos &&
               note.find("bone is left in the path of the tool") != std::string::npos;
    };
    EXPECT_TRUE(std::any_of(made.notes.begin(), made.notes.end(), names_it));
}

TEST(ExactFollower, ShowsTheSurfaceWhileItIsCut) {
    const Scene scene = leg_with("local");
    ExactStrategies strategies(host());
    ASSERT_EQ(strategies.start(scene.procedure), "");
    RunRequest request;
    request.rehearsal = "expert";
    request.strategies = &strategies;
    RunOutcome outcome;
    const auto run = Run::create(scene, test::plugins(), request, outcome);
    ASSERT_NE(run, nullptr) << outcome.error;
    ASSERT_NE(run->exact(), nullptr);
    run->exact()->watch();
    std::shared_ptr<const bone::ExactView> first, last;
    while (run->step()) {
        if (const auto view = run->exact()->view(); view != nullptr && !view->pieces.empty()) {
            if (first == nullptr) first = view;
            last = view;
            if (last->pieces.size() > 1 && last != first) break;
        }
        std::this_thread::sleep_for(200us);  // a little nearer to a loop on the clock
    }
    ASSERT_NE(first, nullptr);
    // A view never changes: its pages are whole while the surface goes on.
    for (const auto& view : {first, last})
        for (const bone::ExactView::Piece& piece : view->pieces) {
            std::size_t faces = 0;
            for (std::size_t f = 0; f < piece.surface.faces.size(); ++f) {
                const bone::GrowingSurface::Face& face = piece.surface.faces[f];
                if (face.is_there == 0) continue;
                ++faces;
                for (const std::uint32_t corner : face.corners) ASSERT_LT(corner, piece.surface.vertices.size());
            }
            EXPECT_EQ(faces, piece.surface.face_count);
        }
    while (run->step()) {
    }
    // Who looked on makes no difference.
    EXPECT_EQ(run->finish().summary.exact->digest, plain_run("local").summary.exact->digest);
}

}  // namespace
}  // namespace kerf::run
