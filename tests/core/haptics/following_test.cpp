// SPDX-License-Identifier: Apache-2.0
// What follows a law: its filter and its bound, with round numbers.
#include "core/haptics/loop/following.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>

namespace kerf {
namespace {

/// 8 N and 0.2 N·m are the most; 100 N·s/m and 0.25 N·m·s/rad hold the tool, 100 mm before the grip.
struct Held {
    std::array<kerf_channel, 2> channels{};
    Balance balance;
    Motion motion;

    Held() {
        balance.force = {.pull = {}, .drag = 100.0, .limit = 8.0};
        balance.torque = {.pull = {}, .drag = 0.25, .limit = 0.2};
        balance.centre = {0, 0, -0.1};
        for (std::uint32_t i = 0; i < 2; ++i) {
            channels[i].id = 7 + i;
            channels[i].d[2] = 1.0;
        }
        balance.channels = std::span(channels).first(1);
    }
};

void expect_near(const Vec6& is, const Vec6& wanted) {
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(is[i], wanted[i], 1e-9) << i;
}

TEST(Following, BeginsWithTheLawsOwnWrench) {
    const Held held;
    const Vec6 own{0.1, 0.2, 0.3, 0.001, 0.002, 0.003};
    expect_near(Following().wrench(held.balance, own), own);
}

TEST(Following, ApproachesItsForceTickByTick) {
    // μ = 0.5, so α = 1/(1 + 0.25)
    Held held;
    held.channels[0].follow[0] = 0.5;
    held.motion.lambda[0] = 4.0;
    Following following;
    following.update(held.balance, held.motion);
    const double torque_free = 0.5 * 3.2;  // of the force alone; its lever about the grip is balanced below
    held.channels[0].follow[4] = 0.5 * -0.1;
    expect_near(following.wrench(held.balance, {}), {torque_free, 0, 0, 0, -0.1 * torque_free, 0});
}

TEST(Following, FollowsEachComponentWithItsSign) {
    Held held;
    held.motion.lambda[0] = 1.0;
    for (std::size_t i = 0; i < 6; ++i) held.channels[0].follow[i] = (i % 2 == 0 ? 1.0 : -1.0) * 1e-3;
    Following following;
    for (int i = 0; i < 100; ++i) following.update(held.balance, held.motion);
    expect_near(following.wrench(held.balance, {1e-3, 0, 0, 0, 0, 0}), {2e-3, -1e-3, 1e-3, -1e-3, 1e-3, -1e-3});
}

TEST(Following, IsSlowerTheMoreFollows) {
    // Forces weigh 1/100, torques 1/(0.25 + 100 · 0.1²) = 0.8; the channel that follows most decides for all
    const auto share_after_one = [](std::initializer_list<double> force, double torque) {
        Held held;
        held.balance.channels = held.channels;
        std::size_t c = 0;
        for (const double follow : force) held.channels[c++].follow[1] = follow;
        held.channels[0].follow[5] = torque;
        held.motion.lambda[0] = 1.0;
        Following following;
        following.update(held.balance, held.motion);
        for (kerf_channel& channel : held.channels) channel.follow[1] = channel.follow[5] = 0.0;
        held.channels[0].follow[2] = 1.0;
        return following.wrench(held.balance, {})[2];
    };
    EXPECT_NEAR(share_after_one({0.0, 0.0}, 0.0), 1.0, 1e-12);
    EXPECT_NEAR(share_after_one({2.0, 0.0}, 0.0), 1.0 / (1.0 + 4.0), 1e-12);
    EXPECT_NEAR(share_after_one({0.0, 2.0}, 0.0), 1.0 / (1.0 + 4.0), 1e-12);
    EXPECT_NEAR(share_after_one({1.0, 2.0}, 0.0), 1.0 / (1.0 + 4.0), 1e-12);
    EXPECT_NEAR(share_after_one({0.0, 0.0}, 0.1), 1.0 / (1.0 + 0.8 * 0.01 / 0.01), 1e-12);
}

TEST(Following, GivesAtMostHalfOfTheLimit) {
    const Held held;
    const Following following;
    // A force through the grip, whose torque is about the tip alone
    const auto through_grip = [](double force) { return Vec6{force, 0, 0, 0, -0.1 * force, 0}; };
    expect_near(following.wrench(held.balance, through_grip(4.0)), through_grip(4.0));
    expect_near(following.wrench(held.balance, through_grip(6.0)), through_grip(4.0));
    expect_near(following.wrench(held.balance, through_grip(-6.0)), through_grip(-4.0));
    const Vec6 torque{0, 0, 0, 0, 0, 0.2}, half{0, 0, 0, 0, 0, 0.1};
    expect_near(following.wrench(held.balance, half), half);
    expect_near(following.wrench(held.balance, torque), half);
    // At the tip the same force turns the tool about the grip: 6 N at 0.1 m are three times the torque's limit
    expect_near(following.wrench(held.balance, {6.0, 0, 0, 0, 0, 0}), {1.0, 0, 0, 0, 0, 0});
}

TEST(Following, ForgetsAChannelThatIsGone) {
    Held held;
    held.channels[0].follow[2] = 0.1;
    held.motion.lambda[0] = 2.0;
    Following following;
    for (int i = 0; i < 50; ++i) following.update(held.balance, held.motion);
    EXPECT_NEAR(following.wrench(held.balance, {})[2], 0.2, 1e-9);

    held.channels[0].id = 99;
    EXPECT_EQ(following.wrench(held.balance, {})[2], 0.0) << "another id is another channel";
    held.motion.lambda[0] = 0.0;
    following.update(held.balance, held.motion);
    held.channels[0].id = 7;
    EXPECT_EQ(following.wrench(held.balance, {})[2], 0.0) << "it is not remembered";

    held.motion.lambda[0] = 2.0;
    following.update(held.balance, held.motion);
    EXPECT_GT(following.wrench(held.balance, {})[2], 0.0);
    following.forget();
    EXPECT_EQ(following.wrench(held.balance, {})[2], 0.0);
}

}  // namespace
}  // namespace kerf
