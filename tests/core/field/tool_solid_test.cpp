// SPDX-License-Identifier: Apache-2.0
#include "core/field/tool_solid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/block.h"

namespace kerf {
namespace {

using namespace literals;

// A cone of 45° and radius 2 mm, on a cylinder that ends 10 mm behind the tip.
const ToolSolid tool = test::drill_outline(2.0_mm, 45.0_deg, 10.0_mm);

TEST(ToolSolid, DistanceIsThatOfConeWallAndCap) {
    EXPECT_NEAR(tool.distance({0, 0, 1.0_mm}), 1.0_mm, 1e-15);              // ahead of the tip
    EXPECT_NEAR(tool.distance({3.0_mm, 0, -5.0_mm}), 1.0_mm, 1e-15);        // beside the wall
    EXPECT_NEAR(tool.distance({0, 1.5_mm, -5.0_mm}), -0.5_mm, 1e-15);       // inside, near the wall
    EXPECT_NEAR(tool.distance({0, 0, -11.0_mm}), 1.0_mm, 1e-15);            // behind the cap
    EXPECT_NEAR(tool.distance({0, 0, -1.0_mm}), -1.0_mm / std::sqrt(2.0), 1e-15);  // on the axis, below the cone
}

TEST(ToolSolid, APointLeavesAlongTheAxisThroughTheCone) {
    // At radius 1 mm the cone's face is 1 mm behind the tip.
    EXPECT_NEAR(tool.travel_to_leave({1.0_mm, 0, -4.0_mm}, {0, 0, 1}), 3.0_mm, 1e-12);
    EXPECT_NEAR(tool.travel_to_leave({1.0_mm, 0, -4.0_mm}, {1, 0, 0}), 1.0_mm, 1e-12);
    EXPECT_NEAR(tool.travel_to_leave({1.0_mm, 0, -4.0_mm}, {0, 0, -1}), 6.0_mm, 1e-12);
}

TEST(ToolSolid, OutsideThereIsNothingToLeave) {
    EXPECT_EQ(tool.travel_to_leave({3.0_mm, 0, -4.0_mm}, {0, 0, 1}), 0.0);
}

TEST(ToolSolid, EndsExactlyOnItsSurfaceAfterThatTravel) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 p{2.0_mm * unit(random), 2.0_mm * unit(random), -5.0_mm + 5.0_mm * unit(random)};
        if (tool.distance(p) > -1e-6) continue;
        const Vec3 direction = normalized(Vec3{unit(random), unit(random), unit(random)});
        const double travel = tool.travel_to_leave(p, direction);
        EXPECT_NEAR(tool.distance(p + travel * direction), 0.0, 1e-12) << i;
        EXPECT_LT(tool.distance(p + 0.5 * travel * direction), 1e-12) << "convex: the way there lies inside";
    }
}

}  // namespace
}  // namespace kerf
