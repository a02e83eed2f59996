// SPDX-License-Identifier: Apache-2.0
// The drill fed through bone at a prescribed rate (`coupling: direct`), against exact forces and published ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "tests/support/layered_slab.h"
#include "tests/support/rig.h"

namespace kerf {
namespace {

using namespace literals;

struct Felt {
    double depth, thrust, torque, lateral;
};

/// Feeds straight in from 1 mm above the face.
std::vector<Felt> feed(const Body& body, const ToolSetup& setup, double rate, double depth, Vec3 entry = {}) {
    test::Rig simulation(body, setup, test::at_depth(-1.0_mm, 0.0, entry));
    std::vector<Felt> felt;
    double at = -1.0_mm;
    while (at < depth) {
        const TickResult r = simulation.tick_direct({test::at_depth(at + rate * Simulation::dt, 0.0, entry)});
        EXPECT_FALSE(r.is_quarantined);
        felt.push_back({at, r.thrust, r.torque, std::hypot(r.bone_on_tool[0], r.bone_on_tool[1])});
        at += rate * Simulation::dt;
    }
    return felt;
}

Felt mean_between(const std::vector<Felt>& felt, double from, double to) {
    Felt sum{};
    double count = 0.0;
    for (const Felt& f : felt)
        if (f.depth >= from && f.depth < to) {
            sum.thrust += f.thrust;
            sum.torque += f.torque;
            sum.lateral += f.lateral;
            count += 1.0;
        }
    return {0.5 * (from + to), sum.thrust / count, sum.torque / count, sum.lateral / count};
}

Felt steady(const ToolSetup& setup, double rate, double spacing = 0.25_mm) {
    const Body body = test::block({-5.0_mm, -5.0_mm, -8.0_mm}, {5.0_mm, 5.0_mm, 0}, spacing, {0.21, 0.34, 0.55});
    return mean_between(feed(body, setup, rate, 4.0_mm), 2.5_mm, 4.0_mm);
}

// B1-a: one line through three speeds of a study meets each within its spread; a law proportional to feed does not.
TEST(DrillThrust, MeetsTheHumanFemurOfMacAvelia) {
    const struct {
        double rpm, thrust, thrust_sd, torque, torque_sd;
    } measured[] = {
        {1000, 198.4, 14.2, 186.3, 16.9}, {1250, 180.6, 14.0, 157.8, 16.1}, {1500, 176.3, 11.2, 140.2, 16.4}};
    for (const auto& m : measured) {
        const Felt f = steady(test::twist_drill({{"spindle_speed", m.rpm / 60.0}}), 2.0_mm_per_s);
        EXPECT_NEAR(f.thrust, m.thrust, m.thrust_sd) << m.rpm << " rpm";
        EXPECT_NEAR(f.torque, m.torque * 1.0_Nmm, m.torque_sd * 1.0_Nmm) << m.rpm << " rpm";
    }
}

// C.2, with the edge terms: T = k_t f R²/2 and F = k_a f R hold for constant coefficients and no web.
TEST(DrillThrust, IsTheClosedFormOfTheLipIntegral) {
    const double f = 0.12_mm, r = 1.6_mm, k_cut = 1000.0_N_per_mm2, k_thrust = 400.0_N_per_mm2;
    const ToolSetup setup = test::twist_drill({{"web", 0.05},
                                               {"thrust_edge", 0.0},
                                               {"cutting_edge", 0.0},
                                               {"chisel_edge", 0.0},
                                               {"chisel_chip", 0.0},
                                               {"thrust_chip", k_thrust},
                                               {"cutting_chip", k_cut}});
    const Felt felt = steady(setup, 2.0_mm_per_s);
    const double r_c = 0.5 * 0.05 * 3.2_mm / std::sin(55.0_deg);
    EXPECT_NEAR(felt.torque / (k_cut * f * (r * r - r_c * r_c) / 2.0), 1.0, 0.005);

    // Thrust: each piece gives k (f/2) n_z dr per lip, n_z within 1 % of sin p for so thin a web.
    EXPECT_NEAR(felt.thrust / (k_thrust * f * (r - r_c) * std::sin(59.0_deg)), 1.0, 0.01);
}

// P8: the work of thrust and torque is the law's own: chip energy × volume + edge energy × swept edge area, plus the
// thrust's share. The volume is the field's, counted from the voxels.
TEST(DrillThrust, WorksAsMuchAsTheBoneItTakesCosts) {
    using namespace drilling;
    const double rate = 2.0_mm_per_s, n = 1000.0_rpm;
    test::Rig simulation(test::block({-5.0_mm, -5.0_mm, -8.0_mm}, {5.0_mm, 5.0_mm, 0}, 0.2_mm, {0.21, 0.34, 0.55}),
                         test::twist_drill({{"chisel_edge", 0.0},
                                            {"chisel_chip", 0.0},
                                            {"thrust_edge", 0.0},
                                            {"thrust_chip", 1.0_N_per_mm2 /* next to nothing */},
                                            {"web", 0.05}}),
                         test::at_depth(-1.0_mm));
    double work = 0.0, at = -1.0_mm, from_volume = 0.0, revolutions = 0.0;
    while (at < 6.0_mm) {
        const TickResult r = simulation.tick_direct({test::at_depth(at + rate * Simulation::dt)});
        at += rate * Simulation::dt;
        if (at < 2.5_mm) {
            from_volume = simulation.present().removed();
            continue;
        }
        work += (r.torque * 2.0 * pi * n + r.thrust * rate) * Simulation::dt;
        revolutions += n * Simulation::dt;
    }

    const Lip lip = make_lip(value_of<drilling::TwistBit>(simulation.setup().tool_parameters).drill(), 0.1_mm);
    double edge_area_per_turn = 0.0;
    for (std::size_t i = 0; i < lip.count; ++i)
        edge_area_per_turn += 2.0 * lip.element[i].width * 2.0 * pi * lip.element[i].radius;
    const auto law = value_of<drilling::DrillCutting>(simulation.setup().force_parameters);
    const double cost = law.cutting_chip * (simulation.present().removed() - from_volume) +
                        law.cutting_edge * edge_area_per_turn * revolutions;
    EXPECT_NEAR(work / cost, 1.0, 0.02);
}

// P6: finer elements converge, they do not add force.
TEST(DrillThrust, DoesNotScaleWithTheNumberOfElements) {
    const double coarse = steady(test::twist_drill({{"element_pitch", 0.2_mm}}), 2.0_mm_per_s).thrust;
    const double fine = steady(test::twist_drill({{"element_pitch", 0.1_mm}}), 2.0_mm_per_s).thrust;
    const double finest = steady(test::twist_drill({{"element_pitch", 0.05_mm}}), 2.0_mm_per_s).thrust;
    EXPECT_NEAR(coarse / finest, 1.0, 0.01);
    EXPECT_NEAR(fine / finest, 1.0, 0.002);
}

// P3: antipodal lips in one tissue cancel sideways.
TEST(DrillThrust, HasNoSidewaysPartInOneTissue) {
    const Felt f = steady(test::twist_drill(), 2.0_mm_per_s);
    EXPECT_LT(f.lateral, 1e-9 * f.thrust);
}

// P4: four times the length, and half the time, with coefficients in the same units: the same force.
TEST(DrillThrust, IsTheSameInAnyUnitsOfLengthAndTime) {
    const auto scaled = [](double length, double time) {
        const ToolSetup setup = test::twist_drill({{"diameter", 3.2_mm * length},
                                                   {"length", 70.0_mm * length},
                                                   {"element_pitch", 0.1_mm * length},
                                                   {"edge_depth", 4.0_um * length},
                                                   {"clearance", 0.05_mm * length},
                                                   {"thrust_edge", 27.0_N_per_mm / length},
                                                   {"cutting_edge", 16.0_N_per_mm / length},
                                                   {"chisel_edge", 99.0_N_per_mm / length},
                                                   {"thrust_chip", 285.0_N_per_mm2 / length / length},
                                                   {"cutting_chip", 934.0_N_per_mm2 / length / length},
                                                   {"chisel_chip", 871.0_N_per_mm2 / length / length},
                                                   {"spindle_speed", 1000.0_rpm / time}});
        const double mm = length * 1.0_mm;
        const Body body =
            test::block({-5.0 * mm, -5.0 * mm, -8.0 * mm}, {5.0 * mm, 5.0 * mm, 0}, 0.25 * mm, {0.21, 0.34, 0.55});
        return mean_between(feed(body, setup, 2.0 * mm / time, 4.0 * mm), 2.5 * mm, 4.0 * mm);
    };
    const Felt one = scaled(1.0, 1.0);
    for (const double length : {1.0, 4.0})
        for (const double time : {0.5, 1.0}) {
            const Felt other = scaled(length, time);
            EXPECT_NEAR(other.thrust / one.thrust, 1.0, 1e-3) << length << " " << time;
            EXPECT_NEAR(other.torque / (length * one.torque), 1.0, 1e-3) << length << " " << time;
        }
}

// P10: in both directions the bone works against the motion, along the shaft and across it.
TEST(DrillThrust, OpposesTheMotionOnBothStrokes) {
    test::Rig simulation(test::block({-6.0_mm, -6.0_mm, -12.0_mm}, {6.0_mm, 6.0_mm, 0}, 0.25_mm, {0.21, 0.34, 0.55}),
                         test::twist_drill(), test::at_depth(-1.0_mm));
    const auto work_to = [&](double depth_from, double depth_to, double aside_from, double aside_to) {
        double work = 0.0;
        Vec3 last = simulation.world_from_tool().position;
        constexpr int ticks = 1000;
        for (int i = 1; i <= ticks; ++i) {
            const double t = static_cast<double>(i) / ticks;
            const TickResult r = simulation.tick_direct({test::at_depth(
                depth_from + t * (depth_to - depth_from), 0.0, {aside_from + t * (aside_to - aside_from), 0, 0})});
            work += dot(linear(r.bone_on_tool), r.world_from_tool.position - last);
            last = r.world_from_tool.position;
        }
        return work;
    };
    EXPECT_LT(work_to(-1.0_mm, 3.0_mm, 0.0, 0.0), -0.1) << "in [J]";
    const double aside = work_to(3.0_mm, 3.0_mm, 0.0, 0.6_mm), across = work_to(3.0_mm, 3.0_mm, 0.6_mm, -0.6_mm),
                 back = work_to(3.0_mm, 3.0_mm, -0.6_mm, 0.0);
    EXPECT_LT(aside, -1e-3) << "to one side";
    EXPECT_LT(across, -1e-3) << "and to the other";
    EXPECT_LT(back, -0.95 * aside) << "back it is given no more than the walls held";
    EXPECT_LT(aside + across + back, -1e-3);
    EXPECT_LE(work_to(3.0_mm, -1.0_mm, 0.0, 0.0), 1e-9) << "out";
}

// P9
TEST(DrillThrust, WithoutFeedThereIsNone) {
    test::Rig simulation(test::block({-5.0_mm, -5.0_mm, -8.0_mm}, {5.0_mm, 5.0_mm, 0}, 0.25_mm), test::twist_drill(),
                         test::at_depth(-1.0_mm));
    for (double at = -1.0_mm; at < 3.0_mm; at += 2.0_um) {
        (void)simulation.tick_direct({test::at_depth(at)});
    }
    const Pose here = simulation.world_from_tool();
    for (int i = 0; i < 50; ++i) EXPECT_EQ(simulation.tick_direct({here}).thrust, 0.0);
}

// S-12: in a finished hole nothing is felt until the bottom is met again, at any depth of the last two voxels.
TEST(DrillThrust, IsGoneWhenReEnteringTheHole) {
    const double h = 0.25_mm;
    const Body body = test::block({-5.0_mm, -5.0_mm, -8.0_mm}, {5.0_mm, 5.0_mm, 0}, h, {0.2, 0.4, 0.6});
    const ToolSetup setup = test::twist_drill();
    for (double back = 2.0_um; back <= 2.0 * h + 1.0_um; back += 31.0_um) {
        test::Rig simulation(body, setup, test::at_depth(-1.0_mm));
        double at = -1.0_mm, worst = 0.0;
        const auto move_to = [&](double target, double rate) {
            while (std::abs(target - at) > 1e-12) {
                at += std::clamp(target - at, -rate * Simulation::dt, rate * Simulation::dt);
                const double thrust = simulation.tick_direct({test::at_depth(at)}).thrust;
                worst = std::max(worst, thrust);
            }
        };
        move_to(2.0_mm, 2.0_mm_per_s);
        move_to(2.0_mm - back, 1.0_mm_per_s);
        worst = 0.0;
        move_to(2.0_mm - 0.05_um, 1.0_mm_per_s);
        EXPECT_LT(worst, 0.05) << "after withdrawing " << back * 1e6 << " um";
        move_to(2.1_mm, 2.0_mm_per_s);
        EXPECT_GT(worst, 100.0) << "the bottom is still there";
    }
}

// ---- what a drill may be like ---------------------------------------------------------------------------------------

TEST(DrillThrust, MoreRakeIsLessForceAndTheFittedHelixIsAsFitted) {
    const Felt fitted = steady(test::twist_drill(), 2.0_mm_per_s);
    const Felt same = steady(test::twist_drill({{"helix_angle", 28.0_deg}, {"rake_effect", 0.05}}), 2.0_mm_per_s);
    const Felt steep = steady(test::twist_drill({{"helix_angle", 36.0_deg}}), 2.0_mm_per_s);
    const Felt straight = steady(test::twist_drill({{"helix_angle", 0.0}}), 2.0_mm_per_s);
    EXPECT_EQ(same.torque, fitted.torque);
    EXPECT_LT(steep.torque, fitted.torque);
    EXPECT_GT(straight.torque, fitted.torque);
    // All of the torque is the lips': at the corner 28° of rake less are 28 %, nearer to the axis less.
    EXPECT_NEAR(straight.torque / fitted.torque, 1.22, 0.04);
}

TEST(DrillThrust, AWiderWebNeedsMorePush) {
    EXPECT_GT(steady(test::twist_drill({{"web", 0.25}}), 2.0_mm_per_s).thrust,
              1.1 * steady(test::twist_drill(), 2.0_mm_per_s).thrust);
}

// R5: what a lip feeds beyond its relief stands on its heel, however often the loop asks.
TEST(Heel, StandsOnWhatIsFedBeyondTheRelief) {
    const double turns = 1000.0 / 60.0, rate = 60.0_mm_per_s, limit = 2.0 * pi * 1.6_mm * std::tan(10.0_deg);
    const auto thrust = [&](double stiffness, double period, double density) {
        Body body = test::block({-4.0_mm, -4.0_mm, -14.0_mm}, {4.0_mm, 4.0_mm, 0}, 0.5_mm, {0.21, 0.34, 0.55});
        body.materials = {{"bone", density, {}}};
        test::Rig simulation(body, test::twist_drill({{"heel_stiffness", stiffness}, {"motor_torque", 1000.0}}),
                             test::at_depth(-0.5_mm), test::gains(), period);
        double felt = 0.0;
        for (double depth = -0.5_mm; depth < 9.0_mm; depth += rate * period) {
            felt = simulation.tick_direct({test::at_depth(depth)}).thrust;
        }
        return felt;
    };
    const double k = 1000.0_N_per_mm;
    for (const double period : {2e-3, 1e-3, 0.5e-3, 0.25e-3})
        for (const double share : {1.0, 0.25}) {
            const double density = 1850.0 * std::sqrt(share);
            const double more = thrust(k, period, density) - thrust(0.0, period, density);
            EXPECT_NEAR(more / (k * share * 0.5 * (rate / turns - limit)), 1.0, 0.01) << period << ", " << share;
        }
}

// A tip that runs off its axis: the hole is wider by the runout, one lip takes all, and what pushes aside turns around.
TEST(DrillThrust, ATipThatRunsOutCutsAWiderHoleAndIsPushedAsideAsItTurns) {
    const double e = 0.1_mm;
    test::Rig simulation(test::block({-5.0_mm, -5.0_mm, -8.0_mm}, {5.0_mm, 5.0_mm, 0}, 0.25_mm, {0.21, 0.34, 0.55}),
                         test::twist_drill({{"runout", e}}), test::at_depth(-1.0_mm));
    double at = -1.0_mm, largest_x = 0.0, min_x = 0.0, mean = 0.0, count = 0.0, thrust = 0.0;
    while (at < 4.0_mm) {
        const TickResult r = simulation.tick_direct({test::at_depth(at)});
        at += 2.0_um;
        if (at < 2.5_mm) continue;
        largest_x = std::max(largest_x, r.bone_on_tool[0]);
        min_x = std::min(min_x, r.bone_on_tool[0]);
        mean += r.bone_on_tool[0];
        thrust += r.thrust;
        count += 1.0;
    }
    EXPECT_GT(largest_x, 5.0);
    EXPECT_NEAR(min_x, -largest_x, 0.1 * largest_x);
    EXPECT_NEAR(mean / count, 0.0, 0.02 * largest_x) << "over whole turns it cancels";

    // One lip with the whole feed: its chip is the same, the second edge's force is gone. The chisel stays.
    const double both = steady(test::twist_drill(), 2.0_mm_per_s).thrust;
    EXPECT_LT(thrust / count, 0.85 * both);
    EXPECT_GT(thrust / count, 0.65 * both);

    simulation.finish();
    const double removed = simulation.present().removed();
    // A frustum from the runout to the corner, and the cylinder behind it.
    const double r = 1.6_mm + e, tip = 0.9614_mm, depth = 4.0_mm;
    const double frustum = pi * tip / 3.0 * (e * e + e * r + r * r);
    EXPECT_NEAR(removed / (frustum + pi * r * r * (depth - tip)), 1.0, 0.01);
}

// A step drill: whatever the angles of its cones, the lips together clear the widest circle.
TEST(StepDrill, ItsTorqueIsTheClosedFormOfItsWidestCircle) {
    const double k_cut = 1000.0_N_per_mm2, f = 0.12_mm, r_c = 0.5 * 0.15 * 3.2_mm / std::sin(55.0_deg);
    for (const double angle : {20.0_deg, 90.0_deg}) {
        const ToolSetup setup = test::step_drill({{"thrust_edge", 0.0},
                                                  {"cutting_edge", 0.0},
                                                  {"chisel_edge", 0.0},
                                                  {"chisel_chip", 0.0},
                                                  {"thrust_chip", 1.0_N_per_mm2},
                                                  {"cutting_chip", k_cut},
                                                  {"element_pitch", 0.05_mm},
                                                  {"shoulder_diameter", 5.0_mm},
                                                  {"shoulder_angle", angle},
                                                  {"shoulder_depth", 2.0_mm}});
        const double full = 2.0_mm + 0.9_mm / std::tan(0.5 * angle) + 0.5_mm;  // the whole cone is in
        const Body body = test::block({-6.0_mm, -6.0_mm, -20.0_mm}, {6.0_mm, 6.0_mm, 0}, 0.25_mm, {0.21, 0.34, 0.55});
        const auto felt = feed(body, setup, 2.0_mm_per_s, full + 1.0_mm);
        const double pilot = mean_between(felt, 1.3_mm, 1.9_mm).torque,
                     whole = mean_between(felt, full, full + 1.0_mm).torque;
        EXPECT_NEAR(pilot / (k_cut * f * (1.6_mm * 1.6_mm - r_c * r_c) / 2.0), 1.0, 0.01) << angle;
        EXPECT_NEAR(whole / (k_cut * f * (2.5_mm * 2.5_mm - r_c * r_c) / 2.0), 1.0, 0.01) << angle;
    }
}

// ---- layers (C.4, C.9) -------------------------------------------------------------------------------------------

TEST(LayeredSlab, ThrustIsThatOfTheExactLipIntegral) {
    const double rate = 8.0_mm_per_s;
    const ToolSetup setup = test::twist_drill({{"diameter", 5.4_mm}, {"element_pitch", 0.05_mm}});
    const double feed_per_lip = rate / (2.0 * 1000.0 / 60.0);
    for (const double h : {0.5_mm, 0.25_mm}) {
        double error2 = 0.0, mean = 0.0, count = 0.0;
        for (const Felt& f : feed(test::Slab::make(h, {0.31, 0.77, 0.43}), setup, rate, 21.0_mm)) {
            const double exact = test::exact_thrust(setup, test::at_depth(f.depth), 0.0, feed_per_lip, 2000);
            if (exact <= 0.0) continue;
            error2 += (f.thrust - exact) * (f.thrust - exact);
            mean += exact;
            count += 1.0;
        }
        const double relative = std::sqrt(error2 / count) / (mean / count);
        RecordProperty("rms_percent_at_" + std::to_string(static_cast<int>(h * 1e6)) + "_um",
                       std::to_string(100.0 * relative));
        EXPECT_LT(relative, h > 0.4_mm ? 0.01 : 0.005) << "spacing " << h;
    }
}

TEST(LayeredSlab, HasTheSevenStagesOfThePaper) {
    const double rate = 4.0_mm_per_s, h = 0.25_mm;
    const ToolSetup setup = test::twist_drill({{"diameter", 5.4_mm}});
    const auto felt = feed(test::Slab::make(h, {0.1, 0.9, 0.6}), setup, rate, 21.0_mm);
    const double full = mean_between(felt, 2.5_mm, 3.5_mm).thrust;
    const double low = mean_between(felt, 7.0_mm, 12.0_mm).thrust;
    EXPECT_NEAR(low / full, 0.1, 0.002) << "the ratio of the tissues";

    // Where thrust leaves one level and where it reaches the next: R cot p apart, within a voxel.
    const double tip = 1.622_mm;
    const auto crossing = [&](double from, double level, bool is_rising) {
        for (const Felt& f : felt)
            if (f.depth >= from && (is_rising ? f.thrust >= level : f.thrust <= level)) return f.depth;
        return 1.0;
    };
    EXPECT_NEAR(crossing(-0.5_mm, 0.999 * full, true), tip, h) << "A ends";
    EXPECT_NEAR(crossing(3.0_mm, 0.99 * full, false), 4.0_mm, h) << "C begins";
    EXPECT_NEAR(crossing(4.0_mm, 1.01 * low, false), 4.0_mm + tip, h) << "C ends";
    EXPECT_NEAR(crossing(13.0_mm, 1.1 * low, true), 14.0_mm, h) << "E begins";
    EXPECT_NEAR(crossing(14.0_mm, 0.999 * full, true), 14.0_mm + tip, h) << "E ends";
    EXPECT_NEAR(crossing(17.0_mm, 0.99 * full, false), 18.0_mm, h) << "G begins";
    EXPECT_NEAR(crossing(18.0_mm, 0.001 * full, false), 18.0_mm + tip, h) << "G ends";
}

}  // namespace
}  // namespace kerf
