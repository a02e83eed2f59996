// SPDX-License-Identifier: Apache-2.0
#include "studies/papers/as_printed/volumetric_drilling.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/studies/papers/as_printed/printed_rig.h"

namespace kerf::as_printed {
namespace {

using namespace literals;

double size_of(const ObliqueForce& f) { return std::sqrt(f.r * f.r + f.c * f.c + f.e * f.e); }

// P1: a transform keeps the length of a force. Printed, it makes some.
TEST(VolumetricDrilling, EquationTwoMakesForceOutOfNothing) {  // E01-2
    const SinCos ten = sin_cos_exact(10.0_deg);
    EXPECT_NEAR(std::hypot(1.0, 0.4), 1.077, 0.001);
    EXPECT_NEAR(size_of(oblique_force(1.0, 0.4, ten, ten, ten)), 1.483, 0.001);
    EXPECT_NEAR(size_of(oblique_force_corrected(1.0, 0.4, ten, ten, ten)), 1.077, 0.001);
}

TEST(VolumetricDrilling, AnEdgeSquareToItsMotionShouldFeelNothingAlongItself) {
    const SinCos none = sin_cos_exact(0.0);
    EXPECT_EQ(oblique_force_corrected(1.0, 0.4, none, none, none).e, 0.0);
    EXPECT_EQ(oblique_force(1.0, 0.4, none, none, none).e, 1.0) << "printed";
}

// P4: the chip of two lips at 2 mm/s and 1000 rpm is 60 µm.
TEST(VolumetricDrilling, TheChipIsTooThinByTwoPi) {  // E01-3
    EXPECT_NEAR(chip_thickness(2.0_mm_per_s, 1000.0_rpm) * 2.0 * pi, 60.0_um, 1e-12);
}

TEST(VolumetricDrilling, PointsOneVoxelApartLeaveBoneStandingThatWasSwept) {  // E01-6, 01-07
    const chart::Scene scene = chart::slab_scene(0.0);
    const chart::Measured at = chart::measure(test::method("001"), scene, test::shared_law(), {0.5_mm, 31, {}}, 1);
    EXPECT_GT(at.volume_error, 0.1) << "of the hole";
    const chart::Measured swept = chart::measure(test::method("M2"), scene, test::shared_law(), {0.5_mm, 31, {}}, 1);
    EXPECT_LT(swept.volume_error, 0.05) << "by the same voxels, asked one by one";
}

TEST(VolumetricDrilling, OppositeLipsCancelSideways) {
    test::InTheBlock block("001", 0.25_mm);
    // Wear is random at the front; before any, in whole bone, lips are equal.
    chart::Scene scene = chart::block_scene(chart::slab_scene(0.0), 3.0_mm);
    scene.depth = {2.5_mm, 2.508_mm, 2.516_mm};
    const auto run = test::method("001").start(scene, {0.5_mm, 31, {}}, 1.0);
    (void)run->tick(scene.pose_at(scene.depth[1]));
    const Vec3 force = linear(run->tick(scene.pose_at(scene.depth[2])).wrench);
    EXPECT_LT(std::hypot(force.x, force.y), 1e-6 * std::abs(force.z));
}

}  // namespace
}  // namespace kerf::as_printed
