// SPDX-License-Identifier: Apache-2.0
// The shipped third lumbar vertebra has the dimensions that it was made from.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "documents/read_anatomy.h"
#include "documents/solids.h"
#include "kerf/units.hpp"

namespace kerf::documents {
namespace {

using namespace literals;

const Anatomy& vertebra() {
    static const Anatomy read = [] {
        text::Diagnostics diagnostics;
        auto anatomy = read_anatomy(KERF_SOURCE_DIR "/procedures/anatomy/vertebra-l3.yaml").take(diagnostics);
        EXPECT_TRUE(anatomy) << to_text(diagnostics);
        return anatomy.value_or(Anatomy{});
    }();
    return read;
}

/// Returns how far the border of bone is from a point in a direction, up to 60 mm.
double to_border(Vec3 from, Vec3 along) {
    const bool is_inside = distance_to(vertebra().phantom, from) < 0.0;
    for (double far = 0.0; far < 60.0_mm; far += 0.02_mm)
        if ((distance_to(vertebra().phantom, from + far * along) < 0.0) != is_inside) return far;
    return HUGE_VAL;
}
double across(Vec3 at, Vec3 along) { return to_border(at, along) + to_border(at, -along); }

/// Of the body in a plane; its middle may be hollow there.
double width_from_outside(double z) {
    return 2.0 * 50.0_mm - to_border({-50.0_mm, 0, z}, {1, 0, 0}) - to_border({50.0_mm, 0, z}, {-1, 0, 0});
}

TEST(VertebraL3, HasAPedicleOfItsWidthHeightAndAngle) {
    const double angle = 14.4 * 3.14159265358979323846 / 180.0;
    const Vec3 isthmus{-17.16_mm, 21.5_mm, 4.0_mm}, side{std::cos(angle), std::sin(angle), 0};
    EXPECT_NEAR(across(isthmus, side), 9.7_mm, 0.3_mm);
    EXPECT_NEAR(across(isthmus, {0, 0, 1}), 14.7_mm, 0.3_mm);
    const LandmarkAxis& axis = vertebra().axes.front();
    ASSERT_EQ(axis.id, "right_pedicle");
    const Vec3 along = normalized(axis.to - axis.from);
    EXPECT_NEAR(std::atan2(along.x, -along.y), angle, 0.005);
    EXPECT_LT(length(cross(isthmus - axis.from, along)), 0.1_mm) << "it leads through the middle";
}

TEST(VertebraL3, HasABodyOfItsSize) {
    EXPECT_NEAR(width_from_outside(-11.6_mm), 48.0_mm, 0.5_mm);
    EXPECT_NEAR(width_from_outside(11.6_mm), 44.8_mm, 0.5_mm);
    EXPECT_NEAR(across({0, 0, 11.0_mm}, {0, 1, 0}), 35.2_mm, 0.5_mm);
    EXPECT_NEAR(across({0, 0, -4.0_mm}, {1, 0, 0}), 40.3_mm, 0.5_mm) << "its waist";
    EXPECT_NEAR(across({0, -15.5_mm, 0}, {0, 0, 1}), 26.7_mm, 1.0_mm);
    EXPECT_NEAR(across({0, -1.0_mm, 0}, {0, 0, 1}), 26.7_mm - 1.5_mm - 2.5_mm, 0.5_mm) << "between hollow end-plates";
}

TEST(VertebraL3, HasACanalOfItsWidthAndDepth) {
    const Vec3 level_with_pedicles{0, 21.5_mm, 4.0_mm};
    EXPECT_NEAR(across(level_with_pedicles, {1, 0, 0}), 24.3_mm, 0.5_mm);
    double depth = HUGE_VAL;
    for (double z = -14.0_mm; z < 4.0_mm; z += 0.5_mm) depth = std::min(depth, across({0, 24.0_mm, z}, {0, 1, 0}));
    EXPECT_NEAR(depth, 15.7_mm, 0.5_mm);
    for (double z = -30.0_mm; z <= 30.0_mm; z += 0.5_mm)
        EXPECT_GT(distance_to(vertebra().phantom, {0, 25.0_mm, z}), 6.0_mm) << "a tube of 12 mm passes at " << z;
}

TEST(VertebraL3, ReachesFromTipToTipAsFarAsItsProcesses) {
    double farthest = 0.0;  // to the right, anywhere in the section there
    for (double x = 40.0_mm; x < 50.0_mm; x += 0.1_mm)
        for (double y = 28.0_mm; y < 40.0_mm; y += 0.5_mm)
            for (double z = 0.0; z < 12.0_mm; z += 0.5_mm)
                if (distance_to(vertebra().phantom, {-x, y, z}) < 0.0) farthest = x;
    EXPECT_NEAR(2.0 * farthest, 88.0_mm, 2.0_mm) << "transverse processes";
    EXPECT_NEAR(60.0_mm + to_border({0, 60.0_mm, -10.5_mm}, {0, 1, 0}), 70.5_mm, 0.5_mm) << "spinous process";
}

}  // namespace
}  // namespace kerf::documents
