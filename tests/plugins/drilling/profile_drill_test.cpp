// SPDX-License-Identifier: Apache-2.0
// A drill of any outline: what the lips along it resist and remove, and what it may not be.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "plugins/drilling/drill_force.h"
#include "tests/support/drill_rig.h"
#include "tests/support/rig.h"

namespace kerf {
namespace {

using namespace literals;
using Corners = std::vector<std::pair<double, double>>;  // [m] depth behind the tip, radius

ToolSetup profile_drill(std::map<std::string, double> set, const Corners& corners) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
        set["depth_" + std::to_string(i + 1)] = corners[i].first;
        set["diameter_" + std::to_string(i + 1)] = 2.0 * corners[i].second;
    }
    return test::drill("profile_drill", set);
}

/// A hemisphere: a point of 150° and eight cones behind it, their corners on the sphere.
constexpr double ball_radius = 2.5_mm;
ToolSetup ball(std::map<std::string, double> set = {}) {
    const double half_point = 75.0_deg;
    Corners corners;
    // The chord from the tip at 15° to the face meets the sphere 30° round it; from there on in even steps.
    for (int i = 0; i <= 8; ++i) {
        const double round = (30.0_deg + i * 60.0_deg / 8);
        corners.emplace_back(ball_radius * (1.0 - std::cos(round)), ball_radius * std::sin(round));
    }
    set.insert({"diameter", 2.0 * corners.front().second});
    set.insert({"point_angle", 2.0 * half_point});
    set.insert({"shank_diameter", 2.35_mm});
    set.insert({"corner", 0.05});
    corners.erase(corners.begin());
    return profile_drill(set, corners);
}

struct Drilled {
    double removed = 0.0;
    TickResult last;
    std::map<std::uint32_t, kerf_channel> channels;
};

/// Straight down to `depth` at `feed` [m/s] through bone that is thicker than that, or `plate` thick.
Drilled drill_down(const ToolSetup& setup, double depth, double feed = 4.0e-3, double plate = 16.0_mm,
                   double spacing = 0.2_mm) {
    test::Rig simulation(test::block({-5.0_mm, -5.0_mm, -plate}, {5.0_mm, 5.0_mm, 0}, spacing, {0.21, 0.34, 0.55}),
                         setup, test::at_depth(-1.0_mm));
    Drilled drilled;
    for (double at = -1.0_mm; at < depth; at += feed * Simulation::dt) {
        drilled.last = simulation.tick_direct({test::at_depth(at)});
    }
    for (const kerf_channel& c : test::law_now(simulation)) drilled.channels[c.id] = c;
    simulation.finish();
    drilled.removed = simulation.present().removed();
    return drilled;
}

void expect_alike(const std::map<std::uint32_t, kerf_channel>& one, const std::map<std::uint32_t, kerf_channel>& other,
                  double within) {
    ASSERT_EQ(one.size(), other.size());
    for (const auto& [id, c] : one) {
        ASSERT_TRUE(other.contains(id)) << id;
        const kerf_channel& d = other.at(id);
        EXPECT_NEAR(d.tau, c.tau, within * c.tau) << id;
        EXPECT_NEAR(d.eta, c.eta, within * c.eta) << id;
        EXPECT_NEAR(d.k, c.k, within * c.k) << id;
        EXPECT_NEAR(d.follow[5], c.follow[5], within * std::abs(c.follow[5])) << id;
    }
}

TEST(ProfileDrill, WithoutCornersItIsTheTwistDrill) {
    expect_alike(drill_down(test::twist_drill(), 6.0_mm).channels, drill_down(profile_drill({}, {}), 6.0_mm).channels,
                 1e-12);
}

TEST(ProfileDrill, WithAShouldersCornersItIsTheStepDrill) {
    const ToolSetup step =
        test::step_drill({{"shoulder_diameter", 5.0_mm}, {"shoulder_angle", 90.0_deg}, {"shoulder_depth", 3.0_mm}});
    const ToolSetup profile = profile_drill({}, {{3.0_mm, 1.6_mm}, {3.9_mm, 2.5_mm}});
    const Drilled one = drill_down(step, 5.0_mm), other = drill_down(profile, 5.0_mm);
    expect_alike(one.channels, other.channels, 1e-9);
    EXPECT_NEAR(other.removed / one.removed, 1.0, 1e-9);
}

// Corners that all lie on the point's own cone change nothing but how the lip is cut into pieces.
TEST(ProfileDrill, WithItsCornersOnOneConeItIsThatTwistDrill) {
    const double cot = 0.6008606190275604, pilot = 0.8_mm, whole = 1.6_mm;
    Corners corners;
    for (int i = 1; i <= 8; ++i) {
        const double r = pilot + (whole - pilot) * i / 8;
        corners.emplace_back(r * cot, r);
    }
    const ToolSetup setup =
        profile_drill({{"diameter", 2.0 * pilot}, {"web", 0.3}, {"corner", 0.5}, {"element_pitch", 0.05_mm}}, corners);
    const Drilled one = drill_down(test::twist_drill({{"element_pitch", 0.05_mm}}), 6.0_mm),
                  other = drill_down(setup, 6.0_mm);
    expect_alike(one.channels, other.channels, 0.03);
    EXPECT_NEAR(other.removed / one.removed, 1.0, 1e-3);
}

TEST(ProfileDrill, ABallLeavesItsHole) {
    const double depth = 6.0_mm, r = ball_radius;
    const double volume = 2.0 / 3.0 * pi * r * r * r + pi * r * r * (depth - r);
    // Its corners lie on the sphere, so it is 0.4 % less than that.
    EXPECT_NEAR(drill_down(ball(), depth).removed / volume, 1.0, 0.01);
}

// What an edge gives along the axis does not depend on the outline; what a chip does goes with sin p, a ball's √(1 −
// (r/R)²):
//
//     F_z = Σ over both lips ∫ (K_e + K_c f/2 sin p cos β / cos i) cos β ds,  and the chisel's
TEST(ProfileDrill, ABallsThrustIsTheIntegralAlongItsLips) {
    const double feed = 4.0e-3, n = 1000.0 / 60.0, per_lip = feed / (2.0 * n);
    const ToolSetup setup = ball({{"element_pitch", 0.05_mm}, {"edge_depth", 0.01e-6}});
    const auto law = value_of<drilling::DrillCutting>(setup.force_parameters);
    const double half_web = 0.5 * 0.15 * value_of<drilling::ProfileBit>(setup.tool_parameters).diameter,
                 c = half_web / 0.81915204428899180, r = ball_radius;
    constexpr int pieces = 20000;
    const double first = std::sqrt(c * c - half_web * half_web), last = std::sqrt(r * r - half_web * half_web),
                 ds = (last - first) / pieces;
    double thrust = 2.0 * c * (law.chisel_edge + law.chisel_chip * per_lip);
    for (int i = 0; i < pieces; ++i) {
        const double s = first + (i + 0.5) * ds, at = std::sqrt(s * s + half_web * half_web), cos_beta = s / at;
        const double sin_p = std::sqrt(1.0 - at * at / (r * r)),
                     cos2_i = 1.0 - sin_p * sin_p * (1.0 - cos_beta * cos_beta);
        thrust +=
            2.0 * ds * cos_beta * (law.thrust_edge + law.thrust_chip * per_lip * sin_p * cos_beta / std::sqrt(cos2_i));
    }
    EXPECT_NEAR(drill_down(setup, 8.0_mm, feed).last.thrust / thrust, 1.0, 0.005) << thrust << " N";
}

// Behind its head a thin shank is free of the hole: moved aside, the head's land meets the wall, and nothing behind it
// does.
TEST(ProfileDrill, ShankThinnerThanItsHoleTouchesNothing) {
    const auto pressed = [](double shank) {
        test::Rig simulation(test::block({-5.0_mm, -5.0_mm, -20.0_mm}, {5.0_mm, 5.0_mm, 0}, 0.2_mm, {0.21, 0.34, 0.55}),
                             ball({{"shank_diameter", shank}, {"spindle_speed", 1000.0_rpm}}), test::at_depth(-1.0_mm));
        for (double at = -1.0_mm; at < 14.0_mm; at += 4.0_um) {
            (void)simulation.tick_direct({test::at_depth(at)});
        }
        (void)simulation.tick_direct({test::at_depth(14.0_mm, 0.0, {0.15_mm, 0, 0})});
        int touching = 0;
        for (const kerf_channel& c : test::law_now(simulation)) touching += c.kind == KERF_CONTACT && c.delta > 0.0;
        return touching;
    };
    EXPECT_GT(pressed(0.0), 0);
    EXPECT_EQ(pressed(2.35_mm), 0);
}

TEST(ProfileDrill, RefusesWhatIsNoOutlineAndSaysWhatIsNeeded) {
    const auto refusal = [](std::map<std::string, double> set, const Corners& corners) {
        ToolOutline outline;
        std::string why;
        (void)outline_of(profile_drill(std::move(set), corners), outline, why);
        return why;
    };
    const std::string begin = "tool `profile_drill` cannot be made from these parameters: ";
    EXPECT_EQ(refusal({}, {{4.0_mm, 1.6_mm}, {5.0_mm, 2.0_mm}, {8.0_mm, 2.0_mm}, {9.0_mm, 3.0_mm}}), "");
    EXPECT_EQ(refusal({}, {{0.5_mm, 2.0_mm}}),
              begin + "`depth_1` is 0.5 mm; it needs 0.01 mm or more beyond the depth of the point, 0.961 mm.");
    EXPECT_EQ(refusal({}, {{4.0_mm, 1.6_mm}, {4.0_mm, 2.0_mm}}),
              begin + "`depth_2` is 4 mm; it needs 0.01 mm or more beyond the depth of the corner before, 4 mm.");
    EXPECT_NE(refusal({}, {{4.0_mm, 1.6_mm}, {4.001_mm, 2.0_mm}}).find("0.01 mm or more beyond"), std::string::npos);
    EXPECT_EQ(
        refusal({}, {{4.0_mm, 1.0_mm}}),
        begin + "`diameter_1` is 2 mm; it needs that of the point, 3.2 mm, or a degree of half angle more: 3.31 mm.");
    EXPECT_EQ(
        refusal({}, {{40.0_mm, 1.601_mm}}),
        begin + "`diameter_1` is 3.2 mm; it needs that of the point, 3.2 mm, or a degree of half angle more: 4.56 mm.");
    EXPECT_EQ(refusal({{"depth_3", 9.0_mm}, {"diameter_3", 4.0_mm}}, {{4.0_mm, 1.6_mm}}),
              begin + "corner 3 is given, but `depth_2` is 0 mm; corners need numbers from 1 on without a gap, each a "
                      "depth and a diameter.");
    EXPECT_EQ(refusal({{"diameter_1", 4.0_mm}}, {}),
              begin + "corner 1 is given, but `depth_1` is 0 mm; corners need numbers from 1 on without a gap, each a "
                      "depth and a diameter.");
    EXPECT_EQ(refusal({{"length", 10.0_mm}}, {{9.0_mm, 1.6_mm}, {9.8_mm, 3.0_mm}}),
              begin + "`length` is 10 mm; it needs more than the cutting part and the land behind it, 10.6 mm.");
}

TEST(ProfileDrill, SwitchedOffItStandsOnItsHeadAsABlunterToolDoes) {
    test::Rig simulation(test::block({-5.0_mm, -5.0_mm, -8.0_mm}, {5.0_mm, 5.0_mm, 0}, 0.25_mm, {0.21, 0.34, 0.55}),
                         ball({{"spindle_speed", 0.0}}), test::at_depth(-0.2_mm));
    TickResult r;
    for (double hand = -0.2_mm; hand < 3.0_mm; hand += 4.0_um) {
        r = simulation.tick({test::at_depth(hand)});
    }
    EXPECT_GT(r.thrust, 20.0) << "N";
    EXPECT_LT(-simulation.world_from_tool().position.z, 0.3_mm);
    EXPECT_EQ(simulation.present().removed(), 0.0);
}

}  // namespace
}  // namespace kerf
