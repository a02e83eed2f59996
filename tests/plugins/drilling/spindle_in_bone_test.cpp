// SPDX-License-Identifier: Apache-2.0
// The drill and its motor: what happens when it is slow, too weak, or switched off.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "plugins/drilling/drill_force.h"
#include "tests/support/drill_rig.h"

namespace kerf {
namespace {

using namespace literals;

struct Rig {
    Body body = test::block({-5.0_mm, -5.0_mm, -12.0_mm}, {5.0_mm, 5.0_mm, 0}, 0.25_mm, {0.3, 0.1, 0.7});
    ToolSetup setup;
    Simulation simulation;
    std::vector<std::string> events;

    explicit Rig(const std::map<std::string, double>& set)
        : setup(test::twist_drill(set)),
          simulation(body, setup, test::rigid_outline(setup), test::gains(), test::at_depth(-0.2_mm)) {}

    TickResult push(double force) {
        const double stretch = force * test::gains().force_scale / test::gains().stiffness;
        const TickResult r = simulation.tick({test::at_depth(depth() + stretch)});
        for (std::size_t i = 0; i < r.event_count; ++i) events.emplace_back(r.events[i]);
        return r;
    }
    [[nodiscard]] double depth() const { return -simulation.world_from_tool().position.z; }
    [[nodiscard]] double rpm() const {
        return signals_of<drilling::DrillCutting>(simulation.signals()).spindle_speed * 60.0;
    }
};

TEST(SpindleInBone, ItRunsUpBeforeItCuts) {
    Rig rig({{"run_up", 0.2}});
    for (int i = 0; i < 150; ++i) (void)rig.push(0.0);
    EXPECT_NEAR(rig.rpm(), 745.0, 15.0);
    for (int i = 0; i < 850; ++i) (void)rig.push(150.0);
    EXPECT_NEAR(rig.rpm(), 1000.0, 1e-9);
    EXPECT_EQ(rig.events, (std::vector<std::string>{"drilling.spinning_up", "drilling.running"}));
    EXPECT_GT(rig.depth(), 0.5_mm);
}

TEST(SpindleInBone, AWeakMotorBogsDownUnderAHardPushAndRecoversWhenLet) {
    Rig rig({{"run_up", 0.1}, {"motor_torque", 100.0_Nmm}});  // full depth at 1000 rpm and 2 mm/s takes 186 N·mm
    for (int i = 0; i < 300; ++i) (void)rig.push(0.0);
    for (int i = 0; i < 4000 && rig.rpm() > 600.0; ++i) (void)rig.push(250.0);
    EXPECT_LT(rig.rpm(), 600.0);
    EXPECT_GT(rig.rpm(), 0.0);
    for (int i = 0; i < 500; ++i) (void)rig.push(0.0);
    EXPECT_NEAR(rig.rpm(), 1000.0, 1e-9);
    EXPECT_EQ(rig.events, (std::vector<std::string>{"drilling.spinning_up", "drilling.running", "drilling.bogging",
                                                    "drilling.running"}));
}

TEST(SpindleInBone, AMotorTooWeakForTheBoneStallsAndPullsAtTheHandUntilSwitchedOff) {
    Rig rig({{"run_up", 0.05}, {"motor_torque", 20.0_Nmm}, {"inertia", 5e-6}});
    for (int i = 0; i < 300; ++i) (void)rig.push(0.0);
    TickResult r;
    for (int i = 0; i < 3000 && rig.events.back() != "drilling.stalled"; ++i) r = rig.push(250.0);
    ASSERT_EQ(rig.events.back(), "drilling.stalled");
    for (int i = 0; i < 200; ++i) r = rig.push(50.0);
    EXPECT_EQ(rig.rpm(), 0.0);
    EXPECT_NEAR(r.torque, 20.0_Nmm, 0.5_Nmm) << "all of the motor's torque";
    EXPECT_FALSE(r.is_cutting);
    rig.simulation.command_drive(drilling::spindle_drive, 0.0);
    for (int i = 0; i < 20; ++i) r = rig.push(0.0);
    EXPECT_LT(std::abs(r.torque), 0.5_Nmm);
    rig.simulation.command_drive(drilling::spindle_drive, 1000.0_rpm);
    for (int i = 0; i < 200; ++i) r = rig.push(0.0);
    EXPECT_EQ(rig.events.back(), "drilling.running");
}

TEST(SpindleInBone, InReverseItRubsAndTakesNoBone) {
    Rig rig({});
    for (int i = 0; i < 2000; ++i) (void)rig.push(170.0);
    rig.simulation.command_drive(drilling::spindle_drive, -1000.0_rpm);
    for (int i = 0; i < 300; ++i) (void)rig.push(100.0);
    const double depth = rig.depth();
    TickResult r;
    for (int i = 0; i < 500; ++i) r = rig.push(100.0);
    EXPECT_NEAR(rig.rpm(), -1000.0, 1e-9);
    EXPECT_NEAR(rig.depth(), depth, 2.0_um);
    EXPECT_NEAR(r.thrust, 100.0, 3.0);
    EXPECT_FALSE(r.is_cutting);
    // What rubs the motor pays, and the hand feels it, the other way round than in cutting.
    EXPECT_NEAR(r.torque, -0.3 * 100.0 * 2.0 / 3.0 * 1.6_mm, 2.0_Nmm);
    EXPECT_NEAR(
        signals_of<drilling::DrillCutting>(rig.simulation.signals()).drive_power / (2.0 * pi * 1000.0_rpm * -r.torque),
        1.0, 0.02);
}

TEST(SpindleInBone, StalledInReverseItPullsTheOtherWay) {
    Rig rig({{"motor_torque", 20.0_Nmm}, {"inertia", 5e-6}});
    for (int i = 0; i < 1500; ++i) (void)rig.push(20.0);
    rig.simulation.command_drive(drilling::spindle_drive, -1000.0_rpm);
    TickResult r;
    for (int i = 0; i < 3000 && rig.events.back() != "drilling.stalled"; ++i) r = rig.push(250.0);
    ASSERT_EQ(rig.events.back(), "drilling.stalled");
    for (int i = 0; i < 200; ++i) r = rig.push(50.0);
    EXPECT_NEAR(r.torque, -20.0_Nmm, 0.5_Nmm);
}

// A motor that cannot turn what such a push asks of it stays where it stalled, and does not creep through bone a jerk
// at a time.
TEST(SpindleInBone, AMotorTooWeakForThePushStaysWhereItStalls) {
    for (const double torque : {60.0_Nmm, 100.0_Nmm, 120.0_Nmm}) {
        Rig rig({{"run_up", 0.2}, {"motor_torque", torque}});
        for (int i = 0; i < 300; ++i) (void)rig.push(0.0);
        for (int i = 0; i < 6000 && rig.events.back() != "drilling.stalled"; ++i) (void)rig.push(200.0);
        ASSERT_EQ(rig.events.back(), "drilling.stalled") << torque;
        const double removed = rig.simulation.present().removed(), depth = rig.depth();
        for (int i = 0; i < 2000; ++i) (void)rig.push(200.0);
        EXPECT_NEAR(rig.depth(), depth, 0.05_mm) << torque;
        EXPECT_NEAR(rig.simulation.present().removed(), removed, 0.5e-9) << torque;
    }
}

// S-19, its first half: what cut becomes what touches, without a blow.
TEST(SpindleInBone, SwitchedOffUnderPushItStopsCuttingAndStands) {
    Rig rig({{"run_up", 0.2}});
    for (int i = 0; i < 2500; ++i) (void)rig.push(150.0);
    const double at_switch = rig.depth();
    rig.simulation.command_drive(drilling::spindle_drive, 0.0);
    double last = rig.push(150.0).thrust, largest_step = 0.0;
    for (int i = 0; i < 2000; ++i) {
        const double thrust = rig.push(150.0).thrust;
        largest_step = std::max(largest_step, std::abs(thrust - last));
        last = thrust;
    }
    EXPECT_EQ(rig.rpm(), 0.0);
    EXPECT_NEAR(last, 150.0, 3.0) << "it stands on the bottom of its hole";
    EXPECT_LT(largest_step, 0.07 * 150.0);
    EXPECT_LT(rig.depth() - at_switch, 0.5_mm) << "while running down";
    const double stands = rig.depth();
    for (int i = 0; i < 500; ++i) (void)rig.push(150.0);
    EXPECT_NEAR(rig.depth(), stands, 1.0_um);
    EXPECT_EQ(rig.events.back(), "drilling.spindle_off");
}

TEST(SpindleInBone, WhatItCutBeforeItStoodIsGone) {
    // However far the open stretch had come when it took the last bone: that tick closes it
    for (const int ticks : {2000, 2003, 2008, 2014}) {
        Rig rig({{"run_up", 0.0}});
        for (int i = 0; i < ticks; ++i) (void)rig.push(170.0);
        rig.simulation.command_drive(drilling::spindle_drive, 0.0);
        Pose last_cut = rig.simulation.world_from_tool();
        for (int i = 0; i < 100; ++i)
            if (rig.push(170.0).is_cutting) last_cut = rig.simulation.world_from_tool();
        const CutTracker& tracker = rig.simulation.tracker();
        EXPECT_EQ(length(tracker.recent(tracker.recent_count() - 1).to.position - last_cut.position), 0.0) << ticks;
    }
}

TEST(SpindleInBone, TheMotorPaysForTheTorque) {
    Rig rig({});
    double torque = 0.0, power = 0.0, count = 0.0;
    for (int i = 0; i < 3000; ++i) {
        const TickResult r = rig.push(170.0);
        if (i < 2000) continue;
        torque += r.torque;
        power += signals_of<drilling::DrillCutting>(rig.simulation.signals()).drive_power;
        count += 1.0;
    }
    EXPECT_NEAR(power / count / (2.0 * pi * 1000.0_rpm * torque / count), 1.0, 0.05);
}

TEST(SpindleInBone, AStillDrillInItsHoleRubsOnTheWall) {
    Rig rig({{"run_up", 0.0}});
    for (int i = 0; i < 4000; ++i) (void)rig.push(170.0);
    ASSERT_GT(rig.depth(), 3.0_mm);
    rig.simulation.command_drive(drilling::spindle_drive, 0.0);
    // Pulled out by a hand that stands a millimetre aside, the shank is pressed on the wall: friction holds it back.
    const double deep = rig.depth();
    TickResult r;
    for (int i = 0; i < 2000; ++i) {
        Pose hand = test::at_depth(deep - 1.0_um * i);
        hand.position.x += std::min<double>(1.0_mm, 0.01_mm * i);
        r = rig.simulation.tick({hand});
    }
    const double pressed = std::hypot(r.bone_on_tool[0], r.bone_on_tool[1]);
    EXPECT_GT(pressed, 0.5);
    EXPECT_GE(-r.thrust, 0.3 * pressed * 0.999) << "Coulomb's friction, with the default coefficient";

    // A tilted shank is pressed on opposite walls at once; what rubs is the sum of what each carries, k δ at rest.
    double carried = 0.0;
    for (const kerf_channel& c : test::law_now(rig.simulation))
        if (c.kind == KERF_CONTACT && std::abs(c.d[2]) < 0.1) carried += std::max(0.0, c.k * c.delta);
    EXPECT_NEAR(-r.thrust / carried, 0.3, 0.015);
}

}  // namespace
}  // namespace kerf
