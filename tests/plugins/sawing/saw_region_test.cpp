// SPDX-License-Identifier: Apache-2.0
// A saw at the end of the region in which bone can be cut.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "tests/support/rig.h"
#include "tests/support/saw_rig.h"

namespace kerf {
namespace {

using namespace literals;

/// A block that was looked at only down to 4 mm, and 10 mm to either side.
Body looked_at_in_part() {
    Body body = test::block({-14.0_mm, -4.0_mm, -12.0_mm}, {14.0_mm, 4.0_mm, 0}, 0.5_mm, {0.3, 0.1, 0.7});
    body.region = {{-10.0_mm, -3.0_mm, -4.0_mm}, {10.0_mm, 3.0_mm, 2.0_mm}};
    return body;
}

struct AtTheEnd {
    test::Rig simulation{looked_at_in_part(), test::saw({{"tooth_count", 6.0}}), test::at_depth(-0.5_mm)};
    int times_said = 0;

    TickResult tick(const Pose& hand) {
        const TickResult r = simulation.tick({hand});
        for (std::size_t e = 0; e < r.event_count; ++e)
            times_said += std::string_view(r.events[e]) == "haptics.left_region";
        return r;
    }
};

TEST(SawAtTheRegionsEnd, CutsUpToItAndStandsThereAndItIsSaidOnce) {
    AtTheEnd saw;
    double thrust = 0.0;
    for (int i = 0; i < 3000; ++i)
        thrust = saw.tick(test::at_depth(std::min<double>(-0.5_mm + i * 6.0_um, 5.0_mm))).thrust;
    EXPECT_EQ(saw.times_said, 1);
    EXPECT_NEAR(-saw.simulation.world_from_tool().position.z, 4.0_mm, 0.5_mm) << "a voxel";
    EXPECT_GT(thrust, 10.0) << "N: it is felt";
}

TEST(SawAtTheRegionsEnd, TakesNothingBeyondIt) {
    AtTheEnd saw;
    for (int i = 0; i < 3000; ++i) (void)saw.tick(test::at_depth(std::min<double>(-0.5_mm + i * 6.0_um, 5.0_mm)));
    saw.simulation.finish();
    const Grid& g = saw.simulation.body().grid();
    const CutField &cut = saw.simulation.exact(), uncut(saw.simulation.body(), 1);
    std::size_t taken = 0;
    for (int k = 0; k < g.samples(2); ++k)
        for (int j = 0; j < g.samples(1); ++j)
            for (int i = 0; i < g.samples(0); ++i) {
                const bool is_changed = cut.sample(i, j, k) != uncut.sample(i, j, k);
                taken += is_changed;
                ASSERT_FALSE(is_changed && outside_region(saw.simulation.body(), g.sample_position(i, j, k)) > 1e-9)
                    << i << " " << j << " " << k;
            }
    EXPECT_GT(taken, 0u);
}

TEST(SawAtTheRegionsEnd, GoneAsideItStandsAtTheFaceToo) {
    AtTheEnd saw;
    for (int i = 0; i < 1500; ++i) (void)saw.tick(test::at_depth(std::min<double>(-0.5_mm + i * 6.0_um, 2.0_mm)));
    ASSERT_EQ(saw.times_said, 0);
    for (int i = 0; i < 3000; ++i)
        (void)saw.tick(test::at_depth(2.0_mm, 0.0, {std::min<double>(i * 6.0_um, 12.0_mm), 0, 0}));
    EXPECT_EQ(saw.times_said, 1);
    const double reach = test::outline(saw.simulation.setup()).cutting.largest_radius();
    EXPECT_LT(std::abs(saw.simulation.world_from_tool().position.x) + reach, 10.0_mm + 0.5_mm);
}

}  // namespace
}  // namespace kerf
