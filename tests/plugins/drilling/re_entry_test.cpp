// SPDX-License-Identifier: Apache-2.0
// S-12 and B5: what a drill has cut is gone, for the ends of its lips along the wall too, and it runs free in its hole.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/layered_slab.h"
#include "tests/support/rig.h"
#include "tests/support/tremor.h"

namespace kerf {
namespace {

using namespace literals;

TEST(ReEntry, BackInItsHoleADrillMeetsNothingBeforeTheFront) {
    struct Hole {
        double diameter, spacing, depth;
    };
    for (const auto [d, h, deep] : {Hole{5.4_mm, 1.0_mm, 4.5_mm},
                                    {5.4_mm, 1.0_mm, 13.0_mm},
                                    {5.4_mm, 0.7_mm, 13.0_mm},
                                    {5.4_mm, 0.5_mm, 4.5_mm},
                                    {5.4_mm, 0.5_mm, 13.0_mm},
                                    {5.4_mm, 0.25_mm, 4.5_mm},
                                    {3.2_mm, 1.0_mm, 13.0_mm},
                                    {3.2_mm, 0.8_mm, 13.0_mm},
                                    {3.2_mm, 0.7_mm, 13.0_mm},
                                    {3.2_mm, 0.5_mm, 13.0_mm},
                                    {3.2_mm, 0.9_mm, 8.0_mm},
                                    {1.5_mm, 0.42_mm, 8.0_mm}})
        for (const double offset : {0.1, 0.35, 0.6, 0.85}) {
            double depth = -1.0_mm;
            test::Rig simulation(test::Slab::make(h, {0.3, 0.7, offset}),
                                 test::twist_drill({{"diameter", d}, {"motor_torque", 20.0}}), test::at_depth(depth));
            const auto move_with_tip = [&](double speed) {
                depth += speed * Simulation::dt;
                const double thrust = simulation.tick_direct({test::at_depth(depth)}).thrust;
                return std::abs(thrust);
            };
            while (depth < deep) (void)move_with_tip(8.0_mm_per_s);
            const double front = depth;
            while (depth > 1.0_mm) (void)move_with_tip(-20.0_mm_per_s);
            double most = 0.0;
            while (depth < front - 45.0_um) most = std::max(most, move_with_tip(20.0_mm_per_s));
            EXPECT_LT(most, 0.05) << d << ", " << h << ", " << deep << ", " << offset;
            // And at the front there is bone.
            for (int i = 0; i < 10; ++i) most = std::max(most, move_with_tip(8.0_mm_per_s));
            EXPECT_GT(most, deep < 5.0_mm ? 100.0 : 10.0) << d << ", " << h << ", " << deep << ", " << offset;
        }
}

TEST(InItsHole, HandNoiseIsNotFeltAcrossTheDrill) {
    const ToolSetup setup = test::twist_drill({{"diameter", 5.4_mm}});
    for (const double h : {1.0_mm, 0.5_mm, 0.2_mm}) {
        test::Rig simulation(test::block({-6.0_mm, -6.0_mm, -10.0_mm}, {6.0_mm, 6.0_mm, 0}, h, {0.31, 0.17, 0.73}),
                             setup, test::at_depth(-0.5_mm));
        const auto felt_across = [&](const Pose& pose) {
            const TickResult r = simulation.tick_direct({pose});
            return std::hypot(r.bone_on_tool[0], r.bone_on_tool[1]);
        };
        for (double depth = -0.5_mm; depth < 6.0_mm; depth += 2.0_um) (void)felt_across(test::at_depth(depth));
        for (double depth = 6.0_mm; depth > 5.0_mm; depth -= 10.0_um) (void)felt_across(test::at_depth(depth));
        const Pose still = test::at_depth(5.0_mm);
        double most = 0.0;
        for (int i = 0; i < 10000; ++i) {
            const double t = i * Simulation::dt;
            most = std::max(most,
                            felt_across(still * Pose{{test::tremor(t, 1.0), test::tremor(t, 2.0), test::tremor(t, 3.0)},
                                                     {1, 0, 0, 0}}));
        }
        EXPECT_LT(most, 0.05) << "N, at " << h;
    }
}

}  // namespace
}  // namespace kerf
