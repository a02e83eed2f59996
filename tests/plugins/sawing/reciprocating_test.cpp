// SPDX-License-Identifier: Apache-2.0
// The reciprocating saw fed through bone at a prescribed rate, against the law's closed form and against what is
// measured (validation A.5, B.3, C.1, C.7).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "plugins/sawing/reciprocating_force.h"
#include "plugins/sawing/saw_force.h"
#include "tests/support/loop_guard.h"
#include "tests/support/rig.h"
#include "tests/support/saw_rig.h"

namespace kerf {
namespace {

using namespace literals;
using sawing::ReciprocatingBlade;
using sawing::ReciprocatingCutting;
using sawing::ReciprocatingSignals;
using sawing::StraightBlade;
using sawing::Stroke;

constexpr double rate = 1.0_mm_per_s;

// Ten teeth 2 mm apart that move by 4 mm: round numbers, to check by hand.
std::map<std::string, double> ten_teeth(const std::map<std::string, double>& more = {}) {
    std::map<std::string, double> set{{"blade_length", 20.0_mm}, {"tooth_pitch", 2.0_mm}, {"stroke", 4.0_mm}};
    for (const auto& [key, value] : more) set[key] = value;
    return set;
}
Body wide_block(double spacing = 0.5_mm) {
    return test::block({-16.0_mm, -4.0_mm, -12.0_mm}, {16.0_mm, 4.0_mm, 0}, spacing, {0.31, 0.17, 0.73});
}

struct Felt {
    Vec6 wrench{};  ///< bone on saw, world frame, about the tip
    double thrust = 0.0;
    ReciprocatingSignals signals;
};

/// A saw on its way straight down, turned about its feed by `about`.
struct Feeding {
    Body body;
    ToolSetup setup;
    double about, depth = -1.0_mm, dt;
    Vec3 aside;
    Simulation simulation;

    explicit Feeding(Body bone, ToolSetup saw, double period = Simulation::dt, double turned = 0.0,
                     Vec3 points_around = {})
        : body(std::move(bone)),
          setup(std::move(saw)),
          about(turned),
          dt(period),
          aside(points_around),
          simulation(body, setup, test::outline(setup), test::gains(), pose(), period) {}

    [[nodiscard]] Pose pose() const {
        Pose p = test::at_depth(depth, 0.0, aside);
        p.rotation = p.rotation * quat_from_rotation_vector({0, 0, about});
        return p;
    }
    Felt go(double feed) {
        depth += feed * dt;
        const TickResult r = simulation.tick_direct({pose()});
        EXPECT_FALSE(r.is_quarantined);
        return {r.bone_on_tool, r.thrust, signals_of<ReciprocatingCutting>(simulation.signals())};
    }
    Felt to(double target, double feed = 8.0_mm_per_s) {
        Felt last;
        while (depth < target - 1e-12) last = go(std::min(feed, (target - depth) / dt));
        return last;
    }
    /// The averages over some ticks.
    Felt mean(double feed, int ticks) {
        Felt sum;
        for (int i = 0; i < ticks; ++i) {
            const Felt one = go(feed);
            for (std::size_t c = 0; c < 6; ++c) sum.wrench[c] += one.wrench[c] / ticks;
            sum.thrust += one.thrust / ticks;
            sum.signals.chip_thickness += one.signals.chip_thickness / ticks;
            sum.signals.engaged_teeth += one.signals.engaged_teeth / ticks;
            sum.signals.tooth_force += one.signals.tooth_force / ticks;
            sum.signals.vibration += one.signals.vibration / ticks;
            sum.signals.drive_power += one.signals.drive_power / ticks;
        }
        return sum;
    }
};

/// The thrust of the saw at this feed, all its teeth in cortical bone, averaged over the true oscillation [N].
double exact_thrust(const ToolSetup& setup, double feed) {
    const StraightBlade blade = value_of<ReciprocatingBlade>(setup.tool_parameters).blade();
    const auto k = value_of<ReciprocatingCutting>(setup.force_parameters).thrust();
    const Stroke stroke{blade.stroke(), blade.pitch, setup.drives[0]};
    constexpr int steps = 2000;
    double sum = 0.0;
    for (int s = 0; s < steps; ++s)
        sum += force_per_width(feed * sawing::chip_per_feed(stroke, std::cos((s + 0.5) / steps * 0.5 * pi)), k) / steps;
    return sum * blade.kerf() * static_cast<double>(blade.count());
}
/// The saw with all its teeth in bone at an average chip of `chip` [m].
Felt at_chip(double chip, const std::map<std::string, double>& set = {}) {
    const ToolSetup setup = test::reciprocating_saw(ten_teeth(set));
    const StraightBlade blade = value_of<ReciprocatingBlade>(setup.tool_parameters).blade();
    Feeding saw(wide_block(), setup);
    saw.to(4.0_mm);
    return saw.mean(chip / sawing::mean_chip_per_feed({blade.stroke(), blade.pitch, setup.drives[0]}), 20);
}

// ---- the law of a tooth, through the whole loop ---------------------------------------------------------------------

// 2 mm/s, 2 mm, S = 4 mm, 250/s: at the mean speed of 2 m/s, t = f p/(2 S u) = 2 µm.
TEST(ReciprocatingThrust, MeetsTheHandCheckedNumbers) {
    const Stroke stroke{4.0_mm, 2.0_mm, 250.0};
    EXPECT_NEAR(stroke.mean_speed(), 2.0, 1e-12) << "4 A F with the amplitude A = S/2 (04-02)";
    EXPECT_NEAR(2.0_mm_per_s * sawing::chip_per_feed(stroke, 2.0 / pi), 2.0_um, 1e-12);
    // One tooth, kerf 1 mm, at 2 µm: 6.57 (1 − e^−5) + 238 · 0.002 = 6.526 + 0.476
    const auto law = defaults_of<ReciprocatingCutting>();
    EXPECT_NEAR(1.0_mm * force_per_width(2.0_um, law.thrust()), 7.002, 0.001);
    EXPECT_NEAR(1.0_mm * force_per_width(2.0_um, law.cutting()), 4.966, 0.001);
}

TEST(ReciprocatingThrust, IsThatOfAllTeethOverTheStroke) {
    const ToolSetup setup = test::reciprocating_saw(ten_teeth());
    for (const double feed : {0.1_mm_per_s, 1.0_mm_per_s, 6.0_mm_per_s}) {
        Feeding saw(wide_block(), setup);
        saw.to(4.0_mm);
        const Felt felt = saw.mean(feed, 50);
        EXPECT_NEAR(felt.thrust / exact_thrust(setup, feed), 1.0, 0.035 /* two parts stand for the stroke */) << feed;
        EXPECT_NEAR(felt.signals.engaged_teeth, 10.0, 1e-9);
    }
}

TEST(ReciprocatingThrust, OfOneToothEqualsTheOscillatingSaws) {
    // Given both saws with the same pitch, stroke and rate, all teeth in bone
    const double arc = 4.0 / 60.0;
    const std::map<std::string, double> arc_saw{
        {"arc", arc}, {"tooth_pitch", 2.0_mm}, {"tooth_count", 10.0}, {"stroke_rate", 250.0}};
    test::Rig oscillating(wide_block(), test::saw(arc_saw), test::at_depth(-1.0_mm));
    (void)oscillating.feed(-1.0_mm, 4.0_mm, 8.0_um);
    (void)oscillating.feed(4.0_mm, 4.1_mm, 2.0_um);
    Feeding saw(wide_block(), test::reciprocating_saw(ten_teeth()));
    saw.to(4.0_mm);
    // Then a tooth feels the same, but for the slant of the arc's teeth
    EXPECT_NEAR(signals_of<sawing::SawCutting>(oscillating.signals()).tooth_force /
                    saw.mean(2.0_mm_per_s, 20).signals.tooth_force,
                1.0, 0.01);
}

TEST(ReciprocatingThrust, OfOneToothLiesWhereItWasMeasured) {  // B3-a
    double last = 0.0;
    for (const double chip : {2.5_um, 5.0_um, 10.0_um}) {
        const Felt felt = at_chip(chip);
        EXPECT_NEAR(felt.signals.chip_thickness, chip, 0.01_um);
        const double resultant =
            std::hypot(felt.signals.tooth_force, felt.signals.vibration / felt.signals.engaged_teeth);
        EXPECT_GE(resultant, 8.0) << chip;
        EXPECT_LE(resultant, 11.0) << chip;
        EXPECT_GT(resultant, last) << "higher at greater depth";
        last = resultant;
    }
}

TEST(ReciprocatingThrust, GrowsByThreeTenthsFromTwoToTenMicrometres) {  // B3-b
    const Felt thin = at_chip(2.0_um), thick = at_chip(10.0_um);
    EXPECT_NEAR(thick.thrust / thin.thrust, 1.3, 0.1);
    EXPECT_NEAR(thick.signals.vibration / thin.signals.vibration, 1.0, 0.1) << "the cutting force does not";
}

TEST(ReciprocatingThrust, DoesNotDependOnTheSpeedAtAFixedChip) {  // B3-c: 0.8 to 3.3 m/s
    double least = 1e300, most = 0.0;
    for (const double strokes : {6000.0_rpm, 12000.0_rpm, 25000.0_rpm}) {
        const double thrust = at_chip(5.0_um, {{"stroke_rate", strokes}}).thrust;
        least = std::min(least, thrust);
        most = std::max(most, thrust);
    }
    EXPECT_GT(least, 50.0);
    EXPECT_NEAR(most / least, 1.0, 0.05);
}

TEST(ReciprocatingThrust, IsOneAndAHalfTimesTheCuttingForceOrSo) {  // B3-d
    for (const double chip : {2.5_um, 5.0_um, 10.0_um}) {
        const Felt felt = at_chip(chip);
        EXPECT_GE(felt.thrust / felt.signals.vibration, 1.4) << chip;
        EXPECT_LE(felt.thrust / felt.signals.vibration, 1.8) << chip;
    }
}

TEST(ReciprocatingThrust, AtTheAdvanceOfACycleIsALittleLighterNotHalf) {  // B3-e: 3.75, 3.0 and 2.0 µm
    const double slow = at_chip(3.75_um).thrust, middle = at_chip(3.0_um).thrust, fast = at_chip(2.0_um).thrust;
    EXPECT_NEAR(slow / fast, 1.07, 0.02);
    EXPECT_NEAR(middle / fast, 1.04, 0.02);
}

TEST(ReciprocatingThrust, FallsWithTheRateAtAFixedFeed) {  // 04-11
    double last = 1e300;
    for (const double strokes : {8000.0_rpm, 10000.0_rpm, 15000.0_rpm}) {
        Feeding saw(wide_block(), test::reciprocating_saw(ten_teeth({{"stroke_rate", strokes}})));
        saw.to(4.0_mm);
        const double thrust = saw.mean(0.5_mm_per_s, 100).thrust;
        RecordProperty("N_at_" + std::to_string(std::lround(60.0 * strokes)), std::to_string(thrust));
        EXPECT_LT(thrust, last - 0.5) << "N, at " << strokes;
        last = thrust;
    }
    EXPECT_GT(last, 5.0);
}

TEST(ReciprocatingThrust, RisesAtItsEntryAndThenLevels) {  // 04-11: the plateau's coefficient of variation
    Feeding saw(wide_block(), test::reciprocating_saw(ten_teeth()));
    saw.to(-0.2_mm);
    std::vector<double> thrust;
    for (int i = 0; i < 4000; ++i) thrust.push_back(saw.go(0.5_mm_per_s).thrust);
    EXPECT_EQ(thrust.front(), 0.0) << "in air";
    double sum = 0.0, squares = 0.0;
    for (int i = 2000; i < 4000; ++i) {
        const double one = thrust[static_cast<std::size_t>(i)];
        sum += one / 2000.0;
        squares += one * one / 2000.0;
    }
    EXPECT_GT(sum, 10.0);
    EXPECT_LT(std::sqrt(std::max(0.0, squares - sum * sum)) / sum, 0.1);
}

TEST(ReciprocatingThrust, RisesWithTheFeedAtAFixedRate) {
    double last = 0.0;
    Feeding saw(wide_block(), test::reciprocating_saw(ten_teeth()));
    saw.to(4.0_mm);
    for (const double feed : {0.1_mm_per_s, 0.3_mm_per_s, 1.0_mm_per_s, 3.0_mm_per_s, 10.0_mm_per_s}) {
        const double thrust = saw.mean(feed, 50).thrust;
        EXPECT_GT(thrust, last + 1.0) << feed;
        last = thrust;
    }
}

TEST(ReciprocatingThrust, WithoutFeedThereIsNone) {  // P9
    Feeding saw(wide_block(), test::reciprocating_saw(ten_teeth()));
    saw.to(4.0_mm);
    for (int i = 0; i < 50; ++i) EXPECT_EQ(saw.go(0.0).thrust, 0.0);
}

TEST(ReciprocatingThrust, MeetsNothingOnTheWayBackInItsSlot) {  // S-12
    Feeding saw(wide_block(), test::reciprocating_saw(ten_teeth()));
    saw.to(5.0_mm, 2.0_mm_per_s);
    const double front = saw.depth;
    double most = 0.0;
    while (saw.depth > 3.0_mm) most = std::max(most, std::abs(saw.go(-20.0_mm_per_s).thrust));
    while (saw.depth < front - 22.0_um) most = std::max(most, std::abs(saw.go(20.0_mm_per_s).thrust));
    EXPECT_LT(most, 0.05);
    for (int i = 0; i < 40; ++i) most = std::max(most, saw.go(2.0_mm_per_s).thrust);
    EXPECT_GT(most, 50.0) << "the bottom is still there";
}

TEST(ReciprocatingThrust, IsTheSameInTicksOfAnyLength) {  // S-10: the law as printed would be eight times as large
    double first = 0.0;
    for (const double dt : {2e-3, 1e-3, 0.5e-3, 0.25e-3}) {
        Feeding saw(wide_block(), test::reciprocating_saw(ten_teeth()), dt);
        saw.to(4.0_mm);
        const double thrust = saw.mean(rate, static_cast<int>(0.1 / dt)).thrust;
        if (first == 0.0) first = thrust;
        EXPECT_NEAR(thrust / first, 1.0, 1e-3) << dt;
    }
}

TEST(ReciprocatingThrust, HardlyDependsOnTheSpacing) {
    const auto at = [](double h) {
        Feeding saw(wide_block(h), test::reciprocating_saw(ten_teeth()));
        saw.to(4.0_mm);
        return saw.mean(rate, 50).thrust;
    };
    EXPECT_NEAR(at(0.5_mm) / at(0.25_mm), 1.0, 0.005);
}

// ---- frames, mirrors, strokes ---------------------------------------------------------------------------------------

TEST(ReciprocatingThrust, TurnsWithTheSaw) {
    // Given nine teeth: one of them has no neighbour and pushes across the blade
    const auto felt = [](double about) {
        Feeding saw(test::block({-16.0_mm, -16.0_mm, -8.0_mm}, {16.0_mm, 16.0_mm, 0}, 0.5_mm, {0.31, 0.17, 0.73}),
                    test::reciprocating_saw(ten_teeth({{"blade_length", 18.0_mm}})), Simulation::dt, about);
        saw.to(4.0_mm);
        return saw.mean(rate, 100).wrench;
    };
    const Vec6 straight = felt(0.0), quarter = felt(90.0_deg), half = felt(180.0_deg);
    const double one = 0.1 * straight[2] / 9.0;
    EXPECT_NEAR(quarter[2] / straight[2], 1.0, 0.01);
    EXPECT_NEAR(std::abs(straight[1]), one, 0.03 * one) << "a tenth of a tooth's thrust";
    EXPECT_NEAR(std::abs(quarter[0]), one, 0.03 * one);
    EXPECT_NEAR(half[1], -straight[1], 0.03 * one) << "seen in the mirror";
    EXPECT_NEAR(straight[0], 0.0, 0.02 * one);
}

TEST(ReciprocatingThrust, BoneUnderOneEndPushesThatEndBack) {
    // Given bone under three teeth at either end: the torque about y of the tool is x |f_z|
    double torque[2];
    for (const int end : {0, 1}) {
        const double sign = end == 0 ? 1.0 : -1.0;
        const Body bone =
            test::block({std::min(sign * 4.0_mm, sign * 30.0_mm), -4.0_mm, -9.0_mm},
                        {std::max(sign * 4.0_mm, sign * 30.0_mm), 4.0_mm, 0}, 0.25_mm, {0.31, 0.17, 0.73});
        Feeding saw(bone, test::reciprocating_saw(ten_teeth()));
        const Vec3 x = rotate(saw.simulation.world_from_tool().rotation, {1, 0, 0});
        saw.to(4.0_mm, 4.0_mm_per_s);
        const Felt felt = saw.mean(rate, 50);
        EXPECT_NEAR(felt.signals.engaged_teeth, 3.0, 0.05);
        const Vec3 in_tool = rotate(conjugate(saw.simulation.world_from_tool().rotation), angular(felt.wrench));
        torque[end] = in_tool.y * x.x;
        // The three outer teeth of ten: at 5, 7 and 9 mm
        EXPECT_NEAR(torque[end], sign * felt.thrust * 7.0_mm, 0.02 * felt.thrust * 7.0_mm) << end;
    }
    EXPECT_NEAR(torque[0], -torque[1], 0.01 * torque[0]) << "the mirrored scene has the mirrored torque";
}

TEST(ReciprocatingStroke, CutsBothWays) {  // 04-03, P10
    const double strokes = 20.0;
    Feeding saw(wide_block(), test::reciprocating_saw(ten_teeth({{"stroke_rate", strokes}})));
    saw.to(4.0_mm, 2.0_mm_per_s);
    double thrust[2] = {}, along[2] = {};
    int ticks[2] = {};
    for (int i = 0; i < 500; ++i) {
        const double phase = 2.0 * pi * strokes * saw.dt * static_cast<double>(saw.simulation.ticks());
        const bool is_back = std::cos(phase) < 0.0;
        const Felt felt = saw.go(rate);
        const Vec3 in_tool = rotate(conjugate(saw.simulation.world_from_tool().rotation), linear(felt.wrench));
        thrust[is_back] += felt.thrust;
        along[is_back] += in_tool.x;
        ++ticks[is_back];
    }
    EXPECT_NEAR(ticks[0], 250, 10);
    const double to = thrust[0] / ticks[0], fro = thrust[1] / ticks[1];
    EXPECT_NEAR(to / fro, 1.0, 0.02) << "both strokes cut";
    EXPECT_LT(along[0] / ticks[0], -25.0) << "N: against the teeth as they move along +x";
    EXPECT_GT(along[1] / ticks[1], 25.0) << "and as they move back";
}

TEST(ReciprocatingStroke, HasNoBeatWithTheTicks) {  // S-13
    double first = 0.0;
    for (const double strokes : {249.75, 250.0, 250.25}) {
        Feeding saw(wide_block(), test::reciprocating_saw(ten_teeth({{"stroke_rate", strokes}})));
        saw.to(4.0_mm);
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

// C.7: N = ⌊ℓ/p⌋ or one more; peak to peak over the mean is 1/N.
TEST(ReciprocatingStroke, RipplesByOneToothInThoseInBone) {
    // Given bone 9 mm wide, 4.5 pitches, and a saw so slow that each stroke is felt
    const Body bone = test::block({-4.5_mm, -4.0_mm, -12.0_mm}, {4.5_mm, 4.0_mm, 0}, 0.25_mm, {0.31, 0.17, 0.73});
    Feeding saw(bone, test::reciprocating_saw(ten_teeth({{"stroke_rate", 10.0}})));
    saw.to(3.0_mm, 2.0_mm_per_s);
    double least = 1e300, most = 0.0, sum = 0.0;
    constexpr int ticks = 400;
    for (int i = 0; i < ticks; ++i) {
        const double teeth = saw.go(0.2_mm_per_s).signals.engaged_teeth;
        least = std::min(least, teeth);
        most = std::max(most, teeth);
        sum += teeth;
    }
    EXPECT_NEAR(least, 4.0, 0.05);
    EXPECT_NEAR(most, 5.0, 0.05);
    EXPECT_NEAR((most - least) / (sum / ticks), 1.0 / 4.5, 0.02);
}

TEST(ReciprocatingStroke, AveragedRipplesByHalfAToothAtMost) {
    // Given the same bone, and an averaged saw at nine positions along a pitch
    double least = 1e300, most = 0.0, sum = 0.0;
    for (int i = 0; i <= 8; ++i) {
        const Body bone = test::block({-4.5_mm, -4.0_mm, -12.0_mm}, {4.5_mm, 4.0_mm, 0}, 0.25_mm, {0.31, 0.17, 0.73});
        Feeding saw(bone, test::reciprocating_saw(ten_teeth()), Simulation::dt, 0.0, {i * 0.25_mm, 0, 0});
        saw.to(3.0_mm);
        const double thrust = saw.mean(rate, 20).thrust;
        least = std::min(least, thrust);
        most = std::max(most, thrust);
        sum += thrust / 9.0;
    }
    EXPECT_LE((most - least) / sum, 1.0 / 4.5 + 0.01) << "no more than the teeth themselves";
    EXPECT_GT(least, 10.0);
}

// ---- a rod, a tube --------------------------------------------------------------------------------------------------

// C.7, for a rod of 10 mm: ℓ = 2 √(2 R y − y²), N = ℓ/p.
TEST(ReciprocatingRod, HasAsManyTeethInBoneAsTheChordHoldsPitches) {
    constexpr double radius = 10.0_mm, feed = 8.0_mm_per_s;
    const ToolSetup setup = test::reciprocating_saw({{"blade_length", 30.0_mm}, {"tooth_pitch", 1.0_mm}});
    test::Rig simulation(test::tube(radius, -1.0, 3.0_mm, 0.25_mm), setup,
                         test::at_depth(-1.0_mm, 0.0, {0, 0, radius}));
    double worst = 0.0, most = 0.0;
    for (double depth = -1.0_mm; depth < 22.0_mm; depth += feed * Simulation::dt) {
        (void)simulation.tick_direct({test::at_depth(depth, 0.0, {0, 0, radius})});
        const double y = std::clamp(depth, 0.0, 2.0 * radius), chord = 2.0 * std::sqrt(2.0 * radius * y - y * y);
        const double teeth = signals_of<ReciprocatingCutting>(simulation.signals()).engaged_teeth;
        worst = std::max(worst, std::abs(teeth - chord / 1.0_mm));
        most = std::max(most, teeth);
    }
    RecordProperty("worst", std::to_string(worst));
    EXPECT_NEAR(most, 20.0, 1.0);
    EXPECT_LE(worst, 1.0) << "teeth";
    EXPECT_EQ(signals_of<ReciprocatingCutting>(simulation.signals()).engaged_teeth, 0.0) << "through";
}

// C.1: k π (R_o² − R_i²), 04-17.
TEST(ReciprocatingTube, LosesItsRingsAreaTimesTheKerf) {
    constexpr double outer = 13.0_mm, inner = 5.3_mm;
    for (const double h : {0.5_mm, 0.25_mm}) {
        test::Rig simulation(test::tube(outer, inner, 3.0_mm, h), test::reciprocating_saw(),
                             test::at_depth(-1.0_mm, 0.0, {0, 0, outer}));
        for (double depth = -1.0_mm; depth < 27.5_mm; depth += 20.0_mm_per_s * Simulation::dt)
            (void)simulation.tick_direct({test::at_depth(depth, 0.0, {0, 0, outer})});
        simulation.finish();
        const double exact = 1.0_mm * pi * (outer * outer - inner * inner);
        RecordProperty("volume_at_" + std::to_string(static_cast<int>(h * 1e6)) + "_um",
                       std::to_string(simulation.present().removed() / exact));
        EXPECT_NEAR(simulation.present().removed() / exact, 1.0, 1e-4) << "at " << h << ", a kerf of 1 mm";
    }
}

// ---- still, sound, real time ----------------------------------------------------------------------------------------

TEST(StillReciprocatingSaw, OnlyTouches) {  // P9, S-19
    test::Rig simulation(wide_block(0.25_mm), test::reciprocating_saw(ten_teeth({{"stroke_rate", 0.0}})),
                         test::at_depth(-0.5_mm));
    double work = 0.0, peak = 0.0, last = 0.0;
    for (int i = -100; i <= 300; ++i) {  // in by 0.1 mm and out again
        const double thrust = simulation.tick_direct({test::at_depth((i <= 100 ? i : 200 - i) * 1.0_um)}).thrust;
        work -= 0.5 * (last + thrust) * (i <= 100 ? 1.0_um : -1.0_um);
        peak = std::max(peak, thrust);
        last = thrust;
    }
    EXPECT_GT(peak, 5.0) << "N, at 0.1 mm";
    EXPECT_LT(peak, 500.0) << "finite";
    EXPECT_LE(work, 1e-3 * peak * 0.1_mm) << "it gives back no more than it took";
    simulation.finish();
    EXPECT_EQ(simulation.present().removed(), 0.0);
}

TEST(ReciprocatingLaw, BacksIntoBoneWithItsBackEdge) {
    // Given a saw above a block, its teeth up: the back edge meets the bone first
    test::Rig simulation(wide_block(0.25_mm), test::reciprocating_saw(ten_teeth({{"stroke_rate", 0.0}})),
                         test::pointing({0, 0, 11.0_mm}, {0, 0, 1}));
    double back = 0.0;
    for (double z = 11.0_mm; z > 9.9_mm; z -= 2.0_um)
        back = simulation.tick_direct({test::pointing({0, 0, z}, {0, 0, 1})}).bone_on_tool[2];
    EXPECT_GT(back, 5.0) << "N: it is stopped";
}

TEST(ReciprocatingLaw, IsSoundAnywhere) {
    for (const double strokes : {0.0, 20.0, 101.0, 250.0}) {
        test::Rig simulation(wide_block(), test::reciprocating_saw({{"stroke_rate", strokes}}),
                             test::at_depth(-1.0_mm));
        for (int i = 0; i < 2000; ++i) {
            const double t = 1e-3 * i;
            Pose pose = test::at_depth(4.0_mm * std::sin(3.0 * t), 0.3 * std::sin(5.0 * t),
                                       {3.0_mm * std::sin(7.0 * t), 2.0_mm * std::sin(2.0 * t), 0});
            pose.rotation =
                pose.rotation * quat_from_rotation_vector({0.2 * std::sin(4.0 * t), 0.0, 0.5 * std::sin(t)});
            const TickResult r = simulation.tick({pose});
            ASSERT_FALSE(r.is_quarantined) << strokes << " at tick " << i;
            for (const double w : r.bone_on_tool) ASSERT_TRUE(std::isfinite(w));
        }
    }
}

TEST(ReciprocatingLaw, NeitherAllocatesNorLocksNorThrows) {
    const ToolSetup setup = test::reciprocating_saw();
    const Body body = test::tube(5.0_mm, 3.0_mm, 5.0_mm, 0.25_mm);
    HapticLoop haptic{body, setup, test::outline(setup), test::gains(), test::at_depth(-1.0_mm, 0.0, {0, 0, 5.0_mm})};
    double bound = 0.0, cut = 0.0;
    for (int i = 0; i < 1500; ++i) {
        Pose pose = test::at_depth(std::min<double>(-1.0_mm + i * 10.0_um, 4.0_mm), 0.0, {0, 0, 5.0_mm});
        if (i > 700)
            pose.rotation = pose.rotation * quat_from_rotation_vector({0.3 * std::sin(0.02 * (i - 700)), 0, 0});
        const test::Forbidden before = test::forbidden_here();
        const TickResult result = haptic.tick({pose});
        ASSERT_EQ(test::forbidden_here(), before) << "tick " << i;
        const auto signals = signals_of<ReciprocatingCutting>(haptic.signals());
        bound = std::max(bound, signals.binding);
        cut = std::max(cut, result.thrust);
        haptic.make_room();
    }
    EXPECT_GT(cut, 5.0) << "it cut";
    EXPECT_GT(bound, 1.0) << "and was twisted until it bound";
}

}  // namespace
}  // namespace kerf
