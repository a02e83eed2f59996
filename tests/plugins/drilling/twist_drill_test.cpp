// SPDX-License-Identifier: Apache-2.0
#include "plugins/drilling/twist_drill.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "kerf/units.hpp"

namespace kerf::drilling {
namespace {

using namespace literals;

const TwistDrill orthopaedic{
    .diameter = 5.4_mm, .point_angle = 118.0_deg, .web = 0.15, .length = 80.0_mm, .corner = 0.25};

// P1: every local → tool transform keeps lengths; the lip transform of [tsai-2007] as printed does not.
TEST(Lip, TheNormalOfTheCutIsAUnitVector) {
    const Lip lip = make_lip(orthopaedic, 0.1_mm);
    for (std::size_t i = 0; i < lip.count; ++i) {
        const LipElement& e = lip.element[i];
        EXPECT_NEAR(e.normal_axial * e.normal_axial + e.normal_radial * e.normal_radial, 1.0, 1e-9) << i;
    }
}

TEST(Lip, TheNormalIsAcrossTheLip) {
    // The lip at its own place runs (sin p cos β, sin p sin β, −cos p) in (r̂, t̂, ẑ).
    const double p = 59.0_deg;
    const Lip lip = make_lip(orthopaedic, 0.1_mm);
    for (std::size_t i = 0; i < lip.count; ++i) {
        const LipElement& e = lip.element[i];
        const double cos_beta = e.along / e.radius;
        EXPECT_NEAR(e.normal_radial * std::sin(p) * cos_beta - e.normal_axial * std::cos(p), 0.0, 1e-12);
    }
}

TEST(Lip, WidthTimesChipThicknessIsTheAreaBetweenTwoRadii) {
    // Σ width · n_z over one lip = R − r_c: the annulus it clears, whatever the web.
    const Lip lip = make_lip(orthopaedic, 0.01_mm);
    double cleared = 0.0;
    for (std::size_t i = 0; i < lip.count; ++i) cleared += lip.element[i].width * lip.element[i].normal_axial;
    EXPECT_NEAR(cleared, orthopaedic.radius() - orthopaedic.chisel_radius(), 2e-5_mm /* midpoint rule */);
}

TEST(Lip, LiesOnTheOutlineThatRemovesBone) {
    const Lip lip = make_lip(orthopaedic, 0.1_mm);
    for (std::size_t i = 0; i < lip.count; ++i)
        EXPECT_NEAR(-lip.element[i].z, lip.element[i].radius / std::tan(59.0_deg), 1e-12);
}

TEST(Lip, TheOtherLipIsHalfATurnAway) {
    const Lip lip = make_lip(orthopaedic, 0.1_mm);
    const Vec3 one = position_of(lip.element[5], orthopaedic.half_web(), 0.6, 0.8);
    const Vec3 other = position_of(lip.element[5], orthopaedic.half_web(), -0.6, -0.8);
    // half_web's offset turns with the lip only if the angle's sine and cosine turn together
    EXPECT_NEAR(one.x + other.x, 0.0, 1e-15);
    EXPECT_NEAR(one.y + other.y, 0.0, 1e-15);
    EXPECT_NEAR(std::hypot(one.x, one.y), lip.element[5].radius, 1e-15);
}

TEST(TwistDrill, ThePointIsAsDeepAsItsAngleSays) {
    EXPECT_NEAR(orthopaedic.point_depth(), 1.62_mm, 0.005_mm);  // C.4: 5.4 mm, 118°
}

}  // namespace
}  // namespace kerf::drilling
