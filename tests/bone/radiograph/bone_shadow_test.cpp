// SPDX-License-Identifier: Apache-2.0
#include "bone/radiograph/bone_shadow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/bone/radiograph/plain_rays.h"
#include "tests/bone/radiograph/shapes.h"

namespace kerf::bone {
namespace {

using namespace literals;
using test::Bone;
using test::middle_pixel;
using test::through_origin;
constexpr double quarter = 0.5 * std::numbers::pi;

AttenuationImage image_of(const Bone& bone, double half, int voxels) {
    AttenuationImage image = AttenuationImage::around(test::cube(half), {.voxels = voxels});
    image.update(std::vector{bone.at()});
    return image;
}

/// Rounding of the voxels at the two faces of a path [–]: half a step each.
double rounding(const AttenuationImage& image) { return AttenuationImage::step * image.spacing(); }

Body block_of(double half) {
    Body body = test::block({-half, -half, -half}, {half, half, half}, 0.5_mm);
    body.materials[0].density = test::bone_density;
    return body;
}

TEST(BoneShadow, GivesTheExactDepthOfASphere) {
    const AttenuationImage image = image_of(Bone(test::ball(15.0_mm, 0.5_mm)), 16.0_mm, 80);
    for (const auto& [about, tilt] : {std::pair{0.0, 0.0}, {quarter, 0.0}, {0.6, 0.4}}) {
        const BoneShadow shadow = bone_shadow(image, through_origin(about, tilt));
        ASSERT_EQ(shadow.error, "");
        // Between samples h apart, a surface of radius R lies h²/8R too deep along each of two axes: at both ends of
        // the path, in the field and again in the voxels.
        const double h2 = image.spacing() * image.spacing() + 0.5_mm * 0.5_mm;
        const double caps = test::excess * 4.0 * h2 / (8.0 * 15.0_mm);
        EXPECT_NEAR(shadow.bone[middle_pixel], test::excess * 30.0_mm, rounding(image) + caps) << about;
    }
}

TEST(BoneShadow, GivesTheExactDepthOfABox) {
    const AttenuationImage image = image_of(Bone(block_of(12.0_mm)), 14.0_mm, 64);
    const BoneShadow ap = bone_shadow(image, through_origin(0.0, 0.0));
    EXPECT_NEAR(ap.bone[middle_pixel], test::excess * 24.0_mm, rounding(image));
    // Along a diagonal of two faces, the path is √2 times as long.
    const BoneShadow diagonal = bone_shadow(image, through_origin(0.5 * quarter, 0.0));
    const double edges = test::excess * image.spacing();  // half a voxel of each is rounded off
    EXPECT_NEAR(diagonal.bone[middle_pixel], test::excess * 24.0_mm * std::sqrt(2.0), rounding(image) + edges);
}

TEST(BoneShadow, GivesTheExactDepthOfAHollowCylinder) {
    // Given a pipe along z, 10 mm and 6 mm wide in radius
    const Bone pipe(test::solid(20.0_mm, 0.5_mm, [](Vec3 p) {
        const double r = std::hypot(p.x, p.y);
        return std::max({r - 10.0_mm, 6.0_mm - r, std::abs(p.z) - 15.0_mm});
    }));
    const AttenuationImage image = image_of(pipe, 16.0_mm, 90);

    // Then rays across its axis pass twice through its wall, and rays along it through nothing
    for (const double about : {0.0, quarter, 0.7}) {
        const BoneShadow across = bone_shadow(image, through_origin(about, 0.0));
        const double walls = test::excess * 2.0 * image.spacing() * image.spacing() / 6.0_mm;
        EXPECT_NEAR(across.bone[middle_pixel], test::excess * 8.0_mm, 2.0 * rounding(image) + walls) << about;
    }
    const BoneShadow along = bone_shadow(image, through_origin(0.0, quarter));
    EXPECT_NEAR(along.bone[middle_pixel], 0.0f, 1e-6);
}

TEST(BoneShadow, MagnifiesBySimilarTriangles) {
    // Given a box of 24 mm whose middle is 100 mm from the source
    const AttenuationImage image = image_of(Bone(block_of(12.0_mm)), 14.0_mm, 120);
    Beam beam = bone::beam({0, 0, 0}, 0.0, 0.0, {.source_to_target = 0.1, .width = 0.3});
    beam.columns = beam.rows = 513;

    // When its shadow is cast on the detector at 1 m
    const BoneShadow shadow = bone_shadow(image, beam);

    // Then a ray to x passes the side at y = 12 mm / x from the source: bone from 88 mm to there, at most to 112 mm.
    ASSERT_EQ(shadow.error, "");
    double largest = 0.0;
    for (int c = 0; c < 513; ++c) {
        const double x = std::abs(c - 256) * beam.pixel();
        const double depth = std::clamp(12.0_mm / std::max(x, 1e-9) - 88.0_mm, 0.0, 24e-3) * std::sqrt(1.0 + x * x);
        EXPECT_NEAR(shadow.bone[static_cast<std::size_t>(256 * 513 + c)], test::excess * depth,
                    test::excess * 2.0 * image.spacing() /* edges are rounded off by half a voxel on each axis */)
            << c;
        largest = std::max(largest, depth);
    }
    EXPECT_GT(largest, 24.0_mm);
}

TEST(BoneShadow, LosesTheDepthOfADrilledHole) {
    Bone bone{block_of(12.0_mm)};
    const Beam beam = through_origin(0.0, 0.0);
    AttenuationImage image = image_of(bone, 14.0_mm, 96);
    const float before = bone_shadow(image, beam).bone[middle_pixel];

    // When a hole of 4 mm is drilled 10 mm deep from the front, along the middle ray
    bone.drill(2.0_mm, {0, -20.0_mm, 0}, {0, -2.0_mm, 0});
    image.update(std::vector{bone.at()});

    // Then its bottom lies 1/20 voxel off at most
    const float after = bone_shadow(image, beam).bone[middle_pixel];
    EXPECT_NEAR(before - after, test::excess * 10.0_mm, rounding(image) + test::excess * 0.5_mm / 20.0);
}

TEST(BoneShadow, AddsSoftTissueOfTheEllipsoid) {
    const AttenuationImage image = image_of(Bone(block_of(12.0_mm)), 14.0_mm, 64);
    const Vec3 axes = image.soft_tissue().semi_axes;
    EXPECT_NEAR(bone_shadow(image, through_origin(0.0, 0.0)).soft[middle_pixel], 2.0 * axes.y * water_attenuation,
                1e-5);
    EXPECT_NEAR(bone_shadow(image, through_origin(quarter, 0.0)).soft[middle_pixel], 2.0 * axes.x * water_attenuation,
                1e-5);
    EXPECT_EQ(bone_shadow(image, through_origin(0.0, 0.0, 0.4)).soft[0], 0.0f);
}

TEST(BoneShadow, AgreesWithPlainRays) {
    // Given a lumpy shell with a hole
    Bone bone(test::solid(24.0_mm, 0.6_mm, [](Vec3 p) {
        const double lumps = 2.0_mm * std::sin(p.x / 4.0_mm) * std::cos(p.y / 5.0_mm);
        return 0.6 * (std::abs(length({p.x, 1.3 * p.y, 0.8 * p.z}) - 15.0_mm - lumps) - 1.5_mm);
    }));
    bone.drill(2.0_mm, {3.0_mm, -30.0_mm, 2.0_mm}, {1.0_mm, 5.0_mm, 0});
    const AttenuationImage image = image_of(bone, 23.0_mm, 90);

    for (const auto& [about, tilt] :
         {std::pair{0.0, 0.0}, {quarter, 0.0}, {-quarter, 0.1}, {0.7, 0.5}, {0.1, 1.2}, {3.6, -0.3}}) {
        const Beam beam = through_origin(about, tilt, 0.09);
        const BoneShadow shadow = bone_shadow(image, beam);
        ASSERT_EQ(shadow.error, "");
        double error = 0.0, largest = 0.0;
        int count = 0;
        for (int r = 3; r < 513; r += 16)
            for (int c = 3; c < 513; c += 16, ++count) {
                const double exact = test::marched(image, beam.source, beam.pixel_centre(c, r));
                const double difference = shadow.bone[static_cast<std::size_t>(r * 513 + c)] - exact;
                error += difference * difference;
                largest = std::max(largest, exact);
            }
        EXPECT_LT(std::sqrt(error / count), 0.0014 * largest) << about << ' ' << tilt;
    }
}

TEST(BoneShadow, RefusesBeamsWithoutAPicture) {
    const AttenuationImage image = image_of(Bone(block_of(12.0_mm)), 14.0_mm, 40);
    const Beam good = through_origin(0.0, 0.0);
    EXPECT_EQ(bone_shadow(image, good).error, "");
    const auto error_with = [&](auto change) {
        Beam beam = good;
        change(beam);
        const BoneShadow shadow = bone_shadow(image, beam);
        EXPECT_TRUE(shadow.bone.empty() == !shadow.error.empty());
        return shadow.error;
    };
    EXPECT_NE(error_with([](Beam& b) { b.source = {0, 0, 0}; }), "");
    EXPECT_NE(error_with([](Beam& b) { b.source = {1.0_mm, -11.9_mm, 0}; }), "");
    EXPECT_EQ(error_with([](Beam& b) { b.source = {0, -14.0_mm, 0}; }), "");
    EXPECT_NE(error_with([](Beam& b) { b.source = {0, -14.0_mm, 0}, b.width = 4.0; }), "") << "rays graze the slices";
    EXPECT_NE(error_with([](Beam& b) { b.source = b.centre; }), "");
    EXPECT_NE(error_with([](Beam& b) { b.centre = {0, 0, 0}; }), "");
    EXPECT_NE(error_with([](Beam& b) { b.centre = b.source - (b.centre - b.source); }), "") << "bone behind the source";
    EXPECT_NE(error_with([](Beam& b) { b.width = 0.0; }), "");
    EXPECT_NE(error_with([](Beam& b) { b.width = std::numeric_limits<double>::quiet_NaN(); }), "");
    EXPECT_NE(error_with([](Beam& b) { b.columns = 0; }), "");
    EXPECT_NE(error_with([](Beam& b) { b.right = b.up; }), "");
    EXPECT_NE(error_with([](Beam& b) { b.up = {0, 0, 0}; }), "");
    EXPECT_EQ(error_with([](Beam& b) { b.columns = b.rows = 1; }), "");
    EXPECT_EQ(error_with([](Beam& b) { b.centre = b.centre + Vec3{0.5, 0, 0}; }), "") << "the beam passes the bone";
    EXPECT_NE(bone_shadow(AttenuationImage::around(empty_box), good).error, "");
}

TEST(CArm, TurnsAboutTheHeadAndTilts) {
    // From the front, the patient's left is on the right of the picture.
    const Beam ap = beam({1, 2, 3}, 0.0, 0.0);
    EXPECT_NEAR(length(ap.source - Vec3{1, 2 - 0.65, 3}), 0.0, 1e-12);
    EXPECT_NEAR(length(ap.centre - Vec3{1, 2 + 0.35, 3}), 0.0, 1e-12);
    EXPECT_NEAR(length(ap.right - Vec3{1, 0, 0}), 0.0, 1e-12);
    EXPECT_NEAR(length(ap.up - Vec3{0, 0, 1}), 0.0, 1e-12);
    // From the left, the back is on the right.
    const Beam lateral = beam({0, 0, 0}, quarter, 0.0);
    EXPECT_NEAR(lateral.source.x, 0.65, 1e-12);
    EXPECT_NEAR(lateral.right.y, 1.0, 1e-12);
    const Beam from_head = beam({0, 0, 0}, 0.0, 0.3);
    EXPECT_NEAR(from_head.source.z, 0.65 * std::sin(0.3), 1e-12);
    EXPECT_NEAR(dot(from_head.up, from_head.source), 0.0, 1e-12);
    EXPECT_GT(from_head.up.z, 0.9);
}

}  // namespace
}  // namespace kerf::bone
