// SPDX-License-Identifier: Apache-2.0
// Each kind of channel against its formula, with round numbers, and each bound of what is sound.
#include "core/haptics/law/channel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "kerf/abi.h"

namespace kerf {
namespace {

constexpr double dt = 1e-3;

kerf_channel channel(std::uint32_t kind) {
    kerf_channel c{};
    c.kind = kind;
    c.d[2] = 1.0;
    c.tau = 100.0;
    c.w = 0.01;
    c.eta = 500.0;
    c.k = 2000.0;
    c.b = 30.0;
    return c;
}
ChannelForce at(const kerf_channel& c, double s) { return channel_force(c, s, dt); }

TEST(Cut, BuildsUpOverItsWidthThenRisesEvenly) {
    const kerf_channel c = channel(KERF_CUT);
    const double kept = std::exp(-2.0);
    EXPECT_NEAR(at(c, 0.02).lambda, 100.0 * (1.0 - kept) + 500.0 * 0.02, 1e-9);
    EXPECT_NEAR(at(c, 0.02).slope, 100.0 / 0.01 * kept + 500.0, 1e-6);
}

TEST(Cut, BeginsBeyondItsGap) {
    kerf_channel c = channel(KERF_CUT);
    c.gap = 0.01e-3;  // 10 mm/s for a tick
    EXPECT_EQ(at(c, 0.01).lambda, 0.0);
    EXPECT_EQ(at(c, 0.01).slope, 0.0);
    EXPECT_NEAR(at(c, 0.03).lambda, 100.0 * (1.0 - std::exp(-2.0)) + 500.0 * 0.02, 1e-9);
    EXPECT_EQ(at(channel(KERF_CUT), 0.0).lambda, 0.0);
    EXPECT_EQ(at(channel(KERF_CUT), -0.02).lambda, 0.0) << "a cut does not pull";
}

TEST(ContactChannel, NeverPulls) {
    kerf_channel c = channel(KERF_CONTACT);
    c.delta = 0.5e-3;
    EXPECT_NEAR(at(c, 0.0).lambda, 2000.0 * 0.5e-3, 1e-12);
    EXPECT_NEAR(at(c, 0.1).lambda, 2000.0 * 0.6e-3 + 30.0 * 0.1, 1e-12) << "at the end of the tick";
    EXPECT_NEAR(at(c, 0.1).slope, 2000.0 * dt + 30.0, 1e-12);
    EXPECT_EQ(at(c, -0.2).lambda, 0.0) << "it comes off";
    EXPECT_EQ(at(c, -0.2).slope, 0.0);
}

TEST(ContactChannel, ApartItBeginsWhereItIsMet) {
    kerf_channel c = channel(KERF_CONTACT);
    c.delta = -0.1e-3;  // 0.1 m/s for a tick
    EXPECT_NEAR(at(c, 0.1).lambda, 0.0, 1e-12);
    EXPECT_NEAR(at(c, 0.3).lambda, 2000.0 * 0.2e-3 + 30.0 * 0.2, 1e-12);
    EXPECT_EQ(at(c, 0.05).lambda, 0.0);
}

TEST(Friction, SaturatesAtItsWidthEitherWay) {
    const kerf_channel c = channel(KERF_FRICTION);
    EXPECT_EQ(at(c, 0.0).lambda, 0.0);
    EXPECT_NEAR(at(c, 0.005).lambda, 50.0, 1e-12);
    EXPECT_NEAR(at(c, -0.005).lambda, -50.0, 1e-12);
    EXPECT_EQ(at(c, 0.01).lambda, 100.0);
    EXPECT_EQ(at(c, -0.01).lambda, -100.0);
    EXPECT_EQ(at(c, 0.5).lambda, 100.0);
    EXPECT_EQ(at(c, -0.5).lambda, -100.0);
    EXPECT_EQ(at(c, 0.5).slope, 0.0);
    EXPECT_EQ(at(c, -0.5).slope, 0.0);
    EXPECT_NEAR(at(c, 0.0).slope, 1e4, 1e-9);
}

TEST(Hold, PullsAsWellAsItPushes) {
    kerf_channel c = channel(KERF_HOLD);
    c.delta = -0.5e-3;
    EXPECT_NEAR(at(c, 0.0).lambda, -1.0, 1e-12);
    EXPECT_NEAR(at(c, 0.1).lambda, 2000.0 * -0.4e-3 + 30.0 * 0.1, 1e-12);
    EXPECT_NEAR(at(c, 0.1).slope, 2000.0 * dt + 30.0, 1e-12);
}

TEST(Hold, GivesWayAtItsLimit) {
    kerf_channel c = channel(KERF_HOLD);
    c.tau = 3.0;
    c.delta = 1.4e-3;
    EXPECT_NEAR(at(c, 0.0).lambda, 2.8, 1e-12) << "below it, a spring";
    EXPECT_NEAR(at(c, 0.0).slope, 2000.0 * dt + 30.0, 1e-12);
    EXPECT_EQ(at(c, 1.0).lambda, 3.0);
    EXPECT_EQ(at(c, -1.0).lambda, -3.0);
    EXPECT_EQ(at(c, 1.0).slope, 0.0);
    c.tau = 0.0;
    EXPECT_GT(at(c, 1.0).lambda, 30.0) << "0 is no limit";
}

TEST(ChannelOfNoKind, HasNoForce) {
    EXPECT_EQ(at(channel(KERF_HOLD + 1), 0.1).lambda, 0.0);
    EXPECT_FALSE(is_sound(channel(KERF_HOLD + 1)));
}

TEST(SoundChannel, EachKindIsOne) {
    for (std::uint32_t kind = KERF_CUT; kind <= KERF_HOLD; ++kind) EXPECT_TRUE(is_sound(channel(kind))) << kind;
}

TEST(SoundChannel, CoefficientsMayBeZero) {
    kerf_channel c = channel(KERF_CUT);
    c.tau = c.eta = c.gap = c.k = c.b = c.delta = 0.0;
    EXPECT_TRUE(is_sound(c));
}

TEST(SoundChannel, EachComponentOfBothDirectionsIsFinite) {
    for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL})
        for (int i = 0; i < 6; ++i) {
            kerf_channel c = channel(KERF_CUT), f = channel(KERF_CUT);
            c.d[i] = bad;
            f.follow[i] = bad;
            EXPECT_FALSE(is_sound(c)) << i;
            EXPECT_FALSE(is_sound(f)) << i;
        }
    kerf_channel c = channel(KERF_CUT);
    c.delta = std::nan("");
    EXPECT_FALSE(is_sound(c));
    c.delta = -1.0;
    EXPECT_TRUE(is_sound(c)) << "apart";
}

TEST(SoundChannel, AnyComponentIsADirection) {
    for (int i = 0; i < 6; ++i) {
        kerf_channel c = channel(KERF_CUT);
        c.d[2] = 0.0;
        EXPECT_FALSE(is_sound(c));
        c.d[i] = -1e-3;
        EXPECT_TRUE(is_sound(c)) << i;
    }
}

TEST(SoundChannel, NeedsAWidthForCutAndFriction) {
    for (const std::uint32_t kind : {KERF_CUT, KERF_FRICTION}) {
        kerf_channel c = channel(kind);
        c.w = 1e-6;
        EXPECT_TRUE(is_sound(c));
        c.w = std::nextafter(1e-6, 0.0);
        EXPECT_FALSE(is_sound(c));
        c.w = HUGE_VAL;
        EXPECT_FALSE(is_sound(c));
    }
    for (const std::uint32_t kind : {KERF_CONTACT, KERF_HOLD}) {
        kerf_channel c = channel(kind);
        c.w = 0.0;
        EXPECT_TRUE(is_sound(c)) << "they have none";
    }
}

TEST(OwnContactChannel, IsAContactOfWhatItSays) {
    const kerf_channel c = contact_channel(OwnContact::metal, {1, 2, 3, 4, 5, 6}, 700.0, -0.25);
    EXPECT_EQ(c.kind, static_cast<std::uint32_t>(KERF_CONTACT));
    EXPECT_EQ(c.id, static_cast<std::uint32_t>(OwnContact::metal));
    for (int i = 0; i < 6; ++i) EXPECT_EQ(c.d[i], i + 1.0);
    EXPECT_EQ(c.k, 700.0);
    EXPECT_EQ(c.delta, -0.25);
    EXPECT_EQ(c.b, 0.0);
    EXPECT_TRUE(is_sound(c));
}

}  // namespace
}  // namespace kerf
