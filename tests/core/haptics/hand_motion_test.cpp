// SPDX-License-Identifier: Apache-2.0
// The hand's pose and rate from samples that a reader can check by hand.
#include "core/haptics/loop/hand_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "kerf/units.hpp"

namespace kerf {
namespace {

using namespace literals;

constexpr double dt = 1e-3;
const Quat tilted = quat_from_rotation_vector({0.4, -0.9, 0.5});

/// A handle that moves and turns at constant rates, world frame.
struct SteadyHand {
    Vec3 velocity{20.0_mm_per_s, -30.0_mm_per_s, 50.0_mm_per_s};
    Vec3 turning{};  ///< [rad/s]
    Pose pose{{0.1, 0.2, 0.3}, tilted};
    HandMotion motion{pose};

    bool tick(std::uint32_t missed = 0) {
        const double time = dt * (1 + missed);
        pose = {pose.position + time * velocity, quat_from_rotation_vector(time * turning) * pose.rotation};
        return motion.take({pose, missed}, dt);
    }
    void move(int ticks) {
        for (int i = 0; i < ticks; ++i) ASSERT_TRUE(tick());
    }
};

void expect_near(Vec3 is, Vec3 wanted, double tolerance) {
    EXPECT_NEAR(is.x, wanted.x, tolerance);
    EXPECT_NEAR(is.y, wanted.y, tolerance);
    EXPECT_NEAR(is.z, wanted.z, tolerance);
}

TEST(HandMotion, KeepsAConstantRateOverMissedTicks) {
    for (const std::uint32_t missed : {1u, 2u}) {
        SteadyHand hand;
        hand.move(200);
        ASSERT_TRUE(hand.tick(missed));
        expect_near(linear(hand.motion.rate()), hand.velocity, 1e-9);
    }
}

TEST(HandMotion, FiltersTwiceWithTheTimeThatPassed) {
    for (const std::uint32_t missed : {0u, 1u, 2u}) {
        SteadyHand hand;
        ASSERT_TRUE(hand.tick(missed));
        const double weight = 1.0 - std::exp(-2.0 * pi * 50.0 * dt * (1 + missed));
        expect_near(linear(hand.motion.rate()), weight * weight * hand.velocity, 1e-12);
    }
}

TEST(HandMotion, MeasuresTheTurnInTheWorld) {
    SteadyHand hand;
    hand.turning = {0.5, -0.2, 0.8};
    hand.move(200);
    expect_near(angular(hand.motion.rate()), hand.turning, 1e-6 /* the angle is of third order */);
    hand.turning = -hand.turning;
    hand.move(200);
    expect_near(angular(hand.motion.rate()), hand.turning, 1e-6);
}

TEST(HandMotion, KeepsThePoseAndDropsTheRateOfALostHand) {
    SteadyHand hand;
    hand.move(50);
    const Vec3 last = hand.pose.position;
    EXPECT_FALSE(hand.motion.take({.world_from_handle = {{1.0, 1.0, 1.0}, tilted}, .is_lost = true}, dt));
    EXPECT_TRUE(hand.motion.pose().position == last);
    EXPECT_EQ(hand.motion.rate(), Vec6{});
}

TEST(HandMotion, KnowsNoRateUntilTheSecondPoseAfterALoss) {
    SteadyHand hand;
    hand.move(50);
    for (int time = 0; time < 2; ++time) {
        EXPECT_FALSE(hand.motion.take({.world_from_handle = hand.pose, .is_lost = true}, dt));
        EXPECT_FALSE(hand.tick()) << "the first pose after a loss";
        EXPECT_TRUE(hand.motion.pose().position == hand.pose.position);
        EXPECT_EQ(hand.motion.rate(), Vec6{});
        EXPECT_TRUE(hand.tick());
    }
}

TEST(HandMotion, TakesThreeMissedTicksForALoss) {
    SteadyHand hand;
    hand.move(50);
    EXPECT_TRUE(hand.tick(2));
    EXPECT_FALSE(hand.tick(3));
    EXPECT_EQ(hand.motion.rate(), Vec6{});
    EXPECT_TRUE(hand.tick()) << "the pose of the pause is known";
}

TEST(HandMotion, TakesMoreThanTwentyMillimetresForALeap) {
    for (const Vec3 aside : {Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}}) {
        HandMotion near{identity_pose()}, far{identity_pose()};
        EXPECT_TRUE(near.take({{19.9_mm * aside, {1, 0, 0, 0}}}, dt));
        EXPECT_FALSE(far.take({{20.1_mm * aside, {1, 0, 0, 0}}}, dt));
        EXPECT_TRUE(far.pose().position == 20.1_mm * aside) << "the next motion begins there";
        EXPECT_TRUE(far.take({{20.2_mm * aside, {1, 0, 0, 0}}}, dt));
    }
}

}  // namespace
}  // namespace kerf
