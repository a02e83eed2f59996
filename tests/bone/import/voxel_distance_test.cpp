// SPDX-License-Identifier: Apache-2.0
// Where an image says that bone ends. A voxel is the mean over its box; a scanner blurs more than that.
#include "bone/import/voxel_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <random>
#include <utility>

#include "kerf/units.hpp"

namespace kerf::bone {
namespace {

using namespace literals;

constexpr double h = 0.5_mm;

/// Values along z, the same across it.
VoxelImage layers(const std::function<double(double)>& value_at, int count = 16) {
    VoxelImage image;
    image.size = {3, 3, count};
    image.place({h, 0, 0, 0, 0, h, 0, 0, 0, 0, h, 0});
    for_each_voxel(image,
                   [&](int, int, int k, std::size_t) { image.values.push_back(static_cast<float>(value_at(h * k))); });
    return image;
}
/// Bone below `border`, averaged over `width`: the mean over a voxel's box, or over more.
double edge(double z, double border, double width) { return std::clamp(0.5 + (border - z) / width, 0.0, 1.0); }

/// Where the distance passes through 0 along z.
double border_in(const VoxelImage& image, double threshold) {
    BoneMask mask(image);
    for (std::size_t at = 0; at < image.values.size(); ++at) mask.is_bone[at] = image.values[at] >= threshold;
    const VoxelDistance found = distance_in_voxels(mask, threshold, 4.0 * h);
    EXPECT_EQ(found.crossing_fraction, 1.0);
    for (int k = 0; k + 1 < image.size[2]; ++k) {
        const double below = found.distance.at(1, 1, k), above = found.distance.at(1, 1, k + 1);
        if (below <= 0.0 && above > 0.0) return h * (k - below / (above - below));
    }
    ADD_FAILURE() << "there is no border";
    return 0.0;
}

TEST(VoxelDistance, ASharpBorderLiesWhereTheVoxelsShareOfBoneSays) {
    for (const double threshold : {0.5, 0.3, 0.7})
        for (double part = 0.0; part < 1.0; part += 0.0625) {
            const double border = (7.0 + part) * h;
            // A mean over a box as wide as a voxel reaches the threshold so far beyond
            const double expected = border + (0.5 - threshold) * h;
            EXPECT_NEAR(border_in(layers([&](double z) { return edge(z, border, h); }), threshold), expected, 0.01 * h)
                << "threshold " << threshold << ", border at " << part << " of a voxel";
        }
}

TEST(VoxelDistance, ABlurredBorderLiesWhereTheValuesCrossTheThreshold) {
    // Beyond the half, where the toe of the ramp may pass for a sharp border, a little less exactly
    for (const auto& [threshold, within] : {std::pair{0.5, 1e-3 * h}, std::pair{0.3, 0.04 * h}})
        for (double part = 0.0; part < 1.0; part += 0.0625) {
            const double border = (7.0 + part) * h, width = 4.0 * h;
            EXPECT_NEAR(border_in(layers([&](double z) { return edge(z, border, width); }), threshold),
                        border + (0.5 - threshold) * width, within)
                << "threshold " << threshold << ", border at " << part << " of a voxel";
        }
}

TEST(VoxelDistance, NoiseDoesNotMoveABorderOnAverage) {
    // Given a sharp border of a body, and of a gap of two voxels and of a plate of three, each seen with noise many
    // times over
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0.0, 0.05);
    for (const bool is_thin : {false, true})
        for (double part = 0.125; part < 1.0; part += 0.25) {
            const double border = (7.0 + part) * h, begins = is_thin ? border - 3.0 * h : -h,
                         ends = is_thin ? border + 2.0 * h : 99.0 * h;
            double sum = 0.0;
            constexpr int times = 3000;
            for (int n = 0; n < times; ++n)
                sum += border_in(layers([&](double z) {
                                     return edge(z, border, h) - edge(z, begins, h) + 1.0 - edge(z, ends, h) +
                                            noise(random);
                                 }),
                                 0.5) -
                       border;
            EXPECT_NEAR(sum / times, 0.0, 0.01 * h) << "at " << part << " of a voxel" << (is_thin ? ", thin" : "");
        }
}

TEST(VoxelDistance, APlateOfTwoVoxelsKeepsItsThickness) {
    // Given a plate that lies between voxels, its middle voxel full
    for (double part = 0.0; part < 1.0; part += 0.125) {
        const double low = (6.0 + part) * h, high = low + 2.0 * h;
        const VoxelImage image = layers([&](double z) { return edge(z, high, h) - edge(z, low, h); });
        BoneMask mask(image);
        for (std::size_t at = 0; at < image.values.size(); ++at) mask.is_bone[at] = image.values[at] >= 0.5;
        const VoxelImage d = distance_in_voxels(mask, 0.5, 4.0 * h).distance;
        double thickness = 0.0;
        for (int k = 0; k + 1 < image.size[2]; ++k) {
            const double a = d.at(1, 1, k), b = d.at(1, 1, k + 1);
            if ((a < 0.0) != (b < 0.0)) thickness += (a < 0.0 ? -a : -b) / std::abs(b - a) * h;
            if (a < 0.0 && b < 0.0) thickness += h;
        }
        EXPECT_NEAR(thickness, 2.0 * h, 0.02 * h) << "at " << part << " of a voxel";
    }
}

TEST(VoxelDistance, NoiseBeyondTheBorderDoesNotThrowItOffTheVoxels) {
    // Given values that rise again behind the border, and a border in the last voxels of the image
    const VoxelImage rising = layers([&](double z) { return z < 7.2 * h ? 1.0 : z < 8.2 * h ? 0.2 : 0.45; });
    EXPECT_NEAR(border_in(rising, 0.5), 7.5 * h, 0.5 * h);
    const VoxelImage last = layers([&](double z) { return edge(z, 14.2 * h, h); });
    EXPECT_NEAR(border_in(last, 0.5), 14.2 * h, 0.2 * h);
}

}  // namespace
}  // namespace kerf::bone
