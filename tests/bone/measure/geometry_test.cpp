// SPDX-License-Identifier: Apache-2.0
// Fits, angles and distances of points that a reader can check by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "bone/measure/angle.h"
#include "bone/measure/distance.h"
#include "bone/measure/fit_plane.h"
#include "bone/measure/principal_axes.h"
#include "kerf/units.hpp"

namespace kerf::bone {
namespace {

using namespace literals;

const Line along_x{{0, 0, 0}, {1, 0, 0}};

TEST(LineThrough, LeadsFromTheFirstPointToTheLast) {
    const std::vector<Vec3> points{{3, 1, 0}, {2, 1, 0}, {-1, 1, 0}};
    const auto fitted = line_through(points);
    ASSERT_TRUE(fitted);
    EXPECT_NEAR(fitted->line.direction.x, -1.0, 1e-12);
    EXPECT_NEAR(fitted->residual, 0.0, 1e-12);
    EXPECT_FALSE(line_through(std::vector<Vec3>{{1, 1, 1}, {1, 1, 1}}));
    EXPECT_FALSE(line_through(std::vector<Vec3>{{1, 1, 1}}));
}

TEST(PlaneThrough, PassesThroughThreePoints) {
    const std::vector<Vec3> points{{0, 0, 2}, {1, 0, 2}, {0, 1, 2}};
    const auto fitted = plane_through(points);
    ASSERT_TRUE(fitted);
    EXPECT_NEAR(fitted->plane.normal.z, 1.0, 1e-12);
    EXPECT_NEAR(fitted->residual, 0.0, 1e-12);
    EXPECT_FALSE(plane_through(std::vector<Vec3>{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}));
}

TEST(PlaneThrough, ReportsTheResidualAndTheTilt) {
    // Four corners of a square of 20 mm, two of them 1 mm up and two 1 mm down: d = ±1 mm, s = 2 mm, N − 3 = 1.
    const std::vector<Vec3> points{
        {10e-3, 10e-3, 1e-3}, {-10e-3, 10e-3, -1e-3}, {-10e-3, -10e-3, 1e-3}, {10e-3, -10e-3, -1e-3}};
    const auto fitted = plane_through(points);
    ASSERT_TRUE(fitted);
    EXPECT_NEAR(std::abs(fitted->plane.normal.z), 1.0, 1e-12);
    EXPECT_NEAR(fitted->residual, 2e-3, 1e-12);
    EXPECT_NEAR(fitted->tilt_uncertainty, 2e-3 / 20e-3, 1e-12);
}

TEST(PlaneThrough, ScattersAsItsUncertaintySays) {
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0.0, 1e-4);
    double squares = 0.0, stated = 0.0;
    constexpr int trials = 2000;
    for (int trial = 0; trial < trials; ++trial) {
        std::vector<Vec3> points;
        for (int i = 0; i < 5; ++i)
            for (int j = 0; j < 3; ++j) points.push_back({4e-3 * i, 4e-3 * j, noise(random)});
        const auto fitted = plane_through(points);
        ASSERT_TRUE(fitted);
        const double tilt = fitted->plane.normal.y / fitted->plane.normal.z;  // about the long side: the uncertain one
        squares += tilt * tilt;
        stated += fitted->tilt_uncertainty * fitted->tilt_uncertainty;
    }
    EXPECT_NEAR(std::sqrt(squares / stated), 1.0, 0.05 /* 1/√(2 · 2000) = 1.6 % */);
}

TEST(MirrorPlane, LiesBetweenThePairs) {
    const std::vector<Vec3> left{{11, 0, 0}, {21, 5, 3}}, right{{-9, 0, 0}, {-19, 5, 3}};
    const auto fitted = mirror_plane(left, right);
    ASSERT_TRUE(fitted);
    EXPECT_NEAR(fitted->plane.normal.x, 1.0, 1e-12);
    EXPECT_NEAR(fitted->plane.point.x, 1.0, 1e-12);
    EXPECT_NEAR(fitted->residual, 0.0, 1e-12);
    EXPECT_FALSE(mirror_plane({}, {}));
    EXPECT_FALSE(mirror_plane(std::vector<Vec3>{{1, 0, 0}}, std::vector<Vec3>{{1, 0, 0}}));
}

TEST(PrincipalAxes, AreRightHandedAndOrdered) {
    const std::vector<Vec3> points{{5, 1, 0.1}, {-5, -1, 0.1}, {1, -3, -0.1}, {-1, 3, -0.1}};
    const PrincipalAxes found = principal_axes(points);
    EXPECT_GE(found.squares[0], found.squares[1]);
    EXPECT_GE(found.squares[1], found.squares[2]);
    EXPECT_NEAR(dot(cross(found.axes[0], found.axes[1]), found.axes[2]), 1.0, 1e-12);
    EXPECT_NEAR(found.squares[0] + found.squares[1] + found.squares[2], 2 * 26 + 2 * 10 + 4 * 0.01, 1e-9);
}

TEST(AngleBetween, LinesLeadAwayFromTheCorner) {
    const Line up{{5, 5, 5}, {0, 0, 1}}, back{{0, 0, 0}, {-1, 0, 0}};
    EXPECT_NEAR(angle_between(along_x, up), 90.0_deg, 1e-12);
    EXPECT_NEAR(angle_between(along_x, back), 180.0_deg, 1e-12);
    EXPECT_NEAR(angle_between(along_x, Line{{}, normalized(Vec3{1, 1e-9, 0})}), 1e-9, 1e-15);
}

TEST(AngleBetween, APlaneHasNoSense) {
    const Plane level{{}, {0, 0, 1}}, tilted{{}, normalized(Vec3{0, -1, 1})};
    EXPECT_NEAR(angle_between(Line{{}, normalized(Vec3{1, 0, 1})}, level), 45.0_deg, 1e-12);
    EXPECT_NEAR(angle_between(Line{{}, normalized(Vec3{1, 0, -1})}, level), 45.0_deg, 1e-12);
    EXPECT_NEAR(angle_between(level, tilted), 45.0_deg, 1e-12);
    EXPECT_NEAR(angle_between(level, Plane{{}, -tilted.normal}), 45.0_deg, 1e-12);
}

TEST(SeenIn, DropsWhatIsAcrossTheView) {
    const Plane view{{7, 0, 0}, {1, 0, 0}};
    const auto line = projected_onto(view, Line{{0, 1, 1}, normalized(Vec3{1, 1, 1})});
    ASSERT_TRUE(line);
    EXPECT_NEAR(line->direction.x, 0.0, 1e-12);
    EXPECT_NEAR(line->direction.y, line->direction.z, 1e-12);
    EXPECT_NEAR(line->point.x, 7.0, 1e-12);
    EXPECT_FALSE(projected_onto(view, along_x));

    const auto trace = projected_onto(view, Plane{{0, 0, 3}, normalized(Vec3{1, 0, 2})});
    ASSERT_TRUE(trace);
    EXPECT_NEAR(std::abs(trace->direction.y), 1.0, 1e-12);
    EXPECT_NEAR(trace->point.x, 7.0, 1e-9);
    EXPECT_NEAR(trace->point.z, 3.0 - 3.5, 1e-9);
    EXPECT_FALSE(projected_onto(view, Plane{{}, {-1, 0, 0}}));
}

TEST(DistanceBetween, HasTheLengthOfTheShortestWay) {
    EXPECT_NEAR(distance_between(Vec3{0, 3, 4}, Vec3{}), 5.0, 1e-12);
    EXPECT_NEAR(distance_between(Vec3{9, 3, 4}, along_x), 5.0, 1e-12);
    EXPECT_NEAR(distance_between(Vec3{1, 2, -3}, Plane{{0, 0, 1}, {0, 0, 1}}), 4.0, 1e-12);
    EXPECT_NEAR(distance_between(along_x, Line{{0, 5, 2}, {0, 1, 0}}), 2.0, 1e-12);
    EXPECT_NEAR(distance_between(along_x, Line{{9, 3, 4}, {-1, 0, 0}}), 5.0, 1e-12);
}

}  // namespace
}  // namespace kerf::bone
