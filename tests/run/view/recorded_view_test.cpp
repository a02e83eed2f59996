// SPDX-License-Identifier: Apache-2.0
// A run as a viewer sees it from its session alone.
#include "run/view/recorded_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "bone/surface/write_stl.h"
#include "run/view/mesh_surface.h"
#include "session/recorder.h"
#include "session/session_tables.h"
#include "tests/session/synthetic_run.h"
#include "tests/support/plain_session.h"
#include "tests/support/temporary_folder.h"
#include "text/write_file.h"

namespace kerf::run {
namespace {

using session::EventRow;
using session::TickRow;
using test::TemporaryFolder;

constexpr const char* procedure_text = R"(metadata: {title: Pilot hole in a pedicle}
instruments:
  pilot_drill: {plugin: kerf.drilling, parameters: {diameter: 3.2 mm}}
steps:
  - {id: pilot-hole, title: Drill the pilot hole, instrument: pilot_drill,
     goals: [{depth: {at_least: 30 mm}}], limits: [{clearance: {zone: spinal-canal, at_least: 1 mm}}, {depth: {at_most: 31 mm}}]}
  - {id: withdraw, title: Withdraw the bit, instrument: pilot_drill}
)";

session::SessionHeader header() {
    const session::RunSummary summary = test::synthetic_summary();
    session::SessionHeader made;
    made.procedure = summary.procedure;
    made.procedure_text = procedure_text;
    made.conditions.force_scale = summary.force_scale;
    made.signals = summary.signals;
    made.tissues = summary.tissues;
    return made;
}

std::vector<TickRow> ticks() {
    std::vector<TickRow> rows = test::synthetic_ticks();
    for (TickRow& row : rows)
        for (std::size_t i = 0; i < 6; ++i) row.commanded[i] = 0.05 * row.coupled[i];
    return rows;
}

std::vector<EventRow> events() {
    return {{1500, 1.5, "image.taken", "AP 1"},
            {11400, 11.4, "zone_entered", "spinal-canal"},
            {11750, 11.75, "limit_broken", "depth"},
            {12050, 12.05, "goal_reached", "pilot-hole: depth"},
            {12100, 12.1, "step_done", "pilot-hole"}};
}

std::unique_ptr<session::Recorder> recorder(const std::string& path, const std::vector<TickRow>& rows) {
    auto created = session::Recorder::create(path, header());
    EXPECT_EQ(created.error, "");
    for (const EventRow& event : events()) created.recorder->push_event(event);
    for (const TickRow& row : rows) {
        created.recorder->push(row);
        created.recorder->wait_for_capacity();
    }
    return std::move(created.recorder);
}

/// Writes a finished session. Returns its file.
std::string finished(const TemporaryFolder& folder, const std::vector<TickRow>& rows = ticks()) {
    std::string path = folder / "session.db";
    session::RunSummary summary = test::synthetic_summary();
    summary.deductions = {{.name = "depth", .at = 11.75, .loss = 10.0},
                          {.name = "spinal-canal", .detail = "0.6 mm inside", .at = 11.4, .loss = 28.3}};
    EXPECT_EQ(recorder(path, rows)->finish(summary, session::drawn_surface(test::synthetic_bone(24))), "");
    return path;
}

std::unique_ptr<RecordedView> shown(const std::string& path) {
    std::string error;
    auto view = RecordedView::read(path, "its procedure has another text now", error);
    EXPECT_NE(view, nullptr) << error;
    return view;
}

std::string refusal(const std::string& path) {
    std::string error;
    EXPECT_EQ(RecordedView::read(path, "", error), nullptr);
    return error;
}

std::size_t triangles_of(const ViewedSurface& surface) {
    std::size_t count = 0;
    for (const ViewedBodySurface& body : surface.bodies)
        for (std::size_t brick = 0; brick < body.patches.capacity(); ++brick)
            if (body.patches[brick] != nullptr) count += body.patches[brick]->triangles.size();
    return count;
}

bool has(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

/// All that a view shows of the finished session.
struct Seen {
    TemporaryFolder folder;
    std::vector<TickRow> recorded = ticks();
    std::unique_ptr<RecordedView> view = shown(finished(folder));
    std::vector<ViewedRow> rows;
    std::vector<ViewedMoment> moments;
    std::vector<ViewedEvent> events;

    Seen() {
        view->take(rows);
        view->take(moments);
        view->take(events);
    }
    [[nodiscard]] const ViewedState& at(double time) const {
        const auto after = std::upper_bound(moments.begin(), moments.end(), time,
                                            [](double t, const ViewedMoment& m) { return t < m.state.time; });
        return std::prev(after)->state;
    }
};
const Seen& seen() {
    static const Seen one;
    return one;
}

TEST(RecordedView, HasTheRowsOfTheSession) {
    ASSERT_EQ(seen().rows.size(), seen().recorded.size());
    for (std::size_t i = 0; i < seen().rows.size(); i += 97) {
        const TickRow& row = seen().recorded[i];
        ASSERT_EQ(seen().rows[i].time, row.time);
        ASSERT_FLOAT_EQ(seen().rows[i].force, static_cast<float>(length(linear(row.modelled))));
        ASSERT_FLOAT_EQ(seen().rows[i].hand_force, static_cast<float>(length(linear(row.coupled)))) << "bone newtons";
        ASSERT_FLOAT_EQ(seen().rows[i].torque, static_cast<float>(row.torque));
        ASSERT_FLOAT_EQ(seen().rows[i].depth, static_cast<float>(row.depth));
        ASSERT_EQ(seen().rows[i].step, row.step);
    }
    EXPECT_NEAR(*seen().view->duration(), 14.0, 1e-9) << "the end of the last tick";
}

TEST(RecordedView, ShowsTheStateOfATimeAsRecorded) {
    for (const double time : {0.5, 3.0, 11.9, 13.5}) {
        const ViewedState& state = seen().at(time);
        const TickRow& row = seen().recorded[state.tick - 1];
        EXPECT_NEAR(state.time, time, 17e-3);
        EXPECT_LT(length(state.world_from_tool.position - row.world_from_tool.position), 1e-8) << time;
        EXPECT_NEAR(state.thrust, row.thrust, 1e-5);
        EXPECT_EQ(state.step, row.step);
        EXPECT_EQ(state.tissue, row.tissue);
    }
    EXPECT_EQ(seen().at(6.0).cortices, 1u);
}

TEST(RecordedView, NamesStepsToolsAndLimitsByTheRecordedText) {
    const ViewedScene& scene = seen().view->scene();
    EXPECT_EQ(scene.title, "Pilot hole in a pedicle");
    ASSERT_EQ(scene.steps.size(), 2u);
    EXPECT_EQ(scene.steps[0].title, "Drill the pilot hole");
    EXPECT_EQ(scene.steps[0].goals.front().words, "depth at least 30 mm");
    EXPECT_EQ(scene.steps[0].limits.front().words, "distance to spinal canal at least 1 mm");
    EXPECT_EQ(scene.steps[0].depth_limit, 31e-3);
    EXPECT_EQ(scene.steps[0].length, 0.0) << "the plan is unknown";
    ASSERT_EQ(scene.tools.size(), 1u);
    EXPECT_EQ(scene.tools[0].name, "pilot drill");
    float widest = 0.0f;
    for (const auto& p : scene.tools[0].mesh.positions) widest = std::max(widest, std::hypot(p[0], p[1]));
    EXPECT_NEAR(widest, 1.6e-3f, 1e-6f);
}

TEST(RecordedView, EstimatesTheAxisOfAStep) {
    const ViewedStep& step = seen().view->scene().steps[0];
    EXPECT_LT(length(step.along - Vec3{0, 0, -1}), 1e-6);
    EXPECT_LT(length(step.entry), 1e-5);
}

TEST(RecordedView, MarksEventsByTheirKind) {
    using Kind = ViewedEvent::Kind;
    std::vector<Kind> kinds;
    for (const ViewedEvent& event : seen().events) kinds.push_back(event.kind);
    EXPECT_EQ(kinds, (std::vector{Kind::image, Kind::limit, Kind::limit, Kind::goal, Kind::step}));
}

TEST(RecordedView, SetsGoalsAndLimitsAtTheirTimes) {
    EXPECT_EQ(seen().at(11.0).broken, 0u);
    EXPECT_EQ(seen().at(11.5).broken, 1u);
    EXPECT_EQ(seen().at(12.0).broken, 3u);
    EXPECT_EQ(seen().at(12.0).goals_done, 0u);
    EXPECT_EQ(seen().at(12.09).goals_done, 1u);
    EXPECT_EQ(seen().at(13.0).broken, 0u) << "the next step has none";
}

TEST(RecordedView, HasAPlaceholderForEachRadiograph) {
    std::vector<std::shared_ptr<const ViewedRadiograph>> all;
    auto view = shown(seen().folder / "session.db");
    view->take(all);
    ASSERT_EQ(all.size(), 1u) << "as many as the state counts, or a viewer waits for them";
    EXPECT_EQ(seen().moments.back().state.shots, 1u);
    EXPECT_NE(all[0]->error, "");
}

TEST(RecordedView, ShowsTheResult) {
    const auto result = seen().view->result();
    ASSERT_TRUE(result);
    EXPECT_EQ(result->verdict, "fail");
    EXPECT_EQ(result->score, 61.7);
    ASSERT_EQ(result->deductions.size(), 2u);
    EXPECT_EQ(result->deductions[0].words, "spinal-canal: 0.6 mm inside");
    EXPECT_EQ(result->deductions[0].time, 11.4);
}

TEST(RecordedView, ShowsTheBoneOfTheEnd) {
    ASSERT_NE(seen().view->surface(), nullptr);
    EXPECT_EQ(triangles_of(*seen().view->surface()), test::synthetic_bone(24).triangles.size());
    EXPECT_EQ(seen().moments.front().surface, seen().moments.back().surface);
    const std::string& note = seen().view->scene().note;
    EXPECT_TRUE(has(note, "its procedure has another text now")) << note;
    EXPECT_TRUE(has(note, "the bone is as at the end")) << note;
    EXPECT_TRUE(has(note, "a pointer of 100 mm")) << note;
}

TEST(RecordedView, ShowsARunThatWasCutShort) {
    const TemporaryFolder folder;
    recorder(folder / "session.db", ticks()).reset();
    const auto view = shown(folder / "session.db");
    EXPECT_EQ(view->surface(), nullptr);
    EXPECT_TRUE(has(view->scene().note, "no bone is drawn, because the run was cut short")) << view->scene().note;
    EXPECT_EQ(view->result()->verdict, "incomplete");
    EXPECT_TRUE(std::isnan(view->result()->score));
    EXPECT_GT(view->scene().region_radius, 0.0);
}

TEST(RecordedView, RefusesDamagedRows) {
    for (const bool has_pose : {false, true}) {
        const TemporaryFolder folder;
        std::vector<TickRow> rows = test::synthetic_ticks(40);
        if (has_pose)
            rows[20].time = -1.0;
        else
            rows[20].world_from_tool.rotation = {0, 0, 0, 0};
        EXPECT_TRUE(has(refusal(finished(folder, rows)), "tick 20 has no pose or no time"));
    }
}

TEST(RecordedView, ShowsForcesThatAreNoNumbersAsZero) {
    const TemporaryFolder folder;
    std::vector<TickRow> rows = test::synthetic_ticks(40);
    rows[20].modelled[1] = std::numeric_limits<double>::quiet_NaN();
    rows[21].torque = std::numeric_limits<double>::infinity();
    std::vector<ViewedRow> all;
    shown(finished(folder, rows))->take(all);
    for (const ViewedRow& row : all) ASSERT_TRUE(std::isfinite(row.force) && std::isfinite(row.torque));
}

TEST(RecordedView, RefusesFilesThatAreCut) {
    const TemporaryFolder folder;
    const std::string whole = test::contents_of(finished(folder, test::synthetic_ticks(40)));
    for (const std::size_t percent : {0u, 1u, 30u, 60u, 95u}) {
        const std::string path = folder / ("cut-" + std::to_string(percent) + ".db");
        std::ofstream(path, std::ios::binary) << whole.substr(0, whole.size() * percent / 100);
        EXPECT_NE(refusal(path), "") << percent;
    }
    EXPECT_TRUE(has(refusal(folder / "missing.db"), "cannot be opened"));
}

TEST(RecordedView, RefusesASessionOfALaterSchema) {
    const TemporaryFolder folder;
    const std::string path = finished(folder, test::synthetic_ticks(40));
    ASSERT_EQ(test::run_sql(path, "PRAGMA user_version = 99"), "");
    EXPECT_TRUE(has(refusal(path), "schema 99"));
}

// ---- sessions that do not locate their bone -----------------------------------------------------------------------

/// Copies a kept session of an older schema. Returns its file.
std::string older_session(const TemporaryFolder& folder) {
    std::filesystem::copy_file(KERF_SOURCE_DIR "/tests/sessions/schema-4.db", folder / "session.db");
    return folder / "session.db";
}

TEST(RecordedView, TakesTheBoneOfTheFolderForAnOlderSession) {
    const TemporaryFolder folder;
    const std::string path = older_session(folder);
    const Mesh bone = test::synthetic_bone(24);
    ASSERT_EQ(text::write_file(folder / "bone.stl", bone::stl_bytes(bone)), "");
    const auto view = shown(path);
    ASSERT_NE(view->surface(), nullptr) << view->scene().note;
    EXPECT_EQ(triangles_of(*view->surface()), bone.triangles.size());
}

TEST(RecordedView, ShowsNoBoneOfAFileThatCannotBeUsed) {
    const TemporaryFolder folder;
    const std::string path = older_session(folder);
    const auto note_with = [&](const std::string& bytes) {
        std::ofstream(folder / "bone.stl", std::ios::binary) << bytes;
        const auto view = shown(path);
        EXPECT_EQ(view->surface(), nullptr);
        return view->scene().note;
    };
    EXPECT_TRUE(has(shown(path)->scene().note, "bone.stl` is missing"));
    EXPECT_TRUE(has(note_with("no surface"), "cannot be read (E0644)"));
    std::filesystem::resize_file(folder / "bone.stl", 201'000'000);
    EXPECT_TRUE(has(shown(path)->scene().note, "has 201 MB, expected at most 200 MB"));
}

TEST(RecordedView, ReadsSessionsOfEachSchema) {
    for (const char* schema : {"2", "3", "4", "5"}) {
        const auto view = shown(std::string(KERF_SOURCE_DIR "/tests/sessions/schema-") + schema + ".db");
        EXPECT_EQ(view->scene().title, "Opening a pedicle with an awl") << schema;
        EXPECT_NEAR(*view->duration(), 0.05, 2e-3) << schema;
    }
}

// ---- surfaces of meshes -------------------------------------------------------------------------------------------

Mesh with_normals(const Mesh& mesh) { return session::unpacked(session::drawn_surface(mesh)); }

TEST(MeshSurface, ThinsToTheCountThatIsAllowed) {
    const Mesh fine = with_normals(test::synthetic_bone(96));
    ASSERT_GT(fine.triangles.size(), 18'000u);
    const Mesh coarse = thinned(fine, 2'000);
    EXPECT_LE(coarse.triangles.size(), 2'000u);
    EXPECT_GT(coarse.triangles.size(), 500u);
    for (const auto& t : coarse.triangles) ASSERT_LT(std::max({t[0], t[1], t[2]}), coarse.vertices.size());
    EXPECT_EQ(thinned(fine, fine.triangles.size()).triangles.size(), fine.triangles.size());
}

TEST(MeshSurface, KeepsEachTriangleInOneBrick) {
    const Mesh fine = with_normals(test::synthetic_bone(96));
    const auto surface = viewed_surface(fine);
    ASSERT_TRUE(surface);
    ViewedSurface all;
    all.bodies.push_back(*surface);
    EXPECT_EQ(triangles_of(all), fine.triangles.size());
    EXPECT_GT(surface->bricks[0], 2);
}

TEST(MeshSurface, RefusesTrianglesThatAreAllAtOnePosition) {
    Mesh mesh = with_normals(test::synthetic_bone(4));
    const auto one = mesh.triangles.front();
    mesh.triangles.assign(5'000, one);
    EXPECT_FALSE(viewed_surface(mesh));
    mesh.triangles.clear();
    EXPECT_FALSE(viewed_surface(mesh));
}

}  // namespace
}  // namespace kerf::run
