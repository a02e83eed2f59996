// SPDX-License-Identifier: Apache-2.0
// Bone beyond a body's region: solid, and not to be cut.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "tests/support/drill_rig.h"
#include "tests/support/rig.h"

namespace kerf {
namespace {

using namespace literals;

/// A block that was looked at only down to 4 mm.
Body looked_at_in_part() {
    Body body = test::block({-6.0_mm, -6.0_mm, -12.0_mm}, {6.0_mm, 6.0_mm, 0}, 0.25_mm, {0.3, 0.1, 0.7});
    body.region = {{-5.5_mm, -5.5_mm, -4.0_mm}, {5.5_mm, 5.5_mm, 2.0_mm}};
    return body;
}

TEST(RegionWall, ADrillCutsUpToTheRegionsEndAndStands) {
    const CouplingGains gains = test::gains();
    test::Rig simulation(looked_at_in_part(), test::twist_drill(), test::at_depth(-0.2_mm), gains);
    int left = 0;
    double thrust = 0.0;
    for (int i = 0; i < 6000; ++i) {
        const double depth = -simulation.world_from_tool().position.z;
        const TickResult r = simulation.tick({test::at_depth(depth + 170.0 * gains.force_scale / gains.stiffness)});
        for (std::size_t e = 0; e < r.event_count; ++e) left += std::string_view(r.events[e]) == "haptics.left_region";
        thrust = r.thrust;
    }
    EXPECT_EQ(left, 1) << "said once";
    EXPECT_NEAR(-simulation.world_from_tool().position.z, 4.0_mm, 0.25_mm);
    EXPECT_NEAR(thrust, 170.0, 5.0) << "it is felt";
}

TEST(RegionWall, FromOutsideItIsMetWhereItsSurfaceIs) {
    Body body = test::block({-20.0_mm, -6.0_mm, -12.0_mm}, {20.0_mm, 6.0_mm, 0}, 0.5_mm, {0.3, 0.1, 0.7});
    body.region = {{-8.0_mm, -5.5_mm, -11.5_mm}, {8.0_mm, 5.5_mm, 3.0_mm}};
    const ToolSetup setup = test::twist_drill({{"motor_torque", 20.0}});
    for (const double aside : {9.0_mm, 12.0_mm, 15.0_mm}) {
        const auto over = [&](double depth) { return test::at_depth(depth, 0.0, {aside, 0, 0}); };
        test::Rig simulation(body, setup, over(-1.0_mm));
        double max_across = 0.0, thrust = 0.0;
        for (double depth = -1.0_mm; depth < 3.0_mm; depth += 2.0_um) {
            const TickResult r = simulation.tick({over(depth)});
            max_across = std::max(max_across, std::hypot(r.bone_on_tool[0], r.bone_on_tool[1]));
            thrust = r.thrust;
        }
        EXPECT_GT(thrust, 50.0) << aside;
        EXPECT_LT(max_across, 5.0) << aside << ": it stands, and is not thrown back into the region";
        EXPECT_NEAR(simulation.world_from_tool().position.x, aside, 0.2_mm);
        EXPECT_LT(-simulation.world_from_tool().position.z, 0.5_mm) << aside;
    }
}

TEST(RegionWall, BeyondTheRegionAirIsAir) {
    test::Rig simulation(looked_at_in_part(), test::twist_drill(), test::at_depth(-5.0_mm));
    for (double depth = -5.0_mm; depth > -20.0_mm; depth -= 0.02_mm) {
        const TickResult r = simulation.tick({test::at_depth(depth)});
        ASSERT_LT(std::abs(r.thrust), 1e-9);
        for (std::size_t e = 0; e < r.event_count; ++e) EXPECT_STRNE(r.events[e], "haptics.left_region");
    }
}

}  // namespace
}  // namespace kerf
