// SPDX-License-Identifier: Apache-2.0
// S-12: what a drill has cut is gone, for the ends of its lips along the wall too.
#include <gtest/gtest.h>

#include "tests/support/layered_slab.h"

namespace kerf {
namespace {

using namespace literals;

TEST(ReEntry, BackInItsHoleADrillMeetsNothingBeforeTheFront) {
    const ToolSetup setup = test::twist_drill({{"diameter", 5.4_mm}, {"motor_torque", 20.0}});
    for (const double h : {0.5_mm, 0.25_mm})
        for (const double offset : {0.1, 0.35, 0.6, 0.85}) {
            const Body body = test::Slab::make(h, {0.3, 0.7, offset});
            double depth = -1.0_mm;
            Simulation simulation(body, setup, test::outline(setup), test::gains(), test::at_depth(depth));
            const auto go = [&](double speed) {
                depth += speed * Simulation::dt;
                const double thrust = simulation.tick_direct({test::at_depth(depth)}).thrust;
                simulation.after_tick();
                return std::abs(thrust);
            };
            while (depth < 4.5_mm) (void)go(8.0_mm_per_s);
            const double front = depth;
            while (depth > 1.0_mm) (void)go(-20.0_mm_per_s);
            double most = 0.0;
            while (depth < front - 45.0_um) most = std::max(most, go(20.0_mm_per_s));
            EXPECT_LT(most, 0.05) << h << ", " << offset;
            // And at the front there is bone.
            for (int i = 0; i < 10; ++i) most = std::max(most, go(8.0_mm_per_s));
            EXPECT_GT(most, 100.0) << h << ", " << offset;
        }
}

}  // namespace
}  // namespace kerf
