// SPDX-License-Identifier: Apache-2.0
#include "studies/papers/as_printed/hsieh_2006.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>

#include "tests/studies/papers/as_printed/printed_rig.h"
#include "tests/support/drill_rig.h"

namespace kerf::as_printed {
namespace {

using namespace literals;

/// Ten teeth in a cortical block, fed straight down.
struct Sawing {
    Body body = test::block({-12.0_mm, -3.0_mm, -8.0_mm}, {12.0_mm, 3.0_mm, 0}, 0.5_mm, {0.31, 0.17, 0.73});
    ToolSetup setup;
    std::unique_ptr<Simulation> simulation;
    double depth = -1.0_mm;

    explicit Sawing(const std::map<std::string, double>& set = {}) {
        setup.tool = test::printed_plugins().find("papers.as_printed", KERF_KIND_TOOL, "paper_saw");
        setup.force = test::printed_plugins().find("papers.as_printed", KERF_KIND_FORCE, "hsieh_2006");
        for (const auto& info : test::printed_plugins().catalog()) {
            if (info.id == "paper_saw") {
                setup.tool_parameters = test::values(info.parameters, set);
                setup.drives = test::values(info.drives, set);
            }
            if (info.id == "hsieh_2006") setup.force_parameters = test::values(info.parameters, set);
        }
        simulation =
            std::make_unique<Simulation>(body, setup, test::outline(setup), test::gains(), test::at_depth(depth));
    }
    TickResult go(double rate) {
        depth += rate * Simulation::dt;
        const TickResult r = simulation->tick_direct({test::at_depth(depth)});
        return r;
    }
    void to(double target, double rate = 2.0_mm_per_s) {
        while (depth < target - 1e-12) (void)go(rate);
    }
    Hsieh2006::Signals signals() const { return signals_of<Hsieh2006>(simulation->signals()); }
};

TEST(Hsieh2006, TheMiddleToothStandsAtARightAngleAsPrinted) {  // E03-2
    EXPECT_NEAR(tooth_angle_as_printed(60.0_mm, 1e-12, 0.0), 90.0_deg, 1e-9);
    EXPECT_NEAR(tooth_angle_as_printed(60.0_mm, 7.0_mm, 0.0), std::atan(60.0 / 7.0), 1e-15) << "for 6.7 deg";
}

TEST(Hsieh2006, TheAreaOfAChipIsAVolume) {  // E03-1: twice in every length, and it grows eightfold
    const double once = chip_as_printed(1.0_mm, 1.4_mm, 1.0_mm_per_s, 200.0);
    EXPECT_NEAR(once, 0.007e-9, 1e-20) << "0.007 mm3";
    EXPECT_NEAR(chip_as_printed(2.0_mm, 2.8_mm, 2.0_mm_per_s, 200.0) / once, 8.0, 1e-12);
    EXPECT_FALSE(std::isfinite(chip_as_printed(1.0_mm, 1.4_mm, 1.0_mm_per_s, 0.0))) << "from a saw that stands";
}

TEST(Hsieh2006, ItsForcesAreNotTurnedButMixed) {  // E03-3: at 5°, with 1 N and 0.5 N
    const SawForce printed = saw_force(sin_cos_exact(5.0_deg), 1.0, 0.5);
    EXPECT_NEAR(printed.x, 1.04, 0.005);
    EXPECT_NEAR(std::sin(5.0_deg) * 1.0 + std::cos(5.0_deg) * 0.5, 0.585, 0.001) << "what a turn gives";
    EXPECT_GT(std::hypot(printed.x, printed.z), std::hypot(1.0, 0.5)) << "it makes force";
}

TEST(Hsieh2006, TheForceAlongTheStrokeNeverTurns) {  // E03-4
    Sawing saw({{"oscillation", 20.0}});
    saw.to(4.0_mm);
    for (int i = 0; i < 200; ++i) {
        (void)saw.go(1.0_mm_per_s);
        EXPECT_GT(saw.signals().f_x, 0.0) << "over four whole oscillations, to one side";
    }
}

TEST(Hsieh2006, NeighboursDoNotCancel) {  // E03-5
    Sawing saw;
    saw.to(4.0_mm);
    for (int i = 0; i < 5; ++i) (void)saw.go(1.0_mm_per_s);
    ASSERT_EQ(saw.signals().teeth_in_bone, 10.0);
    EXPECT_NEAR(saw.signals().f_y, 10.0 * 0.8, 0.1) << "of ten teeth set by turns nothing should be left";
}

// 03-05, and E03-6: from 2 to 10 µm bone shows 1.3.
TEST(Hsieh2006, ForceIsProportionalToTheFeedAndToOneOverTheRate) {
    const auto thrust = [](double feed, double rate) {
        Sawing saw({{"oscillation", rate}, {"swing", 0.0}});
        saw.to(4.0_mm);
        for (int i = 0; i < 3; ++i) (void)saw.go(feed);
        return saw.go(feed).thrust;
    };
    const double once = thrust(1.0_mm_per_s, 200.0);
    EXPECT_GT(once, 50.0);
    EXPECT_NEAR(thrust(5.0_mm_per_s, 200.0) / once, 5.0, 1e-6);
    EXPECT_NEAR(thrust(1.0_mm_per_s, 400.0) / once, 0.5, 1e-6);
}

TEST(Hsieh2006, WhatWasSawnIsFeltAgain) {  // 03-12, S-12: no bone is removed
    Sawing saw;
    saw.to(4.0_mm);
    for (int i = 0; i < 100; ++i) (void)saw.go(-20.0_mm_per_s);
    for (int i = 0; i < 3; ++i) (void)saw.go(2.0_mm_per_s);
    EXPECT_GT(saw.go(2.0_mm_per_s).thrust, 100.0) << "N, where a slot should be";
}

TEST(Hsieh2006, AStillSawIsHeldBackWhenItIsDrawnOut) {  // 03-11
    Sawing saw({{"oscillation", 0.0}});
    saw.to(2.0_mm);
    EXPECT_GT(saw.go(1.0_mm_per_s).thrust, 0.0) << "in";
    (void)saw.go(-1.0_mm_per_s);
    EXPECT_LT(saw.go(-1.0_mm_per_s).thrust, 0.0) << "and out";
}

}  // namespace
}  // namespace kerf::as_printed
