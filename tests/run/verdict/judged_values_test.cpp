// SPDX-License-Identifier: Apache-2.0
// Each judged value alone, in steps whose bone, axis and entry are those of no frame.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "kerf/units.hpp"
#include "run/verdict/step_monitor.h"

namespace kerf::run {
namespace {

using namespace literals;

const Pose askew{{0.1, -0.2, 0.3}, quat_from_rotation_vector({0.4, -0.9, 0.5})};
const Pose elsewhere{{-0.3, 0.2, 0.1}, quat_from_rotation_vector({-0.7, 0.2, 1.1})};

/// Two steps with one axis, which begins at (10, 20, 30) mm and leads to +x.
struct TwoSteps {
    documents::Procedure procedure;
    documents::Anatomy anatomy;
    ToolSolid drill{{{0.0, 0.0}, {-1.0_mm, 1.5_mm}, {-2.0_mm, 1.5_mm}}};
    AxisFrame frame{.entry = {10.0_mm, 20.0_mm, 30.0_mm}, .along = {1, 0, 0}, .medial = {0, 1, 0}};

    TwoSteps() {
        procedure.steps.resize(2);
        for (std::size_t s = 0; s < 2; ++s) procedure.steps[s].id = s == 0 ? "first" : "second";
    }
    [[nodiscard]] StepMonitor monitor() const { return {procedure, anatomy, {frame, frame}}; }
    /// The tool that many metres beyond the entry, in the frame of the bone.
    [[nodiscard]] Pose tool_at(double depth, Vec3 beside = {}) const {
        return {frame.entry + depth * frame.along + beside, quat_between({0, 0, 1}, frame.along)};
    }
    void limit_at_most(double maximum, const std::vector<std::string>& quantities) {
        for (const std::string& quantity : quantities)
            procedure.steps[0].limits.push_back({.quantity = quantity, .bound = {{}, maximum}});
    }
};

// ---- the end of a step ---------------------------------------------------------------------------------------------

TEST(JudgeHole, ComparesEachLimitWithItsOwnValue) {
    TwoSteps scene;
    scene.limit_at_most(1.0, {"hole_angle", "entry_offset", "narrowest_offset", "end_offset", "excess_removal"});
    StepMonitor monitor = scene.monitor();
    HoleResult result;
    result.hole = bone::DrilledHole{.entry_offset = 2.0_mm,
                                    .narrowest_offset = 3.0_mm,
                                    .end_offset = 4.0_mm,
                                    .angle = 5.0_deg,
                                    .drilled = 3e-7,
                                    .ideal = 2e-7,
                                    .whole = 4e-7};
    monitor.judge_hole(0, result, 1.0);
    const std::array<double, 5> wanted{5.0_deg, 2.0_mm, 3.0_mm, 4.0_mm, 0.5};
    for (std::size_t l = 0; l < wanted.size(); ++l)
        EXPECT_NEAR(monitor.steps()[0].limits[l].worst, wanted[l], 1e-12)
            << scene.procedure.steps[0].limits[l].quantity;
}

TEST(JudgeHole, ComparesABreachWithTheLimitOfItsDiameter) {
    TwoSteps scene;
    scene.procedure.steps[0].limits = {{.quantity = "breach", .bound = {{}, 2.0_mm}, .diameter = 5.5_mm},
                                       {.quantity = "breach", .bound = {{}, 2.0_mm}, .diameter = 6.5_mm}};
    StepMonitor monitor = scene.monitor();
    HoleResult result;
    result.hole = bone::DrilledHole{};
    result.breaches = {{6.5_mm, {.towards = {0, 2.5_mm, 0, 0}}}, {5.5_mm, {.towards = {0, 1.5_mm, 0, 0}}}};
    monitor.judge_hole(0, result, 1.0);
    EXPECT_EQ(monitor.steps()[0].limits[0].worst, 1.5_mm);
    EXPECT_FALSE(monitor.steps()[0].limits[0].broken_at);
    EXPECT_EQ(monitor.steps()[0].limits[1].worst, 2.5_mm);
    EXPECT_TRUE(monitor.steps()[0].limits[1].broken_at);
}

TEST(JudgeCut, ComparesEachLimitWithItsOwnValue) {
    TwoSteps scene;
    scene.limit_at_most(1.0, {"plane_angle", "plane_offset", "flatness", "removed_volume"});
    StepMonitor monitor = scene.monitor();
    monitor.judge_cut(0, bone::CutWall{.angle = 4.0_deg, .offset = 3.0_mm, .flatness = 2.0_mm, .points = 9}, 1e-8, 1.0);
    const std::array<double, 4> wanted{4.0_deg, 3.0_mm, 2.0_mm, 1e-8};
    for (std::size_t l = 0; l < wanted.size(); ++l)
        EXPECT_EQ(monitor.steps()[0].limits[l].worst, wanted[l]) << scene.procedure.steps[0].limits[l].quantity;
}

TEST(JudgeMeasures, ComparesEachLimitAndGoalWithItsOwnMeasure) {
    TwoSteps scene;
    scene.procedure.measures = {{.id = "slope"}, {.id = "width"}};
    scene.procedure.steps[0].limits = {{.quantity = "measure", .bound = {{}, 1.0}, .measure = "width"},
                                       {.quantity = "measure", .bound = {{}, 1.0}, .measure = "slope"}};
    StepMonitor monitor = scene.monitor();
    std::vector<documents::MeasureReading> readings(2);
    readings[0].value = 0.25;
    readings[1].value = 0.5;
    monitor.judge_measures(0, readings, 1.0);
    EXPECT_EQ(monitor.steps()[0].limits[0].worst, 0.5);
    EXPECT_EQ(monitor.steps()[0].limits[1].worst, 0.25);
}

TEST(JudgeMeasures, AMeasureThatIsLostAtTheEndLosesItsGoal) {
    TwoSteps scene;
    scene.procedure.measures = {{.id = "slope"}};
    scene.procedure.steps[0].goals = {{.quantity = "measure", .bound = {0.0, 1.0}, .measure = "slope"}};
    StepMonitor monitor = scene.monitor();
    monitor.observe({.world_from_tool = scene.tool_at(1.0_mm)}, scene.drill);
    std::vector<documents::MeasureReading> readings(1);
    readings[0].value = 0.5;
    monitor.show_measures(readings);
    monitor.observe({.world_from_tool = scene.tool_at(1.0_mm)}, scene.drill);
    ASSERT_TRUE(monitor.steps()[0].goal_done[0]);
    monitor.judge_measures(0, readings, 1.0);
    EXPECT_TRUE(monitor.steps()[0].goal_done[0]);
    readings[0].value.reset();
    monitor.judge_measures(0, readings, 1.0);
    EXPECT_FALSE(monitor.steps()[0].goal_done[0]);
}

// ---- a bone that lies askew ----------------------------------------------------------------------------------------

/// A step whose bone is the second of two, wherever that lies.
struct OfAPiece : TwoSteps {
    StepMonitor watch;
    std::array<Pose, 2> bodies{elsewhere, askew};
    double time = 0.0;

    OfAPiece() : watch(prepare()) { watch.set_owners({.zone = {1}, .step = {1, 1}}); }
    StepMonitor prepare() {
        procedure.steps[0].goals = {{.quantity = "depth", .bound = {20.0_mm, {}}}};
        procedure.steps[0].limits = {{.quantity = "clearance", .zone = "nerve", .bound = {0.0, {}}}};
        anatomy.zones = {{"nerve", {documents::TubeSolid{{0, 26.0_mm, 30.0_mm}, {50.0_mm, 26.0_mm, 30.0_mm}, 1.0_mm}}}};
        return monitor();
    }
    void show(double depth, Vec3 beside = {}, Vec3 handle_in_bone = {}) {
        watch.observe({.time = time += 1e-3,
                       .world_from_tool = askew * tool_at(depth, beside),
                       .is_running = true,
                       .is_resisted = true,
                       .world_from_body = bodies,
                       .is_bone_ahead = depth < 10.0_mm,
                       .tip_inside = std::min(depth, 10.0_mm - depth),
                       .handle = askew * (frame.entry + handle_in_bone)},
                      drill);
    }
    [[nodiscard]] const StepState& state() const { return watch.steps()[0]; }
};

TEST(StepMonitor, MeasuresDepthAndOffsetInThePieceOfTheStep) {
    OfAPiece piece;
    piece.show(5.0_mm, {0, 3.0_mm, -4.0_mm});
    piece.show(7.0_mm);
    EXPECT_NEAR(piece.state().deepest, 7.0_mm, 1e-12);
    EXPECT_NEAR(piece.state().farthest_offset, 5.0_mm, 1e-12);
}

TEST(StepMonitor, NamesTheClosestPointInThePieceOfTheZone) {
    // The zone runs 6 mm from the axis, its wall at 5 mm; the drill is 1.5 mm wide
    OfAPiece piece;
    piece.show(2.0_mm);
    piece.show(6.0_mm, {0, 2.0_mm, 0});
    piece.show(8.0_mm, {0, 1.0_mm, 0});
    const LimitState& limit = piece.state().limits[0];
    EXPECT_NEAR(limit.worst, 1.5_mm, 1e-9);
    ASSERT_TRUE(limit.closest);
    EXPECT_EQ(limit.closest->time, 2e-3);
    EXPECT_NEAR(limit.closest->at.y, 20.0_mm + 3.5_mm, 1e-9);
    EXPECT_NEAR(limit.closest->at.z, 30.0_mm, 1e-9);
}

TEST(StepMonitor, MeasuresThePlungeOfTheHandInThePieceOfTheStep) {
    OfAPiece piece;
    for (const double depth : {1.0_mm, 5.0_mm, 10.0_mm}) piece.show(depth, {}, {depth - 100.0_mm, 0, 0});
    piece.show(12.0_mm, {}, {15.0_mm - 100.0_mm, 7.0_mm, 0});
    EXPECT_NEAR(piece.state().advance.plunge, 2.0_mm, 1e-9);
    EXPECT_NEAR(piece.state().advance.hand_plunge, 5.0_mm, 1e-9);
}

TEST(StepMonitor, ABoneThatTurnsAboutItsEntryHasNotMoved) {
    TwoSteps scene;
    StepMonitor monitor = scene.monitor();
    const Quat turn = quat_from_rotation_vector({0.3, 0.2, -0.9});
    Pose bone{scene.frame.entry - rotate(turn, scene.frame.entry), turn};
    const auto show = [&] {
        monitor.observe({.world_from_tool = scene.tool_at(1.0_mm), .world_from_body = {&bone, 1}}, scene.drill);
        return monitor.steps()[0].moved;
    };
    EXPECT_NEAR(show(), 0.0, 1e-15);
    bone.position = bone.position + Vec3{3.0_mm, 0, -4.0_mm};
    EXPECT_NEAR(show(), 5.0_mm, 1e-15);
}

TEST(StepMonitor, KeepsTheRangeOfASignalThatIsNeverZero) {
    for (const double sign : {1.0, -1.0}) {
        TwoSteps scene;
        scene.procedure.steps[0].goals = {{.quantity = "signal", .signal = {"temperature", 0, "K"}}};
        StepMonitor monitor = scene.monitor();
        for (const double value : {3.0, 2.0, 5.0, 4.0}) {
            const double signal = sign * value;
            monitor.observe({.world_from_tool = scene.tool_at(1.0_mm), .signals = {&signal, 1}}, scene.drill);
        }
        const auto& [signal, smallest, greatest, last, is_seen] = monitor.steps()[0].signals[0];
        EXPECT_EQ(smallest, sign > 0.0 ? 2.0 : -5.0);
        EXPECT_EQ(greatest, sign > 0.0 ? 5.0 : -2.0);
        EXPECT_EQ(last, sign * 4.0);
    }
}

// ---- the second time -----------------------------------------------------------------------------------------------

TEST(StepMonitor, ASecondImplantNeedsItsOwnRelease) {
    TwoSteps scene;
    for (documents::Step& step : scene.procedure.steps) step.goals = {{.quantity = "depth", .bound = {10.0_mm, {}}}};
    StepMonitor monitor = scene.monitor();
    monitor.ends_with_release(0);
    monitor.ends_with_release(1);
    const auto show = [&] {
        monitor.observe({.world_from_tool = scene.tool_at(11.0_mm), .is_running = true, .is_resisted = true},
                        scene.drill);
    };
    for (std::size_t step = 0; step < 2; ++step) {
        show();
        show();
        EXPECT_EQ(monitor.current(), step);
        EXPECT_EQ(monitor.release(), "");
        show();
        EXPECT_EQ(monitor.current(), step + 1);
    }
}

TEST(StepMonitor, ASecondPlungeCountsFromTheSecondFace) {
    // Bone from 0 to 10 mm and from 14 to 20 mm, with a gap of 4 mm between them
    TwoSteps scene;
    scene.procedure.steps[0].goals = {{.quantity = "depth", .bound = {1.0, {}}}};  // never reached
    StepMonitor monitor = scene.monitor();
    const auto advance_to = [&](double from, double to) {
        for (double depth = from; depth < to; depth += 0.1_mm)
            monitor.observe(
                {.world_from_tool = scene.tool_at(depth),
                 .is_running = true,
                 .is_resisted = true,
                 .tip_inside = std::max(std::min(depth, 10.0_mm - depth), std::min(depth - 14.0_mm, 20.0_mm - depth))},
                scene.drill);
        return monitor.steps()[0].advance.plunge;
    };
    EXPECT_NEAR(advance_to(-1.0_mm, 14.0_mm), 4.0_mm, 0.2_mm);
    EXPECT_NEAR(advance_to(14.0_mm, 20.0_mm), 4.5_mm, 0.2_mm) << "until it is well inside again";
    EXPECT_NEAR(advance_to(20.0_mm, 23.0_mm), 4.5_mm, 0.2_mm) << "3 mm beyond the second face";
    EXPECT_NEAR(advance_to(23.0_mm, 26.0_mm), 6.0_mm, 0.2_mm);
}

// ---- frames of a step ----------------------------------------------------------------------------------------------

void expect_near(Vec3 is, Vec3 wanted) {
    EXPECT_NEAR(is.x, wanted.x, 1e-12);
    EXPECT_NEAR(is.y, wanted.y, 1e-12);
    EXPECT_NEAR(is.z, wanted.z, 1e-12);
}

TEST(AxisFrame, TiltsRightHandedAboutTheFeedInBothSenses) {
    const AxisFrame frame{.entry = {}, .along = {1, 0, 0}, .across = {0, 0, 1}};
    for (const double tilt : {30.0_deg, -30.0_deg}) {
        const Pose pose = frame.pose_at({.tilt = tilt});
        expect_near(rotate(pose.rotation, {0, 0, 1}), {1, 0, 0});
        expect_near(rotate(pose.rotation, {0, 1, 0}), {0, -std::sin(tilt), std::cos(tilt)});
    }
}

TEST(AxisFrame, LeansTowardsTheHeadInBothSenses) {
    // An axis to the front and down, at 30° to the horizontal
    const Vec3 along{0, -std::cos(30.0_deg), -0.5};
    const AxisFrame frame{.entry = {1.0_mm, 2.0_mm, 3.0_mm}, .along = along, .medial = {1, 0, 0}};
    for (const double lean : {20.0_deg, -20.0_deg}) {
        const Pose pose = frame.pose_at({.depth = 10.0_mm, .cranial_angle = lean});
        const double down = 30.0_deg - lean;
        const Vec3 direction{0, -std::cos(down), -std::sin(down)};
        expect_near(rotate(pose.rotation, {0, 0, 1}), direction);
        expect_near(pose.position, frame.entry + 10.0_mm * direction);
    }
}

TEST(AxisFrame, LeansTowardsTheMidlineInBothSenses) {
    const AxisFrame frame{.entry = {1.0_mm, 2.0_mm, 3.0_mm}, .along = {0, -1, 0}, .medial = {1, 0, 0}};
    for (const double lean : {20.0_deg, -20.0_deg})
        expect_near(rotate(frame.pose_at({.medial_angle = lean}).rotation, {0, 0, 1}),
                    {std::sin(lean), -std::cos(lean), 0});
}

TEST(AxisFrame, GoesAsideAlongTheToolsX) {
    const AxisFrame frame{.entry = {}, .along = {1, 0, 0}, .across = {0, 0, 1}};
    const Pose pose = frame.pose_at({.depth = 5.0_mm, .aside = 2.0_mm, .off_plan = 3.0_mm});
    expect_near(inverse(frame.pose_at({})) * pose.position, {2.0_mm, 3.0_mm, 5.0_mm});
}

}  // namespace
}  // namespace kerf::run
