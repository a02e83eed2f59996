// SPDX-License-Identifier: Apache-2.0
#include "bone/measure/border.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "kerf/units.hpp"

namespace kerf::bone {
namespace {

using namespace literals;

const BorderView from_below{{0, 1, 0}, {0, 0, -1}};
const Path border{{{0, 0, 0}, {40.0_mm, 0, 0}}, 10.0_mm};

std::vector<Vec3> points_at(double (*height)(double)) {
    std::vector<Vec3> points;
    for (int i = 0; i < 40; ++i) {
        const double x = (i + 0.5) * 1.0_mm;
        points.push_back({x, 0, height(x)});
        points.push_back({x, 0, height(x) + 3.0_mm});  // behind the outline
    }
    return points;
}

TEST(BorderRoughness, OfASmoothCurveIsNone) {
    const auto curve = border_roughness(points_at([](double x) { return 2.0 * x * x; }), border, from_below, 0.01_mm);
    ASSERT_TRUE(curve);
    EXPECT_NEAR(curve->value, 0.0, 1e-9);
    EXPECT_EQ(curve->uncertainty, 0.01_mm);
}

TEST(BorderRoughness, OfAComb) {
    // Every second millimetre is 0.4 mm lower: ±0.2 mm about the middle.
    const auto comb = border_roughness(points_at([](double x) { return std::fmod(x, 2.0_mm) < 1.0_mm ? 0.0 : 0.4_mm; }),
                                       border, from_below, 0.0);
    ASSERT_TRUE(comb);
    EXPECT_NEAR(comb->value, 0.2_mm, 0.002_mm /* the parabola follows the ends a little */);
}

TEST(BorderRoughness, NeedsABorder) {
    EXPECT_FALSE(border_roughness({}, border, from_below, 0.0));
    const std::vector<Vec3> few{{1.0_mm, 0, 0}, {2.0_mm, 0, 0}};
    EXPECT_FALSE(border_roughness(few, border, from_below, 0.0));
}

}  // namespace
}  // namespace kerf::bone
