// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/loop/motor_heat.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace kerf {
namespace {

constexpr double continuous = 2.0, peak = 8.0, dt = 1e-3;  // [N], [s]

/// A hand that pushes with this force, as far as the device resists. Returns the last usable fraction.
double push(MotorHeat& heat, double force, double seconds) {
    for (int tick = 0; tick < static_cast<int>(seconds / dt); ++tick)
        heat.take(std::min(force, heat.usable_fraction() * peak), continuous, peak, dt);
    return heat.usable_fraction();
}

TEST(MotorHeat, AllowsThePeakForAsLongAsItIsCool) {
    // At twice the continuous force the heat is 4 (1 - exp(-t / 30 s)): 0.8 after 6.69 s.
    MotorHeat heat;
    EXPECT_EQ(push(heat, 4.0, 6.6), 1.0);
    EXPECT_LT(push(heat, 4.0, 0.2), 1.0);
}

TEST(MotorHeat, FallsToTheContinuousForceUnderALastingPush) {
    MotorHeat heat;
    push(heat, peak, 300.0);
    // Heat h and limit F settle where h = (F / 2 N)^2 and F = 8 N - 6 N (h - 0.8) / 0.2: at h = 1 and F = 2 N.
    EXPECT_NEAR(push(heat, peak, 1.0) * peak, continuous, 1e-3);
    EXPECT_NEAR(heat.heat(), 1.0, 1e-3) << "what the motors carry for ever";
}

TEST(MotorHeat, AllowsTheContinuousForceForEver) {
    MotorHeat heat;
    EXPECT_GE(push(heat, continuous, 600.0) * peak, continuous * (1.0 - 1e-9));
}

TEST(MotorHeat, CoolsInRest) {
    MotorHeat heat;
    push(heat, peak, 60.0);
    EXPECT_EQ(push(heat, 0.0, 7.0), 1.0) << "from 1 to 0.8 in 6.7 s";
    EXPECT_TRUE(heat.is_warm());
    push(heat, 0.0, 4.0);
    EXPECT_FALSE(heat.is_warm()) << "from 1 to 0.7 in 10.7 s";
}

TEST(MotorHeat, NeverJumps) {
    MotorHeat heat;
    double last = 1.0;
    for (int tick = 0; tick < 60000; ++tick) {
        heat.take(last * peak, continuous, peak, dt);
        const double fraction = heat.usable_fraction();
        EXPECT_LT(std::abs(fraction - last) * peak, 0.03) << "[N] in a tick; S-21 allows 0.5 N";
        last = fraction;
    }
}

TEST(MotorHeat, LimitsNothingWithoutAContinuousForce) {
    MotorHeat heat;
    for (int tick = 0; tick < 100000; ++tick) heat.take(peak, 0.0, peak, dt);
    EXPECT_EQ(heat.usable_fraction(), 1.0);
}

}  // namespace
}  // namespace kerf
