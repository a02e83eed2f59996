// SPDX-License-Identifier: Apache-2.0
// The saw fed through bone at a prescribed rate (`coupling: direct`), against the law's closed form and against what is
// measured.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <utility>
#include <vector>

#include "plugins/sawing/saw_force.h"
#include "tests/support/saw_rig.h"

namespace kerf {
namespace {

using namespace literals;
using sawing::Stroke;

constexpr double rate = 1.0_mm_per_s;

/// A block that the whole front fits into.
Body wide_block(double spacing = 0.5_mm) {
    return test::block({-18.0_mm, -4.0_mm, -9.0_mm}, {18.0_mm, 4.0_mm, 0}, spacing, {0.31, 0.17, 0.73});
}

struct Felt {
    Vec6 wrench{};  ///< bone on saw, world frame, about the tip
    double thrust = 0.0, depth = 0.0;
    std::vector<double> signals;
};

/// A saw on its way straight down, in a frame of its own.
struct Feeding {
    Body body;
    ToolSetup setup;
    Simulation simulation;
    double depth = -1.0_mm;
    double dt;
    Quat turn{1, 0, 0, 0};  ///< of the saw about its shaft

    explicit Feeding(Body bone, const ToolSetup& saw, double period = Simulation::dt, double about = 0.0)
        : body(std::move(bone)),
          setup(saw),
          simulation(body, setup, test::outline(setup), test::gains(), pose(-1.0_mm, about), period),
          dt(period),
          turn(quat_from_rotation_vector({0, 0, about})) {}

    static Pose pose(double at, double about, Vec3 aside = {}) {
        Pose p = test::at_depth(at, 0.0, aside);
        p.rotation = p.rotation * quat_from_rotation_vector({0, 0, about});
        return p;
    }
    Felt go(double feed, Vec3 aside = {}) {
        depth += feed * dt;
        Pose p = test::at_depth(depth, 0.0, aside);
        p.rotation = p.rotation * turn;
        const TickResult r = simulation.tick_direct({p});
        EXPECT_FALSE(r.is_quarantined);
        return {r.bone_on_tool,
                r.thrust,
                depth,
                {simulation.signals(), simulation.signals() + setup.force->force->signal_count}};
    }
    Felt to(double target, double feed = 8.0_mm_per_s) {
        Felt last;
        while (depth < target - 1e-12) last = go(std::min(feed, (target - depth) / dt));
        return last;
    }
    Felt mean(double feed, int ticks) {
        Felt sum = go(feed);
        for (int i = 1; i < ticks; ++i) {
            const Felt one = go(feed);
            for (std::size_t c = 0; c < 6; ++c) sum.wrench[c] += one.wrench[c];
            sum.thrust += one.thrust;
            for (std::size_t s = 0; s < sum.signals.size(); ++s) sum.signals[s] += one.signals[s];
        }
        for (double& c : sum.wrench) c /= ticks;
        sum.thrust /= ticks;
        for (double& s : sum.signals) s /= ticks;
        return sum;
    }
};

/// All teeth in cortical bone at this feed: what each resists, in the mean over the oscillation, on its own normal.
double exact_thrust(const ToolSetup& setup, double feed) {
    const sawing::SawBlade blade = value_of<sawing::OscillatingBlade>(setup.tool_parameters).blade();
    const auto k = value_of<sawing::SawCutting>(setup.force_parameters).thrust();
    const Stroke stroke{blade.stroke(), blade.pitch, setup.drives[0]};
    const sawing::Teeth teeth = sawing::teeth_of(blade, 0.0);
    constexpr int steps = 2000;
    double sum = 0.0;
    for (std::size_t i = 0; i < teeth.count; ++i)
        for (int s = 0; s < steps; ++s) {
            const double c = teeth.tooth[i].normal.z,
                         t = feed * c * sawing::chip_per_feed(stroke, std::cos((s + 0.5) / steps * 0.5 * pi));
            sum += c * blade.kerf() * force_per_width(t, k) / steps;
        }
    return sum;
}

// ---- the sum over the teeth
// -------------------------------------------------------------------------------------------

TEST(SawThrust, IsThatOfAllTeethOverTheOscillation) {
    const ToolSetup setup = test::saw();
    for (const double feed : {0.1_mm_per_s, 1.0_mm_per_s, 6.0_mm_per_s}) {
        Feeding saw(wide_block(), setup);
        saw.to(5.0_mm);
        EXPECT_NEAR(saw.mean(feed, 100).thrust / exact_thrust(setup, feed), 1.0,
                    0.035 /* two parts stand for the oscillation */)
            << feed;
    }
}

TEST(SawThrust, HasItsEighteenTeethInBone) {
    Feeding saw(wide_block(), test::saw());
    saw.to(5.0_mm);
    EXPECT_NEAR(signals_of<sawing::SawCutting>(saw.mean(rate, 100).signals).engaged_teeth, 18.0, 0.05);
}

// B3-a, through the whole loop: 2.5 … 10 µm in the mean.
TEST(SawThrust, OfOneToothLiesWhereItWasMeasured) {
    const ToolSetup setup = test::saw();
    const sawing::SawBlade blade = value_of<sawing::OscillatingBlade>(setup.tool_parameters).blade();
    const Stroke stroke{blade.stroke(), blade.pitch, setup.drives[0]};
    Feeding saw(wide_block(), setup);
    saw.to(5.0_mm);
    for (const double chip : {2.5_um, 5.0_um, 10.0_um}) {
        const double feed = chip / sawing::mean_chip_per_feed(stroke);
        const Felt felt = saw.mean(feed, 20);
        EXPECT_NEAR(signals_of<sawing::SawCutting>(felt.signals).chip_thickness, chip, 0.01_um);
        const double cutting = signals_of<sawing::SawCutting>(felt.signals).vibration /
                               signals_of<sawing::SawCutting>(felt.signals).engaged_teeth;
        const double resultant = std::hypot(signals_of<sawing::SawCutting>(felt.signals).tooth_force, cutting);
        EXPECT_GE(resultant, 8.0) << chip;
        EXPECT_LE(resultant, 11.0) << chip;
    }
}

// B3-c: the same depth per tooth at four times the speed.
TEST(SawThrust, DoesNotDependOnTheSpeedAtAFixedDepthOfCut) {
    double least = 1e300, most = 0.0;
    for (const double strokes : {6000.0_rpm, 12000.0_rpm, 24000.0_rpm}) {
        Feeding saw(wide_block(), test::saw({{"stroke_rate", strokes}}));
        saw.to(5.0_mm);
        const double thrust = saw.mean(strokes * 5.0_um, 60).thrust;
        least = std::min(least, thrust);
        most = std::max(most, thrust);
    }
    EXPECT_GT(least, 50.0);
    EXPECT_NEAR(most / least, 1.0, 0.05);
}

// 04-11: at a fixed feed it falls with the rate.
TEST(SawThrust, FallsWithTheRateAtAFixedFeed) {
    double last = 1e300;
    for (const double strokes : {8000.0_rpm, 10000.0_rpm, 15000.0_rpm}) {
        Feeding saw(wide_block(), test::saw({{"stroke_rate", strokes}}));
        saw.to(5.0_mm);
        const double thrust = saw.mean(0.5_mm_per_s, 100).thrust;
        EXPECT_LT(thrust, last);
        last = thrust;
    }
}

// P9
TEST(SawThrust, WithoutFeedThereIsNone) {
    Feeding saw(wide_block(), test::saw());
    saw.to(5.0_mm);
    for (int i = 0; i < 50; ++i) EXPECT_EQ(saw.go(0.0).thrust, 0.0);
}

TEST(SawThrust, BackInItsSlotASawMeetsNothingBeforeTheFront) {  // S-12
    for (const double h : {0.5_mm, 0.25_mm}) {
        Feeding saw(wide_block(h), test::saw());
        saw.to(5.0_mm, 2.0_mm_per_s);
        const double front = saw.depth;
        while (saw.depth > 3.0_mm) (void)saw.go(-20.0_mm_per_s);
        double most = 0.0;
        while (saw.depth < front - 22.0_um) most = std::max(most, std::abs(saw.go(20.0_mm_per_s).thrust));
        EXPECT_LT(most, 0.05) << h;
        for (int i = 0; i < 40; ++i) most = std::max(most, saw.go(2.0_mm_per_s).thrust);
        EXPECT_GT(most, 50.0) << "the bottom is still there";
    }
}

// ---- frames, mirrors, ticks
// ---------------------------------------------------------------------------------------------

TEST(SawThrust, TurnsWithTheSaw) {
    const auto felt = [](double about) {
        Feeding saw(test::block({-18.0_mm, -18.0_mm, -7.0_mm}, {18.0_mm, 18.0_mm, 0}, 0.5_mm, {0.31, 0.17, 0.73}),
                    test::saw({{"tooth_count", 17.0}}), Simulation::dt, about);
        saw.to(4.0_mm);
        return saw.mean(rate, 200).wrench;
    };
    const Vec6 straight = felt(0.0), turned = felt(90.0_deg);
    EXPECT_NEAR(turned[2] / straight[2], 1.0, 0.01);
    // The unpaired tooth pushes along y of the saw: along ∓x of the world once it is turned.
    EXPECT_GT(std::abs(straight[1]), 0.3);
    EXPECT_NEAR(std::abs(turned[0]), std::abs(straight[1]), 0.03 * std::abs(straight[1]));
    EXPECT_NEAR(straight[0], 0.0, 0.02 * straight[2]);
}

// E03-5, 03-08: neighbours cancel; of an odd number one is left.
TEST(SawThrust, HasASidewaysPartOfTheUnpairedToothOnly) {
    for (const double teeth : {16.0, 17.0, 18.0}) {
        const ToolSetup setup = test::saw({{"tooth_count", teeth}});
        Feeding saw(wide_block(), setup);
        saw.to(5.0_mm);
        const Felt felt = saw.mean(rate, 100);
        const double one = 0.1 * felt.thrust / teeth, expected = static_cast<int>(teeth) % 2 == 0 ? 0.0 : one;
        EXPECT_NEAR(std::abs(felt.wrench[1]), expected, 0.03 * one) << teeth;
    }
}

Vec3 in_tool(const Feeding& saw, const Vec6& wrench) {
    return rotate(conjugate(saw.simulation.world_from_tool().rotation), linear(wrench));
}

TEST(SawThrust, UnpairedToothPushesAgainstItsSet) {
    // Given 17 teeth, of which the first and the last are set to +y
    const ToolSetup setup = test::saw({{"tooth_count", 17.0}});
    ASSERT_GT(sawing::teeth_of(value_of<sawing::OscillatingBlade>(setup.tool_parameters).blade(), 0.0).tooth[0].side,
              0.0);
    Feeding saw(wide_block(), setup);
    saw.to(5.0_mm);
    const Felt felt = saw.mean(rate, 100);
    EXPECT_NEAR(in_tool(saw, felt.wrench).y, -0.1 * felt.thrust / 17.0, 0.03 * 0.1 * felt.thrust / 17.0);
}

TEST(SawThrust, BoneUnderOneEndPushesThatEndBack) {
    // Given bone under the two last teeth alone, and then under the two first: they are set to either side, 1 mm apart
    const ToolSetup setup = test::saw({{"tooth_count", 17.0}});
    const sawing::SawBlade blade = value_of<sawing::OscillatingBlade>(setup.tool_parameters).blade();
    const sawing::Teeth teeth = sawing::teeth_of(blade, 0.0);
    for (const double end : {1.0, -1.0}) {
        const double from = end * (std::abs(teeth.tooth[0].tip.x) - 1.5 * blade.pitch);
        const Body bone = test::block({std::min(from, end * 30.0_mm), -4.0_mm, -9.0_mm},
                                      {std::max(from, end * 30.0_mm), 4.0_mm, 0}, 0.25_mm, {0.31, 0.17, 0.73});
        // The tool's x is the world's, or its opposite
        Feeding saw(bone, setup);
        const Vec3 x = rotate(saw.simulation.world_from_tool().rotation, {1, 0, 0});
        saw.to(4.0_mm, 4.0_mm_per_s);
        const Felt felt = saw.mean(rate, 50);
        ASSERT_GT(felt.thrust, 1.0);
        // Thrust at the end in bone pushes that end back: about y of the tool, τ_y = z f_x − x f_z = x |f_z|
        const Vec3 torque = rotate(conjugate(saw.simulation.world_from_tool().rotation), angular(felt.wrench));
        const double in_bone_at = end * x.x;
        EXPECT_GT(torque.y * in_bone_at, 0.5 * felt.thrust * std::abs(from)) << "end " << end;
        EXPECT_LT(in_tool(saw, felt.wrench).z, -1.0) << "out of the bone";
    }
}

// S-10: half the tick, the same force.
TEST(SawThrust, IsTheSameInTicksOfAnyLength) {
    double first = 0.0;
    for (const double dt : {2e-3, 1e-3, 0.25e-3}) {
        Feeding saw(wide_block(), test::saw(), dt);
        saw.to(5.0_mm);
        const double thrust = saw.mean(rate, static_cast<int>(0.1 / dt)).thrust;
        if (first == 0.0) first = thrust;
        EXPECT_NEAR(thrust / first, 1.0, 1e-3) << dt;
    }
}

TEST(SawThrust, HardlyDependsOnTheSpacing) {
    const auto at = [](double h) {
        Feeding saw(wide_block(h), test::saw());
        saw.to(5.0_mm);
        return saw.mean(rate, 100).thrust;
    };
    const double fine = at(0.25_mm);
    EXPECT_NEAR(at(0.5_mm) / fine, 1.0, 0.005);
}

// P10: in every direction bone works against the motion.
TEST(SawThrust, OpposesTheMotionInEveryDirection) {
    Feeding saw(wide_block(0.25_mm), test::saw());
    const auto work_of = [&](Vec3 way, double depth_by, Vec3 aside) {
        constexpr int ticks = 600;
        double work = 0.0;
        Vec3 last = saw.simulation.world_from_tool().position;
        for (int i = 1; i <= ticks; ++i) {
            const Felt felt = saw.go(depth_by / ticks / saw.dt, aside + (static_cast<double>(i) / ticks) * way);
            const Vec3 now = saw.simulation.world_from_tool().position;
            work += dot(linear(felt.wrench), now - last);
            last = now;
        }
        return work;
    };
    EXPECT_LT(work_of({}, 4.0_mm, {}), -0.05) << "in [J]";
    EXPECT_LT(work_of({0, 0.6_mm, 0}, 0.0, {}), -1e-3) << "to one side of the blade";
    EXPECT_LT(work_of({0, -1.2_mm, 0}, 0.0, {0, 0.6_mm, 0}), -1e-3) << "to the other";
    EXPECT_LT(work_of({0, 0.6_mm, 0}, 0.0, {0, -0.6_mm, 0}), 1e-3)
        << "back it is given no more than the bent blade held";
    EXPECT_LT(work_of({1.0_mm, 0, 0}, 0.0, {}), -1e-3) << "the way the teeth go";
    EXPECT_LE(work_of({-1.0_mm, 0, 0}, -4.0_mm, {1.0_mm, 0, 0}), 1e-9) << "out";
}

// C.8: what the thrust and the teeth's own motion work is the law's: chip energy times volume, and the edges' on the
// way.
TEST(SawThrust, WorksAsMuchAsTheBoneItTakesCosts) {
    // Chips alone: the energy is in the volume. A cutting chip of 500 N/mm² costs half a joule for each cubic
    // millimetre.
    const double k_cut = 500.0_N_per_mm2;
    const ToolSetup setup = test::saw({{"thrust_edge", 0.0},
                                       {"thrust_chip", 1.0_N_per_mm2 /* next to nothing */},
                                       {"cutting_edge", 0.0},
                                       {"cutting_chip", k_cut},
                                       {"motor_torque", 5.0},
                                       {"arc", 12.0_deg},
                                       {"tooth_pitch", 0.7_mm},
                                       {"tooth_count", 18.0}});
    Feeding saw(wide_block(0.25_mm), setup);
    saw.to(3.0_mm);
    const double before = saw.simulation.present().removed();
    double work = 0.0;
    for (int i = 0; i < 2000; ++i) work += signals_of<sawing::SawCutting>(saw.go(rate).signals).drive_power * saw.dt;
    saw.simulation.finish();
    // The blade sweeps more than its front, by half a swing at either end, where teeth come by only a part of the time:
    // those ends are bone that nobody is charged for. What 18 teeth of 0.7 mm take: kerf x 12.6 mm x 2 mm.
    const double front = 1.0_mm * 18.0 * 0.7_mm * 2.0_mm;
    EXPECT_GT(saw.simulation.present().removed() - before, front);
    const sawing::SawBlade blade = value_of<sawing::OscillatingBlade>(setup.tool_parameters).blade();
    const Stroke stroke{blade.stroke(), blade.pitch, setup.drives[0]};
    // Chips are as thick as the time between teeth makes them; their mean over time, at the mean speed:
    const double chips = sawing::mean_chip_per_feed(stroke) * stroke.mean_speed() / blade.pitch;
    EXPECT_NEAR(work / (k_cut * front * chips), 1.0, 0.02);
    EXPECT_GE(work, k_cut * front) << "no bone for nothing";
}

// ---- the oscillation
// ----------------------------------------------------------------------------------------------------

TEST(SawOscillation, Above100HzSwingsInItsOwnSignalAndNotInTheForce) {
    Feeding saw(wide_block(), test::saw({{"stroke_rate", 12000.0_rpm}}));
    saw.to(5.0_mm);
    double least = 1e300, most = 0.0;
    for (int i = 0; i < 100; ++i) {
        const Felt felt = saw.go(6.0_mm_per_s);
        EXPECT_NEAR(felt.wrench[0], 0.0, 0.02 * felt.thrust);
        least = std::min(least, felt.thrust);
        most = std::max(most, felt.thrust);
        EXPECT_NEAR(signals_of<sawing::SawCutting>(felt.signals).vibration, 18 * 5.0, 2.0)
            << "18 teeth with 5 N along their motion";
    }
    EXPECT_LT(most - least, 0.01 * most) << "no beat of 200 Hz with the ticks";
}

// S-13: at rates that the ticks would alias, by a thousandth more or less.
TEST(SawOscillation, HasNoBeatWithTheTicks) {
    double first = 0.0;
    for (const double strokes : {249.75, 250.0, 250.25}) {
        Feeding saw(wide_block(), test::saw({{"stroke_rate", strokes}}));
        saw.to(5.0_mm);
        double least = 1e300, most = 0.0, sum = 0.0;
        for (int i = 0; i < 500; ++i) {
            const double thrust = saw.go(rate).thrust;
            least = std::min(least, thrust);
            most = std::max(most, thrust);
            sum += thrust;
        }
        EXPECT_LT(most - least, 0.02 * most) << strokes;
        if (first == 0.0) first = sum;
        EXPECT_NEAR(sum / first, 1.0, 0.01);
    }
}

// E03-4, 03-06: below 100 Hz the force is there at its phase, against the motion of the teeth, to and fro alike.
TEST(SawOscillation, Below100HzTheForceGoesAgainstTheTeeth) {
    const double strokes = 20.0;  // 50 ticks each
    Feeding saw(wide_block(), test::saw({{"stroke_rate", strokes}}));
    saw.to(5.0_mm, 2.0_mm_per_s);
    double sum = 0.0, most = 0.0, thrust = 0.0;
    int turns = 0;
    double last = 0.0;
    std::complex<double> at_rate{}, at_other{};
    constexpr int ticks = 500;
    for (int i = 0; i < ticks; ++i) {
        const Felt felt = saw.go(rate);
        const double along = felt.wrench[0];
        EXPECT_EQ(signals_of<sawing::SawCutting>(felt.signals).vibration, 0.0);
        sum += along;
        thrust += felt.thrust;
        most = std::max(most, std::abs(along));
        turns += last * along < 0.0;
        last = along;
        at_rate += along * std::polar(1.0, -2.0 * pi * strokes * i * saw.dt);
        at_other += along * std::polar(1.0, -2.0 * pi * 7.0 * i * saw.dt);
    }
    EXPECT_NEAR(most, 18 * 5.0, 9.0) << "as large as 18 teeth push";
    EXPECT_LT(std::abs(sum / ticks), 0.05 * most) << "in the mean none";
    EXPECT_NEAR(turns, 2.0 * strokes * ticks * saw.dt, 2.0);
    EXPECT_GT(std::abs(at_rate), 20.0 * std::abs(at_other)) << "swings at the strokes' rate";
    // And it works against the teeth: they go along +x of the blade while the swing grows.
    double against = 0.0;
    for (int i = 0; i < 50; ++i) {
        const double phase = 2.0 * pi * strokes * saw.dt * static_cast<double>(saw.simulation.ticks());
        against += in_tool(saw, saw.go(rate).wrench).x * std::cos(phase);
    }
    EXPECT_LT(against / 50.0, -0.4 * most);
    // And the thrust is in the mean what the averaged law would say.
    EXPECT_NEAR(thrust / ticks / exact_thrust(saw.setup, rate), 1.0, 0.05);
}

}  // namespace
}  // namespace kerf
