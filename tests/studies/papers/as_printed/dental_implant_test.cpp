// SPDX-License-Identifier: Apache-2.0
#include "studies/papers/as_printed/dental_implant.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/studies/papers/as_printed/printed_rig.h"

namespace kerf::as_printed {
namespace {

using namespace literals;

// P7: a linear field is reproduced. Printed, two of its axes change places.
TEST(DentalImplant, EquationNineteenSwapsTwoAxes) {  // E02-3
    const auto linear_field = [](double x, double y, double z) { return x + 2.0 * y + 4.0 * z; };
    const std::array<double, 8> nodes = {0, 1, 3, 2, 4, 5, 7, 6};  // in the order of the list of indices
    double worst = 0.0;
    for (const double y : {0.0, 0.5, 1.0})
        for (const double z : {0.0, 0.5, 1.0})
            worst = std::max(worst, std::abs(density_as_printed(nodes, 0.5, y, z) - linear_field(0.5, y, z)));
    EXPECT_NEAR(worst, 2.0, 1e-12) << "of a range of 7";
    EXPECT_NEAR(density_as_printed(nodes, 0.3, 0.4, 0.4), linear_field(0.3, 0.4, 0.4), 1e-12) << "right where y = z";
}

// P3: antipodal elements in one material cancel. These have one phase, and add.
TEST(DentalImplant, EveryElementPushesTheSameWay) {  // E02-5
    test::InTheBlock block("M6");
    const chart::Scene whole = chart::block_scene(chart::slab_scene(0.0), 4.0_mm);
    const auto run = test::method("M6").start(whole, {0.5_mm, 31, {}}, 1.0);
    const Vec3 force = linear(run->tick(whole.pose_at(3.0_mm)).wrench);
    (void)force;
    const Vec3 felt = linear(run->tick(whole.pose_at(3.0_mm)).wrench);
    EXPECT_GT(std::hypot(felt.x, felt.y), 0.5 * std::abs(felt.z)) << "where there is no sideways force at all";
}

TEST(DentalImplant, ForceOfAnElementKeepsItsLength) {  // 02-06
    const Vec3 f = element_force(3.0, 4.0, sin_cos_exact(31.0_deg), sin_cos_exact(1.0));
    EXPECT_NEAR(length(f), 5.0, 1e-12);
}

TEST(DentalImplant, ItsTangentialForceGoesWithTheTurn) {  // E02-7, P10
    const SinCos alpha = sin_cos_exact(0.7);
    const Vec3 edge_moves{-alpha.sin, alpha.cos, 0.0};
    EXPECT_GT(dot(element_force(0.0, 1.0, sin_cos_exact(31.0_deg), alpha), edge_moves), 0.0) << "should be negative";
}

// P9: zero feed, zero cutting force. Printed, the feed is not in it.
TEST(DentalImplant, AStandingDrillFeelsAllOfIt) {  // E02-6
    chart::Scene scene = chart::block_scene(chart::slab_scene(0.0), 4.0_mm);
    scene.depth.front() = 3.0_mm;
    const auto run = test::method("M6").start(scene, {0.5_mm, 31, {}}, 1.0);
    EXPECT_LT(run->tick(scene.pose_at(3.0_mm)).wrench[2], -100.0) << "N";
}

// P5: the same way in half as many ticks wears half as much.
TEST(DentalImplant, RemovalFollowsTheLoopsRate) {  // E02-8
    const auto worn_after = [](int ticks) {
        chart::Scene scene = chart::block_scene(chart::slab_scene(0.0), 4.0_mm);
        scene.depth.front() = 3.0_mm;
        const auto run = test::method("M6").start(scene, {0.5_mm, 31, {}}, 1.0);
        const double first = run->tick(scene.pose_at(3.0_mm)).wrench[2];
        for (int i = 0; i < ticks; ++i) (void)run->tick(scene.pose_at(3.0_mm));
        return 1.0 - run->tick(scene.pose_at(3.0_mm)).wrench[2] / first;
    };
    EXPECT_GT(worn_after(40), 1.5 * worn_after(4)) << "a drill that stands still grinds on, tick by tick";
}

}  // namespace
}  // namespace kerf::as_printed
