// SPDX-License-Identifier: Apache-2.0
// A sleeve of 3.4 mm around a drill of 3.2 mm, 0.1 mm of play to each side.
#include "core/haptics/law/guide_wall.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>

#include "core/haptics/law/channel.h"
#include "tests/support/block.h"

namespace kerf {
namespace {

using namespace literals;

constexpr double radius = 1.6_mm, play = 0.1_mm;
const ToolSolid drill = test::drill_outline(radius, 59.0_deg, 80.0_mm);
// The bore from z = −32 to −2 mm, towards +z.
const Guide sleeve{
    .body = 0, .mouth = {0, 0, -2.0_mm}, .along = {0, 0, 1}, .length = 30.0_mm, .bore_radius = radius + play};

struct Walls {
    std::array<kerf_channel, 2> channel{};
    std::size_t count = 0;
};
Walls walls_of(const Pose& body_from_tool) {
    Walls walls;
    walls.count = guide_wall(sleeve, drill, inverse(body_from_tool), walls.channel.data());
    return walls;
}
Pose tool_at(Vec3 tip, Vec3 direction = {0, 0, 1}) { return test::pointing(tip, direction); }

TEST(GuideWall, ADrillOnTheAxisTouchesNothing) { EXPECT_EQ(walls_of(tool_at({0, 0, 10.0_mm})).count, 0u); }

TEST(GuideWall, ADrillBesideTheAxisIsHeldAtBothEndsByTheUsedUpPlay) {
    const Walls walls = walls_of(tool_at({0.15_mm, 0, 10.0_mm}));
    ASSERT_EQ(walls.count, 2u);
    // Both push along −x: their rates are along +x. The rear one is 42 mm behind the tip, the front one 12 mm.
    const std::array behind{12.0_mm, 42.0_mm};
    for (std::size_t i = 0; i < 2; ++i) {
        const kerf_channel& c = walls.channel[i];
        EXPECT_NEAR(c.delta, 0.15_mm - play, 1e-9);
        EXPECT_NEAR(c.d[0], 1.0, 1e-12);
        EXPECT_NEAR(c.d[2], 0.0, 1e-12);
        EXPECT_NEAR(c.d[4], -behind[i], 1e-9) << "moment about y of +x, so far behind the tip";
        EXPECT_TRUE(is_sound(c));
    }
}

TEST(GuideWall, ATiltedDrillIsPushedOppositeWaysAtTheTwoEnds) {
    const double tilt = 1.0_deg;
    // Through the middle of the bore, 15 mm from either end.
    const Vec3 way{std::sin(tilt), 0, std::cos(tilt)}, middle{0, 0, -17.0_mm};
    const Walls walls = walls_of(tool_at(middle + 27.0_mm * way, way));
    ASSERT_EQ(walls.count, 2u);
    EXPECT_GT(walls.channel[0].d[0], 0.9) << "at the mouth the shaft lies on +x";
    EXPECT_LT(walls.channel[1].d[0], -0.9);
    for (const kerf_channel& c : walls.channel) EXPECT_NEAR(c.delta, 15.0_mm * std::tan(tilt) - play, 1.0_um);
}

TEST(GuideWall, BeforeTheToolComesOutItIsHeldWhereItIsFirstAsWideAsItGets) {
    const Walls walls = walls_of(tool_at({0.2_mm, 0, -12.0_mm}));
    ASSERT_EQ(walls.count, 2u);
    EXPECT_NEAR(walls.channel[0].d[4], -radius / std::tan(59.0_deg), 1e-9);
}

TEST(GuideWall, ADrillBehindOrBesideTheSleeveIsFree) {
    EXPECT_EQ(walls_of(tool_at({0.2_mm, 0, -40.0_mm})).count, 0u);
    EXPECT_EQ(walls_of(tool_at({3.0_mm, 0, 10.0_mm})).count, 0u);
    EXPECT_EQ(walls_of(tool_at({0.2_mm, 0, 10.0_mm}, {1, 0, 0.1})).count, 0u);
}

TEST(GuideWall, FindsTheBoreOfATiltedSleeveByItsTangent) {
    // Given an upright drill, and the bore of a sleeve that leans by 20° and begins 5 mm off its axis
    const double lean = 20.0_deg;
    const Guide wide{.body = 0,
                     .mouth = {5.0_mm, 0, 10.0_mm},
                     .along = {std::sin(lean), 0, std::cos(lean)},
                     .length = 40.0_mm,
                     .bore_radius = 2.7_mm};
    Walls walls;
    walls.count = guide_wall(wide, drill, identity_pose(), walls.channel.data());
    ASSERT_EQ(walls.count, 2u);

    // Then its front wall is where the drill is first as wide as it gets, and its rear wall where the bore ends
    const double front = -radius / std::tan(59.0_deg), rear = 10.0_mm - 40.0_mm * std::cos(lean);
    const double bore_in_front = 5.0_mm - (10.0_mm - front) * std::tan(lean),
                 bore_behind = 5.0_mm - 40.0_mm * std::sin(lean);
    EXPECT_NEAR(walls.channel[0].delta, bore_in_front + radius - 2.7_mm, 1e-12);
    EXPECT_NEAR(walls.channel[0].d[0], -1.0, 1e-12) << "the bore has not crossed the drill";
    EXPECT_NEAR(walls.channel[0].d[4], -front, 1e-12);
    EXPECT_NEAR(walls.channel[1].delta, -bore_behind + radius - 2.7_mm, 1e-12);
    EXPECT_NEAR(walls.channel[1].d[0], 1.0, 1e-12);
    EXPECT_NEAR(walls.channel[1].d[4], rear, 1e-12);
}

TEST(GuideWall, UsesTheToolsOwnRadiusAtEitherEnd) {
    // Given a head of 3.2 mm on a neck of 2 mm, with a cone from 10 to 11 mm between them
    const ToolSolid necked({{0.0, 0.0}, {-1.0_mm, 1.6_mm}, {-10.0_mm, 1.6_mm}, {-11.0_mm, 1.0_mm}, {-80.0_mm, 1.0_mm}});
    const auto deltas = [&](double length) {
        Guide guide = sleeve;
        guide.length = length;
        Walls walls;
        walls.count = guide_wall(guide, necked, inverse(tool_at({0.5_mm, 0, 0})), walls.channel.data());
        EXPECT_EQ(walls.count, 2u);
        return std::array{walls.channel[0].delta, walls.channel[1].delta};
    };
    EXPECT_NEAR(deltas(20.0_mm)[0], 0.5_mm + 1.6_mm - sleeve.bore_radius, 1e-12);
    EXPECT_NEAR(deltas(20.0_mm)[1], 0.5_mm + 1.0_mm - sleeve.bore_radius, 1e-12) << "22 mm behind the tip";
    EXPECT_NEAR(deltas(8.25_mm)[1], 0.5_mm + 1.45_mm - sleeve.bore_radius, 1e-12) << "a quarter down the cone";
}

// Whatever the frame: the same sleeve and drill, moved together.
TEST(GuideWall, TheWallsAreTheSameInEveryFrame) {
    const Pose moved{{0.1, -0.2, 0.3}, quat_from_rotation_vector({0.3, -1.1, 0.4})};
    Guide there = sleeve;
    there.mouth = moved * sleeve.mouth;
    there.along = rotate(moved.rotation, sleeve.along);
    const Pose tool = tool_at({0.15_mm, 0.05_mm, 10.0_mm}, {0.01, -0.02, 1});
    const Walls here = walls_of(tool);
    std::array<kerf_channel, 2> channel{};
    ASSERT_EQ(guide_wall(there, drill, inverse(moved * tool), channel.data()), here.count);
    ASSERT_GT(here.count, 0u);
    for (std::size_t i = 0; i < here.count; ++i) {
        EXPECT_NEAR(channel[i].delta, here.channel[i].delta, 1e-12);
        for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(channel[i].d[k], here.channel[i].d[k], 1e-9);
    }
}

}  // namespace
}  // namespace kerf
