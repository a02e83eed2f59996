// SPDX-License-Identifier: Apache-2.0
#include "bone/radiograph/radiograph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "tests/bone/radiograph/shapes.h"

namespace kerf::bone {
namespace {

using namespace literals;
using test::Bone;
using test::middle_pixel;
using test::through_origin;

const AttenuationImage& ball_image() {
    static const AttenuationImage image = [] {
        const Bone bone(test::ball(15.0_mm, 0.6_mm));
        AttenuationImage made = AttenuationImage::around(test::cube(16.0_mm), {.voxels = 64});
        made.update(std::vector{bone.at()});
        return made;
    }();
    return image;
}
const test::Mesh rod = test::cylinder(3.0_mm, 20.0_mm, 32);

TEST(Radiograph, ShowsBoneDarkInACircle) {
    const Radiograph picture = radiograph(ball_image(), through_origin(0.0, 0.0, 0.09), {}, {.noise = 0.0});
    ASSERT_EQ(picture.error, "");
    ASSERT_EQ(picture.grey.size(), 513u * 513u);
    const auto at = [&](int column, int row) {
        return static_cast<int>(picture.grey[static_cast<std::size_t>(row * 513 + column)]);
    };
    EXPECT_EQ(at(2, 2), 0) << "outside the collimator";
    EXPECT_GT(at(20, 256), 150) << "soft tissue";
    EXPECT_LT(at(256, 256), 80) << "bone";
    // The shadow of the ball is as wide as its tangents: 15 mm, 0.65 m from the source.
    const double tangent = 15.0_mm / std::sqrt(0.65 * 0.65 - 15.0_mm * 15.0_mm) / (0.09 / 513);
    int edge = 256;
    while (at(edge, 256) < 150) ++edge;
    EXPECT_NEAR(edge - 256, tangent, 8.0 /* the last pixels of the ball are thin */);
}

TEST(Radiograph, GivesTheSameBytesForTheSameShot) {
    const MetalShape metal = rod.shape();
    const Beam beam = through_origin(0.3, 0.1, 0.09);
    const auto shot = [&](std::uint64_t number) {
        return radiograph(ball_image(), beam, std::span(&metal, 1), {.shot = number}).grey;
    };
    EXPECT_EQ(shot(1), shot(1));
    EXPECT_NE(shot(1), shot(2));
}

TEST(Radiograph, HasTheRequestedNoise) {
    // Differences of two shots in the middle of the ball have √2 times the noise, scaled by the window.
    const Beam beam = through_origin(0.0, 0.0, 0.09);
    const Development quiet{.noise = 0.01, .shot = 1}, loud{.noise = 0.02, .shot = 1};
    const auto deviation = [&](Development development) {
        const Radiograph a = radiograph(ball_image(), beam, {}, development);
        development.shot = 2;
        const Radiograph b = radiograph(ball_image(), beam, {}, development);
        double sum = 0.0;
        for (int r = 206; r < 307; ++r)
            for (int c = 206; c < 307; ++c) {
                const auto i = static_cast<std::size_t>(r * 513 + c);
                const double difference = a.grey[i] - b.grey[i];
                sum += difference * difference;
            }
        return std::sqrt(sum / 101.0 / 101.0);
    };
    EXPECT_NEAR(deviation(loud) / deviation(quiet), 2.0, 0.25);
}

TEST(Radiograph, MultipliesMetalWithoutAHalo) {
    const Beam beam = through_origin(0.0, 0.0, 0.09);
    const MetalShape metal = rod.shape();
    const Radiograph with = radiograph(ball_image(), beam, std::span(&metal, 1), {.noise = 0.0});
    const Radiograph without = radiograph(ball_image(), beam, {}, {.noise = 0.0});
    // 3 mm at a magnification of 1/0.65 are 26 pixels; the rod is 20 mm long to either side.
    for (int column = 0; column < 513; ++column) {
        const auto i = static_cast<std::size_t>(256 * 513 + column);
        if (std::abs(column - 256) > 29) {
            EXPECT_EQ(with.grey[i], without.grey[i]) << column;
        }
    }
    const double transmitted = std::exp(-titanium_attenuation * 6.0_mm);
    EXPECT_NEAR(with.grey[middle_pixel], without.grey[middle_pixel] * transmitted, 1.0);
    // At the soft tissue above the ball it shows, too.
    const auto above = static_cast<std::size_t>((256 - 155) * 513 + 256);
    EXPECT_NEAR(with.grey[above], without.grey[above] * transmitted, 3.0 /* 32 sides */);
}

TEST(Radiograph, IsSoundForAnyBeam) {
    const MetalShape metal = rod.shape();
    std::size_t pictures = 0;
    for (const double width : {0.0, 1e-3, 0.2, 10.0})
        for (const double about : {0.0, 0.5 * std::numbers::pi, 0.25 * std::numbers::pi})
            for (const double tilt : {0.0, 0.5 * std::numbers::pi, -1.0})
                for (const double distance : {-0.1, 0.0, 0.01, 0.03, 0.65, 1.0})
                    for (const int pixels : {1, 2, 33}) {
                        const Beam beam = bone::beam({0, 0, 0}, about, tilt,
                                                     {.source_to_target = distance, .width = width, .pixels = pixels});
                        const Radiograph picture = radiograph(ball_image(), beam, std::span(&metal, 1));
                        const auto all = static_cast<std::size_t>(pixels * pixels);
                        ASSERT_EQ(picture.grey.size(), picture.error.empty() ? all : 0u);
                        pictures += picture.error.empty();
                    }
    EXPECT_GT(pictures, 50u);
}

TEST(Radiograph, ShowsSoftTissueWithoutBone) {
    const AttenuationImage image = AttenuationImage::around(test::cube(16.0_mm));
    const Radiograph picture = radiograph(image, through_origin(0.0, 0.0, 0.09), {}, {});
    EXPECT_EQ(picture.error, "");
    EXPECT_GT(picture.grey[middle_pixel], 0);
}

}  // namespace
}  // namespace kerf::bone
