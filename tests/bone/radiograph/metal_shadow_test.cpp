// SPDX-License-Identifier: Apache-2.0
#include "bone/radiograph/metal_shadow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/bone/radiograph/shapes.h"

namespace kerf::bone {
namespace {

using namespace literals;
using test::middle_pixel;
using test::through_origin;

const test::Mesh rod = test::cylinder(3.0_mm, 20.0_mm, 64);

std::vector<float> shadow_of(const MetalShape& shape, const Beam& beam) {
    return metal_shadow(std::span(&shape, 1), beam);
}

TEST(MetalShadow, GivesTheThicknessOfACylinder) {
    // Chords of 64 sides are at most r (1 − cos(π/64)) inside the circle, on either side.
    const double chords = 2.0 * 3.0_mm * (1.0 - std::cos(std::numbers::pi / 64)) * titanium_attenuation;
    const Beam beam = through_origin(0.0, 0.0);
    const std::vector<float> across = shadow_of(rod.shape(), beam);
    EXPECT_NEAR(across[middle_pixel], 6.0_mm * titanium_attenuation, chords + 1e-5);

    // A ray at the angle a to the axis of the beam passes the axis at 0.65 sin a.
    for (const std::size_t beside : {3u, 6u, 9u, 12u}) {
        const double angle = std::atan(static_cast<double>(beside) * beam.pixel());
        const double distance = 0.65 * std::sin(angle), chord = 2.0 * std::sqrt(9e-6 - distance * distance);
        const double slope = 2.0 * distance / chord * 4.0;  // the chord grows with the error of the radius
        EXPECT_NEAR(across[middle_pixel + beside], chord * titanium_attenuation, (1.0 + slope) * chords) << beside;
    }
    EXPECT_EQ(across[middle_pixel + 40], 0.0f);

    const std::vector<float> along = shadow_of(rod.shape(), through_origin(0.0, 0.5 * std::numbers::pi));
    EXPECT_NEAR(along[middle_pixel], 40.0_mm * titanium_attenuation, 1e-4);
    const Pose turned{{0, 0, 0}, quat_from_rotation_vector({0, 0.6, 0})};
    EXPECT_NEAR(shadow_of(rod.shape(turned), beam)[middle_pixel], 6.0_mm * titanium_attenuation, chords + 1e-5);
    EXPECT_NEAR(shadow_of(rod.shape(identity_pose(), steel_attenuation), beam)[middle_pixel] / across[middle_pixel],
                steel_attenuation / titanium_attenuation, 1e-4 /* sums are float */);
}

TEST(MetalShadow, LeavesNoPixelOutAndNoneBeside) {
    // A sum over a closed surface is 0 outside, and everywhere as smooth as the chord.
    const Pose oblique{{1.3_mm, 0, -2.0_mm}, quat_from_rotation_vector({0.4, 0.3, 0.7})};
    const Beam beam = through_origin(0.3, 0.2);
    const std::vector<float> shadow = shadow_of(rod.shape(oblique), beam);
    double volume = 0.0;
    for (std::size_t i = 0; i < shadow.size(); ++i) {
        const Vec3 ray = beam.pixel_centre(static_cast<int>(i % 513), static_cast<int>(i / 513)) - beam.source;
        // A pixel is this large at the rod, seen along its ray.
        const double cosine = 1.0 / length(ray), at_rod = beam.pixel() * 0.65;
        volume += static_cast<double>(shadow[i]) / titanium_attenuation * at_rod * at_rod * cosine;
        ASSERT_LT(shadow[i], 41.0_mm * titanium_attenuation);
    }
    const double sides = 64.0 / 2.0 * std::sin(2.0 * std::numbers::pi / 64) * 9e-6;
    EXPECT_NEAR(volume / (sides * 40.0_mm), 1.0, 0.03 /* depth of ± 20 mm at 650 mm, to first order */);
}

TEST(MetalShadow, TakesMirroredDetectors) {
    Beam beam = through_origin(0.0, 0.0);
    const float straight = shadow_of(rod.shape(), beam)[middle_pixel];
    ASSERT_GT(straight, 1.0f);
    beam.right = -beam.right;
    EXPECT_FLOAT_EQ(shadow_of(rod.shape(), beam)[middle_pixel], straight);
}

TEST(MetalShadow, CutsWhatLiesAtTheSourceOrBehindTheDetector) {
    const Beam beam = through_origin(0.0, 0.0);
    // Along the beam, through the source: from 2 % of 1 m to the end at −0.5 + 0.65 m.
    const test::Mesh bar = test::cylinder(3.0_mm, 300.0_mm, 32);
    const Quat along_y = quat_between({0, 0, 1}, {0, 1, 0});
    const std::vector<float> at_source = shadow_of(bar.shape({{0, -0.8, 0}, along_y}), beam);
    EXPECT_NEAR(at_source[middle_pixel], (0.15 - 0.02) * titanium_attenuation, 1e-3);
    const std::vector<float> at_detector = shadow_of(bar.shape({{0, 0.35, 0}, along_y}), beam);
    EXPECT_NEAR(at_detector[middle_pixel], 0.3 * titanium_attenuation, 1e-3);
    for (const double y : {-1.2, 0.9}) {
        const std::vector<float> outside = shadow_of(bar.shape({{0, y, 0}, along_y}), beam);
        EXPECT_EQ(*std::max_element(outside.begin(), outside.end()), 0.0f) << y;
    }
}

TEST(MetalShadow, LeavesInvalidTrianglesOut) {
    test::Mesh mesh = rod;
    mesh.triangles.push_back({0, 1, 100000});
    mesh.triangles.push_back({5, 5, 5});
    const auto nan_at = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back({std::numeric_limits<float>::quiet_NaN(), 0, 0});
    mesh.positions.push_back({std::numeric_limits<float>::max(), 0, 0});
    mesh.triangles.push_back({0, 1, nan_at});
    mesh.triangles.push_back({0, 1, nan_at + 1});
    const Beam beam = through_origin(0.0, 0.0);
    EXPECT_EQ(shadow_of(mesh.shape(), beam)[middle_pixel], shadow_of(rod.shape(), beam)[middle_pixel]);

    const Pose nowhere{{std::numeric_limits<double>::infinity(), 0, 0}, {1, 0, 0, 0}};
    EXPECT_EQ(shadow_of(rod.shape(nowhere), beam)[middle_pixel], 0.0f);
    Beam flat = beam;
    flat.width = 0.0;
    EXPECT_TRUE(shadow_of(rod.shape(), flat).empty());
}

}  // namespace
}  // namespace kerf::bone
