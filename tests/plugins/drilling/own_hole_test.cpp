// SPDX-License-Identifier: Apache-2.0
#include "plugins/drilling/own_hole.h"

#include <gtest/gtest.h>

#include "kerf/math.hpp"
#include "kerf/units.hpp"

namespace kerf::drilling {
namespace {

using namespace literals;

constexpr double dt = 1.0_ms, play = 0.05_mm, z = -2.0_mm, land = 1.0_mm;
constexpr Vec3 x{1, 0, 0}, y{0, 1, 0};

OwnHole moved(OwnHole hole, const Vec6& rate, int ticks, double advance = 0.0) {
    for (int i = 0; i < ticks; ++i) hole.move(rate, dt, advance, z, land, play);
    return hole;
}

TEST(OwnHole, ALandGoesAsFarAsItsPlayAndTakesTheMiddleAlong) {
    const Vec6 aside{1.0_mm_per_s, 0, 0, 0, 0, 0}, back{-1.0_mm_per_s, 0, 0, 0, 0, 0};
    EXPECT_NEAR(moved({}, aside, 30).along(x), 0.03_mm, 1e-15);
    const OwnHole far = moved({}, aside, 1000);
    EXPECT_NEAR(far.along(x), play, 1e-15);
    EXPECT_NEAR(moved(far, back, 30).along(x), 0.02_mm, 1e-15) << "from there it has its play again";
    EXPECT_NEAR(moved(far, back, 1000).along(-x), play, 1e-15);
}

TEST(OwnHole, TheHoleStaysWhereItIsWhileTheToolTurnsAndTilts) {
    const OwnHole off{0.03_mm, 0.0};
    const double quarter = 0.5 * pi;
    const OwnHole turned = moved(off, {0, 0, 0, 0, 0, quarter}, 1000);  // by 90°, in steps of 0.09°
    EXPECT_NEAR(turned.along(-y), 0.03_mm, 0.03_mm * 2e-3);
    EXPECT_NEAR(turned.along(x), 0.0, 0.03_mm * 2e-3);
    const OwnHole tilted = moved({}, {0, 0, 0, 0, 10.0_deg, 0}, 10);  // about y: what lies behind the tip goes back
    EXPECT_NEAR(tilted.along(x), z * 0.1_deg, 1e-15);
}

TEST(OwnHole, ALandGoesAsideByBothTiltsAndTurnsOfBothSenses) {
    const OwnHole about_x = moved({}, {0, 0, 0, 10.0_deg, 0, 0}, 10);  // what lies behind the tip goes to +y
    EXPECT_NEAR(about_x.along(y), -z * 0.1_deg, 1e-15);
    EXPECT_NEAR(about_x.along(x), 0.0, 1e-15);
    const OwnHole off{0.0, 0.03_mm};
    for (const double sense : {1.0, -1.0})
        EXPECT_NEAR(moved(off, {0, 0, 0, 0, 0, sense * 0.5 * pi}, 1000).along(x), sense * 0.03_mm, 0.03_mm * 2e-3);
}

TEST(OwnHole, WhatItDrillsAnewLiesWhereItIs) {
    const OwnHole off{0.03_mm, 0.0};
    EXPECT_NEAR(moved(off, {}, 1, 0.25_mm).along(x), 0.75 * 0.03_mm, 1e-15);
    EXPECT_EQ(moved(off, {}, 1, 2.0 * land).along(x), 0.0);
}

}  // namespace
}  // namespace kerf::drilling
