// SPDX-License-Identifier: Apache-2.0
// The energy balance of a law, against sums by hand.
#include "core/haptics/loop/law_ledger.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "core/haptics/law/channel.h"

namespace kerf {
namespace {

constexpr double dt = 1e-3;

/// A law of one channel along z.
EvaluatedLaw law_of(std::uint32_t kind, double stiffness, double depth) {
    EvaluatedLaw law;
    law.count = law.law_count = 1;
    kerf_channel& channel = law.channel[0];
    channel.kind = kind;
    channel.d[2] = 1.0;
    channel.w = 1e-6;
    channel.k = stiffness;
    channel.delta = depth;
    return law;
}

/// Adds a step at the speed `v` along z.
bool add(LawLedger& ledger, const EvaluatedLaw& law, double v, double push = 0.0, bool is_driven = false) {
    const double lambda = law.law_count == 0 ? 0.0 : channel_force(law.channel[0], v, dt).lambda;
    AppliedMotion applied;
    applied.rate[2] = v;
    applied.following[2] = push;
    applied.lambda = &lambda;
    applied.dt = dt;
    return ledger.add(law, applied, is_driven);
}

/// A second after a change is no part of the balance.
void settle(LawLedger& ledger) {
    for (int i = 0; i < 1000; ++i) ASSERT_FALSE(add(ledger, EvaluatedLaw{}, 0.0));
}

/// Presses a spring 0.1 mm deep in ten steps and lets it out again, fifty times in a second. Returns whether the law
/// made energy.
bool press_for_a_second(LawLedger& ledger, double in, double out, std::uint32_t kind = KERF_CONTACT) {
    constexpr double step = 10e-6;
    bool made = false;
    for (int press = 0; press < 50; ++press)
        for (int i = 0; i < 20; ++i) {
            const double depth = step * (i < 10 ? i : 20 - i);
            made = add(ledger, law_of(kind, i < 10 ? in : out, depth), (i < 10 ? step : -step) / dt) || made;
        }
    return made;
}

TEST(LawLedger, FindsNoEnergyInASpring) {
    for (const std::uint32_t kind : {KERF_CONTACT, KERF_HOLD}) {
        LawLedger ledger;
        settle(ledger);
        EXPECT_FALSE(press_for_a_second(ledger, 1e5, 1e5, kind));
        EXPECT_EQ(ledger.largest().made, 0.0);
    }
}

TEST(LawLedger, FindsWhatARatchetReturns) {
    LawLedger ledger;
    settle(ledger);
    EXPECT_TRUE(press_for_a_second(ledger, 1e5, 3e5));
    // A press takes k Δ² (1 + … + 10) = 0.55 mJ, of which ½ k δ² = 0.5 mJ are stored; 3 k Δ² (0 + … + 9) = 1.35 mJ come
    // back.
    EXPECT_NEAR(ledger.largest().made, 50 * (1.35e-3 - 0.5e-3), 1e-9);
    EXPECT_NEAR(ledger.largest().through, 50 * (0.55e-3 + 1.35e-3), 1e-9);
    EXPECT_FALSE(press_for_a_second(ledger, 1e5, 3e5)) << "once a tool";
    ledger.restart();
    settle(ledger);
    EXPECT_TRUE(press_for_a_second(ledger, 1e5, 3e5));
}

TEST(LawLedger, LeavesASmallOrSlightExcess) {
    LawLedger ledger;
    settle(ledger);
    EXPECT_FALSE(press_for_a_second(ledger, 1e4, 3e4)) << "4.3 mJ are below 40 mJ";
    EXPECT_FALSE(press_for_a_second(ledger, 1e6, 1.5e6)) << "87 mJ of 612 mJ are below two fifths";
}

TEST(LawLedger, LetsContactTakeOverWhereADriveChanges) {
    LawLedger ledger;
    settle(ledger);
    ledger.change_drive();
    EXPECT_FALSE(press_for_a_second(ledger, 1e5, 3e5));
    EXPECT_TRUE(press_for_a_second(ledger, 1e5, 3e5)) << "a second later";
}

TEST(LawLedger, CountsAPushAlongTheMotion) {
    const auto made_in_air = [](bool is_driven, const auto& push_at) {
        LawLedger ledger;
        settle(ledger);
        bool made = false;
        for (int i = 0; i < 1000; ++i) {
            const double v = 10e-3 * std::cos(0.2 * i);
            made = add(ledger, EvaluatedLaw{}, v, push_at(i, v), is_driven) || made;
        }
        return made;
    };
    const auto along = [](int, double v) { return std::copysign(10.0, v); };
    EXPECT_TRUE(made_in_air(true, along)) << "10 N over 6 mm";
    EXPECT_TRUE(made_in_air(false, along));
    EXPECT_FALSE(made_in_air(true, [](int i, double) { return 10.0 * std::sin(0.2 * i); })) << "it shakes";
    EXPECT_FALSE(made_in_air(true, [](int, double v) { return std::copysign(3.0, -v); })) << "it brakes";
}

TEST(LawLedger, LetsAMotorPushWhereItTouches) {
    const EvaluatedLaw touching = law_of(KERF_CONTACT, 1e5, 20e-6);  // 3 N
    const auto made = [&](double push, bool is_driven) {
        LawLedger ledger;
        settle(ledger);
        bool was_odd = false;
        for (int i = 0; i < 1000; ++i) was_odd = add(ledger, touching, 10e-3, push, is_driven) || was_odd;
        return was_odd;
    };
    EXPECT_TRUE(made(30.0, false)) << "300 mJ of a wrench, against 30 mJ that the contact took";
    EXPECT_FALSE(made(30.0, true)) << "bone carries ten times the contact's force";
    EXPECT_TRUE(made(33.0, true)) << "30 mJ beyond";
    EXPECT_FALSE(made(30.4, true)) << "4 mJ beyond";
}

TEST(LawLedger, EndsASecondEarly) {
    LawLedger ledger;
    settle(ledger);
    for (int i = 0; i < 300; ++i) EXPECT_FALSE(add(ledger, EvaluatedLaw{}, 10e-3, 10.0, true));
    EXPECT_TRUE(ledger.finish());
    EXPECT_NEAR(ledger.last().made, 300 * 100e-6, 1e-12);
}

TEST(LawLedger, SumsWhatTheChannelsResisted) {
    LawLedger ledger;
    const EvaluatedLaw touching = law_of(KERF_CONTACT, 1e5, 0.0);
    for (int i = 0; i < 100; ++i) static_cast<void>(add(ledger, touching, 10e-3));  // 1 N over 10 µm each
    EXPECT_NEAR(ledger.impulse(), 100 * 1.0 * dt, 1e-12);
    EXPECT_NEAR(ledger.work(), 100 * 1.0 * 10e-6, 1e-12);
}

}  // namespace
}  // namespace kerf
