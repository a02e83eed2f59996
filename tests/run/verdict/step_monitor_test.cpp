// SPDX-License-Identifier: Apache-2.0
#include "run/verdict/step_monitor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "kerf/units.hpp"

namespace kerf::run {
namespace {

using namespace literals;

/// One hole of 10 mm along +z with a zone two millimetres beside it; a second step after it.
struct Case {
    documents::Procedure procedure;
    documents::Anatomy anatomy;
    std::vector<AxisFrame> frames;
    ToolSolid drill{{{0.0, 0.0}, {-1.0_mm, 1.5_mm}, {-2.0_mm, 1.5_mm}}};
    std::vector<std::string> new_events;

    Case() {
        documents::Step step;
        step.id = "hole";
        step.goals = {{"entry", {}, {}}, {"depth", {10.0_mm, {}}, {}}};
        step.limits = {{"clearance", "nerve", {0.0, {}}, "Too near.", {}},
                       {"depth", "", {{}, 12.0_mm}, "Too deep.", {}}};
        procedure.steps = {step, step};
        procedure.steps[1].id = "second";
        anatomy.zones = {{"nerve", {documents::TubeSolid{{3.5_mm, 0, -50.0_mm}, {3.5_mm, 0, 50.0_mm}, 1.0_mm}}}};
        const AxisFrame frame{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}};
        frames = {frame, frame};
    }
};

struct Watch {
    Case scene;
    StepMonitor monitor{scene.procedure, scene.anatomy, scene.frames};
    double time = 0.0;

    void show(double depth, double aside = 0.0, bool is_running = true, bool is_resisted = true) {
        monitor.observe({time, {{aside, 0, depth}, {1, 0, 0, 0}}, is_running, is_resisted}, scene.drill);
        for (const auto& [id, detail] : monitor.new_events()) scene.new_events.push_back(id);
        time += 1e-3;
    }
};

TEST(StepMonitor, BesideTheBoneThereIsNoHoleThatCouldBeTooDeep) {
    Watch watch;
    for (double depth = -1.0_mm; depth < 20.0_mm; depth += 0.1_mm) watch.show(depth, 0.0, true, false);
    EXPECT_TRUE(watch.scene.new_events.empty()) << watch.scene.new_events.front();

    watch.show(1.0_mm);                     // it enters,
    watch.show(20.0_mm, 0.0, true, false);  // and is out of the far side: that is too deep
    EXPECT_EQ(watch.scene.new_events, (std::vector<std::string>{"entered_bone", "goal_reached", "limit_broken"}));
}

TEST(AxisFrame, ABladeIsFedAlongTheAxisAndLiesInThePlane) {
    // Given an axis to the back and a plane that looks to the feet, as in a cut across a femur
    const documents::LandmarkAxis axis{"way", {0, -40.0_mm, 0}, {0, 40.0_mm, 0}, 0.0};
    const documents::LandmarkPlane plane{"level", {}, {0, 0, -1}, 0.0};
    const AxisFrame frame = axis_frame(axis, 10.0_mm, {}, &plane);

    // When the tool is 5 mm deep, 3 mm aside and turned by 30 degrees
    const Pose straight = frame.pose_at({.depth = 5.0_mm, .aside = 3.0_mm});
    const Pose tilted = frame.pose_at({.depth = 5.0_mm, .aside = 3.0_mm, .tilt = 30.0_deg});

    // Then +z is the feed, y the plane's normal, and x = y × z, which here is the patient's left
    const auto expect_near = [](Vec3 is, Vec3 wanted) { EXPECT_LT(length(is - wanted), 1e-9 /* rounding */); };
    expect_near(rotate(straight.rotation, {0, 0, 1}), {0, 1, 0});
    expect_near(rotate(straight.rotation, {0, 1, 0}), {0, 0, -1});
    expect_near(straight.position, {3.0_mm, -25.0_mm, 0});
    expect_near(rotate(tilted.rotation, {0, 0, 1}), {0, 1, 0});
    EXPECT_NEAR(dot(rotate(tilted.rotation, {0, 1, 0}), {0, 0, -1}), 0.86602540378, 1e-9);
    expect_near(tilted.position, straight.position);
}

TEST(AxisFrame, AimedBesideTheAxisAllOfTheWayTurnsAboutTheEntryTowardsTheMidline) {
    const documents::LandmarkAxis axis{"way", {0, 0, 0}, {0, 0, 40.0_mm}, 0.0};
    documents::Anatomy anatomy;
    anatomy.points.push_back({"midline", {20.0_mm, 0, 30.0_mm}, 0.0});
    const AxisFrame frame = axis_frame(axis, 10.0_mm, anatomy);

    const Pose aimed = frame.pose_at({.depth = 8.0_mm, .medial = 1.0_mm, .medial_angle = 30.0_deg});

    const double c = std::cos(30.0_deg), s = std::sin(30.0_deg);
    EXPECT_LT(length(rotate(aimed.rotation, {0, 0, 1}) - Vec3{s, 0, c}), 1e-12);
    EXPECT_LT(length(aimed.position - Vec3{8.0_mm * s + 1.0_mm * c, 0, 10.0_mm + 8.0_mm * c - 1.0_mm * s}), 1e-12);
    EXPECT_LT(length(frame.pose_at({.medial_angle = 30.0_deg}).position - frame.entry), 1e-15) << "the entry stays";
}

TEST(AxisFrame, APlaneSeenFromBehindTurnsTheBladeOver) {
    const documents::LandmarkAxis axis{"way", {0, 0, -1.0_mm}, {0, 0, 1.0_mm}, 0.0};
    const documents::LandmarkPlane plane{"level", {}, {0, -1, 0}, 0.0};
    const Pose pose = axis_frame(axis, 0.0, {}, &plane).pose_at({});
    EXPECT_LT(length(rotate(pose.rotation, {0, 1, 0}) - Vec3{0, -1, 0}), 1e-12);
    EXPECT_LT(length(rotate(pose.rotation, {0, 0, 1}) - Vec3{0, 0, 1}), 1e-12);
}

TEST(StepMonitor, JudgesAnImplantAsItIsLeft) {
    Watch run;
    run.monitor.ends_with_release(0);
    run.show(1.0_mm);
    run.show(13.0_mm);  // deeper than the limit of 12 mm, and back
    run.show(5.0_mm);   // the goal was 10 mm
    EXPECT_EQ(run.monitor.release(), "");
    run.show(5.0_mm);
    const StepState& left = run.monitor.steps()[0];
    EXPECT_TRUE(left.is_done());
    EXPECT_EQ(left.left_depth, 5.0_mm);
    EXPECT_EQ(left.goal_done, (std::vector<bool>{true, false}));
    EXPECT_FALSE(left.limits[1].broken_at) << "where it was on its way is no fault";
    EXPECT_EQ(run.scene.new_events.back(), "step_done");
    EXPECT_TRUE(std::count(run.scene.new_events.begin(), run.scene.new_events.end(), "goal_lost"));

    Watch deep;
    deep.monitor.ends_with_release(0);
    deep.show(1.0_mm);
    deep.show(13.0_mm);
    EXPECT_EQ(deep.monitor.release(), "");
    deep.show(13.0_mm);
    EXPECT_TRUE(deep.monitor.steps()[0].limits[1].broken_at);

    Watch never;
    never.monitor.ends_with_release(0);
    never.show(1.0_mm);
    never.show(13.0_mm);
    never.monitor.end_run(never.time);
    EXPECT_TRUE(never.monitor.steps()[0].limits[1].broken_at) << "a run may end before the implant is released";
}

TEST(StepMonitor, JudgesSignalsOfAnImplantAsItIsLeft) {
    const documents::NamedSignal engaged{"engaged", 0, "mm"}, torque{"torque", 1, "N m"};
    Watch run;
    documents::Step& step = run.scene.procedure.steps[0];
    step.goals.push_back({.quantity = "signal", .bound = {20.0_mm, {}}, .signal = engaged});
    step.limits = {{.quantity = "signal", .bound = {15.0_mm, {}}, .signal = engaged},
                   {.quantity = "signal", .bound = {{}, 3.0}, .signal = torque}};
    StepMonitor monitor(run.scene.procedure, run.scene.anatomy, run.scene.frames);
    monitor.ends_with_release(0);
    double time = 0.0;
    const auto show = [&](double depth, double thread, double moment) {
        const std::array signals{thread, moment};
        monitor.observe({.time = time += 1e-3,
                         .world_from_tool = {{0, 0, depth}, {1, 0, 0, 0}},
                         .is_running = true,
                         .is_resisted = true,
                         .signals = signals},
                        run.scene.drill);
    };
    show(1.0_mm, 1.0_mm, 0.5);
    EXPECT_FALSE(monitor.steps()[0].limits[0].broken_at) << "a thread has to begin";
    show(11.0_mm, 21.0_mm, 3.5);
    show(11.0_mm, 12.0_mm, 0.5);
    EXPECT_EQ(monitor.release(), "");
    show(11.0_mm, 12.0_mm, 0.5);
    const StepState& left = monitor.steps()[0];
    EXPECT_EQ(left.goal_done, (std::vector<bool>{true, true, false}));
    EXPECT_TRUE(left.limits[0].broken_at) << "too little of it is left";
    EXPECT_TRUE(left.limits[1].broken_at) << "a torque on the way counts";
}

TEST(StepMonitor, TheStepOfAnImplantEndsWhenItIsReleasedInBone) {
    Watch run;
    run.monitor.ends_with_release(0);
    run.show(1.0_mm);
    EXPECT_EQ(run.monitor.release(), "a goal of the step is not reached");
    run.show(11.0_mm);
    run.show(-1.0_mm, 0.0, true, false);
    EXPECT_FALSE(run.monitor.steps()[0].is_done()) << "it has come out again";
    EXPECT_EQ(run.monitor.release(), "the implant is out of the bone");
    run.show(11.0_mm);
    EXPECT_EQ(run.monitor.release(), "");
    run.show(11.0_mm);
    EXPECT_TRUE(run.monitor.steps()[0].is_done());
}

TEST(StepMonitor, GoalsAreReachedInOrderAndTheStepEndsOutside) {
    Watch run;
    run.show(-2.0_mm, 0.0, true, false);
    EXPECT_FALSE(run.monitor.steps()[0].goal_done[0]);
    run.show(0.1_mm);
    EXPECT_TRUE(run.monitor.steps()[0].goal_done[0]);
    run.show(10.5_mm);
    EXPECT_TRUE(run.monitor.steps()[0].goal_done[1]);
    EXPECT_FALSE(run.monitor.steps()[0].is_done()) << "the tool is still inside";
    run.show(-1.0_mm, 0.0, true, false);
    EXPECT_TRUE(run.monitor.steps()[0].is_done());
    EXPECT_EQ(run.monitor.current(), 1u);
    EXPECT_EQ(run.scene.new_events,
              (std::vector<std::string>{"entered_bone", "goal_reached", "goal_reached", "step_done"}));
}

TEST(StepMonitor, DepthCountsOnlyWhereBoneWasCut) {
    Watch run;
    run.show(11.0_mm, 0.0, true, false);
    EXPECT_LT(run.monitor.steps()[0].deepest, 0.0) << "through air beside the bone";
    run.show(11.0_mm, 0.0, false, true);
    EXPECT_LT(run.monitor.steps()[0].deepest, 0.0) << "a tool that stands cuts nothing";
    EXPECT_TRUE(run.monitor.steps()[0].has_met_bone_still);
}

TEST(StepMonitor, AClearanceIsThatOfTheWholeCuttingRegion) {
    Watch run;
    run.show(5.0_mm);
    EXPECT_NEAR(run.monitor.steps()[0].limits[0].worst, 3.5_mm - 1.0_mm - 1.5_mm, 1e-9);
    EXPECT_FALSE(run.monitor.steps()[0].limits[0].broken_at);
    run.show(5.0_mm, 1.2_mm);
    EXPECT_NEAR(run.monitor.steps()[0].limits[0].worst, -0.2_mm, 1e-9);
    EXPECT_TRUE(run.monitor.steps()[0].limits[0].broken_at);
    run.show(5.0_mm);
    EXPECT_NEAR(run.monitor.steps()[0].limits[0].worst, -0.2_mm, 1e-9) << "the worst is kept";
    EXPECT_EQ(std::count(run.scene.new_events.begin(), run.scene.new_events.end(), "zone_entered"), 1) << "said once";
}

TEST(StepMonitor, HowFarItWanderedIsCountedInBoneOnly) {
    Watch run;
    run.show(-1.0_mm, 3.0_mm, true, false);
    run.show(0.1_mm, 0.2_mm);
    run.show(2.0_mm, 0.7_mm);
    run.show(3.0_mm, 0.1_mm);
    EXPECT_NEAR(run.monitor.steps()[0].farthest_offset, 0.7_mm, 1e-12);
}

TEST(StepMonitor, AZoneThatBelongsToAPieceMovesWithIt) {
    // Given two bodies, the second with the nerve, carried 20 mm away
    Watch run;
    const Pose moved[]{identity_pose(), {{20.0_mm, 0, 0}, {1, 0, 0, 0}}};
    const auto show_at = [&](double x) {
        run.monitor.observe({0.0, {{x, 0, 5.0_mm}, {1, 0, 0, 0}}, true, true, 0.0, moved}, run.scene.drill);
        return run.monitor.steps()[0].limits[0].broken_at.has_value();
    };
    run.monitor.set_owners({.zone = {1}, .step = {0, 0}});

    // Then its place of before harms nobody, and its new one does
    EXPECT_FALSE(show_at(3.5_mm));
    EXPECT_TRUE(show_at(23.5_mm));
}

TEST(StepMonitor, BoneHasComeApartWhenThereAreTwoBodies) {
    Case scene;
    scene.procedure.steps[0].goals = {{"separated", {}, {}}};
    StepMonitor monitor(scene.procedure, scene.anatomy, scene.frames);
    const Pose bodies[]{identity_pose(), identity_pose()};
    const auto show = [&](std::size_t count) {
        monitor.observe({0.0, {{0, 0, 5.0_mm}, {1, 0, 0, 0}}, true, true, 0.0, std::span(bodies).first(count)},
                        scene.drill);
        return bool{monitor.steps()[0].goal_done[0]};
    };
    EXPECT_FALSE(show(1));
    EXPECT_TRUE(show(2));
}

TEST(StepMonitor, ASecondStepMustPartTheBoneOnceMore) {
    Case scene;
    for (documents::Step& step : scene.procedure.steps) step.goals = {{"separated", {}, {}}};
    StepMonitor monitor(scene.procedure, scene.anatomy, scene.frames);
    const Pose bodies[]{identity_pose(), identity_pose(), identity_pose()};
    const auto show = [&](double depth, std::size_t count) {
        monitor.observe({0.0, {{0, 0, depth}, {1, 0, 0, 0}}, true, depth > 0.0, 0.0, std::span(bodies).first(count)},
                        scene.drill);
        return bool{monitor.steps()[1].goal_done[0]};
    };
    EXPECT_FALSE(show(5.0_mm, 2));
    EXPECT_FALSE(show(-(5.0_mm), 2));
    EXPECT_EQ(monitor.current(), 1u);
    EXPECT_FALSE(show(-(5.0_mm), 2)) << "the piece of the first step is still there";
    EXPECT_FALSE(show(5.0_mm, 2));
    EXPECT_TRUE(show(5.0_mm, 3));
}

TEST(StepMonitor, ThrustCountsWhileTheToolRuns) {
    Case scene;
    scene.procedure.steps[0].limits = {{"thrust", "", {{}, 60.0_N}, "Forced.", {}}};
    StepMonitor monitor(scene.procedure, scene.anatomy, scene.frames);
    const auto show = [&](double thrust, bool is_running) {
        monitor.observe({0.0, {{0, 0, 5.0_mm}, {1, 0, 0, 0}}, is_running, true, thrust}, scene.drill);
        return monitor.steps()[0].limits[0].broken_at.has_value();
    };
    EXPECT_FALSE(show(59.0_N, true));
    EXPECT_FALSE(show(80.0_N, false));
    EXPECT_TRUE(show(61.0_N, true));
    EXPECT_EQ(monitor.steps()[0].limits[0].worst, 61.0_N);
}

TEST(StepMonitor, AWallIsJudgedWhenItsStepHasEnded) {
    Case scene;
    scene.procedure.steps[0].limits = {{"plane_angle", "", {{}, 3.0_deg}, "Tilted.", {}},
                                       {"flatness", "", {{}, 1.0_mm}, "Uneven.", {}}};
    StepMonitor monitor(scene.procedure, scene.anatomy, scene.frames);
    monitor.judge_cut(0, bone::CutWall{.angle = 4.0_deg, .offset = 0.0, .flatness = 0.5_mm, .points = 100}, 2e-9, 1.0);
    ASSERT_EQ(monitor.new_events().size(), 1u);
    EXPECT_EQ(monitor.new_events()[0].second, "plane_angle");
    EXPECT_TRUE(monitor.steps()[0].limits[0].broken_at);
    EXPECT_FALSE(monitor.steps()[0].limits[1].broken_at);
    EXPECT_EQ(monitor.steps()[0].removed, 2e-9);
}

// ---- holes -----------------------------------------------------------------------------------------------------

TEST(StepMonitor, AHoleIsJudgedWhenItsStepHasEnded) {
    Case scene;
    scene.procedure.steps[0].limits = {{"hole_angle", "", {{}, 5.0_deg}, "Leads away.", {}},
                                       {"narrowest_offset", "", {{}, 2.0_mm}, "Off.", {}},
                                       {"excess_removal", "", {{}, 0.3}, "Too much.", {}},
                                       {"breach", "", {{}, 2.0_mm}, "Breaches.", {}, "", 6.5_mm}};
    StepMonitor monitor(scene.procedure, scene.anatomy, scene.frames);
    HoleResult result;
    result.hole = bone::DrilledHole{.narrowest_offset = 2.5_mm, .angle = 4.0_deg, .drilled = 1.5e-7, .ideal = 1e-7};
    result.breaches.emplace_back(6.5_mm, bone::Breach{.towards = {0.5_mm, 0, 0, 1.9_mm}, .depth = 20.0_mm});
    monitor.judge_hole(0, result, 1.0);
    ASSERT_EQ(monitor.new_events().size(), 2u);
    EXPECT_EQ(monitor.new_events()[0].second, "narrowest_offset");
    EXPECT_EQ(monitor.new_events()[1].second, "excess_removal");
    EXPECT_NEAR(monitor.steps()[0].limits[2].worst, 0.5, 1e-12);
    EXPECT_NEAR(monitor.steps()[0].limits[3].worst, 1.9_mm, 1e-12);
    for (const LimitState& limit : monitor.steps()[0].limits) EXPECT_TRUE(limit.is_seen);
}

TEST(StepMonitor, OfAScratchNothingIsMeasured) {
    Case scene;
    scene.procedure.steps[0].limits = {{"end_offset", "", {{}, 2.0_mm}, "Off.", {}}};
    StepMonitor monitor(scene.procedure, scene.anatomy, scene.frames);
    monitor.judge_hole(0, {}, 1.0);
    EXPECT_FALSE(monitor.steps()[0].limits[0].is_seen);
}

TEST(StepMonitor, DamageBreaksTheLimitOfThatEventOnce) {
    Case scene;
    documents::Limit damage{"damage", "", {}, "It bent.", {}, "drilling.bit_overbent"};
    scene.procedure.steps[0].limits = {damage};
    StepMonitor monitor(scene.procedure, scene.anatomy, scene.frames);
    monitor.report("drilling.stalled", 0.5);
    EXPECT_FALSE(monitor.steps()[0].limits[0].broken_at);
    monitor.report("drilling.bit_overbent", 1.0);
    ASSERT_EQ(monitor.new_events().size(), 1u);
    EXPECT_EQ(monitor.new_events()[0].second, "drilling.bit_overbent");
    monitor.report("drilling.bit_overbent", 2.0);
    EXPECT_TRUE(monitor.new_events().empty());
    EXPECT_EQ(monitor.steps()[0].limits[0].broken_at, 1.0);
    EXPECT_EQ(monitor.steps()[0].limits[0].worst, 2.0) << "it happened twice";
}

/// A tip that goes in along z, bone from 0 to 10 mm, air behind it.
struct Passage {
    Case scene;
    std::optional<StepMonitor> monitor;
    double time = 0.0;

    Passage() {
        scene.procedure.steps[0].goals = {{"depth", {1.0, {}}, {}}};  // never reached
        scene.procedure.steps[0].limits = {{"plunge", "", {{}, 3.0_mm}, "Plunged.", {}},
                                           {"time_in_air", "", {{}, 0.5_s}, "In air.", {}}};
        monitor.emplace(scene.procedure, scene.anatomy, scene.frames);
    }
    /// The hand stands 120 mm behind the tip, `ahead` nearer.
    void show(double depth, double ahead = 0.0, bool is_hole = false) {
        const bool is_bone = depth >= 0.0 && depth < 10.0_mm;
        monitor->observe({.time = time += 1e-3,
                          .world_from_tool = {{0, 0, depth}, {1, 0, 0, 0}},
                          .is_running = true,
                          .is_resisted = is_bone && !is_hole,
                          .is_bone_ahead = is_bone && !is_hole,
                          .tip_inside = std::min(depth, 10.0_mm - depth),
                          .handle = {0, 0, depth - 120.0_mm + ahead}},
                         scene.drill);
    }
    const TipProgress& advance() const { return monitor->steps()[0].advance; }
    bool is_broken(std::size_t limit) const { return monitor->steps()[0].limits[limit].broken_at.has_value(); }
};

TEST(StepMonitor, APlungeCountsFromTheFarFaceOn) {
    Passage passage;
    for (double depth = -1.0_mm; depth < 10.0_mm; depth += 0.01_mm) passage.show(depth);
    EXPECT_EQ(passage.advance().plunge, 0.0);
    for (double depth = 10.0_mm; depth < 14.0_mm; depth += 0.1_mm) passage.show(depth, 0.25 * (depth - 10.0_mm));
    EXPECT_NEAR(passage.advance().plunge, 3.9_mm, 0.11_mm);
    EXPECT_NEAR(passage.advance().hand_plunge, 1.25 * 3.9_mm, 0.14_mm) << "the hand went on a quarter farther";
    EXPECT_TRUE(passage.is_broken(0));
}

TEST(StepMonitor, WithdrawingThroughTheEntryIsNoPlunge) {
    Passage passage;
    for (double depth = -1.0_mm; depth < 6.0_mm; depth += 0.01_mm) passage.show(depth);
    for (double depth = 6.0_mm; depth > -5.0_mm; depth -= 0.05_mm) passage.show(depth, 0.0, true);
    EXPECT_EQ(passage.advance().plunge, 0.0);
    EXPECT_LT(passage.advance().in_air, 5e-3) << "and in its own hole it is not at its front, a tenth of a mm deep";
    EXPECT_FALSE(passage.is_broken(0));
}

TEST(StepMonitor, TimeInAirCountsAtTheFrontOnly) {
    Passage passage;
    for (double depth = -1.0_mm; depth < 10.0_mm; depth += 0.01_mm) passage.show(depth);
    const double begun = passage.advance().in_air;
    for (int tick = 0; tick < 400; ++tick) passage.show(12.0_mm);
    EXPECT_NEAR(passage.advance().in_air - begun, 0.4, 2e-3);
    EXPECT_NEAR(passage.advance().depth_in_air, 2.0_mm, 0.05_mm);
    EXPECT_FALSE(passage.is_broken(1));
    for (int tick = 0; tick < 200; ++tick) passage.show(12.0_mm);
    EXPECT_TRUE(passage.is_broken(1));
}

// On a slanted face the edge of a drill cuts while its tip is still in air.
TEST(StepMonitor, TimeInAirCountsOnceTheTipHasMetBone) {
    Passage passage;
    for (double depth = -1.0_mm; depth < 2.0_mm; depth += 0.001_mm)
        passage.monitor->observe({.time = passage.time += 1e-3,
                                  .world_from_tool = {{0, 0, depth}, {1, 0, 0, 0}},
                                  .is_running = true,
                                  .is_resisted = depth > 0.0,
                                  .is_bone_ahead = depth >= 1.0_mm,
                                  .tip_inside = depth - 1.0_mm},
                                 passage.scene.drill);
    EXPECT_EQ(passage.advance().in_air, 0.0);
    EXPECT_FALSE(passage.is_broken(1));
}

TEST(StepMonitor, AStillToolHarmsNothing) {
    Watch run;
    run.show(13.0_mm, 1.5_mm, false, true);
    for (const auto& limit : run.monitor.steps()[0].limits) EXPECT_FALSE(limit.broken_at);
}

TEST(StepMonitor, ALimitOnDepthIsBrokenByGoingDeeper) {
    Watch run;
    run.show(12.5_mm);
    EXPECT_TRUE(run.monitor.steps()[0].limits[1].broken_at);
    EXPECT_NEAR(run.monitor.steps()[0].limits[1].worst, 12.5_mm, 1e-12);
}

// ---- values exactly at a bound -----------------------------------------------------------------------------------

/// A step with one limit and no goal, shown at a depth of its own.
struct OneLimit {
    Case scene;
    explicit OneLimit(const documents::Limit& limit) {
        scene.procedure.steps[0].goals = {{"depth", {1.0, {}}, {}}};  // never reached
        scene.procedure.steps[0].limits = {limit};
    }
    LimitState after(const std::vector<Observation>& shown) const {
        StepMonitor monitor(scene.procedure, scene.anatomy, scene.frames);
        for (const Observation& one : shown) monitor.observe(one, scene.drill);
        return monitor.steps()[0].limits[0];
    }
};

Observation cutting_at(double depth, double thrust = 0.0, double aside = 0.0) {
    return {.time = 0.25,
            .world_from_tool = {{aside, 0, depth}, {1, 0, 0, 0}},
            .is_running = true,
            .is_resisted = true,
            .thrust = thrust};
}

// Numbers that a double holds exactly
TEST(StepMonitor, AtItsUpperBoundALimitHolds) {
    const OneLimit depth({"depth", "", {{}, 0.25}, "", {}}), thrust({"thrust", "", {{}, 60.0}, "", {}});
    EXPECT_FALSE(depth.after({cutting_at(0.25)}).broken_at);
    EXPECT_TRUE(depth.after({cutting_at(std::nextafter(0.25, 1.0))}).broken_at);
    EXPECT_FALSE(thrust.after({cutting_at(0.0, 60.0)}).broken_at);
    EXPECT_TRUE(thrust.after({cutting_at(0.0, std::nextafter(60.0, 61.0))}).broken_at);
}

TEST(StepMonitor, AtItsLowerBoundALimitHolds) {
    const OneLimit depth({"depth", "", {0.25, {}}, "", {}}), thrust({"thrust", "", {60.0, {}}, "", {}});
    EXPECT_FALSE(depth.after({cutting_at(0.25)}).broken_at);
    EXPECT_TRUE(depth.after({cutting_at(std::nextafter(0.25, 0.0))}).broken_at);
    EXPECT_FALSE(thrust.after({cutting_at(0.0, 60.0)}).broken_at);
    EXPECT_TRUE(thrust.after({cutting_at(0.0, std::nextafter(60.0, 59.0))}).broken_at);
}

TEST(StepMonitor, AClearanceOfExactlyItsLowerBoundHolds) {
    // The zone's nearest point stands 2.5 mm from the axis; the drill's wall 1.5 mm
    const auto clearance_of = [](double aside) {
        return OneLimit({"clearance", "nerve", {0.0, {}}, "", {}}).after({cutting_at(5.0_mm, 0.0, aside)});
    };
    const double nearest = clearance_of(0.0).worst;
    ASSERT_GT(nearest, 0.0);
    const OneLimit at({"clearance", "nerve", {nearest, {}}, "", {}}),
        above({"clearance", "nerve", {std::nextafter(nearest, 1.0), {}}, "", {}});
    EXPECT_FALSE(at.after({cutting_at(5.0_mm)}).broken_at);
    EXPECT_TRUE(above.after({cutting_at(5.0_mm)}).broken_at);
}

TEST(StepMonitor, AWallExactlyAtItsBoundHolds) {
    const bone::CutWall wall{.angle = 0.125, .offset = -0.25, .flatness = 0.5, .points = 100};
    const auto broken = [&](const char* quantity, const documents::Bound& bound) {
        Case scene;
        scene.procedure.steps[0].limits = {{quantity, "", bound, "", {}}};
        StepMonitor monitor(scene.procedure, scene.anatomy, scene.frames);
        monitor.judge_cut(0, wall, 0.0, 1.0);
        return monitor.steps()[0].limits[0].broken_at.has_value();
    };
    const auto below = [](double v) { return std::nextafter(v, -1.0); };
    for (const auto& [quantity, value] :
         {std::pair{"plane_angle", 0.125}, {"plane_offset", -0.25}, {"flatness", 0.5}}) {
        EXPECT_FALSE(broken(quantity, {{}, value})) << quantity;
        EXPECT_TRUE(broken(quantity, {{}, below(value)})) << quantity;
        EXPECT_FALSE(broken(quantity, {value, {}})) << quantity;
        EXPECT_TRUE(broken(quantity, {std::nextafter(value, 1.0), {}})) << quantity;
        EXPECT_FALSE(broken(quantity, {value, value})) << quantity;
    }
}

TEST(StepMonitor, WithoutAWallNothingIsJudged) {
    Case scene;
    scene.procedure.steps[0].limits = {{"flatness", "", {{}, -1.0}, "", {}}};
    StepMonitor monitor(scene.procedure, scene.anatomy, scene.frames);
    monitor.judge_cut(0, std::nullopt, 3e-9, 1.0);
    EXPECT_FALSE(monitor.steps()[0].limits[0].is_seen);
    EXPECT_FALSE(monitor.steps()[0].wall);
    EXPECT_EQ(monitor.steps()[0].removed, 3e-9);
}

TEST(StepMonitor, KeepsTheWorstOfEachSide) {
    const OneLimit upper({"thrust", "", {{}, 60.0}, "", {}}), lower({"thrust", "", {60.0, {}}, "", {}});
    const std::vector<Observation> shown{cutting_at(0.0, 50.0), cutting_at(0.0, 70.0), cutting_at(0.0, 65.0),
                                         cutting_at(0.0, 40.0), cutting_at(0.0, 45.0)};
    EXPECT_EQ(upper.after(shown).worst, 70.0);
    EXPECT_EQ(lower.after(shown).worst, 40.0);
    EXPECT_EQ(upper.after({cutting_at(0.0, -5.0)}).worst, -5.0) << "the first value, whatever it is";
    EXPECT_EQ(lower.after({cutting_at(0.0, 99.0)}).worst, 99.0);
}

TEST(StepMonitor, KeepsTheValueFarthestBeyondEitherEnd) {
    const OneLimit both({"thrust", "", {10.0, 60.0}, "", {}});
    EXPECT_EQ(both.after({cutting_at(0.0, 50.0), cutting_at(0.0, 70.0), cutting_at(0.0, 5.0)}).worst, 70.0);
    EXPECT_EQ(both.after({cutting_at(0.0, 50.0), cutting_at(0.0, 61.0), cutting_at(0.0, 5.0)}).worst, 5.0);
    EXPECT_EQ(both.after({cutting_at(0.0, 30.0), cutting_at(0.0, 59.0)}).worst, 59.0) << "the nearest to an end";
}

TEST(StepMonitor, ALimitIsBrokenOnceAtItsFirstTime) {
    OneLimit limit({"thrust", "", {{}, 60.0}, "", {}});
    StepMonitor monitor(limit.scene.procedure, limit.scene.anatomy, limit.scene.frames);
    std::size_t told = 0;
    for (const auto& [time, thrust] : {std::pair{1.0, 50.0}, {2.0, 61.0}, {3.0, 50.0}, {4.0, 62.0}}) {
        Observation now = cutting_at(0.0, thrust);
        now.time = time;
        monitor.observe(now, limit.scene.drill);
        for (const auto& [id, detail] : monitor.new_events()) told += id == "limit_broken";
    }
    EXPECT_EQ(monitor.steps()[0].limits[0].broken_at, 2.0);
    EXPECT_EQ(told, 1u);
}

// ---- goals -------------------------------------------------------------------------------------------------------

struct OneGoal {
    Case scene;
    explicit OneGoal(const documents::Goal& goal) {
        scene.procedure.steps[0].goals = {goal};
        scene.procedure.steps[0].limits = {};
    }
    bool is_reached_after(const std::vector<Observation>& shown, std::size_t owner = 0) const {
        StepMonitor monitor(scene.procedure, scene.anatomy, scene.frames);
        monitor.set_owners({.zone = {0}, .step = {owner, owner}});
        for (const Observation& one : shown) monitor.observe(one, scene.drill);
        return monitor.steps()[0].goal_done[0];
    }
};

TEST(StepMonitor, ReachesADepthGoalAtEitherBound) {
    const OneGoal goal({"depth", {0.25, 0.5}, {}});
    EXPECT_FALSE(goal.is_reached_after({cutting_at(std::nextafter(0.25, 0.0))}));
    EXPECT_TRUE(goal.is_reached_after({cutting_at(0.25)}));
    EXPECT_TRUE(goal.is_reached_after({cutting_at(0.5)}));
    EXPECT_FALSE(goal.is_reached_after({cutting_at(std::nextafter(0.5, 1.0))}));
}

TEST(StepMonitor, ADepthGoalWithoutABoundNeedsBone) {
    const OneGoal goal({"depth", {}, {}});
    Observation in_air = cutting_at(5.0_mm);
    in_air.is_resisted = false;
    EXPECT_FALSE(goal.is_reached_after({in_air}));
    EXPECT_TRUE(goal.is_reached_after({cutting_at(5.0_mm)}));
    EXPECT_TRUE(goal.is_reached_after({cutting_at(0.0)})) << "bone at the entry itself";
}

TEST(StepMonitor, AGoalOfMovingIsReachedAtItsLeastWay) {
    const OneGoal goal({"moved", {0.25, {}}, {}});
    const auto after = [&](double way) {
        const std::vector<Pose> bodies{{{way, 0, 0}, {1, 0, 0, 0}}};
        Observation now = cutting_at(5.0_mm);
        now.world_from_body = bodies;
        return goal.is_reached_after({now});
    };
    EXPECT_FALSE(after(std::nextafter(0.25, 0.0)));
    EXPECT_TRUE(after(0.25));
    EXPECT_TRUE(after(-0.25)) << "whichever way";
}

TEST(StepMonitor, MovedIsTheFarthestAndNotTheLast) {
    const OneGoal goal({"moved", {0.25, {}}, {}});
    StepMonitor monitor(goal.scene.procedure, goal.scene.anatomy, goal.scene.frames);
    for (const double way : {0.125, 0.0625}) {
        const Pose body{{0, way, 0}, {1, 0, 0, 0}};
        Observation now = cutting_at(5.0_mm);
        now.world_from_body = {&body, 1};
        monitor.observe(now, goal.scene.drill);
    }
    EXPECT_EQ(monitor.steps()[0].moved, 0.125);
}

TEST(StepMonitor, HeldIsTheBodyOfTheStepAndNoOther) {
    const OneGoal goal({"held", {}, {}});
    const Pose bodies[2]{identity_pose(), identity_pose()};
    Observation now = cutting_at(5.0_mm);
    now.world_from_body = bodies;
    for (const int held : {-1, 0, 1}) {
        now.held = held;
        EXPECT_EQ(goal.is_reached_after({now}, 0), held == 0) << held;
        EXPECT_EQ(goal.is_reached_after({now}, 1), held == 1) << held;
    }
}

TEST(StepMonitor, AStepEndsOnlyOutsideWithNothingHeld) {
    const auto is_done_after = [](double depth, int held) {
        OneGoal goal({"entry", {}, {}});
        StepMonitor monitor(goal.scene.procedure, goal.scene.anatomy, goal.scene.frames);
        monitor.observe(cutting_at(0.5), goal.scene.drill);
        Observation out = cutting_at(depth);
        out.held = held;
        monitor.observe(out, goal.scene.drill);
        return monitor.current() == 1;
    };
    EXPECT_TRUE(is_done_after(std::nextafter(0.0, -1.0), -1));
    EXPECT_FALSE(is_done_after(0.0, -1)) << "at the entry it is not outside";
    EXPECT_FALSE(is_done_after(-1.0, 0)) << "something is held";
}

TEST(StepMonitor, AfterItsLastStepItSeesNothing) {
    Case scene;
    for (documents::Step& step : scene.procedure.steps) step.goals = {{"entry", {}, {}}};
    StepMonitor monitor(scene.procedure, scene.anatomy, scene.frames);
    for (int i = 0; i < 2; ++i) {
        monitor.observe(cutting_at(0.5_mm), scene.drill);
        monitor.observe(cutting_at(-0.5_mm), scene.drill);
    }
    ASSERT_EQ(monitor.current(), 2u);
    monitor.observe(cutting_at(50.0_mm), scene.drill);
    EXPECT_TRUE(monitor.new_events().empty());
    EXPECT_LT(monitor.steps()[1].deepest, 1.0_mm);
}

TEST(StepMonitor, TakesStepTimesFromFirstAndLastTick) {
    OneGoal goal({"entry", {}, {}});
    StepMonitor monitor(goal.scene.procedure, goal.scene.anatomy, goal.scene.frames);
    for (const auto& [time, depth] : {std::pair{1.0, -0.5}, {2.0, 0.5}, {3.0, 0.25}, {4.0, -0.5}, {5.0, -0.5}}) {
        Observation now = cutting_at(depth);
        now.time = time;
        now.is_resisted = depth > 0.0;
        monitor.observe(now, goal.scene.drill);
    }
    EXPECT_EQ(monitor.steps()[0].start, 1.0);
    EXPECT_EQ(monitor.steps()[0].end, 4.0);
    EXPECT_EQ(monitor.steps()[1].start, 5.0);
    EXPECT_EQ(monitor.steps()[0].deepest, 0.5) << "the deepest, not the last";
}

// ---- loads, pace and signals -------------------------------------------------------------------------------------

TEST(StepMonitor, ATorqueCountsEitherWayAndAlsoAtAStandstill) {
    const OneLimit limit({"torque", "", {{}, 3.0}, "", {}});
    const auto after = [&](double torque, bool is_running) {
        Observation now = cutting_at(0.25);
        now.is_running = is_running;
        now.torque = torque;
        return limit.after({now});
    };
    EXPECT_FALSE(after(3.0, true).broken_at);
    EXPECT_TRUE(after(std::nextafter(3.0, 4.0), true).broken_at);
    EXPECT_TRUE(after(-4.0, false).broken_at);
    EXPECT_EQ(after(-4.0, false).worst, 4.0);
}

TEST(StepMonitor, ALateralForceCountsAlsoAtAStandstill) {
    const OneLimit limit({"lateral_force", "", {{}, 20.0}, "", {}});
    Observation now = cutting_at(0.25);
    now.is_running = false;
    now.lateral_force = 20.0;
    EXPECT_FALSE(limit.after({now}).broken_at);
    now.lateral_force = 21.0;
    EXPECT_TRUE(limit.after({now}).broken_at);
}

TEST(StepMonitor, ASpeedCountsWhileTheToolRunsInBone) {
    const OneLimit limit({"speed", "", {{}, 5.0_mm_per_s}, "", {}});
    const auto after = [&](Vec3 velocity, bool is_running, bool is_resisted) {
        std::vector<Observation> shown;
        for (int tick = 0; tick < 50; ++tick)
            shown.push_back({.time = 1e-3 * tick,
                             .world_from_tool = {1e-3 * tick * velocity, {1, 0, 0, 0}},
                             .is_running = is_running,
                             .is_resisted = is_resisted});
        return limit.after(shown);
    };
    EXPECT_NEAR(after({0, 0, 4.9_mm_per_s}, true, true).worst, 4.9_mm_per_s, 1e-9 /* rounding of the path */);
    EXPECT_FALSE(after({0, 0, 4.9_mm_per_s}, true, true).broken_at);
    EXPECT_TRUE(after({3.5_mm_per_s, 0, 4.0_mm_per_s}, true, true).broken_at) << "along and across";
    EXPECT_FALSE(after({0, 0, 9.0_mm_per_s}, false, true).broken_at) << "it stands";
    EXPECT_FALSE(after({0, 0, 9.0_mm_per_s}, true, false).is_seen) << "in air";
}

TEST(TipSpeed, AveragesOverTwentyTicksInBone) {
    TipSpeed speed;
    double tip = 0.0;
    const auto show = [&](double moved, bool is_in_bone) {
        speed.show({0, 0, tip += moved}, is_in_bone, 1e-3);
        return speed.value();
    };
    show(1.0, false);  // the approach through air is not its speed in bone
    EXPECT_NEAR(show(0.1_mm, true), 5.0_mm_per_s, 1e-9) << "a tenth of a millimetre in 20 ms";
    EXPECT_NEAR(show(-0.1_mm, true), 0.0, 1e-9) << "a tip that chatters goes nowhere";
    for (int tick = 0; tick < 20; ++tick) show(0.002_mm, true);
    EXPECT_NEAR(speed.value(), 2.0_mm_per_s, 1e-9);
}

TEST(StepMonitor, ADurationBeginsWithItsStep) {
    Case scene;
    for (documents::Step& step : scene.procedure.steps) {
        step.goals = {{"entry", {}, {}}};
        step.limits = {{"duration", "", {{}, 2.0}, "", {}}};
    }
    StepMonitor monitor(scene.procedure, scene.anatomy, scene.frames);
    const auto show = [&](double time, double depth) {
        Observation now = cutting_at(depth);
        now.time = time;
        now.is_resisted = depth > 0.0;
        monitor.observe(now, scene.drill);
    };
    show(1.0, 0.5);
    show(3.0, -0.5);
    ASSERT_EQ(monitor.current(), 1u);
    EXPECT_FALSE(monitor.steps()[0].limits[0].broken_at) << "two seconds are allowed";
    show(3.5, -0.5);
    show(5.5, -0.5);
    EXPECT_FALSE(monitor.steps()[1].limits[0].broken_at);
    show(5.75, -0.5);
    EXPECT_EQ(monitor.steps()[1].limits[0].broken_at, 5.75);
    EXPECT_EQ(monitor.steps()[1].limits[0].worst, 2.25);
}

TEST(StepMonitor, RemovedBoneIsLimitedDuringTheStepAndAtItsEnd) {
    Case scene;
    scene.procedure.steps[0].limits = {{"removed_volume", "", {{}, 2e-7}, "", {}}};
    const auto after = [&](double counted, double at_end) {
        StepMonitor monitor(scene.procedure, scene.anatomy, scene.frames);
        Observation now = cutting_at(0.25);
        now.removed = counted;
        monitor.observe(now, scene.drill);
        monitor.judge_cut(0, std::nullopt, at_end, 1.0);
        return monitor.steps()[0].limits[0].broken_at;
    };
    EXPECT_FALSE(after(2e-7, 2e-7));
    EXPECT_EQ(after(3e-7, 2e-7), 0.25) << "while it lasted";
    EXPECT_EQ(after(1e-7, 3e-7), 1.0) << "after the last count";
}

TEST(StepMonitor, AGoalOnRemovedBoneHasTwoBounds) {
    const OneGoal goal({"removed_volume", {1e-7, 2e-7}, {}});
    const auto after = [&](double removed) {
        Observation now = cutting_at(0.25);
        now.removed = removed;
        return goal.is_reached_after({now});
    };
    EXPECT_FALSE(after(0.5e-7));
    EXPECT_TRUE(after(1e-7));
    EXPECT_TRUE(after(2e-7));
    EXPECT_FALSE(after(3e-7));
}

/// A tick of a still tool in air whose law reports these.
Observation reporting(const std::vector<double>& signals) {
    return {.time = 0.5, .world_from_tool = {{0, 0, -1.0}, {1, 0, 0, 0}}, .signals = signals};
}

TEST(StepMonitor, ASignalIsLimitedInEveryTick) {
    const documents::Limit clamp{.quantity = "signal", .bound = {{}, 100.0}, .signal = {"clamp", 1, "N"}};
    const OneLimit limit(clamp);
    const std::vector<double> low{500.0, 100.0}, high{0.0, 100.5};
    EXPECT_FALSE(limit.after({reporting(low)}).broken_at);
    EXPECT_EQ(limit.after({reporting(low), reporting(high), reporting(low)}).worst, 100.5);
    EXPECT_TRUE(limit.after({reporting(high)}).broken_at);
    const std::vector<double> none;
    EXPECT_FALSE(limit.after({reporting(none)}).is_seen) << "another law, which reports fewer";
    const std::vector<double> unsound{0.0, std::nan("")};
    EXPECT_EQ(limit.after({reporting(unsound), reporting(low)}).worst, 100.0) << "what is no number is passed over";
}

TEST(StepMonitor, ASignalGoalIsReachedOnceTheSignalWasThere) {
    const OneGoal goal({.quantity = "signal", .bound = {100.0, 200.0}, .signal = {"clamp", 0, "N"}});
    const std::vector<double> below{99.0}, within{150.0}, above{201.0};
    EXPECT_FALSE(goal.is_reached_after({reporting(below), reporting(above)})) << "it jumped over the range";
    EXPECT_TRUE(goal.is_reached_after({reporting(within)}));
    EXPECT_TRUE(goal.is_reached_after({reporting(below), reporting(within), reporting(above)}));
}

TEST(StepMonitor, ASignalBeforeItsTurnCountsAsWell) {
    Case scene;
    scene.procedure.steps[0].goals = {{"entry", {}, {}},
                                      {.quantity = "signal", .bound = {100.0, {}}, .signal = {"clamp", 0, "N"}}};
    StepMonitor monitor(scene.procedure, scene.anatomy, scene.frames);
    const std::vector<double> high{120.0}, low{0.0};
    monitor.observe(reporting(high), scene.drill);
    EXPECT_FALSE(monitor.steps()[0].goal_done[1]) << "goals are reached in order";
    Observation entering = cutting_at(0.5);
    entering.signals = low;
    monitor.observe(entering, scene.drill);
    EXPECT_TRUE(monitor.steps()[0].goal_done[1]);
    EXPECT_EQ(monitor.new_events().back().second, "hole: clamp");
}

TEST(StepMonitor, KeepsTheRangeOfEachNamedSignalOnce) {
    Case scene;
    const documents::NamedSignal clamp{"clamp", 0, "N"};
    scene.procedure.steps[0].goals = {{.quantity = "signal", .bound = {1e3, {}}, .signal = clamp}};
    scene.procedure.steps[0].limits = {{.quantity = "signal", .bound = {{}, 2e3}, .signal = clamp}};
    StepMonitor monitor(scene.procedure, scene.anatomy, scene.frames);
    for (const double value : {3.0, -2.0, 7.0}) {
        const std::vector<double> signals{value};
        monitor.observe(reporting(signals), scene.drill);
    }
    ASSERT_EQ(monitor.steps()[0].signals.size(), 1u);
    EXPECT_EQ(monitor.steps()[0].signals[0].least, -2.0);
    EXPECT_EQ(monitor.steps()[0].signals[0].greatest, 7.0);
    EXPECT_TRUE(monitor.steps()[1].signals.empty());
}

TEST(Clearance, IsThatOfTheNearestPointAlongTheOutline) {
    // Given a cone of 45 degrees to 4 mm, and a cube of 2 mm beside each of its parts
    const ToolSolid cone({{0.0, 0.0}, {-4.0_mm, 4.0_mm}, {-8.0_mm, 4.0_mm}});
    const auto to = [&](Vec3 at) {
        return clearance(cone, identity_pose(), {"cube", {documents::BoxSolid{at, {2.0_mm, 2.0_mm, 2.0_mm}}}});
    };
    EXPECT_NEAR(to({0, 0, 3.0_mm}), 2.0_mm, 1e-9) << "ahead of the tip";
    EXPECT_NEAR(to({7.0_mm, 0, -6.0_mm}), 2.0_mm, 1e-9) << "beside the wall, where a ring is";
    EXPECT_NEAR(to({7.0_mm, 0, -8.0_mm}), 2.0_mm, 1e-9) << "beside the end";
    EXPECT_NEAR(to({4.0_mm, 0, 0.0_mm}), std::sqrt(2.0) * 1.0_mm, 1e-9) << "beside the middle of the cone";
    EXPECT_NEAR(to({4.5_mm, 0, -6.0_mm}), -0.5_mm, 1e-9) << "it is inside";
    const Pose moved{{0, 0, 3.0_mm}, {1, 0, 0, 0}};
    EXPECT_NEAR(clearance(cone, moved, {"cube", {documents::BoxSolid{{0, 0, 8.0_mm}, {2.0_mm, 2.0_mm, 2.0_mm}}}}),
                4.0_mm, 1e-9);
}

TEST(Clearance, NamesTheNearestPointOfTheOutline) {
    const ToolSolid cone({{0.0, 0.0}, {-4.0_mm, 4.0_mm}, {-8.0_mm, 4.0_mm}});
    Vec3 closest{};
    EXPECT_NEAR(clearance(cone, identity_pose(),
                          {"cube", {documents::BoxSolid{{0, 0, 3.0_mm}, {2.0_mm, 2.0_mm, 2.0_mm}}}}, &closest),
                2.0_mm, 1e-9);
    EXPECT_NEAR(length(closest), 0.0, 1e-12) << "the tip";
}

TEST(StepMonitor, KeepsWhereTheToolCameClosestToAZone) {
    const OneLimit near({"clearance", "nerve", {0.0, {}}, "", {}});
    const Observation first = cutting_at(5.0_mm), farther = cutting_at(5.0_mm, 0.0, -1.0_mm);
    const LimitState once = near.after({first}), twice = near.after({first, farther});
    ASSERT_TRUE(once.closest && twice.closest);
    EXPECT_EQ(twice.worst, once.worst);
    EXPECT_EQ(twice.closest->at.x, once.closest->at.x) << "the second tick is farther away";
    EXPECT_EQ(twice.closest->time, first.time);
}

/// The goal of the first step is a measure of at most 5 mm.
struct MeasuringWatch : Watch {
    MeasuringWatch() : Watch{measuring()} {}
    explicit MeasuringWatch(Case with) : Watch{std::move(with)} {}

    static Case measuring() {
        Case made;
        made.procedure.measures = {{.id = "wall", .kind = documents::Measure::Kind::thickness}};
        documents::Goal goal;
        goal.quantity = "measure";
        goal.measure = "wall";
        goal.bound = {{}, 5.0_mm};
        made.procedure.steps[0].goals = {goal};
        made.procedure.steps[0].limits.clear();
        return made;
    }
};

TEST(StepMonitor, AsksForMeasuresWhenTheToolIsOutOfBone) {
    MeasuringWatch watch;
    watch.show(-1.0_mm, 0.0, true, false);
    EXPECT_FALSE(watch.monitor.needs_measures()) << "nothing is cut yet";
    watch.show(3.0_mm);
    EXPECT_FALSE(watch.monitor.needs_measures()) << "the tool is in bone";
    watch.show(-1.0_mm, 0.0, true, false);
    EXPECT_TRUE(watch.monitor.needs_measures());
    watch.monitor.show_measures({{.value = 6.0_mm}});
    watch.show(-1.0_mm, 0.0, true, false);
    EXPECT_FALSE(watch.monitor.needs_measures()) << "once is enough";
    EXPECT_EQ(watch.monitor.current(), 0U);
    watch.show(4.0_mm);
    watch.show(-1.0_mm, 0.0, true, false);
    EXPECT_TRUE(watch.monitor.needs_measures());
    watch.monitor.show_measures({{.value = 5.0_mm}});
    watch.show(-1.0_mm, 0.0, true, false);
    EXPECT_EQ(watch.monitor.current(), 1U) << "the goal is reached at its bound";
    EXPECT_FALSE(watch.monitor.needs_measures());
}

TEST(StepMonitor, AMeasureThatCannotBeMadeReachesNoGoal) {
    MeasuringWatch watch;
    watch.show(3.0_mm);
    watch.show(-1.0_mm, 0.0, true, false);
    watch.monitor.show_measures({{.why_not = "there is no bone"}});
    watch.show(-1.0_mm, 0.0, true, false);
    EXPECT_EQ(watch.monitor.current(), 0U);
}

}  // namespace
}  // namespace kerf::run
