// SPDX-License-Identifier: Apache-2.0
// How hard a bit is bent: what steel stands is the limit of what a trainee may pull.
#include "plugins/drilling/bit_bending.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "plugins/drilling/drill_force.h"
#include "tests/support/drill_rig.h"
#include "tests/support/rig.h"

namespace kerf {
namespace {

using namespace literals;
using drilling::TwistDrill;

/// A force of 1 N across the bit at each of some heights.
struct Pushes {
    std::vector<kerf_channel> channel;
    std::vector<double> lambda;
    Vec6 following{};

    void add(double z, double newtons) {
        kerf_channel one{};
        one.kind = KERF_CONTACT;
        const Vec6 d = rate_at({0, 0, z}, {-1, 0, 0});
        std::copy(d.begin(), d.end(), one.d);
        channel.push_back(one);
        lambda.push_back(newtons);
    }
    [[nodiscard]] Advance advance() const {
        return {.rate = {}, .channel = channel, .lambda = lambda, .following = following};
    }
};

TwistDrill bit() { return {3.2_mm, 118.0_deg, 0.15, 60.0_mm, 0.25}; }
constexpr double section = pi * 3.2_mm * 3.2_mm * 3.2_mm / 64.0;  // [m³]

TEST(BitBending, APushAtTheTipBendsMostAtTheChuck) {
    Pushes at_tip;
    at_tip.add(0.0, 27.0);
    EXPECT_NEAR(drilling::bending_of(bit(), at_tip.advance()).stress(), 27.0 * 60.0_mm / section, 1.0);
    EXPECT_NEAR(drilling::bending_of(bit(), at_tip.advance()).stress() / 1e6, 1007.0, 1.0) << "what yields near 27 N";
}

TEST(BitBending, BetweenTwoPushesItBendsByTheFirstAlone) {
    Pushes clamped;  // as a hole holds it at its bottom and at its mouth; the chuck then carries nothing but the rest
    clamped.add(-1.0_mm, 30.0);
    clamped.add(-21.0_mm, -45.0);
    EXPECT_NEAR(drilling::bending_of(bit(), clamped.advance()).stress(), 30.0 * 20.0_mm / section, 1.0);
    EXPECT_EQ(drilling::bending_of(bit(), Pushes{}.advance()).stress(), 0.0);
}

// What follows goes with filtered forces and has a limit: where a lip comes out of a wall, a sum of the law's own
// figures was thousands of N/mm2.
TEST(BitBending, WhatFollowsBendsAsItWasGivenAndNotAsItWasAskedFor) {
    Pushes held;
    held.add(-0.5_mm, 60.0);
    held.channel[0].follow[0] = -5.0;
    const double alone = drilling::bending_of(bit(), held.advance()).stress();
    EXPECT_NEAR(alone, 60.0 * 59.5_mm / section, 1.0);
    held.following = rate_at({0, 0, -0.5_mm}, {-60, 0, 0});
    EXPECT_NEAR(drilling::bending_of(bit(), held.advance()).stress(), 0.0, 1e-3) << "at one height, and as much";
    held.following = rate_at({0, 0, 0}, {-60, 0, 0});
    EXPECT_NEAR(drilling::bending_of(bit(), held.advance()).stress(), 60.0 * 0.5_mm / section, 1.0)
        << "half a millimetre apart";
}

TEST(BitBending, IsAboutTheAxisAcrossThePush) {
    Pushes at_tip;
    at_tip.add(0.0, 10.0);
    const drilling::Bending bending = drilling::bending_of(bit(), at_tip.advance());
    EXPECT_EQ(bending.about_x, 0.0);
    EXPECT_NEAR(std::abs(bending.about_y), 10.0 * 60.0_mm / section, 1.0);
    at_tip.lambda[0] = -10.0;
    EXPECT_EQ(drilling::bending_of(bit(), at_tip.advance()).about_y, -bending.about_y) << "to the other side";
}

TEST(BitBending, PushesAcrossEachOtherAddAsVectors) {
    // Given 3 N to −x and 4 N to −y at the tip
    Pushes both;
    both.add(0.0, 3.0);
    both.add(0.0, 4.0);
    const Vec6 d = rate_at({}, {0, -1, 0});
    std::copy(d.begin(), d.end(), both.channel[1].d);
    const drilling::Bending bending = drilling::bending_of(bit(), both.advance());
    EXPECT_NEAR(bending.stress(), 5.0 * 60.0_mm / section, 1.0);
    EXPECT_NEAR(std::abs(bending.about_y), 3.0 * 60.0_mm / section, 1.0);
    EXPECT_NEAR(std::abs(bending.about_x), 4.0 * 60.0_mm / section, 1.0);
    EXPECT_LT(bending.about_x * bending.about_y, 0.0) << "as r × F of a push to the third quadrant";
}

TEST(BitBending, AThinPilotIsBentTheHarder) {
    TwistDrill stepped = bit();
    stepped.corners[0] = {10.0_mm, 1.6_mm};
    stepped.corners[1] = {11.0_mm, 3.2_mm};
    stepped.corner_count = 2;
    EXPECT_EQ(stepped.bit_radius_at(-5.0_mm), 1.6_mm);
    EXPECT_EQ(stepped.bit_radius_at(-10.5_mm), 3.2_mm);
    EXPECT_EQ(stepped.bit_radius_at(-40.0_mm), 3.2_mm);
    Pushes at_tip;
    at_tip.add(0.0, 10.0);
    at_tip.add(-10.0_mm, 1e-9);
    EXPECT_NEAR(drilling::bending_of(stepped, at_tip.advance()).stress(),
                std::max(10.0 * 10.0_mm / section, 10.0 * 60.0_mm / (8.0 * section)), 10.0);
}

// In bone: what the law says bends the bit is what the hand holds it with.
TEST(BitBending, InAHoleItIsTheMomentOfWhatTheHandPullsWith) {
    test::Rig simulation(test::block({-5.0_mm, -5.0_mm, -8.0_mm}, {6.0_mm, 5.0_mm, 0}, 0.25_mm, {0.31, 0.17, 0.73}),
                         test::twist_drill({{"motor_torque", 20.0}, {"length", 60.0_mm}}), test::at_depth(-0.1_mm),
                         test::gains(1.0 / 128.0));
    int told = 0;
    double stress_when_told = 0.0, min_not_told = 0.0;
    const auto move_with_tip = [&](double depth, double aside) {
        const TickResult r = simulation.tick({test::at_depth(depth, 0.0, {aside, 0, 0})});
        const double stress = signals_of<drilling::DrillCutting>(simulation.signals()).bending_stress;
        for (std::size_t i = 0; i < r.event_count; ++i)
            if (std::string(r.events[i]) == "drilling.bit_overbent" && told++ == 0) stress_when_told = stress;
        if (told == 0) min_not_told = std::max(min_not_told, stress);
        return r;
    };
    double depth = -0.1_mm;
    for (; - simulation.world_from_tool().position.z < 3.0_mm && depth < 40.0_mm; depth += 4.0_um)
        (void)move_with_tip(depth, 0.0);
    simulation.command_drive(drilling::spindle_drive, 0.0);
    for (int i = 0; i < 500; ++i) (void)move_with_tip(depth, 0.0);
    TickResult r;
    for (double aside = 0.0; aside < 12.0_mm && told == 0; aside += 0.5_um) r = move_with_tip(depth, aside);
    ASSERT_EQ(told, 1);
    EXPECT_GT(stress_when_told, 1000e6);
    EXPECT_LT(min_not_told, 1000e6);
    const Quat q = simulation.world_from_tool().rotation;
    const Vec3 force = rotate(conjugate(q), linear(r.bone_on_tool)),
               torque = rotate(conjugate(q), angular(r.bone_on_tool));
    const Vec3 at_chuck = torque + cross(Vec3{0, 0, 60.0_mm}, force);  // from (0, 0, −60 mm) to the tip
    EXPECT_GE(stress_when_told * section * 1.005, std::hypot(at_chuck.x, at_chuck.y))
        << "N m; no less than at the chuck";
    EXPECT_NEAR(stress_when_told * section / std::hypot(at_chuck.x, at_chuck.y), 1.0, 0.05)
        << "held near its tip it bends most there";
}

}  // namespace
}  // namespace kerf
