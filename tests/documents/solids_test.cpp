// SPDX-License-Identifier: Apache-2.0
#include "documents/solids.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

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

TEST(EllipticTubeSolid, BoundsContainItsWiderSide) {
    for (const auto& [width, height] : {std::pair<double, double>{10.0_mm, 15.0_mm}, {15.0_mm, 10.0_mm}}) {
        const EllipticTubeSolid tube{{0, 0, 0}, {0, 30.0_mm, 0}, width, height, {0, 0, 1}};
        const Box bounds = bounds_of(tube);
        EXPECT_LE(bounds.low.x, -0.5 * width);
        EXPECT_GE(bounds.high.x, 0.5 * width);
        EXPECT_LE(bounds.low.z, -0.5 * height);
        EXPECT_GE(bounds.high.z, 0.5 * height);
        EXPECT_LE(bounds.low.y, 0.0);
        EXPECT_GE(bounds.high.y, 30.0_mm);
    }
}

TEST(TissueRegion, PassesSmoothlyIntoTheRest) {
    Tissue tissue;
    tissue.thickness = 1.0_mm;
    tissue.density = 300.0;
    tissue.regions = {{{SphereSolid{{0, 0, 0}, 10.0_mm}}, 2.0_mm, 0.4_mm, 0.0},
                      {{SphereSolid{{10.0_mm, 0, 0}, 10.0_mm}}, 2.0_mm, 0.8_mm, 200.0}};
    EXPECT_DOUBLE_EQ(thickness_at(tissue, {0, 5.0_mm, 0}), 0.4_mm);
    EXPECT_DOUBLE_EQ(thickness_at(tissue, {8.0_mm, 0, 0}), 0.4_mm) << "the first region has precedence";
    EXPECT_DOUBLE_EQ(thickness_at(tissue, {15.0_mm, 0, 0}), 0.8_mm);
    EXPECT_NEAR(thickness_at(tissue, {-11.0_mm, 0, 0}), 0.7_mm, 1e-9) << "half way";
    EXPECT_NEAR(thickness_at(tissue, {11.0_mm, 0, 0}), 0.6_mm, 1e-9) << "half of the first over the second";
    EXPECT_DOUBLE_EQ(thickness_at(tissue, {-13.0_mm, 0, 0}), 1.0_mm);
    EXPECT_DOUBLE_EQ(density_at(tissue, {0, 0, 0}), 200.0) << "the first has no density of its own";
    EXPECT_DOUBLE_EQ(density_at(tissue, {-5.0_mm, 0, 0}), 300.0);
    EXPECT_DOUBLE_EQ(thinnest(tissue), 0.4_mm);
    EXPECT_DOUBLE_EQ(thickest(tissue), 1.0_mm);
}

}  // namespace
}  // namespace kerf::documents
