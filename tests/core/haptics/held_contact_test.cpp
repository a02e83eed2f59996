// SPDX-License-Identifier: Apache-2.0
// Contact of a held body at points that are known.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include "core/haptics/law/held_body.h"
#include "tests/support/block.h"

namespace kerf {
namespace {

using namespace literals;

/// A block below z = 0, and a cube in the grip of a tool 5 mm above it.
struct Grip {
    Body block = test::block({-10.0_mm, -10.0_mm, -4.0_mm}, {10.0_mm, 10.0_mm, 0}, 0.5_mm, {0.3, 0.1, 0.7});
    Body cube = test::block({-1.0_mm, -1.0_mm, -1.0_mm}, {1.0_mm, 1.0_mm, 1.0_mm}, 0.5_mm);
    ToolSolid tool = test::drill_outline(1.0_mm, 60.0_deg, 10.0_mm);
    std::vector<std::unique_ptr<LiveBody>> bodies;
    Pose world_from_tool{{0, 0, 5.0_mm}, {1, 0, 0, 0}};
    HeldBody held;

    Grip() {
        bodies.push_back(std::make_unique<LiveBody>(0, block, CutField(block, 0), tool));
        bodies.push_back(std::make_unique<LiveBody>(1, cube, CutField(cube, 0), tool));
        bodies[1]->world_from_body = {{0, 0, 50.0_mm}, {1, 0, 0, 0}};
        held.take(bodies, 1, world_from_tool);
    }
    /// The channels of contact points in the tool frame.
    std::vector<kerf_channel> channels_of(const std::vector<Vec3>& points) {
        HeldPoints found = held.points_of(bodies);
        found.points = points;
        held.set_points(found);
        std::vector<kerf_channel> channels(max_held_channels);
        channels.resize(held.add_contact(bodies, world_from_tool, channels.data()));
        return channels;
    }
};

TEST(HeldContact, ActsAtThePointThatTouches) {
    // Given points far from the block, and one 0.05 mm in it at x = 3 and y = 2 mm
    Grip grip;
    const auto channels = grip.channels_of({{1.0_mm, -6.0_mm, 40.0_mm},
                                            {-5.0_mm, 4.0_mm, 30.0_mm},
                                            {7.0_mm, 7.0_mm, 45.0_mm},
                                            {3.0_mm, 2.0_mm, -5.05_mm}});
    ASSERT_EQ(channels.size(), 1u);
    const std::array<double, 6> wanted{0, 0, -1, -2.0_mm, 3.0_mm, 0};
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(channels[0].d[i], wanted[i], 1e-6) << i;
    EXPECT_NEAR(channels[0].delta, 0.05_mm, 1e-6);
}

TEST(HeldContact, ActsInEachOctantAlone) {
    // Two points of equal depth in one octant act at their middle, a third in another acts alone
    Grip grip;
    const auto channels = grip.channels_of(
        {{-8.0_mm, 0, 30.0_mm}, {6.0_mm, 1.0_mm, -5.1_mm}, {4.0_mm, 3.0_mm, -5.1_mm}, {-4.0_mm, -2.0_mm, -5.05_mm}});
    ASSERT_EQ(channels.size(), 2u);
    EXPECT_NEAR(channels[0].d[3], 2.0_mm, 1e-6);
    EXPECT_NEAR(channels[0].d[4], -4.0_mm, 1e-6);
    EXPECT_NEAR(channels[0].delta, 0.05_mm, 1e-6);
    EXPECT_NEAR(channels[1].d[3], -2.0_mm, 1e-6);
    EXPECT_NEAR(channels[1].d[4], 5.0_mm, 1e-6);
    EXPECT_NEAR(channels[1].delta, 0.1_mm, 1e-6);
    EXPECT_NE(channels[0].id, channels[1].id);
}

TEST(HeldContact, IgnoresPointsOfTheLastGrip) {
    Grip grip;
    HeldPoints before = grip.held.points_of(grip.bodies);
    before.points = {{3.0_mm, 2.0_mm, -5.05_mm}};
    grip.held.release();
    grip.held.take(grip.bodies, 1, grip.world_from_tool);
    grip.held.set_points(before);
    EXPECT_TRUE(grip.held.lacks_points());
}

TEST(HeldContact, MovesAsFarAsTheFarthestCornerOfItsPoints) {
    Grip grip;
    static_cast<void>(grip.channels_of({{0, 0, 0}, {30.0_mm, 40.0_mm, 0}}));
    const Pose turned{grip.world_from_tool.position, quat_from_rotation_vector({0, 0, 0.01})};
    EXPECT_NEAR(grip.held.largest_motion(grip.world_from_tool, turned), 50.0_mm * 2.0 * std::sin(0.005), 1e-9);
}

}  // namespace
}  // namespace kerf
