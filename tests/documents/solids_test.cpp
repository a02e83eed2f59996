// SPDX-License-Identifier: Apache-2.0
#include "documents/solids.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kerf/units.hpp"

namespace kerf::documents {
namespace {

using namespace literals;

const SphereSolid ball{{10.0_mm, -(20.0_mm), 5.0_mm}, 23.0_mm};

TEST(SphereSolid, DistanceIsToItsSurface) {
    EXPECT_NEAR(distance_to(ball, ball.centre), -(23.0_mm), 1e-15);
    EXPECT_NEAR(distance_to(ball, ball.centre + Vec3{0, 30.0_mm, 40.0_mm}), 27.0_mm, 1e-15 /* 3, 4, 5 */);
}

TEST(SphereSolid, BoundsTouchItOnAllSides) {
    const Box bounds = bounds_of(ball);
    EXPECT_NEAR(bounds.low.x, -(13.0_mm), 1e-15);
    EXPECT_NEAR(bounds.low.y, -(43.0_mm), 1e-15);
    EXPECT_NEAR(bounds.low.z, -(18.0_mm), 1e-15);
    EXPECT_NEAR(bounds.high.x, 33.0_mm, 1e-15);
    EXPECT_NEAR(bounds.high.y, 3.0_mm, 1e-15);
    EXPECT_NEAR(bounds.high.z, 28.0_mm, 1e-15);
}

TEST(SphereSolid, HasTheVolumeOfASphere) {
    const double step = 0.5_mm;
    double volume = 0.0;
    const Box bounds = bounds_of(ball);
    for (double x = bounds.low.x; x < bounds.high.x; x += step)
        for (double y = bounds.low.y; y < bounds.high.y; y += step)
            for (double z = bounds.low.z; z < bounds.high.z; z += step)
                volume += distance_to(ball, {x, y, z}) < 0.0 ? step * step * step : 0.0;
    const double exact = 4.0 / 3.0 * 3.14159265358979323846 * std::pow(23.0_mm, 3);
    EXPECT_NEAR(volume / exact, 1.0, 1e-3 /* counted in cubes of 0.5 mm */);
}

}  // namespace
}  // namespace kerf::documents
