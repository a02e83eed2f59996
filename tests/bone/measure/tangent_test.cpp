// SPDX-License-Identifier: Apache-2.0
#include "bone/measure/tangent.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "bone/measure/outline.h"
#include "kerf/units.hpp"

namespace kerf::bone {
namespace {

using namespace literals;

// A border along x, seen along y; out is down.
const BorderView from_below{{0, 1, 0}, {0, 0, -1}};
const Path border{{{0, 0, 0}, {40.0_mm, 0, 0}}, 10.0_mm};

TEST(OuterHull, LeavesOutWhatARulerCannotTouch) {
    const std::vector<PlanePoint> points{{0, 0}, {1, 1}, {2, 0.5}, {3, 1}, {4, 0}, {2, -5}, {2, 1}};
    const std::vector<std::size_t> hull = outer_hull(points);
    EXPECT_EQ(hull, (std::vector<std::size_t>{0, 1, 3, 4}));
    EXPECT_TRUE(outer_hull({}).empty());
}

TEST(OuterHull, HasNoPointAboveIt) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> anywhere(-1.0, 1.0);
    for (int trial = 0; trial < 50; ++trial) {
        std::vector<PlanePoint> points(200);
        for (PlanePoint& p : points) p = {anywhere(random), anywhere(random)};
        const std::vector<std::size_t> hull = outer_hull(points);
        ASSERT_GE(hull.size(), 2U);
        for (std::size_t i = 0; i + 1 < hull.size(); ++i) {
            const PlanePoint &a = points[hull[i]], &b = points[hull[i + 1]];
            ASSERT_LT(a.along, b.along);
            for (const PlanePoint& p : points)
                EXPECT_LE((b.along - a.along) * (p.out - a.out) - (b.out - a.out) * (p.along - a.along), 1e-12);
        }
        for (const PlanePoint& p : points) {
            EXPECT_GE(p.along, points[hull.front()].along);
            EXPECT_LE(p.along, points[hull.back()].along);
        }
    }
}

TEST(ContactsOfRuler, LieOnBothSidesOfTheMiddle) {
    const std::vector<PlanePoint> points{{0, 0}, {1, 1}, {3, 1.2}, {4, 0}};
    const auto contacts = contacts_of_ruler(points, 2.0, 0.0);
    ASSERT_TRUE(contacts);
    EXPECT_EQ(contacts->first, 1U);
    EXPECT_EQ(contacts->last, 2U);
    EXPECT_FALSE(contacts_of_ruler(points, 5.0, 0.0));
    EXPECT_FALSE(contacts_of_ruler(points, -1.0, 0.0));
    EXPECT_FALSE(contacts_of_ruler({}, 0.0, 0.0));
}

TEST(ContactsOfRuler, PlayJoinsAlmostStraightEdges) {
    std::vector<PlanePoint> points;
    for (int i = 0; i <= 20; ++i) points.push_back({0.1 * i, -1e-4 * (i - 10) * (i - 10)});
    const auto narrow = contacts_of_ruler(points, 1.01, 0.0), wide = contacts_of_ruler(points, 1.01, 1e-3);
    ASSERT_TRUE(narrow && wide);
    EXPECT_EQ(narrow->last - narrow->first, 1U);
    EXPECT_GT(wide->last - wide->first, 4U);
}

TEST(Tangent, TouchesTwoPointsAndIsAboveNone) {
    std::vector<Vec3> points;
    for (int i = 0; i <= 40; ++i)
        points.push_back({i * 1.0_mm, 0.2_mm * (i % 7), i > 10 && i < 25 ? 2.0_mm : -0.05 * i * 1.0_mm});
    const auto tangent = tangent_of(points, border, from_below);
    ASSERT_TRUE(tangent);
    for (const Vec3 p : points) EXPECT_LE(dot(p - tangent->line.point, tangent->out), 1e-12);
    EXPECT_NEAR(dot(tangent->first - tangent->line.point, tangent->out), 0.0, 1e-12);
    EXPECT_NEAR(dot(tangent->last - tangent->line.point, tangent->out), 0.0, 1e-12);
    EXPECT_LT(tangent->first.x, 20.0_mm);
    EXPECT_GT(tangent->last.x, 20.0_mm);
    EXPECT_NEAR(tangent->line.direction.z / tangent->line.direction.x, -0.05, 1e-9);
}

TEST(Tangent, OfACircleIsLevelAtTheMiddle) {
    std::vector<Vec3> points;
    for (int i = 0; i < 3600; ++i) {
        const double a = i * 0.1_deg;
        points.push_back({20.0_mm + 60.0_mm * std::cos(a), 0, 60.0_mm * (1.0 + std::sin(a))});
    }
    const auto tangent = tangent_of(points, border, from_below, 0.05_mm);
    ASSERT_TRUE(tangent);
    EXPECT_NEAR(tangent->line.direction.z, 0.0, 0.1_deg);
    EXPECT_NEAR(length(tangent->last - tangent->first), 2.0 * std::sqrt(2.0 * 60.0_mm * 0.05_mm), 0.3_mm);
}

TEST(Tangent, IgnoresBoneBesideItsPath) {
    std::vector<Vec3> points{{0, 0, 0}, {40.0_mm, 0, 0}};
    const auto alone = tangent_of(points, border, from_below);
    points.push_back({20.0_mm, 30.0_mm, -20.0_mm});
    const auto beside = tangent_of(points, border, from_below);
    ASSERT_TRUE(alone && beside);
    EXPECT_TRUE(alone->line.direction == beside->line.direction);
}

TEST(Tangent, NeedsASideAcrossTheBorder) {
    const std::vector<Vec3> points{{0, 0, 0}, {40.0_mm, 0, 0}};
    EXPECT_FALSE(tangent_of(points, border, {{0, 1, 0}, {1, 0, 0}}));
    EXPECT_FALSE(tangent_of(points, border, {{1, 0, 0}, {0, 0, -1}})) << "seen along the border";
    EXPECT_FALSE(tangent_of({}, border, from_below));
}

TEST(Tangent, ContactsThatMoveTurnItAsStated) {
    const std::vector<Vec3> points{{0, 0, 0}, {40.0_mm, 0, 0}};
    const double shifts[] = {0.1_mm, -0.1_mm};
    const auto straight = tangent_of(points, border, from_below),
               turned = tangent_of(points, border, from_below, 0.0, shifts);
    ASSERT_TRUE(straight && turned);
    EXPECT_NEAR(turned->line.direction.z, 0.2 / 40.0, 1e-6);
    EXPECT_NEAR(direction_uncertainty(*straight, 0.1_mm), std::sqrt(2.0) * 0.1 / 40.0, 1e-12);
}

}  // namespace
}  // namespace kerf::bone
