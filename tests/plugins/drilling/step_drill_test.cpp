// SPDX-License-Identifier: Apache-2.0
// A drill with a shoulder: what its second cone, its pilot and its wider shank resist and remove.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>

#include "plugins/drilling/drill_force.h"
#include "tests/support/drill_rig.h"
#include "tests/support/rig.h"

namespace kerf {
namespace {

using namespace literals;

TEST(StepDrill, LeavesTheHoleItIsShapedLike) {
    const ToolSetup setup =
        test::step_drill({{"shoulder_diameter", 5.0_mm}, {"shoulder_angle", 90.0_deg}, {"shoulder_depth", 3.0_mm}});
    test::Rig simulation(test::block({-5.0_mm, -5.0_mm, -8.0_mm}, {5.0_mm, 5.0_mm, 0}, 0.2_mm, {0.21, 0.34, 0.55}),
                         setup, test::at_depth(-1.0_mm));
    double at = -1.0_mm;
    for (; at < 5.0_mm; at += 4.0_um) {
        (void)simulation.tick_direct({test::at_depth(at)});
    }
    simulation.finish();
    const double removed = simulation.present().removed();
    const double tip = 0.9614_mm, cone = 0.9_mm, r = 1.6_mm, w = 2.5_mm;
    const double volume = pi * r * r * (tip / 3.0 + 3.0_mm - tip) + pi * cone / 3.0 * (r * r + r * w + w * w) +
                          pi * w * w * (5.0_mm - 3.0_mm - cone);
    EXPECT_NEAR(removed / volume, 1.0, 0.005);
}

TEST(StepDrill, RefusesAShoulderThatIsNone) {
    ToolOutline outline;
    std::string why;
    EXPECT_FALSE(outline_of(test::step_drill({{"shoulder_diameter", 2.0_mm}}), outline, why));
    EXPECT_FALSE(outline_of(test::step_drill({{"shoulder_depth", 0.2_mm}}), outline, why));
    EXPECT_TRUE(outline_of(test::step_drill(), outline, why)) << why;
}

// The pilot of one drill and its shoulder make one cone: the drill of the shoulder's diameter. It is resisted as that
// one is.
TEST(StepDrill, WithAShoulderThatGoesOnItsPointItIsThatTwistDrill) {
    const double whole = 3.2_mm, pilot = 2.0_mm, turn = 118.0_deg, cot = 0.6008606190275604;
    const auto law = [](const ToolSetup& setup) {
        test::Rig simulation(test::block({-5.0_mm, -5.0_mm, -14.0_mm}, {5.0_mm, 5.0_mm, 0}, 0.2_mm, {0.21, 0.34, 0.55}),
                             setup, test::at_depth(-1.0_mm));
        for (double at = -1.0_mm; at < 8.0_mm; at += 2.0_um) {
            (void)simulation.tick_direct({test::at_depth(at)});
        }
        // Moved aside into the wall of its hole, so that the shank presses.
        for (int i = 0; i < 2; ++i) {
            (void)simulation.tick_direct({test::at_depth(8.0_mm, 0.0, {0.2_mm, 0, 0})});
        }
        std::map<std::uint32_t, kerf_channel> channels;
        for (const kerf_channel& c : test::law_now(simulation)) channels[c.id] = c;
        return channels;
    };
    const auto one = law(test::twist_drill({{"diameter", whole}, {"element_pitch", 0.05_mm}}));
    const auto two = law(test::step_drill({{"diameter", pilot},
                                           {"shoulder_diameter", whole},
                                           {"shoulder_angle", turn},
                                           {"point_angle", turn},
                                           {"shoulder_depth", 0.5 * pilot * cot + 1e-9},
                                           {"web", 0.15 * whole / pilot},
                                           {"corner", 0.25 * whole / pilot},
                                           {"element_pitch", 0.05_mm}}));
    ASSERT_EQ(one.size(), two.size());
    for (const auto& [id, c] : one) {
        ASSERT_TRUE(two.contains(id)) << id;
        const kerf_channel& d = two.at(id);
        EXPECT_NEAR(d.tau, c.tau, 0.03 * c.tau) << id;
        EXPECT_NEAR(d.eta, c.eta, 0.03 * c.eta) << id;
        EXPECT_NEAR(d.k, c.k, 0.01 * c.k) << id << ": its thinner point bends a little more";
        EXPECT_NEAR(d.delta, c.delta, 1e-6) << id;
        EXPECT_NEAR(d.follow[5], c.follow[5], 0.03 * std::abs(c.follow[5])) << id;
    }
}

// Through a plate with its pilot, onto its face with its shoulder.
struct Countersink {
    test::Rig simulation{test::block({-8.0_mm, -8.0_mm, -4.0_mm}, {8.0_mm, 8.0_mm, 0}, 0.25_mm, {0.3, 0.1, 0.7}),
                         test::step_drill({{"diameter", 3.2_mm},
                                           {"shoulder_diameter", 8.0_mm},
                                           {"shoulder_angle", 90.0_deg},
                                           {"shoulder_depth", 8.0_mm}}),
                         test::at_depth(-0.2_mm)};

    explicit Countersink(double to) {
        for (double at = -0.2_mm; at < to; at += 4.0_um) {
            (void)simulation.tick_direct({test::at_depth(at)});
        }
    }
    TickResult tick(const Pose& hand) {
        const TickResult r = simulation.tick({hand});
        return r;
    }
};

TEST(StepDrill, SwitchedOffItStandsOnItsShoulder) {
    Countersink sink(7.5_mm);
    sink.simulation.command_drive(drilling::spindle_drive, 0.0);
    for (int i = 0; i < 600; ++i) (void)sink.tick(test::at_depth(7.5_mm));
    ASSERT_EQ(signals_of<drilling::DrillCutting>(sink.simulation.signals()).spindle_speed, 0.0);
    TickResult r;
    for (double hand = 7.5_mm; hand < 11.0_mm; hand += 4.0_um) r = sink.tick(test::at_depth(hand));
    EXPECT_GT(r.thrust, 20.0) << "N";
    EXPECT_LT(-sink.simulation.world_from_tool().position.z, 8.35_mm)
        << "it touches at 8.24 mm, with the foremost of its points";
    EXPECT_FALSE(r.is_cutting);
}

TEST(StepDrill, SwitchedOffItsPilotIsHeldByItsHole) {
    Countersink sink(6.0_mm);
    sink.simulation.command_drive(drilling::spindle_drive, 0.0);
    for (int i = 0; i < 600; ++i) (void)sink.tick(test::at_depth(6.0_mm));
    TickResult r;
    for (double aside = 0.0; aside < 2.0_mm; aside += 2.0_um) r = sink.tick(test::at_depth(6.0_mm, 0.0, {aside, 0, 0}));
    EXPECT_LT(r.bone_on_tool[0], -5.0) << "N";
    EXPECT_LT(sink.simulation.world_from_tool().position.x, 0.2_mm);
}

}  // namespace
}  // namespace kerf
