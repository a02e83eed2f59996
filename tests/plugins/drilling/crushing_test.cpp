// SPDX-License-Identifier: Apache-2.0
// A drill that does not turn, or an awl: pushed harder than bone bears it goes in, and else it stands.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>

#include "plugins/drilling/drill_force.h"
#include "tests/support/drill_rig.h"

namespace kerf {
namespace {

using namespace literals;

constexpr double spongy = 300.0;  // [kg/m³]

/// 68 MPa (ρ / 1 g/cm³)² over the cross-section, and what rubs on the cone, with 118° and μ = 0.3 [N].
double closed_form(double density, double diameter) {
    const double strength = 68e6 * std::pow(1e-3 * density, 2), area = 0.25 * pi * diameter * diameter;
    return strength * area * (1.0 + 0.3 / std::tan(59.0_deg));
}

/// A still drill on the face of a block.
struct Rig {
    Body body;
    ToolSetup setup;
    Simulation simulation;
    double tick;  ///< [s]
    int begun = 0;

    explicit Rig(double density = spongy, double spacing = 0.25_mm, const std::map<std::string, double>& set = {},
                 const std::string& tool = "twist_drill", Pose start = test::at_depth(-0.1_mm),
                 double period = Simulation::dt, double half_width = 6.0_mm)
        : body(made_of(density, spacing, half_width)),
          setup(test::drill(tool, with_still_spindle(set))),
          simulation(body, setup, test::outline(setup), test::gains(0.005), start, period),
          tick(period) {}

    static std::map<std::string, double> with_still_spindle(std::map<std::string, double> set) {
        set["spindle_speed"] = 0.0;
        return set;
    }
    static Body made_of(double density, double spacing, double half_width) {
        Body body =
            test::block({-half_width, -half_width, -20.0_mm}, {half_width, half_width, 0}, spacing, {0.31, 0.17, 0.73});
        body.materials = {{"bone", density, {}}};
        return body;
    }
    [[nodiscard]] double depth() const { return -simulation.world_from_tool().position.z; }
    TickResult move_with_tip(const Pose& hand) {
        const TickResult r = simulation.tick({hand});
        for (std::size_t i = 0; i < r.event_count; ++i) begun += std::string(r.events[i]) == "drilling.crushing";
        return r;
    }
    TickResult go_direct(const Pose& tool) {
        const TickResult r = simulation.tick_direct({tool});
        return r;
    }
    /// With a hand that pushes so hard wherever the drill is.
    TickResult push(double force) {
        const CouplingGains g = test::gains(0.005);
        return move_with_tip(test::at_depth(depth() + force * g.force_scale / g.stiffness));
    }
    /// With a hand that goes on at `rate`; the mean thrust while the tip is between two depths.
    double thrust_between(double from, double to, double rate) {
        double sum = 0.0, most = 0.0;
        int count = 0;
        for (double hand = depth(); depth() < to && hand < 60.0_mm; hand += rate * tick) {
            const double thrust = move_with_tip(test::at_depth(hand)).thrust;
            if (depth() < from) continue;
            sum += thrust;
            most = std::max(most, thrust);
            ++count;
        }
        EXPECT_LT(most, 1.05 * sum / count) << "it goes evenly";
        return sum / count;
    }
};

/// Straight down at `x`, its tip at `depth`.
Pose at(double x, double depth) { return test::at_depth(depth, 0.0, {x, 0, 0}); }

TEST(Crushing, ItsForceIsTheClosedFormOnEveryGrid) {
    for (const double spacing : {0.5_mm, 0.25_mm})
        for (const double density : {200.0, 400.0}) {
            Rig rig(density, spacing);
            EXPECT_NEAR(rig.thrust_between(5.0_mm, 8.0_mm, 2.0_mm_per_s) / closed_form(density, 3.2_mm), 1.0, 0.02)
                << density << ", " << spacing;
        }
}

TEST(Crushing, ItIsTheSameAtEveryRate) {
    Rig slow, fast;
    const double at_one = slow.thrust_between(4.0_mm, 6.0_mm, 1.0_mm_per_s),
                 at_eight = fast.thrust_between(4.0_mm, 6.0_mm, 8.0_mm_per_s);
    EXPECT_NEAR(at_eight / at_one, 1.0, 0.01);
}

TEST(Crushing, ItIsTheSameAtEveryLoopRate) {
    const auto thrust_at = [](double period) {
        return Rig(spongy, 0.25_mm, {}, "twist_drill", test::at_depth(-0.1_mm), period)
            .thrust_between(4.0_mm, 6.0_mm, 2.0_mm_per_s);
    };
    const double slow = thrust_at(2e-3), fast = thrust_at(0.25e-3);
    EXPECT_NEAR(slow / fast, 1.0, 0.01);
}

TEST(Crushing, ItIsTheSameSeenInAMirror) {
    const auto aside = [](double side) {
        Rig rig(spongy, 0.25_mm, {}, "twist_drill", at(side * 5.5_mm, -0.1_mm));
        for (double hand = -0.1_mm; rig.depth() < 4.0_mm && hand < 60.0_mm; hand += 4.0_um)
            (void)rig.move_with_tip(at(side * 5.5_mm, hand));
        return rig.simulation.world_from_tool().position.x - side * 5.5_mm;
    };
    const double right = aside(1.0), left = aside(-1.0);  // it stands half on the edge of the block
    EXPECT_GT(right, 5.0_um) << "which it slides off";
    EXPECT_NEAR(left, -right, 0.1 * right);
}

TEST(Crushing, WhatBoneBearsItStandsOn) {
    Rig rig;
    const double breaking_load = closed_form(spongy, 3.2_mm);  // 58 N
    for (int i = 0; i < 4000 && rig.depth() < 4.0_mm; ++i) (void)rig.push(1.2 * breaking_load);
    ASSERT_GT(rig.depth(), 4.0_mm) << "pushed harder it goes in";
    for (const double share : {0.7, 0.95}) {
        for (int i = 0; i < 500; ++i) (void)rig.push(share * breaking_load);
        const double stands = rig.depth();
        TickResult r;
        for (int i = 0; i < 2000; ++i) r = rig.push(share * breaking_load);
        EXPECT_NEAR(rig.depth(), stands, 7.0_um) << share << ", in two seconds";
        EXPECT_NEAR(r.thrust, share * breaking_load, 0.5);
    }
    const double stands = rig.depth();
    for (int i = 0; i < 500; ++i) (void)rig.move_with_tip(test::at_depth(stands));
    EXPECT_FALSE(rig.move_with_tip(test::at_depth(stands)).is_cutting) << "let go";
    for (int i = 0; i < 2000; ++i) (void)rig.push(std::min(0.8, 0.001 * i) * breaking_load);
    EXPECT_NEAR(rig.depth(), stands, 40.0_um) << "the spring of contact";
    EXPECT_EQ(rig.begun, 1);
}

TEST(Crushing, CortexIsPrickedAsDeepAsItBears) {
    Rig rig(1850.0);
    for (int i = 0; i < 4000; ++i) (void)rig.push(std::min(200.0, 0.1 * i));
    const double pricked = rig.depth(), tangent = std::tan(59.0_deg);
    const double strength = 68e6 * 1.85 * 1.85 * (1.0 + 0.3 / tangent);
    EXPECT_NEAR(pricked, std::sqrt(200.0 / (pi * strength)) / tangent, 0.03_mm);  // 0.29 mm
    for (int i = 0; i < 3000; ++i) (void)rig.push(200.0);
    EXPECT_NEAR(rig.depth(), pricked, 10.0_um);
}

// Whatever it stands with, crushing that begins because its spring gave too far must not end at once and let it go on
// by that much.
TEST(Crushing, WideTipsAndSoftSpringsStandInCortexAsWell) {
    struct Case {
        double diameter, stiffness, push;
    };
    for (const Case& one : {Case{5.0_mm, 500e3, 400.0}, Case{10.0_mm, 500e3, 400.0}, Case{3.2_mm, 50e3, 150.0},
                            Case{3.2_mm, 200e3, 150.0}}) {
        Rig rig(1850.0, 0.25_mm,
                {{"diameter", one.diameter}, {"contact_stiffness", one.stiffness}, {"motor_torque", 20.0}});
        rig.simulation.command_drive(drilling::spindle_drive, 1000.0_rpm);
        for (double depth = -0.1_mm; depth < 5.0_mm; depth += 2.0_um) (void)rig.go_direct(test::at_depth(depth));
        rig.simulation.command_drive(drilling::spindle_drive, 0.0);
        for (int i = 0; i < 300; ++i) (void)rig.move_with_tip(test::at_depth(5.0_mm));
        const double stands = rig.depth();
        rig.begun = 0;
        for (int i = 0; i < 4000; ++i) (void)rig.push(std::min(one.push, 0.5 * i));
        EXPECT_NEAR(rig.depth(), stands, 0.25_mm) << one.diameter << ", " << one.stiffness;
        EXPECT_LE(rig.begun, 2) << one.diameter << ", " << one.stiffness;
    }
}

TEST(Crushing, ATipThatRunsOffCrushesWhatItsTurningShapeRemoves) {
    for (const double runout : {0.05_mm, 0.3_mm}) {
        Rig rig(spongy, 0.25_mm, {{"runout", runout}});
        const double wider = 3.2_mm + 2.0 * runout;
        EXPECT_NEAR(rig.thrust_between(4.0_mm, 7.0_mm, 2.0_mm_per_s) / closed_form(spongy, wider), 1.0, 0.03) << runout;
        EXPECT_EQ(rig.begun, 1) << runout;
    }
}

TEST(Crushing, SidewaysItTakesWhatTheAreaItShowsBears) {
    // Deep in bone and moved aside as it goes on: cone and land, and all of a straight part before a shoulder
    const double strength = 68e6 * 0.3 * 0.3, point = 1.6_mm / std::tan(59.0_deg);
    const auto aside = [](const std::string& tool, const std::map<std::string, double>& set) {
        Rig rig(spongy, 0.25_mm, set, tool);
        double depth = -0.1_mm;
        for (; depth < 10.0_mm; depth += 4.0_um) (void)rig.go_direct(test::at_depth(depth));
        TickResult r;
        for (int i = 0; i < 300; ++i) r = rig.go_direct(test::at_depth(depth += 0.1_um, 0.0, {1.0_um * i, 0, 0}));
        double crushed = 0.0;
        for (const kerf_channel& c : test::law_now(rig.simulation))
            if (c.kind == KERF_CUT && c.d[2] == 0.0) crushed = std::max(crushed, c.tau);
        return crushed;
    };
    const double land = 0.25 * 3.2_mm;
    EXPECT_NEAR(aside("twist_drill", {}) / (strength * (1.6_mm * point + 3.2_mm * land)), 1.0, 0.08);
    const double straight = 6.0_mm - point;
    EXPECT_NEAR(aside("profile_drill",
                      {{"depth_1", 6.0_mm}, {"diameter_1", 3.2_mm}, {"depth_2", 6.5_mm}, {"diameter_2", 4.2_mm}}) /
                    (strength * (1.6_mm * point + 3.2_mm * straight + 0.5_mm * 3.7_mm + 4.2_mm * land)),
                1.0, 0.08);
}

// Before anything is crushed its point sticks to a slope that is less steep than friction's angle, and slides down a
// steeper one.
TEST(StillTip, SticksToASlopeByFriction) {
    const auto slides = [](double friction) {
        Rig rig(1850.0, 0.25_mm, {{"friction", friction}}, "twist_drill", test::at_depth(-1.0_mm, 20.0_deg));
        double from = 0.0;
        for (double hand = -1.0_mm; hand < 4.0_mm; hand += 2.0_um) {
            const TickResult r = rig.move_with_tip(test::at_depth(hand, 20.0_deg));
            if (from == 0.0 && r.thrust > 1.0) from = rig.simulation.world_from_tool().position.x;
        }
        return std::abs(rig.simulation.world_from_tool().position.x - from);
    };
    EXPECT_LT(slides(1.0), 0.3 * slides(0.0));
}

TEST(Crushing, TurningAgainItCutsAndInReverseItCrushesAsItStood) {
    Rig rig;
    (void)rig.thrust_between(2.0_mm, 4.0_mm, 2.0_mm_per_s);
    rig.simulation.command_drive(drilling::spindle_drive, 1000.0_rpm);
    double hand = rig.depth(), last = 0.0, thrust = 0.0;
    for (int i = 0; i < 2000 && rig.depth() < 6.0_mm; ++i) {
        const CouplingGains g = test::gains(0.005);
        hand = rig.depth() + 5.0 * g.force_scale / g.stiffness;
        thrust = rig.move_with_tip(test::at_depth(hand)).thrust;
        last = signals_of<drilling::DrillCutting>(rig.simulation.signals()).spindle_speed;
    }
    EXPECT_NEAR(last, 1000.0_rpm, 1e-9);
    EXPECT_GE(rig.depth(), 6.0_mm) << "with 5 N, cutting";
    EXPECT_LT(thrust, 8.0);
    rig.simulation.command_drive(drilling::spindle_drive, -1000.0_rpm);
    for (int i = 0; i < 500; ++i) (void)rig.push(5.0);
    const double stands = rig.depth();
    for (int i = 0; i < 1000; ++i) (void)rig.push(5.0);
    EXPECT_NEAR(rig.depth(), stands, 2.0_um) << "it takes no bone by turning";
    EXPECT_NEAR(rig.thrust_between(stands + 0.5_mm, stands + 2.0_mm, 2.0_mm_per_s) / closed_form(spongy, 3.2_mm), 1.0,
                0.03);
}

TEST(Crushing, LeavesTheHoleItIsShapedLike) {
    Rig rig;
    (void)rig.thrust_between(1.0_mm, 6.0_mm, 2.0_mm_per_s);
    rig.simulation.finish();
    const double radius = 1.6_mm, point = radius / std::tan(59.0_deg), depth = rig.depth();
    const double hole = pi * radius * radius * (depth - point) + pi * radius * radius * point / 3.0;
    EXPECT_NEAR(rig.simulation.present().removed() / hole, 1.0, 0.03);
    EXPECT_EQ(rig.begun, 1) << "told once";
}

TEST(Crushing, NothingPushesItOutAgain) {
    Rig rig;
    (void)rig.thrust_between(1.0_mm, 5.0_mm, 2.0_mm_per_s);
    const double deep = rig.depth();
    double pushed_back = 0.0;
    for (int i = 0; i < 1000; ++i) (void)rig.move_with_tip(test::at_depth(deep));
    EXPECT_NEAR(rig.depth(), deep, 20.0_um);
    for (int i = 0; i < 1000; ++i)
        pushed_back = std::max(pushed_back, rig.move_with_tip(test::at_depth(deep - 1.0_um * i)).thrust);
    EXPECT_LT(pushed_back, 0.1) << "N, on the way out";
}

TEST(Crushing, BoneHoldsItSidewaysAsWell) {
    Rig rig;
    const double breaking_load = closed_form(spongy, 3.2_mm);
    double aside = 0.0;
    for (int i = 0; i < 3000 && rig.depth() < 4.0_mm; ++i) {
        const CouplingGains g = test::gains(0.005);
        Pose hand = test::at_depth(rig.depth() + 1.2 * breaking_load * g.force_scale / g.stiffness);
        hand.position.x = rig.simulation.world_from_tool().position.x + 5.0 * g.force_scale / g.stiffness;
        (void)rig.move_with_tip(hand);
        aside = rig.simulation.world_from_tool().position.x;
    }
    ASSERT_GT(rig.depth(), 4.0_mm);
    EXPECT_LT(aside, 0.2_mm);
}

TEST(Crushing, AnAwlsForceIsTheClosedFormOfItsCones) {
    // In a block so wide that nothing breaks out of its sides. A point of 60° to 1 mm, from there on a slender cone to
    // 4 mm, 12 mm behind the tip: most of what it takes is friction.
    for (const double spacing : {0.5_mm, 0.25_mm}) {
        Rig rig(200.0, spacing,
                {{"diameter", 1.0_mm}, {"point_angle", 60.0_deg}, {"depth_1", 12.0_mm}, {"diameter_1", 4.0_mm}},
                "profile_drill", test::at_depth(-0.1_mm), Simulation::dt, 12.0_mm);
        const double strength = 68e6 * 0.2 * 0.2, point = 0.5_mm / std::tan(30.0_deg),
                     slope = 1.5_mm / (12.0_mm - point);
        double hand = -0.1_mm;
        for (const double depth : {4.0_mm, 7.0_mm, 10.0_mm}) {
            TickResult r;
            for (; rig.depth() < depth && hand < 60.0_mm; hand += 2.0_um) r = rig.move_with_tip(test::at_depth(hand));
            const double radius = 0.5_mm + slope * (depth - point), of_point = pi * 0.25_mm * 1.0_mm;
            const double force = strength * (of_point * (1.0 + 0.3 / std::tan(30.0_deg)) +
                                             (pi * radius * radius - of_point) * (1.0 + 0.3 / slope));
            EXPECT_NEAR(r.thrust / force, 1.0, 0.06) << depth << ", " << spacing;
        }
    }
}

TEST(Crushing, ASlopeIsCrushedEvenly) {
    // 25° askew, under a hand that leans on it more and more
    Rig rig(spongy, 0.25_mm, {}, "twist_drill", test::at_depth(-1.0_mm, 25.0_deg));
    double last = 0.0, step = 0.0, thrust = 0.0;
    for (double hand = -1.0_mm; rig.depth() < 4.0_mm && hand < 60.0_mm; hand += 4.0_um) {
        thrust = rig.move_with_tip(test::at_depth(hand, 25.0_deg)).thrust;
        step = std::max(step, std::abs(thrust - last));
        last = thrust;
    }
    EXPECT_NEAR(thrust / closed_form(spongy, 3.2_mm), 1.0, 0.05);
    EXPECT_LT(step, 0.05 * closed_form(spongy, 3.2_mm)) << "N from tick to tick";
}

// (It went in by up to a millimetre and was then thrown up, by 24 um a tick: contact gives as far as it is pushed.)
TEST(Crushing, AStillConePressedAgainstTheEdgeOfABoneIsNotThrownUp) {
    for (const double density : {spongy, 1850.0}) {
        Rig rig(density, 0.25_mm, {}, "twist_drill", at(-8.0_mm, 0.6_mm));
        double up = 0.0, last = rig.depth();
        for (int i = 0; i < 6000; ++i) {
            (void)rig.move_with_tip(at(-8.0_mm + 1.0_um * i, 0.6_mm));  // its corner stays above the face
            up = std::max(up, last - rig.depth());
            last = rig.depth();
        }
        EXPECT_GE(rig.begun, 1) << "it touched, " << density;
        EXPECT_LT(up, 10.0_um) << "a tick, " << density;
    }
}

TEST(Crushing, SwitchedOffUnderAPushInSpongyBoneItSinksIn) {
    Rig rig(spongy, 0.25_mm, {{"run_up", 0.1}});
    rig.simulation.command_drive(drilling::spindle_drive, 1000.0_rpm);
    for (int i = 0; i < 6000 && rig.depth() < 4.0_mm; ++i) (void)rig.push(4.0);
    ASSERT_GT(rig.depth(), 4.0_mm);
    rig.simulation.command_drive(drilling::spindle_drive, 0.0);
    for (int i = 0; i < 1000; ++i) (void)rig.push(20.0);
    const double stands = rig.depth();
    for (int i = 0; i < 500; ++i) (void)rig.push(20.0);
    EXPECT_NEAR(rig.depth(), stands, 1.0_um);
    for (int i = 0; i < 3000 && rig.depth() < stands + 1.0_mm; ++i) (void)rig.push(1.1 * closed_form(spongy, 3.2_mm));
    EXPECT_GE(rig.depth(), stands + 1.0_mm);
}

}  // namespace
}  // namespace kerf
