// SPDX-License-Identifier: Apache-2.0
#include "studies/papers/as_printed/touch_count.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "tests/studies/papers/as_printed/printed_rig.h"

namespace kerf::as_printed {
namespace {

using namespace literals;

TEST(TouchCount, SomeTwoThousandPointsForTheLargestDrill) {  // 00-04
    const double tool[] = {5.4_mm, 118.0_deg, 0.15, 120.0_mm};
    kerf_bone_query query{};
    query.sample = [](const kerf_bone*, const kerf_vec3*, std::uint32_t count, const kerf_vec3*, std::uint32_t,
                      kerf_bone_sample* out) {
        for (std::uint32_t i = 0; i < count; ++i) out[i] = {};
    };
    int points = 0;
    for_each_surface_point(value_of<PaperBit>(tool).drill(), 1.0_mm, 100.0_mm, BoneQuery(query),
                           [&](Vec3, Vec3, bool) { ++points; });
    EXPECT_NEAR(points, 2000, 400);
}

// P6: force converges as points are added. This one scales with their number.
TEST(TouchCount, TwiceTheDensityOfPointsIsFourTimesTheForce) {  // 00-07, S-07
    test::InTheBlock coarse("M1", 0.5_mm), fine("M1", 0.25_mm);
    (void)coarse.go(coarse.depth() + 8.0_um);
    (void)fine.go(fine.depth() + 8.0_um);
    const double ratio = fine.go(fine.depth() + 16.0_um).wrench[2] / coarse.go(coarse.depth() + 16.0_um).wrench[2];
    EXPECT_NEAR(ratio, 4.0, 0.8 /* whole rings, whole points on each */);
}

TEST(TouchCount, IsNothingAtRestAndHoldsBackWhatIsWithdrawn) {  // E00-6
    test::InTheBlock block("M1");
    (void)block.go(block.depth());
    EXPECT_EQ(block.go(block.depth()).wrench[2], 0.0);
    (void)block.go(block.depth() - 8.0_um);
    EXPECT_GT(block.go(block.depth() - 16.0_um).wrench[2], 1.0) << "into the bone, while it goes out";
}

}  // namespace
}  // namespace kerf::as_printed
