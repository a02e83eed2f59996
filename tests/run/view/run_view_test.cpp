// SPDX-License-Identifier: Apache-2.0
// A run as a viewer sees it: the same numbers as in its session, and the surface of its bone.
#include "run/view/run_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "run/view/scene_view.h"
#include "tests/support/short_scene.h"
#include "tests/support/watched_run.h"

namespace kerf::run {
namespace {

/// Meshes the bone at the end of a run anew.
class SurfaceAtEnd final : public RunObserver {
public:
    [[nodiscard]] std::string on_result(const session::RunSummary&, const Simulation& simulation) override {
        SurfacePatches patches(*simulation.present().piece(0).bone);
        static_cast<void>(patches.update_all(simulation.present().cut(0)));
        for (std::size_t brick = 0; brick < simulation.present().piece(0).bone->grid().brick_count(); ++brick)
            all.push_back(patches.patch(brick));
        return {};
    }
    std::vector<std::shared_ptr<const BrickPatch>> all;
};

/// The short scene, watched by a viewer.
struct Seen {
    RunView view{test::short_scene(), {.mode = "practice", .hand = "rehearsal expert"}};
    SurfaceAtEnd at_end;
    test::WatchedRun run;
    std::vector<ViewedRow> rows;
    std::vector<ViewedMoment> moments;
    std::vector<ViewedEvent> events;
    ViewedState state;

    Seen() {
        RunRequest request;
        request.observers = {&view, &at_end};
        run = test::watched_run(test::short_scene(), test::plugins(), request);
        view.take(rows);
        view.take(moments);
        view.take(events);
        view.take(state);
    }
};
const Seen& seen() {
    static const Seen one;
    return one;
}

TEST(RunView, ShowsTheNumbersOfTheSession) {
    ASSERT_EQ(seen().rows.size(), seen().run.ticks.size());
    for (std::size_t i = 0; i < seen().rows.size(); i += 7) {
        const session::TickRow& row = seen().run.ticks[i];
        ASSERT_EQ(seen().rows[i].time, row.time);
        ASSERT_EQ(seen().rows[i].depth, static_cast<float>(row.depth));
        ASSERT_EQ(seen().rows[i].torque, static_cast<float>(row.torque));
        ASSERT_FLOAT_EQ(seen().rows[i].force, static_cast<float>(length(linear(row.modelled))));
        ASSERT_EQ(seen().rows[i].step, row.step);
    }
    const session::TickRow& last = seen().run.ticks.back();
    EXPECT_EQ(length(seen().state.world_from_tool.position - last.world_from_tool.position), 0.0);
    EXPECT_EQ(seen().state.tick, seen().run.ticks.size());
    EXPECT_TRUE(seen().state.is_over);
}

TEST(RunView, ShowsTheForceOfTheDeviceInNewtonsOfBone) {
    const auto pressed = std::max_element(seen().rows.begin(), seen().rows.end(),
                                          [](const auto& a, const auto& b) { return a.hand_force < b.hand_force; });
    ASSERT_GT(pressed->hand_force, 5.0f);
    const session::TickRow& row = seen().run.ticks[static_cast<std::size_t>(pressed - seen().rows.begin())];
    EXPECT_NEAR(static_cast<double>(pressed->hand_force) * seen().run.summary.force_scale,
                length(linear(row.commanded)), 1e-5);
}

TEST(RunView, HasSixtyMomentsASecond) {
    const double seconds = seen().run.summary.duration;
    EXPECT_NEAR(static_cast<double>(seen().moments.size()), 62.5 * seconds, 3.0);
    EXPECT_TRUE(std::is_sorted(seen().moments.begin(), seen().moments.end(),
                               [](const auto& a, const auto& b) { return a.state.time < b.state.time; }));
}

TEST(RunView, ShowsTheSurfaceOfThePresentBone) {
    const auto& surface = seen().moments.back().surface->bodies.front();
    std::size_t vertices = 0;
    for (std::size_t brick = 0; brick < seen().at_end.all.size(); ++brick) {
        const auto& expected = seen().at_end.all[brick];
        const auto& shown = surface.patches[brick];
        ASSERT_EQ(expected == nullptr, shown == nullptr) << brick;
        if (shown == nullptr) continue;
        ASSERT_EQ(expected->triangles(), shown->triangles);
        for (std::size_t v = 0; v < shown->vertices.size(); ++v, ++vertices) {
            ASSERT_TRUE(std::equal(shown->vertices[v].position, shown->vertices[v].position + 3,
                                   expected->vertices()[v].position));
            ASSERT_EQ(shown->vertices[v].tissue, expected->tissue()[v]);
        }
    }
    EXPECT_GT(vertices, 10'000u);
}

TEST(RunView, KeepsTheSurfaceOfEarlierMoments) {
    const auto &first = seen().moments.front().surface, &last = seen().moments.back().surface;
    std::size_t changed = 0;
    last->bodies[0].patches.for_each_change_since(first->bodies[0].patches,
                                                  [&](std::size_t, const auto&) { ++changed; });
    EXPECT_GT(changed, 0u) << "the drill has met bone";
    EXPECT_LT(changed, 40u);
}

TEST(RunView, FindsTheNearestZone) {
    const ViewedMoment& last = seen().moments.back();
    ASSERT_GE(last.state.zone, 0);
    const auto zone = static_cast<std::size_t>(last.state.zone);
    const Scene& scene = test::short_scene();
    EXPECT_NEAR(last.state.zone_distance,
                clearance(scene.tool(0).outline.cutting, last.state.world_from_tool, scene.anatomy.zones[zone]), 1e-4);
}

TEST(RunView, ShowsTheResult) {
    const auto result = seen().view.result();
    ASSERT_TRUE(result);
    EXPECT_EQ(result->verdict, session::to_text(seen().run.summary.verdict));
    EXPECT_EQ(result->score, seen().run.summary.score);
    ASSERT_FALSE(result->deductions.empty());
    EXPECT_TRUE(std::is_sorted(result->deductions.begin(), result->deductions.end(),
                               [](const auto& a, const auto& b) { return a.points > b.points; }));
}

TEST(RunView, CanBeReadWhileTheRunGoesOn) {
    RunView view(test::short_scene(), {.mode = "practice"});
    RunRequest request;
    request.observers = {&view};
    std::atomic<bool> is_over{false};
    std::uint64_t last = 0, states = 0;
    std::thread reader([&] {
        std::vector<ViewedMoment> moments;
        std::vector<ViewedRow> rows;
        ViewedState state;
        while (!is_over) {
            if (view.take(state)) ++states;
            EXPECT_GE(state.tick, last);
            last = state.tick;
            view.take(moments);
            view.take(rows);
        }
    });
    static_cast<void>(run_procedure(test::short_scene(), test::plugins(), request));
    is_over = true;
    reader.join();
    EXPECT_GT(states, 3u);
}

TEST(RunView, EndsTheRunWhenTheViewerStopsIt) {
    RunView view(test::short_scene(), {.mode = "practice"});
    RunRequest request;
    request.observers = {&view};
    view.stop();
    const RunOutcome outcome = run_procedure(test::short_scene(), test::plugins(), request);
    EXPECT_TRUE(outcome.was_interrupted);
    EXPECT_EQ(outcome.summary.ticks, 1u);
}

TEST(RunView, EndsAPausedRun) {
    RunView view(test::short_scene(), {.mode = "practice"});
    MouseBox box;
    view.let_mouse_lead(box);
    view.lead({.is_paused = true});
    EXPECT_TRUE(box.get().is_paused);
    view.stop();
    EXPECT_FALSE(box.get().is_paused);
    view.lead({.is_paused = true});
    EXPECT_FALSE(box.get().is_paused) << "the run must end";
}

// ---- the scene in words -------------------------------------------------------------------------------------------

TEST(SceneView, StatesGoalsAndLimitsWithTheirUnits) {
    const documents::Procedure& procedure = test::short_scene().procedure;
    documents::Goal depth{.quantity = "depth", .bound = {.at_least = 30e-3, .at_most = {}}};
    EXPECT_EQ(viewed_goal(depth, procedure).words, "depth at least 30 mm");
    documents::Limit limit{.quantity = "hole_angle", .bound = {.at_least = {}, .at_most = 0.08726646259971647}};
    EXPECT_EQ(viewed_limit(limit, procedure).words, "angle of the hole at most 5 deg");
    documents::Limit zone{.quantity = "clearance", .zone = "spinal_canal", .bound = {.at_least = 1e-3, .at_most = {}}};
    EXPECT_EQ(viewed_limit(zone, procedure).words, "distance to spinal canal at least 1 mm");
    EXPECT_EQ(viewed_limit(zone, procedure).quantity, "spinal_canal");
    documents::Limit both{.quantity = "torque", .bound = {.at_least = 0.5, .at_most = 2.5}};
    EXPECT_EQ(viewed_limit(both, procedure).words, "torque at least 0.5 N m and at most 2.5 N m");
}

TEST(SceneView, HasTheTissuesToolsAndStepsOfTheScene) {
    const Scene& scene = test::short_scene();
    const ViewedScene viewed = viewed_scene(scene, {.mode = "practice", .hand = "mouse"});
    ASSERT_EQ(viewed.tissues.size(), scene.body.materials.size());
    EXPECT_EQ(viewed.tissues[0].name, "cortical");
    EXPECT_EQ(viewed.tissues[0].colour.red, 0xe8);
    ASSERT_EQ(viewed.steps.size(), scene.procedure.steps.size());
    EXPECT_EQ(viewed.steps[0].depth_goal, 30e-3);
    ASSERT_EQ(viewed.tools.size(), scene.tools.size());
    for (const ViewedTool& tool : viewed.tools) EXPECT_FALSE(tool.mesh.triangles.empty()) << tool.name;
}

TEST(SceneView, HasNoHelpInAnExamination) {
    const Scene& scene = test::short_scene();
    const ViewedScene viewed = viewed_scene(scene, {.mode = "exam", .hand = "mouse"});
    EXPECT_TRUE(viewed.zones.empty());
    for (const ViewedStep& step : viewed.steps) {
        EXPECT_TRUE(step.limits.empty());
        EXPECT_FALSE(step.depth_limit);
        EXPECT_FALSE(step.plane_normal);
    }
    EXPECT_EQ(viewed.steps.size(), scene.procedure.steps.size());

    RunView view(scene, {.mode = "exam"});
    RunRequest request;
    request.mode = "exam";
    request.observers = {&view};
    static_cast<void>(run_procedure(scene, test::plugins(), request));
    std::vector<ViewedMoment> moments;
    view.take(moments);
    for (const ViewedMoment& moment : moments) {
        ASSERT_EQ(moment.state.zone, -1);
        ASSERT_EQ(moment.state.broken, 0u);
        for (const float value : moment.state.limit_values) ASSERT_TRUE(std::isnan(value));
    }
    std::vector<ViewedEvent> events;
    view.take(events);
    EXPECT_TRUE(events.empty());
    EXPECT_TRUE(view.next_action().empty());
    EXPECT_TRUE(view.result()) << "at the end";
}

TEST(SceneView, HasTheWordsOfTheLanguage) {
    const Scene scene = test::scene_with(
        {"steps.pilot-hole.title={en: Drill, de: Bohren}", "steps.pilot-hole.hint={en: Straight on, de: Geradeaus}"});
    EXPECT_EQ(viewed_scene(scene, {.language = "de"}).steps[0].title, "Bohren");
    EXPECT_EQ(viewed_scene(scene, {.language = "de"}).steps[0].hint, "Geradeaus");
    EXPECT_EQ(viewed_scene(scene, {.language = "fr"}).steps[0].title, "Drill");
    EXPECT_EQ(viewed_scene(scene, {.mode = "exam", .language = "de"}).steps[0].hint, "");
    EXPECT_EQ(viewed_scene(scene, {.assist = documents::Assist::off}).steps[0].hint, "");
}

/// Returns the states of a run whose hand approaches the bone, and requests help 5 mm in front of it.
std::vector<ViewedState> states_of(const std::string& assist, const std::string& show) {
    const Scene scene = test::scene_with({"assist=" + assist, "zones={canal: {show: " + show + "}}",
                                          "rehearsals.expert.path=[{depth: -20 mm}, {depth: -5 mm, do: assist}, "
                                          "{depth: 0 mm}]"});
    RunView view(scene, {.mode = "practice", .assist = scene.procedure.assist});
    RunRequest request;
    request.observers = {&view};
    static_cast<void>(run_procedure(scene, test::plugins(), request));
    std::vector<ViewedMoment> moments;
    view.take(moments);
    std::vector<ViewedState> states;
    for (const ViewedMoment& moment : moments) states.push_back(moment.state);
    return states;
}

TEST(RunView, ShowsHelpOfAStepFromTheRequestOn) {
    const std::vector<ViewedState> states = states_of("on-request", "always");
    ASSERT_GT(states.size(), 20u);
    EXPECT_FALSE(states.front().has_help);
    EXPECT_EQ(states.front().shown_zones, 0u);
    EXPECT_EQ(states.front().zone, -1);
    const auto helped = std::ranges::find(states, true, &ViewedState::has_help);
    ASSERT_NE(helped, states.end());
    EXPECT_NEAR(helped->depth, -5e-3, 0.5e-3);
    EXPECT_EQ(states[states.size() - 2].shown_zones, 1u);
    EXPECT_EQ(states[states.size() - 2].zone, 0);
}

TEST(RunView, ShowsZonesWhenTheProcedureStates) {
    const std::vector<ViewedState> always = states_of("full", "always"), never = states_of("full", "never"),
                                   after = states_of("full", "after"), near = states_of("full", "near, within: 30 mm");
    EXPECT_EQ(always.front().shown_zones, 1u);
    for (const ViewedState& state : never) ASSERT_EQ(state.shown_zones, 0u);
    for (const ViewedState& state : after) ASSERT_EQ(state.shown_zones, state.is_over ? 1u : 0u);
    ASSERT_TRUE(after.back().is_over);
    ASSERT_EQ(near.size(), always.size());
    bool has_both[2] = {false, false};
    for (std::size_t i = 0; i < near.size(); ++i) {
        const bool is_near = always[i].zone_distance <= 30e-3;
        has_both[is_near] = true;
        ASSERT_EQ(near[i].shown_zones != 0, is_near || near[i].is_over) << always[i].zone_distance;
    }
    EXPECT_TRUE(has_both[0] && has_both[1]) << "the hand crosses the distance";
}

// ---- light --------------------------------------------------------------------------------------------------------

TEST(SurfaceView, IsLightOnAFlatFaceAndDarkInAHole) {
    constexpr double h = 0.25e-3;
    const Grid grid = Grid::covering({-6e-3, -6e-3, -6e-3}, {6e-3, 6e-3, 3e-3}, h);

    Body body;
    body.id = "block";
    body.surface = LevelSet::build(grid, [](Vec3 p) {
        const double block = std::max({p.z, std::abs(p.x) - 5e-3, std::abs(p.y) - 5e-3, -5e-3 - p.z});
        const double hole = std::max(std::hypot(p.x, p.y) - 2.0 * h, -3e-3 - p.z);
        return std::max(block, -hole);
    });
    body.materials.push_back({.id = "cortical", .density = 1850.0, .border = {}});
    PresentBone bone(body, 1);
    SurfaceView view;
    const auto surface = view.update(bone, {true});
    ASSERT_NE(surface, nullptr);
    double flat = 0.0, wall = 0.0;
    int flats = 0, walls = 0;
    const auto& patches = surface->bodies[0].patches;
    for (std::size_t brick = 0; brick < patches.capacity(); ++brick) {
        if (patches[brick] == nullptr) continue;
        for (const ViewedVertex& v : patches[brick]->vertices) {
            const double r = std::hypot(v.position[0], v.position[1]);
            if (v.normal[2] > 120 && std::abs(v.position[2]) < 1e-4f && r > 2.5e-3 && r < 3.5e-3) {
                flat += v.light / 255.0;
                ++flats;
            }
            if (r < 2.3 * h && v.position[2] < -1e-3f && v.position[2] > -2.5e-3f) {
                wall += v.light / 255.0;
                ++walls;
            }
        }
    }
    ASSERT_GT(flats, 50);
    ASSERT_GT(walls, 50);
    EXPECT_GT(flat / flats, 0.97);
    // The probes at 4 and 7 voxels, with weights 0.5 and 0.4 of 2.65, end in the opposite wall.
    EXPECT_NEAR(wall / walls, 1.0 - 0.9 / 2.65, 0.06);
    EXPECT_EQ(view.update(bone, {true}), nullptr) << "nothing has changed";
}

/// Returns a ball.
Body ball(double radius) {
    Body body;
    body.id = "ball";
    const Grid grid = Grid::covering({-6e-3, -6e-3, -6e-3}, {6e-3, 6e-3, 6e-3}, 0.5e-3);
    body.surface = LevelSet::build(grid, [=](Vec3 p) { return length(p) - radius; });
    body.materials.push_back({.id = "cortical", .density = 1850.0, .border = {}});
    return body;
}

std::size_t triangles_of(const ViewedBodySurface& surface) {
    std::size_t count = 0;
    for (std::size_t brick = 0; brick < surface.patches.capacity(); ++brick)
        if (surface.patches[brick] != nullptr) count += surface.patches[brick]->triangles.size();
    return count;
}

// After an undo another body may have the number of the one that went.
TEST(SurfaceView, ShowsAllOfABodyThatReplacesAnother) {
    const Body small = ball(3e-3), large = ball(5e-3);
    PresentBone first(small, 1), second(large, 1);
    SurfaceView view, fresh;
    ASSERT_NE(view.update(first, {true}), nullptr);
    const auto replaced = view.update(second, {true});
    PresentBone again(large, 1);
    const auto expected = fresh.update(again, {true});
    ASSERT_NE(replaced, nullptr);
    EXPECT_EQ(triangles_of(replaced->bodies[0]), triangles_of(expected->bodies[0]));
}

}  // namespace
}  // namespace kerf::run
