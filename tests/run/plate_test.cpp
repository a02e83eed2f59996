// SPDX-License-Identifier: Apache-2.0
// Plates: made of solids, planned on bone, brought in, and followed by steps through their holes.
#include "run/plate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <initializer_list>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/field/cut/removed_volume.h"
#include "documents/solids.h"
#include "run/documents.h"
#include "run/run.h"
#include "run/verdict/cut_results.h"
#include "session/read_session.h"
#include "tests/support/drill_rig.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/watched_run.h"

namespace kerf::run {
namespace {

using namespace literals;

// A block of bone, 30 × 40 × 20 mm with its upper face at z = 10 mm, and a plate of 5 × 30 × 12 mm on it. Its long edge
// is its x, which `up` turns along the patient's y.
const char* const bone = R"(apiVersion: kerf/v1
kind: Anatomy
metadata: {id: block, title: A block of bone}
phantom: {parts: [{id: block, box: {centre: 0 0 0 mm, size: 30 40 20 mm}}]}
tissues: [{id: bone, density: 1.2 g/cm3}]
landmarks:
  points: {middle: {at: 0 0 0 mm, tolerance: 1 mm}}
  axes: {way: {from: 1 2 25 mm, to: 1 2 -9 mm, tolerance: 1 mm}}
)";

const char* const operation = R"(apiVersion: kerf/v1
kind: Procedure
metadata: {id: plating, title: Plating, version: 0.1.0, status: draft}
needs: {landmarks: [way, middle], tissues: [bone]}
anatomy: block.yaml
accuracy: {spacing: 0.5 mm}
haptics: {device: touch}
instruments:
  drill:
    plugin: kerf.drilling
    tool: twist_drill
    force: drill_cutting
    parameters: {diameter: 3.2 mm}
    drives: {spindle_speed: 1000 rpm}
  screw:
    plugin: kerf.implant
    tool: bone_screw
    force: screw_insertion
    parameters: {outer_diameter: 4.5 mm, thread_length: 20 mm, head_diameter: 8 mm}
implants:
  plate:
    parts:
      - {id: body, box: {centre: 0 0 -2.5 mm, size: 30 12 5 mm}}
      - {id: near, tube: {from: -10 0 -6 mm, to: -10 0 1 mm, radius: 2.5 mm}, subtract: true}
      - {id: far, tube: {from: 10 0 -6 mm, to: 10 0 1 mm, radius: 2.5 mm}, subtract: true}
    holes:
      near: {from: -10 0 -15 mm, to: -10 0 15 mm, diameter: 5 mm}
      far: {from: 10 0 -15 mm, to: 10 0 15 mm, diameter: 5 mm}
    place: {axis: way, up: 0 1 0}
steps:
  - {id: drill, title: Drill, instrument: drill, axis: plate.near, goals: [{depth: {at_least: 12 mm}}]}
  - {id: fix, title: Fix, instrument: screw, axis: plate.near, goals: [{depth: {at_least: 5 mm}}]}
rehearsals:
  - id: expert
    expect: pass
    hand: {feed: 3 mm/s, approach: 20 mm/s}
    path:
      - {depth: -25 mm, place: plate}
      - {depth: 12.5 mm}
      - {depth: -25 mm}
      - {step: fix, depth: -1 mm}
      - {depth: 8 mm, turn: {by: 6 turns, speed: 60 rpm}, do: release}
)";

/// `operation` with some of its text changed, in a folder of its own.
class Plating {
public:
    struct Change {
        std::string before, after;
    };
    explicit Plating(std::initializer_list<Change> changes = {}) {
        std::string text = operation;
        for (const Change& change : changes) {
            const std::size_t at = text.find(change.before);
            if (at == std::string::npos) throw std::runtime_error(change.before);
            text.replace(at, change.before.size(), change.after);
        }
        std::ofstream(folder_ / "block.yaml") << bone;
        std::ofstream(folder_ / "plating.yaml") << text;
    }
    [[nodiscard]] std::optional<Scene> scene(text::Diagnostics& found) const {
        return make_scene(folder_ / "plating.yaml", "", test::plugins()).take(found);
    }
    [[nodiscard]] Scene scene() const {
        text::Diagnostics found;
        auto made = scene(found);
        if (!made) throw std::runtime_error(to_text(found));
        return std::move(*made);
    }
    [[nodiscard]] std::string refusal() const {
        text::Diagnostics found;
        EXPECT_FALSE(scene(found));
        return to_text(found);
    }

private:
    test::TemporaryFolder folder_;
};

void expect_near(Vec3 a, Vec3 b, double tolerance) {
    EXPECT_LT(length(a - b), tolerance) << a.x << " " << a.y << " " << a.z << ", expected " << b.x << " " << b.y << " "
                                        << b.z;
}

std::vector<std::string> details_of(const test::WatchedRun& run, const std::string& id) {
    std::vector<std::string> details;
    for (const session::EventRow& event : run.events)
        if (event.id == id) details.push_back(event.detail);
    return details;
}

double metric_of(const session::RunSummary& summary, const std::string& id) {
    for (const session::MetricRow& row : summary.metrics)
        if (row.id == id) return row.value;
    return HUGE_VAL;
}

// ---- its solid

TEST(PlateBody, HasTheVolumeOfItsSolids) {
    // Given a plate of 5 × 20 × 80 mm with two holes of 5 mm
    const Scene scene = Plating({{"size: 30 12 5 mm", "size: 80 20 5 mm"}}).scene();
    const double exact = (80.0 * 20.0 * 5.0 - 2.0 * std::numbers::pi * 2.5 * 2.5 * 5.0) * 1e-9;
    const Body& plate = scene.implants.at(0);
    EXPECT_NEAR(bone_volume(plate, CutField(plate, 0)), exact, 0.01 * exact /* edges are rounded by half a voxel */);
}

TEST(PlateBody, IsSampledFinerThanTheBoneWhereItIsThin) {
    const Scene scene = Plating({{"spacing: 0.5 mm", "spacing: 1 mm"}}).scene();
    EXPECT_NEAR(scene.implants.at(0).grid().spacing, 5.0_mm / 6.0, 1e-9);
    EXPECT_EQ(scene.body.grid().spacing, 1.0_mm);
}

// ---- its planned pose

TEST(PlannedPose, LiesWhereItsAxisMeetsBone) {
    // Given an axis along −z that meets the face of the block at (1, 2, 10) mm, and x along the patient's y
    const Scene scene = Plating().scene();
    ASSERT_TRUE(scene.planned.at(0));
    const Pose& pose = *scene.planned[0];

    // Then z points down, x along +y, and y = z × x along +x
    expect_near(pose.position, {1.0_mm, 2.0_mm, 10.0_mm}, 0.06_mm /* the axis is sampled every 0.05 mm */);
    expect_near(rotate(pose.rotation, {0, 0, 1}), {0, 0, -1}, 1e-12);
    expect_near(rotate(pose.rotation, {1, 0, 0}), {0, 1, 0}, 1e-12);
    expect_near(rotate(pose.rotation, {0, 1, 0}), {1, 0, 0}, 1e-12);
}

TEST(PlannedPose, TurnsXTowardsUpAcrossAnyAxis) {
    const Vec3 along = normalized(Vec3{1.0, -2.0, 0.5});
    for (const Vec3 up : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{1, 0, 0}, Vec3{-1, 0.2, 0}}) {
        const Pose pose = documents::planned_pose({0.1, 0.2, 0.3}, along, up);
        expect_near(rotate(pose.rotation, {0, 0, 1}), along, 1e-12);
        expect_near(rotate(pose.rotation, {1, 0, 0}), normalized(up - dot(up, along) * along), 1e-12);
    }
}

TEST(PlannedPose, GivesStepsTheAxesOfItsHoles) {
    // The hole at x = −10 mm of the plate is at y = 2 − 10 mm of the patient; its axis meets bone at the face.
    const Scene scene = Plating().scene();
    const AxisFrame& frame = scene.frames.at(0);
    expect_near(frame.along, {0, 0, -1}, 1e-12);
    expect_near(frame.entry, {1.0_mm, -8.0_mm, 10.0_mm}, 0.06_mm);
    ASSERT_TRUE(frame.plate);
    EXPECT_NEAR(*frame.plate, -2.5_mm, 0.4_mm /* a ring is sampled every 0.31 mm */);
}

// ---- how it lies on bone

TEST(PlateFit, IsMeasuredInMillimetres) {
    const Scene scene = Plating().scene();
    const auto fit_at = [&](double higher) {
        Pose pose = *scene.planned.at(0);
        pose.position.z += higher;
        return fit_of(scene.implants[0], pose, BoneAround(scene.body));
    };
    EXPECT_NEAR(fit_at(0.0).gap, 0.0, 0.1_mm);
    EXPECT_LT(fit_at(0.0).fraction_in_bone, 0.02);
    EXPECT_NEAR(fit_at(1.5_mm).gap, 1.5_mm, 0.1_mm);
    EXPECT_NEAR(fit_at(6.0_mm).gap, 6.0_mm, 0.2_mm) << "farther than the field of bone knows";
    EXPECT_EQ(fit_at(25.0_mm).gap, farthest_gap);
    EXPECT_NEAR(fit_at(-1.0_mm).fraction_in_bone, 0.2, 0.02);
    EXPECT_NEAR(fit_at(-1.0_mm).deepest, 1.0_mm, 0.1_mm);
    EXPECT_NEAR(fit_at(-4.5_mm).fraction_in_bone, 0.9, 0.02);
    EXPECT_NEAR(fit_at(-4.5_mm).deepest, 4.5_mm, 0.2_mm) << "deeper than the field of bone knows";
}

TEST(PlateFit, IsTheSameOnAFineField) {
    const Scene scene = Plating({{"spacing: 0.5 mm", "spacing: 0.25 mm"}}).scene();
    Pose pose = *scene.planned.at(0);
    pose.position.z += 3.4_mm;
    EXPECT_NEAR(fit_of(scene.implants[0], pose, BoneAround(scene.body)).gap, 3.4_mm, 0.15_mm);
    pose.position.z -= 7.0_mm;
    EXPECT_NEAR(fit_of(scene.implants[0], pose, BoneAround(scene.body)).deepest, 3.6_mm, 0.15_mm);
}

// ---- what is refused

TEST(Plate, IsRefusedOffTheBone) {
    const std::string text = Plating({{"centre: 0 0 -2.5 mm", "centre: 0 0 -7 mm"},
                                      {"from: -10 0 -6 mm, to: -10 0 1 mm", "from: -10 0 -12 mm, to: -10 0 1 mm"},
                                      {"from: 10 0 -6 mm, to: 10 0 1 mm", "from: 10 0 -12 mm, to: 10 0 1 mm"}})
                                 .refusal();
    EXPECT_NE(text.find("E0522"), std::string::npos) << text;
    EXPECT_NE(text.find("its surface is 4.4 mm from the nearest bone, must be at most 3 mm"), std::string::npos)
        << text;
    EXPECT_NE(text.find("place: {axis: way"), std::string::npos) << text;
}

TEST(Plate, IsRefusedInBone) {
    const std::string text = Plating({{"centre: 0 0 -2.5 mm", "centre: 0 0 -1 mm"},
                                      {"to: -10 0 1 mm, radius", "to: -10 0 3 mm, radius"},
                                      {"to: 10 0 1 mm, radius", "to: 10 0 3 mm, radius"}})
                                 .refusal();
    EXPECT_NE(text.find("E0523"), std::string::npos) << text;
    EXPECT_NE(text.find("% of its volume is in bone, must be at most 15 %"), std::string::npos) << text;
}

TEST(Plate, ItsClosedHoleIsRefused) {
    const std::string text = Plating({{"to: -10 0 1 mm, radius", "to: -10 0 -2 mm, radius"}}).refusal();
    EXPECT_NE(text.find("E0521"), std::string::npos) << text;
    EXPECT_NE(text.find("The hole `near` of `plate` is closed: there is metal at"), std::string::npos) << text;
}

TEST(Plate, AHoleBesideItsMetalIsRefused) {
    const std::string text =
        Plating({{"near: {from: -10 0 -15 mm, to: -10 0 15 mm", "near: {from: -30 0 -15 mm, to: -30 0 15 mm"}})
            .refusal();
    EXPECT_NE(text.find("E0521"), std::string::npos) << text;
    EXPECT_NE(text.find("is beside the metal"), std::string::npos) << text;
}

TEST(Plate, AScrewWithoutAHoleIsRefusedWithTheHolesThereAre) {
    const std::string text =
        Plating({{"instrument: screw, axis: plate.near", "instrument: screw, axis: plate.neat"}}).refusal();
    EXPECT_NE(text.find("E0524"), std::string::npos) << text;
    EXPECT_NE(text.find("expected `plate.near` or `plate.far`"), std::string::npos) << text;
}

TEST(Plate, WithoutAPlaceItsHolesHaveNoPosition) {
    const std::string text =
        Plating({{"    place: {axis: way, up: 0 1 0}\n", ""}, {"place: plate", "insert: plate"}}).refusal();
    EXPECT_NE(text.find("E0524"), std::string::npos) << text;
}

TEST(Plate, AScrewThatIsTooThickOrHasASmallHeadIsRefused) {
    const std::string thick = Plating({{"outer_diameter: 4.5 mm", "outer_diameter: 5.5 mm"}}).refusal();
    EXPECT_NE(thick.find("E0525"), std::string::npos) << thick;
    const std::string small = Plating({{"head_diameter: 8 mm", "head_diameter: 4.9 mm"}}).refusal();
    EXPECT_NE(small.find("E0526"), std::string::npos) << small;
    EXPECT_NE(small.find("would fall through"), std::string::npos) << small;
}

TEST(Plate, NeedsAnUpAcrossItsAxis) {
    const std::string text = Plating({{"up: 0 1 0", "up: 0 0 1"}}).refusal();
    EXPECT_NE(text.find("E0407"), std::string::npos) << text;
}

// ---- a screw in its hole

TEST(ScrewInAHole, IsMeasuredInTheMiddleOfThePlate) {
    // Given a screw 8 mm deep, beside the axis of its hole, and one that is turned about the middle of the plate
    const Scene scene = Plating().scene();
    const AxisFrame& frame = scene.frames.at(1);
    const Pose straight = frame.pose_at({.depth = 8.0_mm});
    const Vec3 middle = frame.entry + *frame.plate * frame.along;
    const Quat turn = quat_from_rotation_vector({2.0_deg, 0, 0});
    const auto screw = [&](const Pose& pose) { return *screw_at(scene, 1, frame, scene.body, pose).screw; };

    const InsertedScrew beside = screw({straight.position + Vec3{0.5_mm, 0, 0}, straight.rotation}),
                        turned = screw({middle + rotate(turn, straight.position - middle), turn * straight.rotation});
    EXPECT_NEAR(beside.hole_offset.value(), 0.5_mm, 1e-9);
    EXPECT_NEAR(beside.hole_angle.value(), 0.0, 1e-9);
    EXPECT_NEAR(turned.hole_offset.value(), 0.0, 1e-9);
    EXPECT_NEAR(turned.hole_angle.value(), 2.0_deg, 1e-6);
}

// ---- a run

TEST(PlateRun, DrillsAndScrewsThroughItsHole) {
    const Plating plating;
    const Scene scene = plating.scene();
    const test::TemporaryFolder folder;
    RunRequest request;
    request.out = folder / "run";
    const test::WatchedRun run = test::watched_run(scene, test::plugins(), request);
    ASSERT_EQ(run.error, "");

    // Then nothing touched the metal, and the screw is in the middle of the hole
    EXPECT_EQ(details_of(run, "hand.refused"), std::vector<std::string>{});
    EXPECT_EQ(details_of(run, "haptics.met_metal"), std::vector<std::string>{});
    EXPECT_EQ(run.summary.verdict, session::Verdict::pass) << run.summary.reasons.at(0);
    EXPECT_LT(metric_of(run.summary, "fix.hole-offset"), 0.3_mm);
    EXPECT_LT(metric_of(run.summary, "fix.hole-axis-angle"), 3.0_deg);

    // And a replay ends in the same hash
    std::string error;
    auto inputs = session::read_session(request.out + "/session.db", error);
    ASSERT_TRUE(inputs) << error;
    RunRequest again;
    again.replay = std::move(inputs->device_from_handle);
    again.adoptions = std::move(inputs->adoptions);
    again.missed = std::move(inputs->missed);
    for (const auto& [tick, text] : inputs->hand_inputs)
        again.hand_inputs.emplace_back(tick, documents::hand_input(text).value());
    ASSERT_FALSE(again.hand_inputs.empty());
    EXPECT_EQ(again.hand_inputs.front().second.kind, documents::HandInput::Kind::place);
    EXPECT_EQ(test::watched_run(scene, test::plugins(), again).summary.hash, run.summary.hash);
}

TEST(PlateRun, MeetsTheMetalBesideTheHole) {
    // Given a drill that is too wide for the hole, and bone on a coarser field than the plate
    const Scene scene =
        Plating({{"diameter: 3.2 mm", "diameter: 6 mm"},
                 {"spacing: 0.5 mm", "spacing: 1 mm"},
                 {"axis: plate.near, goals: [{depth: {at_least: 5", "axis: plate.far, goals: [{depth: {at_least: 5"},
                 {"step: fix, depth: -1 mm", "depth: -24 mm"},
                 {"{depth: 8 mm, turn: {by: 6 turns, speed: 60 rpm}, do: release}", "{depth: -25 mm}"},
                 {"instrument: screw, axis", "instrument: drill, axis"},
                 {"expect: pass", "expect: incomplete"}})
            .scene();
    const test::WatchedRun run = test::watched_run(scene, test::plugins(), {});
    EXPECT_FALSE(details_of(run, "haptics.met_metal").empty());
    EXPECT_EQ(run.summary.removed, 0.0);
}

TEST(PlateRun, RefusesAPlateInTheAir) {
    // 25 mm before the bone, the plate would be 20 mm from it or more
    const Scene scene = Plating({{"{depth: -25 mm, place: plate}", "{depth: -25 mm, insert: plate}"}}).scene();
    const test::WatchedRun run = test::watched_run(scene, test::plugins(), {});
    EXPECT_EQ(details_of(run, "hand.refused"),
              std::vector<std::string>{"insert:plate: it meets no bone: its surface is 10 mm or more from the nearest "
                                       "bone, must be at most 3 mm"});
}

TEST(PlateRun, LeadsStepsAlongThePlateThatIsThere) {
    // Given a plate that the hand brings in 2 mm before the bone, at the tool on the axis of its own hole: its origin
    // is where the hole was planned, so that the hole itself is 10 mm farther along the tool's −x.
    const Scene scene =
        Plating({{"{depth: -25 mm, place: plate}", "{depth: -25 mm}\n      - {depth: -2 mm, insert: plate}"},
                 {"expect: pass", "expect: incomplete"}})
            .scene();
    RunOutcome refusal;
    const auto run = Run::create(scene, test::plugins(), {}, refusal);
    ASSERT_NE(run, nullptr);
    Pose tool = identity_pose();
    while (run->simulation().bodies().size() < 2) {
        tool = run->simulation().world_from_tool();
        ASSERT_TRUE(run->step());
    }
    const Pose plate = run->simulation().bodies().back()->world_from_body;

    // Then the step's axis is that of the hole of this plate
    const AxisFrame &now = run->monitor().frame(0), &planned = scene.frames[0];
    expect_near(now.along, rotate(plate.rotation, {0, 0, 1}), 1e-9);
    const Vec3 on_axis = plate * Vec3{-10.0_mm, 0, 0};
    EXPECT_LT(length(cross(on_axis - now.entry, now.along)), 1e-9);
    EXPECT_NEAR(length(now.entry - planned.entry), 10.0_mm, 0.5_mm);
    (void)run->finish();
}

}  // namespace
}  // namespace kerf::run
