// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/physics/pushed_awl.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kerf/units.hpp"
#include "tests/support/drill_rig.h"
#include "tests/support/rig.h"

namespace kerf::chart {
namespace {

using namespace literals;

/// A plate of cortex with free space behind it, met at `tilt` [rad].
Scene plate_scene(double thickness, double tilt) {
    Scene scene;
    scene.bone.surface = [thickness](Vec3 p) { return std::max(p.z, -thickness - p.z); };
    scene.bone.tissues = {{"cortex", 1850.0, {}}};
    scene.along = {std::sin(tilt), 0, -std::cos(tilt)};
    return scene;
}

TEST(PushedAwl, InOneTissueItIsTheClosedForm) {
    Scene scene = slab_scene(0.0);
    PushedAwl awl({4.0_mm, 118.0_deg, 0.3}, scene);
    const double breaking_load = 68e6 * 1.85 * 1.85 * pi * 2.0_mm * 2.0_mm * (1.0 + 0.3 / std::tan(59.0_deg));
    EXPECT_NEAR(awl.push_at(3.0_mm) / breaking_load, 1.0, 1e-6) << "in cortex";
    EXPECT_NEAR(awl.push_at(9.0_mm) / breaking_load, 0.1, 1e-6) << "in what resists a tenth";
    EXPECT_EQ(awl.push_at(30.0_mm), 0.0);
}

TEST(PushedAwl, APlateBreaksUnderWhatItBears) {
    for (const double thickness : {0.35_mm, 1.0_mm})
        for (const double tilt : {0.0_deg, 30.0_deg, 60.0_deg}) {
            const Scene scene = plate_scene(thickness, tilt);
            PushedAwl awl({}, scene);
            const double tension = 68e6 * 1.85 * 1.85 * 133.0 / 193.0, c = std::max(std::cos(tilt), std::sin(15.0_deg));
            double most = 0.0, depth = -4.0_mm;
            for (; !awl.has_broken() && depth < 12.0_mm; depth += 0.05_mm) most = std::max(most, awl.push_at(depth));
            EXPECT_NEAR(most / (4.0 * pi * tension * thickness * thickness / 6.0 * (c + 0.3 * std::sqrt(1.0 - c * c))),
                        1.0, 0.02)
                << thickness << ", " << tilt / 1.0_deg;
            for (; depth < 12.0_mm; depth += 0.2_mm)
                EXPECT_LT(awl.push_at(depth), 0.02 * most) << thickness << ", " << tilt / 1.0_deg;
        }
}

/// The plugin's still drill, on a grid and led along a scene's way, beside the integral over exact bone.
struct Compared {
    const Scene& scene;
    test::Rig simulation{body_of(scene.bone, 0.25_mm, {0.21, 0.34, 0.55}),
                         test::twist_drill({{"diameter", scene.drill.diameter}, {"spindle_speed", 0.0}}),
                         scene.pose_at(scene.depth.front())};
    PushedAwl awl{{scene.drill.diameter, scene.drill.point_angle, 0.3}, scene};

    [[nodiscard]] double thrust_at(double depth) {
        const double thrust = simulation.tick_direct({scene.pose_at(depth)}).thrust;
        return thrust;
    }
};

TEST(PushedAwl, IsWhatThePluginsStillDrillTakesThroughLayers) {
    constexpr double step = 2.0_um;
    constexpr int every = 25;  // of them is compared
    for (const double tilt : {0.0_deg, 20.0_deg}) {
        const Scene scene = slab_scene(tilt);
        Compared both{scene};
        double of_cortex[2] = {}, of_spongy[2] = {};  // squares of the force and of its error [N²]
        int n = 0;
        for (double depth = scene.depth.front(); depth < 14.5_mm; depth += step) {
            const double thrust = both.thrust_at(depth);
            if (++n % every != 0) continue;
            const double exact = both.awl.push_at(depth - step);  // the law is asked where the tick begins
            double* sums = depth > 7.5_mm && depth < 13.0_mm ? of_spongy : of_cortex;
            sums[0] += exact * exact;
            sums[1] += (thrust - exact) * (thrust - exact);
        }
        EXPECT_LT(std::sqrt(of_cortex[1] / of_cortex[0]), 0.04) << tilt / 1.0_deg;
        EXPECT_LT(std::sqrt(of_spongy[1] / of_spongy[0]), 0.02) << tilt / 1.0_deg;
    }
}

TEST(PushedAwl, BreaksOutOfTheLastCortexWhereThePluginsStillDrillDoes) {
    for (const double tilt : {0.0_deg, 20.0_deg}) {
        const Scene scene = slab_scene(tilt);
        Compared both{scene};
        double thrust_broke = 0.0, awl_broke = 0.0, most = 0.0, awl_most = 0.0;  // [m], [N]
        int n = 0;
        for (double depth = scene.depth.front(); depth < 21.0_mm; depth += 4.0_um) {
            const double thrust = both.thrust_at(depth);
            const bool is_last = depth > 14.0_mm;
            if (is_last && thrust > 0.5 * most) thrust_broke = depth;
            if (is_last) most = std::max(most, thrust);
            if (++n % 12 != 0) continue;
            const double push = both.awl.push_at(depth);
            if (is_last) awl_most = std::max(awl_most, push);
            if (awl_broke == 0.0 && both.awl.has_broken()) awl_broke = depth;
        }
        EXPECT_NEAR(most / awl_most, 1.0, 0.04) << tilt / 1.0_deg;
        EXPECT_NEAR(thrust_broke, awl_broke, 0.25_mm) << tilt / 1.0_deg;
    }
}

// An awl that aims at the canal: through the entry, spongy bone, and the pedicle's medial wall from within.
TEST(PushedAwl, BreaksAPediclesWallWhereThePluginsAwlDoes) {
    const Scene scene = pedicle_awl_scene({.towards_canal = 20.0_deg});
    const double slender = 1.75_mm / std::tan(15.0_deg);  // the end of 0.5 mm is blunter, as no drill is as sharp
    test::Rig simulation(body_of(scene.bone, 0.25_mm, {0.21, 0.34, 0.55}),
                         test::drill("profile_drill", {{"spindle_speed", 0.0},
                                                       {"diameter", 0.5_mm},
                                                       {"point_angle", 60.0_deg},
                                                       {"depth_1", 0.433_mm + slender},
                                                       {"diameter_1", 4.0_mm}}),
                         scene.pose_at(scene.depth.front()));
    double awl_most = 0.0, most = 0.0, awl_at = 0.0, at = 0.0;
    PushedAwl awl({}, scene);
    const double shorter = 0.25_mm / std::tan(15.0_deg) - 0.433_mm;  // by so much than a cone of 30° to its end
    int n = 0;
    for (double depth = scene.depth.front(); depth < 20.0_mm; depth += 4.0_um) {
        const double thrust = simulation.tick_direct({scene.pose_at(depth)}).thrust;
        if (depth > 10.0_mm && thrust > most) most = thrust, at = depth;
        if (++n % 25 != 0 || depth < 10.0_mm) continue;
        const double exact = awl.push_at(depth + shorter);
        if (exact > awl_most) awl_most = exact, awl_at = depth;
    }
    EXPECT_NEAR(most / awl_most, 1.0, 0.08);
    EXPECT_NEAR(at, awl_at, 0.3_mm);
}

}  // namespace
}  // namespace kerf::chart
