// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/drill/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "kerf/units.hpp"
#include "studies/chart/drill/measure.h"

namespace kerf::chart {
namespace {

using namespace literals;

/// Edge forces alone, on the lips alone: thrust is K_e times the engaged length of radius.
CuttingLaw lips_only() {
    CuttingLaw law;
    law.edge_depth = 1e-12;
    law.thrust.edge = 10.0_N_per_mm;
    return law;
}

TEST(ExactForce, IsPiecewiseLinearThroughALayeredSlab) {  // C.4
    const Scene scene = slab_scene(0.0);
    const CuttingLaw law = lips_only();
    const double tan_p = std::tan(59.0_deg), radius = 2.7, r_c = 1e3 * scene.drill.chisel_radius();
    const auto by_hand = [&](double h) {  // [mm] → [N]
        double thrust = 0.0;
        const double face[] = {0.0, 4.0, 14.0, 18.0}, resistance[] = {1.0, 0.1, 1.0};
        for (int layer = 0; layer < 3; ++layer) {
            const double inner = std::clamp((h - face[layer + 1]) * tan_p, r_c, radius);
            const double outer = std::clamp((h - face[layer]) * tan_p, r_c, radius);
            thrust += 2.0 * 10.0 * resistance[layer] * (outer - inner);
        }
        return thrust;
    };
    ExactForce exact(scene, law);
    for (double h = 0.05; h < 19.8; h += 0.25) {
        const double thrust = -exact.wrench(scene.pose_at(h * 1e-3), scene.feed, 3.0 * h)[2];
        EXPECT_NEAR(thrust, by_hand(h), 1e-4 /* eight Gauss points */) << "at " << h << " mm";
    }
}

TEST(ExactForce, TheLipsImbalanceIsGreatestAsTheTiltSays) {  // C.5: (r_1 − r_2)/2R
    const double greatest[][2] = {{0.0, 0.0}, {10.0_deg, 0.23}, {20.0_deg, 0.38}};
    for (const auto& [tilt, expected] : greatest) {
        const Scene scene = slab_scene(tilt);
        const CuttingLaw law = lips_only();
        double most = 0.0;
        for (double h = -2.0; h < 4.0; h += 0.02)
            for (double angle = 0.0; angle < pi; angle += 0.05) {
                const Engaged engaged = exactly_engaged(scene.bone, scene.drill, law, scene.pose_at(h * 1e-3), angle);
                double reach[2] = {0.0, 0.0};
                for (int lip = 0; lip < 2; ++lip)
                    for (const Stretch& one : engaged[static_cast<std::size_t>(lip)]) reach[lip] += one.to - one.from;
                most = std::max(most, std::abs(reach[0] - reach[1]) / scene.drill.diameter);
            }
        EXPECT_NEAR(most, expected, 0.03) << "the chisel edge's part is not the lips'";
    }
}

TEST(ExactForce, BehindTheFrontThereIsNothingToCut) {  // S-12
    const Scene scene = slab_scene(0.0);
    const CuttingLaw law = lips_only();
    ExactForce exact(scene, law);
    EXPECT_LT(exact.wrench(scene.pose_at(3.0_mm), 8.0_mm_per_s, 0.0)[2], -1.0);
    EXPECT_EQ(exact.wrench(scene.pose_at(2.0_mm), 20.0_mm_per_s, 0.0)[2], 0.0);
    EXPECT_EQ(exact.wrench(scene.pose_at(3.0_mm), -8.0_mm_per_s, 0.0)[2], 0.0) << "nor on the way out";
    EXPECT_LT(exact.wrench(scene.pose_at(3.0_mm), 20.0_mm_per_s, 0.0)[2], -1.0) << "but beyond it";
}

TEST(ExactVolume, OfAHoleThroughATiltedSlabIsTheClosedForm) {  // C.1
    for (const double tilt : {0.0_deg, 10.0_deg, 30.0_deg}) {
        const Scene scene = slab_scene(tilt);
        const double expected = pi * 2.7 * 2.7 * 18.0 / std::cos(tilt);
        EXPECT_NEAR(exact_volume(scene, scene.depth.back()) * 1e9, expected, 1e-4 * expected);
    }
}

TEST(ExactVolume, OfABlindHoleIsTheClosedForm) {  // C.1
    const Scene scene = block_scene(slab_scene(0.0), 5.0_mm);
    const double expected = pi * 2.7 * 2.7 * (5.0 - 2.0 / 3.0 * 1e3 * scene.drill.point_depth());
    EXPECT_NEAR(exact_volume(scene, 5.0_mm) * 1e9, expected, 1e-3 * expected);
}

TEST(ExactVolume, OfAHoleThroughATubeIsTheClosedForm) {  // C.1
    const Scene scene = femur_scene();
    const double a = 2.25, outer = 13.0, inner = 5.3;
    double expected = 0.0;
    constexpr int n = 20000;
    for (int i = 0; i < n; ++i) {
        const double y = -a + (i + 0.5) * 2.0 * a / n;
        expected += 4.0 * std::sqrt(a * a - y * y) *
                    (std::sqrt(outer * outer - y * y) - std::sqrt(inner * inner - y * y)) * 2.0 * a / n;
    }
    double error = 0.0;
    EXPECT_NEAR(exact_volume(scene, scene.depth.back(), &error) * 1e9, expected, 1e-3 * expected);
    EXPECT_LT(error * 1e9, 1e-2 * expected);
}

}  // namespace
}  // namespace kerf::chart
