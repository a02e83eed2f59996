// SPDX-License-Identifier: Apache-2.0
#include "plugins/drilling/hole_line.h"

#include <gtest/gtest.h>

#include "kerf/units.hpp"

namespace kerf::drilling {
namespace {

using namespace literals;

constexpr Vec3 at{0, 0, -10.0_mm}, x{1, 0, 0}, y{0, 1, 0};

HoleLine moved(HoleLine line, const Vec6& rate, double seconds) {
    constexpr double dt = 0.1_ms;
    for (double t = 0.5 * dt; t < seconds; t += dt) line.move(rate, dt);
    return line;
}

TEST(HoleLine, APlaceOfTheToolHasGoneAsFarAsItMoved) {
    const HoleLine line = moved({}, {2.0_mm_per_s, -1.0_mm_per_s, 3.0_mm_per_s, 0, 0, 0}, 1.0);
    EXPECT_NEAR(line.offset(at, x), 2.0_mm, 1e-12);
    EXPECT_NEAR(line.offset(at, y), -1.0_mm, 1e-12);
    const HoleLine tilted = moved({}, {0, 0, 0, 0, 1.0_deg, 0}, 1.0);  // about y: what lies behind the tip goes back
    EXPECT_NEAR(tilted.offset(at, x), -10.0_mm * 1.0_deg, 1e-6 * 10.0_mm);
    EXPECT_NEAR(tilted.offset({}, x), 0.0, 1e-12);
}

TEST(HoleLine, ATiltedToolThatIsDrawnBackGoesAside) {
    const HoleLine line = moved(moved({}, {0, 0, 0, 0, 2.0_deg, 0}, 1.0), {0, 0, -5.0_mm_per_s, 0, 0, 0}, 1.0);
    EXPECT_NEAR(line.offset({}, x), -5.0_mm * 2.0_deg, 1e-4 * 5.0_mm) << "the tip stands 5 mm up its own axis";
}

TEST(HoleLine, TiltsAboutXAsItDoesAboutY) {
    const HoleLine tilted = moved({}, {0, 0, 0, 1.0_deg, 0, 0}, 1.0);  // about x: what lies behind the tip goes to +y
    EXPECT_NEAR(tilted.offset(at, y), 10.0_mm * 1.0_deg, 1e-6 * 10.0_mm);
    EXPECT_NEAR(tilted.offset(at, x), 0.0, 1e-12);
    const HoleLine back = moved(tilted, {0, 0, -5.0_mm_per_s, 0, 0, 0}, 1.0);
    EXPECT_NEAR(back.offset({}, y), 5.0_mm * 1.0_deg, 1e-4 * 5.0_mm) << "up its own axis, which leans to −y";
}

TEST(HoleLine, KeepsItsTiltInTheBoneWhileTheToolIsTurned) {
    // Given a tool that leans by 1 degree about y, turned by a quarter to either side
    for (const double sense : {1.0, -1.0}) {
        const HoleLine line = moved(moved({}, {0, 0, 0, 0, 1.0_deg, 0}, 1.0), {0, 0, 0, 0, 0, sense * 0.5 * pi}, 1.0);
        EXPECT_NEAR(line.offset(at, y), sense * 10.0_mm * 1.0_deg, 1e-3 * 10.0_mm * 1.0_deg) << sense;
        EXPECT_NEAR(line.offset(at, x), 0.0, 1e-3 * 10.0_mm * 1.0_deg) << sense;
    }
}

TEST(HoleLine, StaysInTheBoneWhileTheToolIsTurned) {
    const HoleLine line = moved(moved({}, {1.0_mm_per_s, 0, 0, 0, 0, 0}, 1.0), {0, 0, 0, 0, 0, 0.5 * pi}, 1.0);
    EXPECT_NEAR(line.offset({}, x), 0.0, 1.0_mm * 1e-3);
    EXPECT_NEAR(line.offset({}, y), -1.0_mm, 1.0_mm * 1e-3) << "what was +x for the tool is -y now";
}

}  // namespace
}  // namespace kerf::drilling
