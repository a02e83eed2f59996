// SPDX-License-Identifier: Apache-2.0
#include "bone/import/phantom_walls.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "bone/import/make_body.h"
#include "tests/support/block.h"

namespace kerf::bone {
namespace {

using namespace literals;

documents::Anatomy phantom(std::vector<documents::PhantomPart> parts) {
    documents::Anatomy anatomy;
    anatomy.id = "phantom";
    anatomy.phantom.parts = std::move(parts);
    anatomy.tissues = {{"cortical", 1850.0, 0.0, ""}};
    return anatomy;
}

TEST(PhantomWalls, APlateIsAsThickAsItIs) {
    // Given a plate of 0.9 mm, turned against the grid
    const Vec3 across = normalized(Vec3{0.3, 0.2, 1.0});
    const Grid grid = Grid::covering({-5.0_mm, -5.0_mm, -5.0_mm}, {5.0_mm, 5.0_mm, 5.0_mm}, 0.5_mm);
    const auto walls = phantom_walls(
        grid, [&](Vec3 p) { return std::abs(dot(p, across)) - 0.45_mm; }, 2.0_mm);
    ASSERT_GT(walls.size(), 100u);
    for (const WallSample& wall : walls) EXPECT_NEAR(wall.thickness, 0.9_mm, 0.02 * 0.5_mm);
}

TEST(PhantomWalls, AnEdgeIsNoWall) {
    const Grid grid = Grid::covering({-6.0_mm, -6.0_mm, -6.0_mm}, {6.0_mm, 6.0_mm, 6.0_mm}, 0.5_mm);
    const auto walls = phantom_walls(
        grid,
        [](Vec3 p) {
            return test::box_distance(p, {-4.0_mm, -4.0_mm, -4.0_mm}, {4.0_mm, 4.0_mm, 4.0_mm});
        },
        2.0_mm);
    EXPECT_EQ(fraction_under(walls, 2.0_mm), 0.0);
}

TEST(PhantomWalls, ABodyWithAPlateThatItsSpacingCannotCarryIsRefused) {
    const documents::Anatomy plate =
        phantom({{"body", documents::BoxSolid{{0, 0, 0}, {20.0_mm, 20.0_mm, 20.0_mm}}, false, ""},
                 {"plate", documents::BoxSolid{{0, 18.0_mm, 0}, {12.0_mm, 20.0_mm, 1.0_mm}}, false, ""}});
    text::Diagnostics coarse, fine;
    EXPECT_FALSE(make_body(plate, 0.5_mm).take(coarse));
    ASSERT_EQ(coarse.size(), 1u);
    EXPECT_EQ(coarse[0].code, "E0655");
    EXPECT_EQ(coarse[0].write, "accuracy: {spacing: 0.33 mm}");
    EXPECT_TRUE(make_body(plate, 0.33_mm).take(fine));
    EXPECT_TRUE(fine.empty()) << to_text(fine);
}

TEST(PhantomWalls, AThinSheetAroundARoomHasTwoFieldsAndIsCarried) {
    const documents::Anatomy sheet =
        phantom({{"body", documents::BoxSolid{{0, 0, 0}, {20.0_mm, 20.0_mm, 20.0_mm}}, false, ""},
                 {"room", documents::BoxSolid{{0, 0, 0}, {19.0_mm, 16.0_mm, 16.0_mm}}, true, ""}});
    text::Diagnostics diagnostics;
    const auto body = make_body(sheet, 0.5_mm).take(diagnostics);
    ASSERT_TRUE(body) << to_text(diagnostics);
    EXPECT_FALSE(body->hollow.is_empty());
}

}  // namespace
}  // namespace kerf::bone
