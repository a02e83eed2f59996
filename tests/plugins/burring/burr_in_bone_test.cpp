// SPDX-License-Identifier: Apache-2.0
// Burrs in bone that is thinner or smaller than they are, and burrs of other shapes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/support/burr_rig.h"

namespace kerf {
namespace {

using namespace literals;
using test::LedBurr;

constexpr double radius = test::ball;

// S-11: the hole of a ball that goes right through a plate is a cylinder.
TEST(BurrThroughAPlate, LeavesARoundHole) {
    for (const double h : {0.25_mm, 0.125_mm}) {
        constexpr double thick = 1.0_mm;
        LedBurr burr(test::block({-6.0_mm, -6.0_mm, -thick}, {6.0_mm, 6.0_mm, 0}, h, {0.31, 0.17, 0.73}),
                     test::round_burr(), {0, 0, radius + 0.1_mm});
        burr.to({0, 0, -1.5_mm}, 2.0_mm_per_s);
        double behind = 0.0;
        for (int i = 0; i < 200; ++i)
            behind = std::max(behind, length(linear(burr.go({0, 0, -2.0_mm_per_s}).bone_on_tool)));
        EXPECT_LT(behind, 0.05) << "N, once the equator is through";
        EXPECT_NEAR(burr.removed() / (pi * radius * radius * thick), 1.0, 0.02) << h;
    }
}

// 5 N on a shell of 1 mm over air (S-15): what is left of it does not push back.
TEST(BurrThroughAPlate, IsFreeBehindIt) {
    LedBurr burr(test::block({-6.0_mm, -6.0_mm, -0.5_mm}, {6.0_mm, 6.0_mm, 0}, 0.125_mm, {0.31, 0.17, 0.73}),
                 test::round_burr(), {-9.0_mm, 0, radius - 1.0_mm});
    burr.to({0, 0, radius - 1.0_mm}, 2.0_mm_per_s);
    const auto felt = burr.mean({1.0_mm_per_s, 0, 0}, 500);
    EXPECT_LT(felt.signals.engagement, 0.12) << "only the plate, not what lies below it";
    EXPECT_GT(felt.signals.cutting_force, 0.2);
    const double slot_of_plate = burr.removed();
    EXPECT_GT(slot_of_plate, 0.0);
    EXPECT_TRUE(std::isfinite(slot_of_plate));
}

TEST(BurrLargerThanTheBone, TakesAllOfIt) {
    LedBurr burr(test::block({-1.0_mm, -1.5_mm, -3.0_mm}, {1.0_mm, 1.5_mm, 0}, 0.25_mm, {0.31, 0.17, 0.73}),
                 test::round_burr({{"diameter", 12.0_mm}, {"motor_torque", 0.5}}), {0, 0, 6.2_mm}, 0.0, Simulation::dt,
                 0.0, 6.0_mm);
    burr.to({0, 0, -1.0_mm}, 3.0_mm_per_s);
    EXPECT_NEAR(burr.removed() / (2.0 * 3.0 * 3.0 * 1e-9), 1.0, 0.02);
    EXPECT_EQ(length(linear(burr.go({0, 0, -1.0_mm_per_s}).bone_on_tool)), 0.0) << "nothing is left";
}

TEST(CylindricalBurr, PlanesAFaceByItsSide) {
    // Given a cylinder that lies along the face, half a millimetre deep: t L d is the volume per way
    test::Rig rig(test::block({-8.0_mm, -8.0_mm, -5.0_mm}, {8.0_mm, 8.0_mm, 0}, 0.2_mm, {0.31, 0.17, 0.73}),
                  test::burr_of("cylindrical_burr"), test::pointing({-12.0_mm, 4.0_mm, 1.5_mm}, {0, 1, 0}));
    double force = 0.0;
    int count = 0;
    for (double x = -12.0_mm; x < 4.0_mm; x += 2.0_um) {
        const TickResult r = rig.tick_direct({test::pointing({x, 4.0_mm, 1.5_mm}, {0, 1, 0})});
        if (x < 0.0) continue;
        force += length(linear(r.bone_on_tool));
        ++count;
    }
    EXPECT_GT(force / count, 1.0);
    rig.finish();
    // From the edge at −8 mm to the middle at 4 mm, its side of 8 mm less the corner, and the quarter in front of it.
    const double r = 2.0_mm, d = 0.5_mm;
    const double segment = r * r * std::acos((r - d) / r) - (r - d) * std::sqrt(2.0 * r * d - d * d);
    const double exact = 8.0_mm * (12.0_mm * d + 0.5 * segment);
    EXPECT_NEAR(rig.present().removed() / exact, 1.0, 0.02);
}

TEST(PearBurr, CutsWithBothItsBallAndItsCone) {
    const auto force = [](Vec3 along, Vec3 from, Vec3 way) {
        test::Rig rig(test::block({-8.0_mm, -8.0_mm, -6.0_mm}, {8.0_mm, 8.0_mm, 0}, 0.25_mm, {0.31, 0.17, 0.73}),
                      test::burr_of("pear_burr"), test::pointing(from, along));
        Vec3 at = from;
        double sum = 0.0;
        for (int i = 0; i < 6000; ++i) {
            at = at + 2e-6 * way;
            const TickResult r = rig.tick_direct({test::pointing(at, along)});
            if (i >= 5000) sum += length(linear(r.bone_on_tool)) / 1000.0;
        }
        rig.finish();
        EXPECT_GT(rig.present().removed(), 1e-9);
        return sum;
    };
    EXPECT_GT(force({0, 0, -1}, {-12.0_mm, 0, -1.0_mm}, {1, 0, 0}), 1.0) << "upright";
    EXPECT_GT(force({0, 1, 0}, {-12.0_mm, 3.0_mm, 1.2_mm}, {1, 0, 0}), 1.0) << "lying";
}

}  // namespace
}  // namespace kerf
