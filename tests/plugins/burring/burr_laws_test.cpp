// SPDX-License-Identifier: Apache-2.0
// What any burr must obey: mirrors, frames, ticks, energy.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/burr_rig.h"
#include "tests/support/loop_guard.h"

namespace kerf {
namespace {

using namespace literals;
using burring::BurrCutting;
using test::BurrFelt;
using test::LedBurr;

constexpr double radius = test::ball, depth = 1.0_mm, feed = 0.5_mm_per_s;

Body wide_block(double spacing = 0.25_mm) {
    return test::block({-8.0_mm, -8.0_mm, -7.0_mm}, {8.0_mm, 8.0_mm, 0}, spacing, {0.31, 0.17, 0.73});
}
/// The mean over a groove along (cos, sin) of `about`, begun in air.
BurrFelt along(const ToolSetup& setup, double about, double period = Simulation::dt, double lean = 0.0) {
    const Vec3 way{std::cos(about), std::sin(about), 0};
    LedBurr burr(wide_block(), setup, Vec3{0, 0, radius - depth} - 15.0_mm * way, lean, period, about);
    burr.to(Vec3{0, 0, radius - depth} - 1.0_mm * way, 10.0_mm_per_s);
    (void)burr.mean(feed * way, static_cast<int>(0.2 / period));
    return burr.mean(feed * way, static_cast<int>(0.4 / period));
}

// ---- mirrors and frames ---------------------------------------------------------------------------------------------

// Seen in the mirror the burr turns the other way: along and down it feels the same, across the opposite.
TEST(BurrSpin, MirrorsTheForceAcross) {
    const ToolSetup right = test::round_burr(), left = test::round_burr({{"spindle_speed", -50000.0_rpm}});
    for (const double lean : {0.0_deg, 30.0_deg}) {
        const BurrFelt one = along(right, 0.0, Simulation::dt, lean), other = along(left, 0.0, Simulation::dt, lean);
        const double size = length(linear(one.wrench));
        EXPECT_NEAR(other.wrench[0], one.wrench[0], 0.03 * size /* the points are not quite their own mirror */);
        EXPECT_NEAR(other.wrench[1], -one.wrench[1], 0.03 * size);
        EXPECT_NEAR(other.wrench[2], one.wrench[2], 0.03 * size);
        EXPECT_NEAR(other.wrench[5], -one.wrench[5], 0.03 * std::abs(one.wrench[5]));
    }
}

// A slot: the blades pass its front from right to left or from left to right, and push the burr the other way.
TEST(BurrSpin, PushesAsideAgainstTheBladesAtTheFront) {
    const BurrFelt felt = along(test::round_burr(), 0.0);
    EXPECT_GT(felt.wrench[1], 0.2 * length(linear(felt.wrench))) << "clockwise from above, the front goes to −y";
    EXPECT_GT(felt.wrench[5], 0.0) << "against the turn";
}

// Bone on one side only. Blades that meet it against the feed pull the burr on (climb), with it they hold it back.
TEST(BurrSpin, PullsOnInClimbAndHoldsBackInConventionalCutting) {
    const auto felt = [](double rpm) {
        // The side of a block that faces +y, and the burr's ball half in it, its shaft beside it
        LedBurr burr(test::block({-12.0_mm, -8.0_mm, -8.0_mm}, {12.0_mm, 0, 0}, 0.25_mm, {0.31, 0.17, 0.73}),
                     test::round_burr({{"spindle_speed", rpm * 1.0_rpm}}), {-15.0_mm, 1.2_mm, -4.0_mm});
        burr.to({0, 1.2_mm, -4.0_mm}, 10.0_mm_per_s);
        (void)burr.mean({feed, 0, 0}, 200);
        return burr.mean({feed, 0, 0}, 400).wrench;
    };
    const Vec6 climb = felt(50000.0), conventional = felt(-50000.0);
    EXPECT_GT(climb[0], conventional[0] + 0.5) << "N along the feed";
    EXPECT_LT(conventional[0], -0.3) << "held back";
    EXPECT_GT(climb[1], 0.0) << "bone pushes the burr out of itself";
    EXPECT_GT(conventional[1], 0.0);
}

TEST(BurrForce, TurnsWithTheScene) {
    const BurrFelt straight = along(test::round_burr(), 0.0);
    const double size = length(linear(straight.wrench));
    for (const double about : {60.0_deg, 90.0_deg, 135.0_deg, 210.0_deg}) {
        const BurrFelt turned = along(test::round_burr(), about);
        const Vec3 back = rotate(quat_from_rotation_vector({0, 0, -about}), linear(turned.wrench));
        EXPECT_LT(length(back - linear(straight.wrench)), 0.08 * size)
            << about << ": the sectors of the head stand elsewhere";
    }
}

TEST(BurrForce, IsTheSameInTicksOfAnyLength) {  // S-10
    const double at_1_ms = length(linear(along(test::round_burr(), 0.0).wrench));
    for (const double dt : {2e-3, 0.5e-3, 0.25e-3})
        EXPECT_NEAR(length(linear(along(test::round_burr(), 0.0, dt).wrench)) / at_1_ms, 1.0, 0.01) << dt;
}

TEST(BurrForce, HasNoBeatWithTheTicks) {  // S-13: 833 turns a second, of six blades each
    // Led along the same way at speeds a tenth of a percent apart, burrs feel the same in each tick.
    std::vector<std::vector<double>> force;
    for (const double rpm : {50000.0, 49950.0, 50050.0}) {
        LedBurr burr(wide_block(0.125_mm), test::round_burr({{"spindle_speed", rpm * 1.0_rpm}}),
                     {-11.0_mm, 0, radius - depth});
        burr.to({0, 0, radius - depth}, 10.0_mm_per_s);
        (void)burr.mean({feed, 0, 0}, 200);
        force.emplace_back();
        for (int i = 0; i < 500; ++i) force.back().push_back(length(linear(burr.go({feed, 0, 0}).bone_on_tool)));
    }
    for (const auto& other : {force[1], force[2]})
        for (std::size_t i = 0; i < other.size(); ++i) EXPECT_NEAR(other[i] / force[0][i], 1.0, 0.005) << i;
}

TEST(BurrForce, HardlyDependsOnTheSpacing) {
    const auto at = [](double h) {
        LedBurr burr(wide_block(h), test::round_burr(), {-11.0_mm, 0, radius - depth});
        burr.to({0, 0, radius - depth}, 10.0_mm_per_s);
        (void)burr.mean({feed, 0, 0}, 200);
        return length(linear(burr.mean({feed, 0, 0}, 400).wrench));
    };
    EXPECT_NEAR(at(0.5_mm) / at(0.25_mm), 1.0, 0.07);
    EXPECT_NEAR(at(0.25_mm) / at(0.125_mm), 1.0, 0.04);
}

// Twice the density, four times the strength [carter-hayes-1977].
TEST(BurrForce, FollowsTheStrengthOfTheBone) {
    const auto at = [](double density) {
        Body body = wide_block();
        body.materials = {{"bone", density, {}}};
        LedBurr burr(body, test::round_burr(), {-11.0_mm, 0, radius - depth});
        burr.to({0, 0, radius - depth}, 10.0_mm_per_s);
        return length(linear(burr.mean({feed, 0, 0}, 300).wrench));
    };
    EXPECT_NEAR(at(1850.0) / at(925.0), 4.0, 0.01);
}

// ---- energy (C.8, P8) -----------------------------------------------------------------------------------------------

// Edges switched off, each mm³ costs u at the motor, whichever part of the head takes it. The groove gets deeper on its
// way, so that no point of the head counts for more than its share.
/// Work of the motor for what the chips cost [–], without edges. 1 is right.
double work_for_chips(double points, double rpm) {
    constexpr double u = 934e6;
    const ToolSetup setup = test::round_burr({{"spindle_speed", rpm * 1.0_rpm},
                                              {"thrust_edge", 0.0},
                                              {"cutting_edge", 0.0},
                                              {"cutting_chip", u},
                                              {"motor_torque", 0.5},
                                              {"edge_points", points}});
    LedBurr burr(wide_block(0.125_mm), setup, {-6.0_mm, 0, radius + 0.1_mm});
    double work = 0.0;
    constexpr int ticks = 12000;  // 12 mm on and 2 mm down
    for (int i = 0; i < ticks; ++i) {
        const TickResult r = burr.go({1.0_mm_per_s, 0, -1.0_mm_per_s / 6.0});
        work += std::abs(r.torque) * 2.0 * pi * std::abs(rpm) * 1.0_rpm * burr.dt();
    }
    return work / (u * burr.removed());
}

TEST(BurrWork, OfTheMotorIsThatOfTheChips) {  // P8
    for (const double rpm : {50000.0, -50000.0}) {
        const double usual = work_for_chips(defaults_of<BurrCutting>().edge_points, rpm),
                     many = work_for_chips(336.0, rpm);
        EXPECT_NEAR(many, 1.0, 0.02) << rpm;
        EXPECT_LT(std::abs(many - 1.0), std::abs(usual - 1.0)) << "more points are nearer";
        EXPECT_NEAR(usual, 1.0, 0.035) << "as docs/models/burr.md has it";
    }
}

// With its edges, all that hand and motor put in is more than the chips cost; a burr may pull, but not for free.
TEST(BurrWork, OfHandAndMotorIsNeverLessThanThatOfTheChips) {
    const double chips = defaults_of<BurrCutting>().cutting_chip;
    for (const double rpm : {50000.0, -50000.0}) {
        LedBurr burr(test::block({-12.0_mm, -8.0_mm, -8.0_mm}, {12.0_mm, 0, 0}, 0.25_mm, {0.31, 0.17, 0.73}),
                     test::round_burr({{"spindle_speed", rpm * 1.0_rpm}}), {-15.0_mm, 1.2_mm, -4.0_mm});
        double by_hand = 0.0, by_motor = 0.0;
        const Vec3 velocity{2.0_mm_per_s, 0, 0};
        for (int i = 0; i < 8000; ++i) {
            const TickResult r = burr.go(velocity);
            by_hand -= dot(linear(r.bone_on_tool), velocity) * burr.dt();
            by_motor += signals_of<BurrCutting>(burr.simulation().signals()).drive_power * burr.dt();
        }
        const double volume = burr.removed();
        EXPECT_GT(volume, 1e-9) << "it cuts";
        EXPECT_GT(by_motor + by_hand, chips * volume) << rpm;
        EXPECT_LT(std::abs(by_hand), 0.05 * by_motor) << "the motor pays";
    }
}

// ---- in its groove, anywhere, in real time --------------------------------------------------------------------------

TEST(BurrInItsGroove, MeetsNothingOnTheWayBack) {  // S-12
    LedBurr burr(wide_block(), test::round_burr(), {-11.0_mm, 0, radius - depth});
    burr.to({0, 0, radius - depth}, 10.0_mm_per_s);
    double most = 0.0;
    const auto go = [&](Vec3 velocity, int ticks) {
        for (int i = 0; i < ticks; ++i) most = std::max(most, length(linear(burr.go(velocity).bone_on_tool)));
    };
    go({-10.0_mm_per_s, 0, 0}, 300);
    go({9.0_mm_per_s, 0, 0}, 300);
    go({0, 0, 10.0_mm_per_s}, 200);
    go({0, 0, -9.5_mm_per_s}, 200);
    EXPECT_LT(most, 0.05) << "N";
    EXPECT_GT(length(linear(burr.mean({1.0_mm_per_s, 0, -1.0_mm_per_s}, 800).wrench)), 1.0) << "but its end is there";
}

// The same way again, to the bit, lies in the wall that the first one left (scene 11, S-09).
TEST(BurrInItsGroove, TakesNothingASecondTime) {
    LedBurr burr(wide_block(), test::round_burr(), {-11.0_mm, 0, radius - depth});
    const auto pass = [&] {
        double most = 0.0;
        for (int i = 0; i < 2200; ++i)
            most = std::max(most, length(linear(burr.go({10.0_mm_per_s, 0, 0}).bone_on_tool)));
        return most;
    };
    EXPECT_GT(pass(), 1.0);
    const double removed = burr.removed();
    burr.to({11.0_mm, 0, 5.0_mm}, 20.0_mm_per_s);
    burr.to({-11.0_mm, 0, 5.0_mm}, 20.0_mm_per_s);
    burr.to({-11.0_mm, 0, radius - depth}, 20.0_mm_per_s);
    EXPECT_LT(pass(), 0.05) << "N";
    EXPECT_NEAR(burr.removed() / removed, 1.0, 1e-3);
}

// Slices of a micron to a tenth of a millimetre, one below the other (scene 11, S-08): in the end a groove of that
// depth.
TEST(BurrThatGrazes, AddsUpToTheGrooveOfItsDepth) {
    constexpr double h = 0.2_mm;
    LedBurr burr(test::block({0, -6.0_mm, -5.0_mm}, {8.0_mm, 6.0_mm, 0}, h, {0.31, 0.17, 0.73}), test::round_burr(),
                 {-3.0_mm, 0, radius});
    double deep = 0.0, way = 1.0;
    for (const double slice : {1.0_um, 3.0_um, 10.0_um, 30.0_um, 100.0_um, 1.0_um, 100.0_um, 100.0_um, 55.0_um}) {
        deep += slice;
        burr.to({burr.centre().x, 0, radius - deep}, 20.0_mm_per_s);
        for (int i = 0; i < 1400; ++i) {
            const TickResult r = burr.go({way * 10.0_mm_per_s, 0, 0});
            for (const double w : r.bone_on_tool) ASSERT_TRUE(std::isfinite(w)) << slice;
        }
        way = -way;
    }
    const double area = radius * radius * std::acos((radius - deep) / radius) -
                        (radius - deep) * std::sqrt(2.0 * radius * deep - deep * deep);
    EXPECT_NEAR(burr.removed() / (8.0_mm * area), 1.0, 0.02) << "0.4 mm deep, two voxels";
}

TEST(BurrLaw, IsSoundAnywhere) {
    for (const char* tool : {"round_burr", "cylindrical_burr", "pear_burr"})
        for (const double rpm : {0.0, 900.0, 1100.0, 50000.0, -50000.0}) {
            test::Rig rig(wide_block(0.5_mm), test::burr_of(tool, {{"spindle_speed", rpm * 1.0_rpm}}),
                          test::at_depth(-1.0_mm));
            for (int i = 0; i < 2000; ++i) {
                const double t = 1e-3 * i;
                Pose pose = test::at_depth(4.0_mm * std::sin(3.0 * t), 0.6 * std::sin(5.0 * t),
                                           {5.0_mm * std::sin(7.0 * t), 4.0_mm * std::sin(2.0 * t), 0});
                pose.rotation = pose.rotation * quat_from_rotation_vector({0.4 * std::sin(4.0 * t), 0, std::sin(t)});
                const TickResult r = rig.tick({pose});
                ASSERT_FALSE(r.is_quarantined) << tool << " " << rpm << " at tick " << i;
                for (const double w : r.bone_on_tool) ASSERT_TRUE(std::isfinite(w));
            }
        }
}

TEST(BurrLaw, NeitherAllocatesNorLocksNorThrows) {
    const ToolSetup setup = test::round_burr();
    const Body body = wide_block();
    HapticLoop haptic{body, setup, test::outline(setup), test::gains(), test::at_depth(-1.0_mm)};
    double cut = 0.0;
    for (int i = 0; i < 2500; ++i) {
        if (i == 1800) haptic.command_drive(0, 0.0);
        const Pose pose = test::at_depth(std::min<double>(-1.0_mm + i * 2.0_um, 1.5_mm), 0.0,
                                         {std::max(0.0, i - 1000.0) * 3.0_um, 0, 0});
        const test::Forbidden before = test::forbidden_here();
        const TickResult result = haptic.tick({pose});
        ASSERT_EQ(test::forbidden_here(), before) << "tick " << i;
        cut = std::max(cut, result.thrust);
        haptic.make_room();
    }
    EXPECT_GT(cut, 0.5) << "it cut";
}

}  // namespace
}  // namespace kerf
