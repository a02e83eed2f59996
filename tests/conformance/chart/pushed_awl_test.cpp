// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "conformance/chart/pushed_awl.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kerf/units.hpp"
#include "tests/support/drill_rig.h"

namespace kerf::chart {
namespace {

using namespace literals;

TEST(PushedAwl, InOneTissueItIsTheClosedForm) {
    Scene scene = slab_scene(0.0);
    const Awl awl{4.0_mm, 118.0_deg, 0.3};
    const double bears = 68e6 * 1.85 * 1.85 * pi * 2.0_mm * 2.0_mm * (1.0 + 0.3 / std::tan(59.0_deg));
    EXPECT_NEAR(push_of(awl, scene, 3.0_mm) / bears, 1.0, 1e-6) << "in cortex";
    EXPECT_NEAR(push_of(awl, scene, 9.0_mm) / bears, 0.1, 1e-6) << "in what resists a tenth";
    EXPECT_EQ(push_of(awl, scene, 30.0_mm), 0.0);
}

// The plugin's still drill, on a grid and in a hand's simulation, against the integral over exact bone.
TEST(PushedAwl, IsWhatThePluginsStillDrillTakesThroughLayers) {
    constexpr double step = 2.0_um;
    for (const double tilt : {0.0_deg, 20.0_deg}) {
        const Scene scene = slab_scene(tilt);
        const Awl drill{scene.drill.diameter, scene.drill.point_angle, 0.3};
        const Body body = body_of(scene.bone, 0.25_mm, {0.21, 0.34, 0.55});
        const ToolSetup setup = test::twist_drill({{"diameter", scene.drill.diameter}, {"spindle_speed", 0.0}});
        Simulation simulation(body, setup, test::outline(setup), test::gains(), scene.pose_at(scene.depth.front()));
        double of_cortex[2] = {}, of_spongy[2] = {};  // squares of the force and of its error [N²]
        for (double depth = scene.depth.front(); depth < 14.5_mm; depth += step) {
            const double thrust = simulation.tick_direct({scene.pose_at(depth)}).thrust;
            simulation.after_tick();
            const double exact = push_of(drill, scene, depth - step);  // the law is asked where the tick begins
            double* sums = depth > 7.5_mm && depth < 13.0_mm ? of_spongy : of_cortex;
            sums[0] += exact * exact;
            sums[1] += (thrust - exact) * (thrust - exact);
        }
        EXPECT_LT(std::sqrt(of_cortex[1] / of_cortex[0]), 0.04) << tilt / 1.0_deg;
        EXPECT_LT(std::sqrt(of_spongy[1] / of_spongy[0]), 0.02) << tilt / 1.0_deg;
    }
}

}  // namespace
}  // namespace kerf::chart
