// SPDX-License-Identifier: Apache-2.0
// A drill that goes sideways: what it takes it feels, by the same law as along its shaft; what it does not take holds
// it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/drill_rig.h"
#include "tests/support/rig.h"

namespace kerf {
namespace {

using namespace literals;

// Over a turn the lips pass each azimuth at which the land moves into bone, and push back along the motion with cos θ
// of their force:
//
//     F = (2 / 2π) ∫ cos θ (K_e (1 − e^(−t/t_e)) + K_c t) dθ b,    t = s cos θ / (2 n),    −π/2 … π/2
//
// of which the law has three azimuths, ±45° apart. Of its length [N/m], at `rate` [m/s].
double of_land(double rate) {
    const double turns = 1000.0 / 60.0, edge = 27.163e3, edge_depth = 4.0_um,
                 chip = 284.77e6;  // as calibrated: docs/models/drilling.md
    double sum = 0.0;
    for (const double facing : {1.0, std::sqrt(0.5), std::sqrt(0.5)}) {
        const double t = rate * facing / (2.0 * turns);
        sum += 2.0 / 8.0 * facing * (edge * (1.0 - std::exp(-t / edge_depth)) + chip * t);
    }
    return sum;
}

/// What a drill resists that stands 6 mm deep, drawn back by `withdrawn` from where it drilled to, and goes sideways at
/// `rate` [N].
struct Pushed {
    double along = 0.0, across = 0.0, torque = 0.0;  // [N], [N], [N·m]
};
Pushed pushed_sideways(const ToolSetup& setup, double spacing, double rate, double withdrawn, double settling = 0.0) {
    test::Rig simulation(test::block({-6.0_mm, -6.0_mm, -14.0_mm}, {8.0_mm, 6.0_mm, 0}, spacing, {0.31, 0.17, 0.73}),
                         setup, test::at_depth(-0.5_mm));
    const auto move_with_tip = [&](const Pose& pose) {
        const TickResult r = simulation.tick_direct({pose});
        return r.bone_on_tool;
    };
    constexpr double stands = 6.0_mm;
    for (double depth = -0.5_mm; depth < stands + withdrawn; depth += 2.0_um)
        (void)move_with_tip(test::at_depth(depth));
    for (double back = withdrawn; back > 0.0; back -= 2.0_um) (void)move_with_tip(test::at_depth(stands + back));
    Vec6 sum{};
    int count = 0;
    const double from = 0.3_mm + settling * rate;
    for (double aside = 0.0; aside < from + 0.5_mm; aside += rate * Simulation::dt) {
        const Vec6 felt = move_with_tip(test::at_depth(stands, 0.0, {aside, 0, 0}));
        if (aside < from) continue;
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += felt[i];
        ++count;
    }
    return {-sum[0] / count, sum[1] / count, std::abs(sum[5] / count)};
}
double pushed(const ToolSetup& setup, double spacing, double rate, double withdrawn) {
    return pushed_sideways(setup, spacing, rate, withdrawn).along;
}

// At the front, and drawn back from it. (There it took for nothing what it took.)
TEST(Sideways, ALandIsResistedByItsLength) {
    const auto drill = [](double corner) {
        ToolSetup setup =
            test::drill("twist_drill", {{"diameter", 3.2_mm},
                                        {"corner", corner},
                                        {"motor_torque", 20.0},
                                        {"contact_stiffness", 1.0_N_per_mm}});  // the shank carries nothing
        return setup;
    };
    for (const double spacing : {0.5_mm, 0.25_mm})
        for (const double rate : {1.0_mm_per_s, 10.0_mm_per_s})
            for (const double withdrawn : {0.0_mm, 0.5_mm, 2.0_mm}) {
                const double more =
                    pushed(drill(1.0), spacing, rate, withdrawn) - pushed(drill(0.25), spacing, rate, withdrawn);
                EXPECT_NEAR(more / (0.75 * 3.2_mm * of_land(rate)), 1.0, 0.03)
                    << spacing << ", " << rate << ", " << withdrawn;
            }
}

// At each azimuth of the half turn that goes into bone a lip takes t = s cos θ/(2 n), and a metre of land
//
//     G = (2/2π) ∫ cos θ f dθ,   M = (2/2π) ∫ r f dθ,   f = K_ce (1 − e^(−t/t_e)) + K_cc t
//
// resists by these, summed here in a thousand steps. 6 mm of it: 127 N along, 145 N across and 313 N·mm at 1 mm/s.
TEST(Sideways, ALandIsPulledAcrossAndTakesTorque) {
    const double turns = 1000.0 / 60.0, edge = 16.203e3, edge_depth = 4.0_um, chip = 933.65e6, r = 1.6_mm;
    const auto drill = [](double corner) {
        return test::twist_drill(
            {{"diameter", 3.2_mm}, {"corner", corner}, {"motor_torque", 20.0}, {"contact_stiffness", 1.0_N_per_mm}});
    };
    for (const double rate : {1.0_mm_per_s, 3.0_mm_per_s}) {
        double across = 0.0, torque = 0.0;
        constexpr int steps = 1000;
        for (int i = 0; i < steps; ++i) {
            const double angle = pi * ((i + 0.5) / steps - 0.5), t = rate * std::cos(angle) / (2.0 * turns);
            const double f = edge * (1.0 - std::exp(-t / edge_depth)) + chip * t;
            across += std::cos(angle) * f / steps;
            torque += r * f / steps;
        }
        const double land = 0.75 * 3.2_mm;
        constexpr double turn_after_turn = 0.8_s;  // until it knows that it goes sideways, and does not run out
        const Pushed longer = pushed_sideways(drill(1.0), 0.25_mm, rate, 0.0, turn_after_turn),
                     shorter = pushed_sideways(drill(0.25), 0.25_mm, rate, 0.0, turn_after_turn);
        EXPECT_NEAR((longer.torque - shorter.torque) / (land * torque), 1.0, 0.03) << rate;
        EXPECT_NEAR(std::abs(longer.across - shorter.across) / (land * across), 1.0, 0.03) << rate;
    }
}

// P8, by an account that asks the law nothing: a chip costs K_cc for each mm³, whichever way the drill goes. Edges and
// thrust are switched off, so the motor pays for all of it; the volume is the field's, counted from the voxels.
TEST(Work, OfTheMotorIsThatOfTheChipsAlongTheAxisAskewAndSideways) {
    const double chip = 933.65e6, turns = 1000.0_rpm;
    const ToolSetup setup = test::twist_drill({{"diameter", 3.2_mm},
                                               {"corner", 1.0},
                                               {"cutting_edge", 0.0},
                                               {"cutting_chip", chip},
                                               {"chisel_edge", 0.0},
                                               {"chisel_chip", 0.0},
                                               {"thrust_edge", 0.0},
                                               {"thrust_chip", 1.0_N_per_mm2 /* next to nothing */},
                                               {"web", 0.05},
                                               {"motor_torque", 20.0},
                                               {"contact_stiffness", 1.0_N_per_mm}});
    for (const double tilt : {0.0_deg, 14.0_deg}) {
        test::Rig simulation(test::block({-6.0_mm, -6.0_mm, -14.0_mm}, {8.0_mm, 6.0_mm, 0}, 0.2_mm, {0.31, 0.17, 0.73}),
                             setup, test::at_depth(-1.5_mm, tilt));
        double work = 0.0, removed = 0.0;
        const auto move_with_tip = [&](const Pose& pose) {
            const TickResult r = simulation.tick_direct({pose});
            work += std::abs(r.torque) * 2.0 * pi * turns * Simulation::dt;
        };
        const auto account = [&] {
            simulation.finish();
            const double taken = simulation.present().removed() - removed;
            const double ratio = work / (chip * taken);
            removed += taken;
            work = 0.0;
            return ratio;
        };
        for (double depth = -1.5_mm; depth < 5.0_mm; depth += 2.0_um) move_with_tip(test::at_depth(depth, tilt));
        EXPECT_NEAR(account(), 1.0, 0.02) << "in, at " << tilt;
        if (tilt != 0.0) continue;
        for (double aside = 0.0; aside < 1.0_mm; aside += 1.0_um)
            move_with_tip(test::at_depth(5.0_mm, 0.0, {aside, 0, 0}));
        EXPECT_NEAR(account(), 1.0, 0.05) << "sideways";
    }
}

// (Of a pilot, only what lies a land's length behind its corner cost anything.) The shank behind the shoulder stands
// out of the bone: it would bend.
TEST(Sideways, SoIsAPilotByItsOwn) {
    const auto drill = [](double shoulder) {
        return test::step_drill({{"diameter", 3.2_mm},
                                 {"shoulder_diameter", 4.5_mm},
                                 {"shoulder_depth", shoulder},
                                 {"motor_torque", 20.0}});
    };
    for (const double spacing : {0.5_mm, 0.25_mm})
        for (const double withdrawn : {0.0_mm, 0.5_mm}) {
            const double rate = 1.0_mm_per_s, more = pushed(drill(4.5_mm), spacing, rate, withdrawn) -
                                                     pushed(drill(3.5_mm), spacing, rate, withdrawn);
            EXPECT_NEAR(more / (1.0_mm * of_land(rate)), 1.0, 0.03) << spacing << ", " << withdrawn;
        }
}

// The bit bends, the bone holds its shank. (Only what was behind the land touched: 2.5 mm deep it went through for
// nothing.)
TEST(Sideways, AStillDrillIsHeldByTheSideOfABone) {
    for (const double depth : {2.5_mm, 4.0_mm})
        for (const double spacing : {0.25_mm, 0.125_mm}) {
            const auto beside = [&](double aside) { return test::at_depth(depth, 0.0, {aside - 1.6_mm, 0, 0}); };
            test::Rig simulation(test::block({0, -6.0_mm, -12.0_mm}, {10.0_mm, 6.0_mm, 0}, spacing, {0.31, 0.17, 0.73}),
                                 test::twist_drill({{"diameter", 3.2_mm}, {"spindle_speed", 0.0}}), beside(-1.0_mm));
            double force = 0.0, largest_step = 0.0;
            for (double aside = -1.0_mm; aside < 2.0_mm; aside += 5.0_um) {
                const double now = -simulation.tick({beside(aside)}).bone_on_tool[0];
                largest_step = std::max(largest_step, std::abs(now - force));
                force = now;
            }
            EXPECT_GT(force, 3.0) << "N, " << depth << ", " << spacing;
            EXPECT_LT(largest_step, 0.5) << "N, " << depth << ", " << spacing;
        }
}

// All of its shank is held by a plate that it has gone through, not only what is near its tip.
TEST(Sideways, APlateHoldsAllOfTheShank) {
    const Body body = test::block({-8.0_mm, -8.0_mm, -4.0_mm}, {8.0_mm, 8.0_mm, 0}, 0.25_mm, {0.31, 0.17, 0.73});
    for (const double deep : {10.0_mm, 35.0_mm, 60.0_mm}) {
        test::Rig simulation(body, test::twist_drill({{"diameter", 3.2_mm}, {"motor_torque", 20.0}}),
                             test::at_depth(-0.2_mm));
        for (double depth = -0.2_mm; depth < deep; depth += depth < 6.0_mm ? 5.0_um : 50.0_um)
            (void)simulation.tick_direct({test::at_depth(depth)});
        TickResult r;
        for (double aside = 0.0; aside < 2.0_mm; aside += 2.0_um) {
            r = simulation.tick({test::at_depth(deep, 0.0, {aside, 0, 0})});
        }
        EXPECT_LT(r.bone_on_tool[0], -1.0) << "N, " << deep;
        EXPECT_LT(simulation.world_from_tool().position.x, 1.5_mm) << deep;
    }
}

// A hand that gives way lets a drill centre itself where its tip runs off: bone costs what it costs without. (It cost a
// hundredth, when the lips did not see that they had been moved aside.)
TEST(Runout, AFreeDrillPaysForItsHole) {
    struct Cost {
        double thrust = 0.0, torque = 0.0;
    };
    const auto drilled = [](double runout, double density, double spacing) {
        Body body = test::block({-5.0_mm, -5.0_mm, -9.0_mm}, {5.0_mm, 5.0_mm, 0}, spacing, {0.31, 0.17, 0.73});
        body.materials = {{"bone", density, {}}};
        test::Rig simulation(body, test::twist_drill({{"diameter", 3.2_mm}, {"runout", runout}}),
                             test::at_depth(-0.1_mm));
        Cost sum;
        int count = 0;
        for (double hand = -0.1_mm; hand < 6.0_mm; hand += 1.5_um) {
            const TickResult r = simulation.tick({test::at_depth(hand)});
            if (-simulation.world_from_tool().position.z < 2.0_mm) continue;
            sum.thrust += r.thrust;
            sum.torque += r.torque;
            ++count;
        }
        return Cost{sum.thrust / count, sum.torque / count};
    };
    for (const double density : {500.0, 1850.0})
        for (const double spacing : {0.5_mm, 0.25_mm}) {
            const Cost without = drilled(0.0, density, spacing);
            for (const double runout : {5.0_um, 50.0_um}) {
                const Cost with = drilled(runout, density, spacing);
                EXPECT_NEAR(with.thrust / without.thrust, 1.0, 0.03) << runout << ", " << density << ", " << spacing;
                EXPECT_NEAR(with.torque / without.torque, 1.0, 0.08) << runout << ", " << density << ", " << spacing;
            }
        }
}

}  // namespace
}  // namespace kerf
