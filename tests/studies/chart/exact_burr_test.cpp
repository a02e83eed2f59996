// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/powered/exact_burr.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "kerf/units.hpp"
#include "studies/chart/powered/powered_reference.h"
#include "studies/chart/powered/round_burr.h"

namespace kerf::chart {
namespace {

using namespace literals;

constexpr double radius = 2.0_mm;

/// Edge forces alone, at their full size from the thinnest chip on: forces are lengths of blade.
BallBurr edges_only() {
    BallBurr burr(Values{{"diameter", 4.0_mm},
                         {"neck_diameter", 1.6_mm},
                         {"blades", 6.0},
                         {"spindle_speed", 500.0},
                         {"thrust_edge", 1.0_N_per_mm},
                         {"thrust_chip", 0.0},
                         {"cutting_edge", 0.7_N_per_mm},
                         {"cutting_chip", 0.0},
                         {"edge_depth", 1e-15},
                         {"reference_density", 1850.0}});
    return burr;
}
ExactBone flat_bone() {
    ExactBone bone;
    bone.surface = [](Vec3 p) { return p.z; };
    bone.tissues = {{"cortical", 1850.0, {}}};
    return bone;
}
/// A burr that looks down, its tip there, moving along +x of the bone.
Pose tip_at(Vec3 tip) { return looking_down(tip); }
Vec6 rate_along(const Pose& pose, Vec3 velocity) { return make_vec6(rotate(conjugate(pose.rotation), velocity), {}); }
Vec3 force_on_burr(ExactBurr& exact, const Pose& pose, Vec3 velocity) {
    return rotate(pose.rotation, linear(*exact.tick(pose, rate_along(pose, velocity))));
}

TEST(GrooveVolume, IsSlotAndHalfOfTheCap) {  // C.7: slot area 2.457 mm²
    EXPECT_NEAR(1e6 * (groove_volume(radius, 1.0_mm, 2.0_mm) - groove_volume(radius, 1.0_mm, 1.0_mm)) / 1.0_mm, 2.457,
                0.0005);
    EXPECT_NEAR(1e9 * groove_volume(radius, 1.0_mm, 0.0), 0.5 * pi * 5.0 / 3.0, 1e-9) << "π d² (3 R − d)/6";
}

// A.6, C.7: the edge forces of a slot. Over the front half of the cap, θ < 60°, the normals sum up to
//     N/(2π) K_e R ∫∫ n dθ dφ = N/(2π) K_e R (2 (1 − cos θ), 0, π sin θ)
// and the turn's, e = (−sin φ, cos φ), to N/(2π) K_t R θ 2 across the way.
TEST(ExactBurr, HasTheAverageForcesOfASlot) {
    const ExactBone bone = flat_bone();
    ExactBurr exact(bone, edges_only());
    const double per_angle = 6.0 / (2.0 * pi) * radius, theta = pi / 3.0;
    const Vec3 force = force_on_burr(exact, tip_at({0, 0, -1.0_mm}), {0.5_mm_per_s, 0, 0});
    // The sums of 32 meridians jump where v·n changes its sign: with real blades forces fade there
    constexpr double sums = 1e-3;
    EXPECT_NEAR(-force.x / (per_angle * 1.0_N_per_mm * 2.0 * (1.0 - std::cos(theta))), 1.0, sums) << "against the way";
    EXPECT_NEAR(force.z / (per_angle * 1.0_N_per_mm * pi * std::sin(theta)), 1.0, sums) << "out of the bone";
    EXPECT_NEAR(std::abs(force.y) / (per_angle * 0.7_N_per_mm * 2.0 * theta), 1.0, sums) << "side pull";
}

TEST(ExactBurr, PullsToTheOtherSideInReverse) {
    const ExactBone bone = flat_bone();
    BallBurr reversed = edges_only();
    reversed.speed = -reversed.speed;
    ExactBurr one(bone, edges_only()), other(bone, reversed);
    const Vec3 a = force_on_burr(one, tip_at({0, 0, -1.0_mm}), {0.5_mm_per_s, 0, 0});
    const Vec3 b = force_on_burr(other, tip_at({0, 0, -1.0_mm}), {0.5_mm_per_s, 0, 0});
    EXPECT_NEAR(a.y, -b.y, 1e-12);
    EXPECT_NEAR(a.x, b.x, 1e-12);
}

TEST(ExactBurr, TakesTheVolumeOfTheGroove) {
    const PoweredScene scene = burr_groove_scene();
    ExactBurr exact(scene.bone, edges_only());
    const Motion motion = prescribed_motion(scene);
    for (std::size_t t = 0; t < motion.from.size(); ++t) (void)exact.tick(motion.from[t], motion.rate[t]);
    EXPECT_NEAR(exact.volume() / *scene.volume, 1.0, 5e-4);
}

TEST(ExactBurr, MeetsTheEdgeOverTheEntryLength) {  // C.7: √(2 R d − d²) = 1.732 mm
    const PoweredScene scene = burr_groove_scene();
    ExactBurr exact(scene.bone, edges_only());
    const Vec3 way{0.5_mm_per_s, 0, 0};
    EXPECT_EQ(length(force_on_burr(exact, tip_at({-1.74_mm, 0, -1.0_mm}), way)), 0.0);
    EXPECT_GT(length(force_on_burr(exact, tip_at({-1.65_mm, 0, -1.0_mm}), way)), 0.0)
        << "a strip within 1/64 of a meridian is not seen";
    const double whole = length(force_on_burr(exact, tip_at({0.5_mm, 0, -1.0_mm}), way));
    EXPECT_LT(length(force_on_burr(exact, tip_at({-0.1_mm, 0, -1.0_mm}), way)), whole);
}

TEST(ExactBurr, FeelsNothingInItsOwnGroove) {  // S-12
    const ExactBone bone = flat_bone();
    BallBurr blades = edges_only();
    blades.thrust.edge_depth = blades.cutting.edge_depth = 0.02_um;
    ExactBurr exact(bone, blades);
    const Vec3 way{1.0_mm_per_s, 0, 0};
    double cut = 0.0, back = 0.0;
    for (int i = 0; i <= 1000; ++i) cut = length(force_on_burr(exact, tip_at({i * 1.0_um, 0, -1.0_mm}), way));
    for (int i = 999; i > 100; --i)  // farther back its rear half has not been
        back = std::max(back, length(force_on_burr(exact, tip_at({i * 1.0_um, 0, -1.0_mm}), -way)));
    EXPECT_GT(cut, 5.0);
    EXPECT_LT(back, 1e-4) << "what touches within 0.1 nm is not known to be gone";
}

TEST(ExactBurr, GrazesWithTheForceOfItsPatch) {
    // At a depth d the front half of a patch of cos θ = 1 − d/R: by the same sums as in a slot.
    const ExactBone bone = flat_bone();
    for (const double depth : {1.0_um, 10.0_um, 50.0_um}) {
        ExactBurr exact(bone, edges_only());
        const double theta = std::acos(1.0 - depth / radius), per_angle = 6.0 / (2.0 * pi) * radius * 1.0_N_per_mm;
        const Vec3 force = force_on_burr(exact, tip_at({0, 0, -depth}), {2.0_mm_per_s, 0, 0});
        EXPECT_NEAR(force.z / (per_angle * pi * std::sin(theta)), 1.0, 2e-3) << depth;
    }
}

TEST(SweptBall, HoldsWhatItPassedAndNotItsSurface) {
    SweptBall ball(1.0_mm);
    for (int i = 0; i <= 100; ++i) ball.go_to({i * 0.05_mm, 0, 0});
    for (int i = 1; i <= 60; ++i) ball.go_to({5.0_mm, i * 0.05_mm, 0});
    ball.go_to({2.0_mm, 3.0_mm, 0});
    ball.go_to({2.0_mm, 1.9_mm, 0});
    ball.look_ahead({0, -1, 0});
    const auto ahead = [](double angle) {
        return Vec3{2.0_mm + 1.0_mm * std::sin(angle), 1.9_mm - 1.0_mm * std::cos(angle), 0};
    };
    EXPECT_TRUE(ball.holds(ahead(0.0))) << "0.9 mm beside the first way";
    EXPECT_FALSE(ball.holds(ahead(std::acos(0.9) + 1e-6))) << "on the wall of it";
    EXPECT_TRUE(ball.holds(ahead(std::acos(0.9) - 1e-6)));
    EXPECT_FALSE(ball.holds(ahead(1.2)));
}

}  // namespace
}  // namespace kerf::chart
