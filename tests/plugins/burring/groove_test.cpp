// SPDX-License-Identifier: Apache-2.0
// A burr of 4 mm makes a groove 1 mm deep: volume, entry and force against closed forms (validation C.1, C.7, 04-12).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/burr_rig.h"

namespace kerf {
namespace {

using namespace literals;
using burring::BurrCutting;
using test::BurrFelt;
using test::LedBurr;

constexpr double radius = test::ball, depth = 1.0_mm, feed = 0.5_mm_per_s;
constexpr double slot_area = 2.457e-6;  // [m²] R² acos((R − d)/R) − (R − d) √(2Rd − d²)
constexpr double entry = 1.732_mm;      // √(2Rd − d²)

/// Bone from x = 0 on, below z = 0.
Body bone_behind_an_edge(double spacing) {
    return test::block({0, -6.0_mm, -5.0_mm}, {12.0_mm, 6.0_mm, 0}, spacing, {0.31, 0.17, 0.73});
}
ToolSetup at_speed(double rpm) { return test::round_burr({{"spindle_speed", rpm * 1.0_rpm}}); }

TEST(Groove, HasTheSlotAreaOfValidation) {
    EXPECT_NEAR(radius * radius * std::acos(0.5) - depth * std::sqrt(2.0 * radius * depth - depth * depth), slot_area,
                0.0005e-6);
    EXPECT_NEAR(std::sqrt(2.0 * radius * depth - depth * depth), entry, 0.001_mm);
}

// V = A L + ½ π d² (3R − d)/3: the slot from the edge to the ball's centre, and the front half of the ball's cap. The
// field rounds the sharp edges of the groove: 0.5 % at 0.25 mm, and by the square of the spacing less.
TEST(Groove, LosesTheVolumeOfASphereGroove) {
    constexpr double length = 8.0_mm;
    const double exact = slot_area * length + 0.5 * pi * depth * depth * (3.0 * radius - depth) / 3.0;
    for (const double h : {0.2_mm, 0.125_mm}) {
        LedBurr burr(bone_behind_an_edge(h), at_speed(30000.0), {-3.0_mm, 0, radius - depth});
        burr.to({length, 0, radius - depth}, 5.0_mm_per_s);
        const double ratio = burr.removed() / exact;
        RecordProperty("volume_at_" + std::to_string(std::lround(h * 1e6)) + "_um", std::to_string(ratio));
        EXPECT_NEAR(ratio, 1.0, 0.005) << h;
    }
}

// C.7: the burr meets the edge 1.73 mm before its centre does, and from there on takes the whole slot.
TEST(Groove, IsEnteredOverTheEntryLength) {
    for (const double h : {0.5_mm, 0.25_mm, 0.125_mm}) {
        LedBurr burr(bone_behind_an_edge(h), at_speed(30000.0), {-2.5_mm, 0, radius - depth});
        const auto removed_at = [&](double x) {
            burr.to({x, 0, radius - depth}, 2.0_mm_per_s);
            return burr.removed();
        };
        EXPECT_EQ(removed_at(-entry - 0.5 * h), 0.0) << h;
        EXPECT_GT(removed_at(-entry + h), 0.0) << "within a voxel, on a grid of " << h;
        const auto area = [&](double from, double to) {
            const double before = removed_at(from);
            return (removed_at(to) - before) / (to - from);
        };
        // At −δ the front cuts a circle of √(R² − δ²): at 1 mm 1.732 mm, with a segment of 0.55 of the slot's.
        EXPECT_LT(area(-1.2_mm, -1.0_mm), 0.6 * slot_area);
        EXPECT_LT(area(-0.5_mm, -0.4_mm), 0.95 * slot_area);
        EXPECT_NEAR(area(h, h + 1.0_mm) / slot_area, 1.0, 0.02) << "from there on as wide as it gets, " << h;
    }
}

TEST(Groove, IsFeltOverTheEntryLength) {
    // Given a head of many points: of the few, the first comes to the edge 0.4 mm later
    LedBurr burr(bone_behind_an_edge(0.25_mm),
                 test::round_burr({{"spindle_speed", 30000.0_rpm}, {"edge_points", 336.0}}),
                 {-2.5_mm, 0, radius - depth});
    std::vector<double> at, force;
    while (burr.centre().x < 2.0_mm) {
        force.push_back(length(linear(burr.go({2.0_mm_per_s, 0, 0}).bone_on_tool)));
        at.push_back(burr.centre().x);
    }
    double steady = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < at.size(); ++i)
        if (at[i] > 0.8_mm) steady += force[i], ++count;
    steady /= count;
    const auto first = [&](double share) {
        for (std::size_t i = 0; i < at.size(); ++i)
            if (force[i] > share * steady) return at[i];
        return 1e9;
    };
    EXPECT_NEAR(first(0.001), -entry, 0.25_mm) << "one voxel";
    EXPECT_NEAR(first(0.98), 0.0, 0.25_mm);
}

// 04-12: a rise, then a steady force.
TEST(Groove, HasASteadyForceAfterItsEntry) {
    LedBurr burr(bone_behind_an_edge(0.25_mm), at_speed(22000.0), {-2.0_mm, 0, radius - depth});
    burr.to({1.0_mm, 0, radius - depth}, 2.0_mm_per_s);
    double sum = 0.0, squares = 0.0;
    constexpr int ticks = 8000;
    for (int i = 0; i < ticks; ++i) {
        const double force = length(linear(burr.go({feed, 0, 0}).bone_on_tool));
        sum += force / ticks;
        squares += force * force / ticks;
    }
    EXPECT_GT(sum, 1.0);
    EXPECT_LT(std::sqrt(std::max(0.0, squares - sum * sum)) / sum, 0.02) << "coefficient of variation, bar 0.1";
}

/// The force of a groove by the law itself, integrated over the front half of the cap in 400 × 400 pieces.
///
///     F = −(N/2π) ∫∫ (f_n(t) n + f_c(t) e) R dθ dφ,   t = v·n/(N u),   θ < 60°, −90° < φ < 90°
Vec3 exact_force(double rpm, double rate) {
    const auto law = defaults_of<BurrCutting>();
    const double blades = 6.0, blade_rate = blades * rpm * 1.0_rpm;
    constexpr int pieces = 400;
    Vec3 sum{};
    for (int i = 0; i < pieces; ++i)
        for (int j = 0; j < pieces; ++j) {
            const double theta = (i + 0.5) / pieces * pi / 3.0, phi = ((j + 0.5) / pieces - 0.5) * pi;
            const Vec3 normal{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), -std::cos(theta)};
            const Vec3 with_the_turn{std::sin(phi), -std::cos(phi), 0};  // clockwise as seen from above
            const double t = rate * normal.x / blade_rate;
            const double width = blades / (2.0 * pi) * radius * (pi / 3.0 / pieces) * (pi / pieces);
            sum = sum - width * (force_per_width(t, law.thrust()) * normal +
                                 force_per_width(t, law.cutting()) * with_the_turn);
        }
    return sum;
}

TEST(GrooveForce, IsTheLawOverTheFrontHalfOfTheCap) {
    for (const double rpm : {15000.0, 50000.0}) {
        const Vec3 exact = exact_force(rpm, feed);
        const auto error = [&](double points) {
            LedBurr burr(bone_behind_an_edge(0.125_mm),
                         test::round_burr({{"spindle_speed", rpm * 1.0_rpm}, {"edge_points", points}}),
                         {-2.0_mm, 0, radius - depth});
            burr.to({2.0_mm, 0, radius - depth}, 4.0_mm_per_s);
            const Vec3 force = linear(burr.mean({feed, 0, 0}, 400).wrench);
            return length(force - exact) / length(exact);
        };
        EXPECT_LT(error(336.0), 0.08) << rpm << ": blades of a sector of 60 deg take one chip";
        EXPECT_LT(error(84.0), 0.12) << rpm << ": points stand for parts of the head";
    }
}

TEST(GrooveForce, ConvergesWithThePoints) {  // P6
    double last = 0.0, last_change = 1.0;
    for (const double points : {84.0, 168.0, 336.0}) {
        double sum = 0.0;
        for (const double deep : {0.7_mm, 0.9_mm, 1.1_mm}) {
            LedBurr burr(bone_behind_an_edge(0.25_mm), test::round_burr({{"edge_points", points}}),
                         {-2.0_mm, 0, radius - deep});
            burr.to({2.0_mm, 0, radius - deep}, 4.0_mm_per_s);
            sum += length(linear(burr.mean({feed, 0, 0}, 200).wrench));
        }
        const double change = last > 0.0 ? std::abs(sum / last - 1.0) : 1.0;
        EXPECT_LT(change, last > 0.0 ? 0.06 : 2.0) << points << ": twice the points are not twice the force";
        last = sum;
        last_change = change;
    }
    EXPECT_LT(last_change, 0.03);
}

TEST(GrooveForce, FallsWithTheSpeedAtAFixedFeed) {  // 04-12, B.4
    double last = 1e300;
    for (const double rpm : {15000.0, 22000.0, 30000.0, 50000.0}) {
        LedBurr burr(bone_behind_an_edge(0.25_mm), at_speed(rpm), {-2.0_mm, 0, radius - depth});
        burr.to({2.0_mm, 0, radius - depth}, 4.0_mm_per_s);
        const BurrFelt felt = burr.mean({feed, 0, 0}, 400);
        const double force = length(linear(felt.wrench));
        RecordProperty("N_at_" + std::to_string(std::lround(rpm)), std::to_string(force));
        EXPECT_LT(force, 0.97 * last) << rpm;
        last = force;
    }
}

TEST(GrooveForce, ChangesMoreWithTheOrientationThanWithTheFeed) {  // B4-a
    const auto force = [](double lean, double rate) {
        LedBurr burr(bone_behind_an_edge(0.25_mm), at_speed(30000.0), {-2.0_mm, 0, radius - depth}, lean);
        burr.to({2.0_mm, 0, radius - depth}, 4.0_mm_per_s);
        return length(linear(burr.mean({rate, 0, 0}, 200).wrench));
    };
    double least = 1e300, most = 0.0;
    for (const double lean : {-60.0_deg, -45.0_deg, -30.0_deg, 0.0_deg, 30.0_deg, 45.0_deg, 60.0_deg}) {
        least = std::min(least, force(lean, feed));
        most = std::max(most, force(lean, feed));
    }
    const double by_orientation = most / least, by_feed = force(0.0, 4.0 * feed) / force(0.0, feed);
    RecordProperty("by_orientation", std::to_string(by_orientation));
    RecordProperty("by_four_times_the_feed", std::to_string(by_feed));
    EXPECT_GT(by_orientation, 2.0);
    EXPECT_GT(by_feed, 1.02) << "a weak chip term";
    EXPECT_GT(by_orientation, 1.3 * by_feed);
}

}  // namespace
}  // namespace kerf
