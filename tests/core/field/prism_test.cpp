// SPDX-License-Identifier: Apache-2.0
// A blade as a solid: an outline in the plane x, z, and two flat sides across y.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>

#include "core/field/cut/removed_volume.h"
#include "core/field/cut/sweep.h"
#include "core/field/cut/tool_solid.h"
#include "tests/support/block.h"

namespace kerf {
namespace {

using namespace literals;

// A plain board: 4 mm wide, 5 mm long, 1 mm thick.
const ToolSolid board = ToolSolid::prism({{0.0, 2.0_mm}, {-5.0_mm, 2.0_mm}}, 1.0_mm);

TEST(Prism, DistanceIsThatOfABox) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 p{4.0_mm * unit(random), 2.0_mm * unit(random), -2.5_mm + 5.0_mm * unit(random)};
        ASSERT_NEAR(board.distance(p), test::box_distance(p, {-2.0_mm, -0.5_mm, -5.0_mm}, {2.0_mm, 0.5_mm, 0}), 1e-15);
    }
}

TEST(Prism, APointLeavesThroughTheNearestFaceAhead) {
    EXPECT_NEAR(board.travel_to_leave({0, 0, -1.0_mm}, {0, 0, 1}), 1.0_mm, 1e-15);
    EXPECT_NEAR(board.travel_to_leave({0, 0.2_mm, -1.0_mm}, {0, 1, 0}), 0.3_mm, 1e-15);
    EXPECT_NEAR(board.travel_to_leave({0, 0.2_mm, -1.0_mm}, {0, -1, 0}), 0.7_mm, 1e-15);
    EXPECT_NEAR(board.travel_to_leave({-1.5_mm, 0, -1.0_mm}, {1, 0, 0}), 3.5_mm, 1e-15);
    EXPECT_NEAR(board.travel_to_leave({0, 0, -1.0_mm}, {0, 0.8, 0.6}), 0.625_mm, 1e-15) << "half a millimetre over 0.8";
    EXPECT_EQ(board.travel_to_leave({0, 0.6_mm, -1.0_mm}, {0, 1, 0}), 0.0) << "outside";
}

TEST(Prism, TheWayInIsThatAlongWhichDepthGrows) {
    const ToolSolid blade = test::blade_outline(20.0_mm, 4.0_mm, 2.0_mm, 1.0_mm);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    int outside = 0, inside = 0;
    for (int i = 0; i < 4000; ++i) {
        const Vec3 p{5.0_mm * unit(random), 1.0_mm * unit(random), -1.0_mm + 2.0_mm * unit(random)};
        const Vec3 way = blade.inward_direction(p);
        ASSERT_NEAR(length(way), 1.0, 1e-12);
        // A hair along it, unless another face is then nearer.
        const double gained = blade.distance(p) - blade.distance(p + 1e-9 * way);
        ASSERT_NEAR(gained, 1e-9, 1e-12) << p.x << ' ' << p.y << ' ' << p.z;
        ++(blade.distance(p) > 0.0 ? outside : inside);
    }
    EXPECT_GT(outside, 500);
    EXPECT_GT(inside, 500);
}

TEST(Prism, ItsCornersMoveFarthest) {
    // Turned by a quarter about y, the corner at (2, ±0.5, -5) mm goes sqrt(2) times its distance from the axis.
    const Pose still = identity_pose(), turned{{0, 0, 0}, quat_from_rotation_vector({0, 90.0_deg, 0})};
    EXPECT_NEAR(largest_motion(board, still, turned), std::sqrt(2.0) * std::hypot(2.0_mm, 5.0_mm), 1e-9);
    // About z the outline's radius alone would say 2 mm.
    const Pose about_z{{0, 0, 0}, quat_from_rotation_vector({0, 0, 180.0_deg})};
    EXPECT_NEAR(largest_motion(board, still, about_z), 2.0 * std::hypot(2.0_mm, 0.5_mm), 1e-9);
}

TEST(Prism, ItsBoxHoldsItAndNoMore) {
    const Pose at{{1.0_mm, 2.0_mm, 3.0_mm}, quat_from_rotation_vector({90.0_deg, 0, 0})};  // y up, z along -y
    const auto [low, high] = board.box(at);
    EXPECT_NEAR(low.x, -1.0_mm, 1e-9);
    EXPECT_NEAR(high.x, 3.0_mm, 1e-9);
    EXPECT_NEAR(high.y - low.y, 5.0_mm, 1e-9);
    EXPECT_NEAR(high.z - low.z, 1.0_mm, 1e-9);
}

// Fed straight down through a block, turned against the grid: thickness x width x depth, the round front's part less.
TEST(Prism, ASlotTakesItsExactVolume) {
    // Where two of its own faces meet inside bone a voxel counts as facing: h²/12 too much for each length of edge, 34
    // mm here.
    const double h = 0.2_mm, half_width = 4.0_mm, kerf = 1.0_mm, radius = 20.0_mm, depth = 4.0_mm;
    const ToolSolid blade = test::blade_outline(radius, half_width, 6.0_mm, kerf);
    // Below the chord of the front there is the polygon's area, next to the segment's.
    double front = 0.0;
    const auto& o = blade.outline();
    for (std::size_t i = 1; i + 1 < o.size(); ++i) front += (o[i].radius - o[i - 1].radius) * (o[i].z + o[i - 1].z);
    for (const double turn : {0.0, 0.35, 1.1}) {
        const Body body = test::block({-8.0_mm, -8.0_mm, -8.0_mm}, {8.0_mm, 8.0_mm, 0}, h, {0.31, 0.17, 0.73});
        const Quat down = quat_between({0, 0, 1}, {0, 0, -1}), about{quat_from_rotation_vector({0, 0, turn})};
        CutField cut(body, 1024);
        CutRecord record;
        record.removes = true;
        for (double at = -0.1_mm; at < depth - 1e-9; at += 0.1_mm) {
            record.from = {{0, 0, -at}, about * down};
            record.to = {{0, 0, -at - 0.1_mm}, about * down};
            cut.stamp(record, blade);
        }
        RemovedVolume volume(body);
        volume.update(cut);
        const double exact = kerf * (2.0 * half_width * depth + front);
        EXPECT_NEAR(volume.total() / exact, 1.0, 0.005) << "turned by " << turn;
    }
}

}  // namespace
}  // namespace kerf
