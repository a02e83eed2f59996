// SPDX-License-Identifier: Apache-2.0
#include "core/field/pieces/bridge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <optional>

#include "core/field/cut/removed_volume.h"
#include "tests/support/block.h"

namespace kerf {
namespace {

using namespace literals;

constexpr double h = 0.2_mm;
const Vec3 low{-2.0_mm, -2.0_mm, -5.0_mm}, high{2.0_mm, 2.0_mm, 0};

/// Two blocks, one over the other.
struct Blocks {
    double gap;
    Body a = test::block(low, high, h), b = test::block(low, high, h);
    CutField cut_of_a{a, 0}, cut_of_b{b, 0};

    [[nodiscard]] Pose b_from_a() const { return {{0, 0, -5.0_mm - gap}, {1, 0, 0, 0}}; }  // b's face over a's
    [[nodiscard]] std::optional<Bridge> bridge() const {
        return bridge_between({&a, &cut_of_a}, {&b, &cut_of_b}, b_from_a());
    }
    [[nodiscard]] double to_a(Vec3 p) const { return test::box_distance(p, low, high); }
    [[nodiscard]] double to_b(Vec3 p) const { return test::box_distance(b_from_a() * p, low, high); }
    /// Of all points outside of both whose distances together are at most `width`.
    [[nodiscard]] double volume_within(double width) const {
        constexpr double step = 0.04_mm, reach = 5.0_mm;
        double volume = 0.0;
        for (double x = -reach; x < reach; x += step)
            for (double y = -reach; y < reach; y += step)
                for (double z = -2.0_mm; z < gap + 2.0_mm; z += step) {
                    const Vec3 p{x + 0.5 * step, y + 0.5 * step, z + 0.5 * step};
                    const double of_a = to_a(p), of_b = to_b(p);
                    if (of_a >= 0.0 && of_b >= 0.0 && of_a + of_b <= width) volume += step * step * step;
                }
        return volume;
    }
};

TEST(Bridge, FillsWhatLiesBetweenFacesThatSeeEachOtherAndGrowsNoSkinBesides) {
    // Given gaps of three, and of six voxels, of which each piece knows four
    for (const double gap : {0.6_mm, 1.2_mm}) {
        const Blocks blocks{gap};
        const std::optional<Bridge> bridge = blocks.bridge();
        ASSERT_TRUE(bridge.has_value());
        EXPECT_NEAR(bridge->span, gap, 0.02 * gap);
        // Then it fills what lies between the faces of 16 mm², and is nowhere larger than the place where the true
        // distances together are small enough: around edges its own are a little too large
        const double volume = bone_volume(bridge->bone, CutField(bridge->bone, 0));
        EXPECT_GT(volume, 0.99 * gap * 16e-6) << gap;
        EXPECT_LT(volume, 1.01 * blocks.volume_within(1.05 * gap + 0.5 * h)) << gap;
        const Grid& grid = bridge->bone.grid();
        std::size_t inside = 0;
        for (int k = 0; k < grid.samples(2); ++k)
            for (int j = 0; j < grid.samples(1); ++j)
                for (int i = 0; i < grid.samples(0); ++i) {
                    if (bridge->bone.surface.sample(i, j, k) >= 0) continue;
                    ++inside;
                    const Vec3 p = grid.sample_position(i, j, k);
                    ASSERT_LE(std::max(blocks.to_a(p), 0.0) + std::max(blocks.to_b(p), 0.0), 1.05 * gap + h);
                }
        EXPECT_GT(inside, 800u);
    }
}

TEST(Bridge, IsNoneWhereTheyAreFartherApartThanTheyKnow) { EXPECT_FALSE(Blocks{8.5 * h}.bridge().has_value()); }

}  // namespace
}  // namespace kerf
