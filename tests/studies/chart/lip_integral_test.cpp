// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/drill/lip_integral.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kerf/units.hpp"
#include "tests/studies/papers/as_printed/printed_rig.h"

namespace kerf::chart {
namespace {

using namespace literals;

const Drill drill{5.4_mm, 118.0_deg, 0.15};
constexpr double per_lip = 60.0_um;

/// A law with one term, so sharp that its onset is nothing.
CuttingLaw bare() {
    CuttingLaw law;
    law.edge_depth = 1e-12;
    return law;
}

TEST(LipIntegral, EdgeThrustIsTheClosedForm) {  // C.3: F = 2 K_e (R − r_c)
    CuttingLaw law = bare();
    law.thrust.edge = 10.0_N_per_mm;
    const double thrust = -edge_wrench(drill, law, wholly_engaged(drill), 0.4, per_lip)[2];
    EXPECT_NEAR(thrust, 2.0 * 10.0 * (2.7 - 1e3 * drill.chisel_radius()), 1e-4 /* eight Gauss points: 3e-7 */);
}

TEST(LipIntegral, ChipTorqueIsTheClosedForm) {  // C.2: T = k_t f (R² − r_c²)/2
    CuttingLaw law = bare();
    law.cutting.chip = 1000.0_N_per_mm2;
    const double r_c = 1e3 * drill.chisel_radius();
    const double torque = -1e3 * edge_wrench(drill, law, wholly_engaged(drill), 0.4, per_lip)[5];
    EXPECT_NEAR(torque, 1000.0 * 0.12 * (2.7 * 2.7 - r_c * r_c) / 2.0, 1e-6);
}

TEST(LipIntegral, ChiselThrustGoesWithItsLength) {
    CuttingLaw law = bare();
    law.chisel.chip = 1000.0_N_per_mm2;
    const double thrust = -edge_wrench(drill, law, wholly_engaged(drill), 0.4, per_lip)[2];
    EXPECT_NEAR(thrust, 1000.0 * 0.06 * 2.0 * 1e3 * drill.chisel_radius(), 1e-6);
}

TEST(LipIntegral, TwoLipsInOneTissueDoNotPushSideways) {  // C.6
    const Vec6 wrench = edge_wrench(drill, test::shared_law(), wholly_engaged(drill), 0.7, per_lip);
    EXPECT_LT(std::hypot(wrench[0], wrench[1]), 1e-12 * std::abs(wrench[2]));
    EXPECT_LT(std::hypot(wrench[3], wrench[4]), 1e-12 * std::abs(wrench[5]));
}

TEST(LipIntegral, OneLipKeepsTheLengthOfItsForces) {  // P1: what E00-1 loses
    CuttingLaw law = bare();
    law.thrust.edge = 1.0;
    Engaged engaged;
    const Span span = span_of(drill, 0);
    const double ds = 1e-7 * (span.to - span.from);
    engaged[0].push_back({span.to - ds, span.to, 1.0});
    const Vec6 wrench = edge_wrench(drill, law, engaged, 0.0, per_lip);
    const double sin_p = std::sin(59.0_deg),
                 cos_i = std::sqrt(1.0 - std::pow(drill.half_web() / drill.radius() * sin_p, 2));
    EXPECT_NEAR(length(linear(wrench)) / (ds * cos_i / sin_p), 1.0, 1e-6) << "force per width of cut";
}

TEST(LipIntegral, TheSharedLawIsFoundByName) {
    EXPECT_NEAR(test::shared_law().thrust.edge, 27.163_N_per_mm, 1e-3);
    EXPECT_FALSE(cutting_law_of({}).has_value());
}

}  // namespace
}  // namespace kerf::chart
