// SPDX-License-Identifier: Apache-2.0
// Holes that lead to any side, measured along a planned axis that is none of the grid's.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "bone/measure/drilled_hole.h"
#include "tests/support/block.h"

namespace kerf::bone {
namespace {

using namespace literals;

constexpr double radius = 1.6_mm, spacing = 0.4_mm;
const ToolSolid drill = test::drill_outline(radius, 59.0_deg, 60.0_mm);

/// A block of bone, 24 mm wide and 30 mm deep from z = 0.
const Body& block() {
    static const Body body =
        test::block({-12.0_mm, -12.0_mm, 0}, {12.0_mm, 12.0_mm, 30.0_mm}, spacing, {0.3, 0.1, 0.7});
    return body;
}
HolePlan plan_along(Vec3 entry, Vec3 along, double depth) {
    return {.entry = entry, .along = normalized(along), .depth = depth, .cutting = drill, .beside = 5.0_mm};
}
/// The hole of a drill along a line, 20 mm deep, without a drill.
std::optional<DrilledHole> hole_of_line(const HolePlan& plan, Vec3 at, Vec3 direction) {
    const Vec3 unit = normalized(direction);
    return measure_hole(block(), plan, [=](Vec3 p) {
        const Vec3 from = p - at;
        const double along = dot(from, unit), off = length(from - along * unit);
        const double bone = std::clamp(0.5 - uncut_distance(block(), locate(block(), p)) / spacing, 0.0, 1.0);
        return Drilled{along < 20.0_mm ? bone * std::clamp(0.5 + (radius - off) / spacing, 0.0, 1.0) : 0.0, 0.0};
    });
}

TEST(DrilledHole, LiesOnTheLineThatWasDrilled) {
    const Vec3 along = normalized(Vec3{0.3, -0.2, 1.0}), direction = normalized(Vec3{0.36, -0.32, 1.0});
    const Vec3 at{-3.0_mm, 2.0_mm, 0};
    const auto hole = hole_of_line(plan_along({-3.0_mm, 2.5_mm, 0}, along, 20.0_mm), at, direction);
    ASSERT_TRUE(hole && hole->angle);
    EXPECT_LT(length(hole->direction - direction), 0.002);
    EXPECT_NEAR(*hole->angle, std::acos(dot(along, direction)), 0.1_deg);
    const Vec3 from = hole->at - at;
    EXPECT_LT(length(from - dot(from, direction) * direction), 0.03_mm);
}

TEST(DrilledHole, HasItsAngleToEverySide) {
    for (const Vec3 lean : {Vec3{0.1, 0, 0}, Vec3{-0.1, 0, 0}, Vec3{0, 0.1, 0}, Vec3{0, -0.1, 0}}) {
        const auto hole = hole_of_line(plan_along({}, {0, 0, 1}, 20.0_mm), {}, Vec3{0, 0, 1} + lean);
        ASSERT_TRUE(hole && hole->angle);
        EXPECT_NEAR(*hole->angle, std::atan(0.1), 0.1_deg);
        EXPECT_LT(length(hole->direction - normalized(Vec3{0, 0, 1} + lean)), 0.002);
    }
}

TEST(HoleAlong, NeedsADirectionIntoTheBone) {
    const HolePlan plan = plan_along({}, {0, 0, 1}, 20.0_mm);
    EXPECT_TRUE(hole_along(block(), plan, {0, 0, 20.0_mm}, {0, 0, 1}));
    EXPECT_FALSE(hole_along(block(), plan, {0, 0, 20.0_mm}, {0, 0, -1}));
}

// ---- breach --------------------------------------------------------------------------------------------------------

/// The breach of a cylinder of 4 mm radius along a straight hole through `entry`, 20 mm deep.
Breach breach_at(Vec3 entry, DepthRange range = {}) {
    const HolePlan plan = plan_along(entry, {0, 0, 1}, 20.0_mm);
    const auto hole = hole_along(block(), plan, entry + Vec3{0, 0, 20.0_mm}, {0, 0, 1});
    return breach_of(block(), plan, hole.value(), 4.0_mm, {1, 0, 0}, {0, 1, 0}, range);
}

TEST(Breach, NamesTheSideThatItLeaves) {
    const std::array<Vec3, 4> sides{Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}};
    for (std::size_t side = 0; side < sides.size(); ++side) {
        const Breach breach = breach_at((12.0_mm - 2.9_mm) * sides[side]);
        for (std::size_t s = 0; s < sides.size(); ++s)
            EXPECT_NEAR(breach.towards[s], s == side ? 1.1_mm : 0.0, 0.05_mm) << side << ' ' << s;
        EXPECT_EQ(breach.worst(), breach.towards[side]);
    }
}

TEST(Breach, NamesTheSideToWhichAHoleOutsideStrayed) {
    const std::array<Vec3, 4> sides{Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}};
    const HolePlan plan = plan_along({}, {0, 0, 1}, 20.0_mm);
    for (std::size_t side = 0; side < sides.size(); ++side) {
        DrilledHole hole = hole_along(block(), plan, {0, 0, 20.0_mm}, {0, 0, 1}).value();
        hole.at = hole.at + 14.0_mm * sides[side];
        const Breach breach = breach_of(block(), plan, hole, 4.0_mm, {1, 0, 0}, {0, 1, 0});
        for (std::size_t s = 0; s < sides.size(); ++s) EXPECT_EQ(breach.towards[s], s == side ? 4.0_mm : 0.0) << side;
    }
}

TEST(Breach, OfAHoleThatCrossesItsPlanIsOnTheFarSide) {
    // Begun 6 mm to −x, it leaves the bone through the face x = 12 mm
    const HolePlan plan = plan_along({}, {0, 0, 1}, 20.0_mm);
    const Vec3 direction = normalized(Vec3{1, 0, 1}), tip{14.0_mm, 0, 20.0_mm};
    DrilledHole hole = hole_along(block(), plan, tip, direction).value();
    hole.at = {-6.0_mm, 0, 0};
    const Breach breach = breach_of(block(), plan, hole, 4.0_mm, {1, 0, 0}, {0, 1, 0}, {19.0_mm, 20.0_mm});
    EXPECT_EQ(breach.towards[0], 4.0_mm);
    EXPECT_EQ(breach.towards[1], 0.0);
}

TEST(Breach, CountsInTheRangeOfDepthsAlone) {
    // A hole that leads towards the face x = 12 mm: 4 mm of radius pass it from 12 mm deep on
    const HolePlan plan = plan_along({}, {0, 0, 1}, 25.0_mm);
    const Vec3 direction = normalized(Vec3{0.5, 0, 1});
    const DrilledHole hole =
        hole_along(block(), plan, Vec3{2.0_mm, 0, 0} + 22.0_mm * Vec3{0.5, 0, 1}, direction).value();
    const double cosine = direction.z;
    const auto breach_in = [&](DepthRange range) {
        return breach_of(block(), plan, hole, 4.0_mm, {1, 0, 0}, {0, 1, 0}, range).towards[0];
    };
    const auto beyond = [&](double depth) { return 4.0_mm - (10.0_mm - 0.5 * depth) / cosine; };
    EXPECT_NEAR(breach_in({}), beyond(20.0_mm), 1.0_mm);
    EXPECT_NEAR(breach_in({0.0, 16.2_mm}), beyond(16.0_mm), 0.05_mm);
    EXPECT_NEAR(breach_in({14.0_mm, 16.2_mm}), beyond(16.0_mm), 0.05_mm);
    EXPECT_EQ(breach_in({0.0, 10.0_mm}), 0.0);
}

// ---- waists --------------------------------------------------------------------------------------------------------

/// A column around z, 30 mm long, whose radius is 3 mm at the waist, 15 mm deep, and 6 mm at both ends.
Body waisted() {
    Body body = test::block({-7.0_mm, -7.0_mm, 0}, {7.0_mm, 7.0_mm, 30.0_mm}, spacing, {0.3, 0.1, 0.7});
    body.surface = LevelSet::build(body.grid(), [](Vec3 p) {
        const double around = std::hypot(p.x, p.y), wide = 3.0_mm + 0.2 * std::abs(p.z - 15.0_mm);
        return std::max({(around - wide) / std::hypot(1.0, 0.2), -p.z, p.z - 30.0_mm});
    });
    return body;
}

TEST(HoleAlong, AWaistEndsWhereBoneIsHalfAsWideAgain) {
    const Body body = waisted();
    const HolePlan plan = plan_along({}, {0, 0, 1}, 28.0_mm);
    const auto hole = hole_along(body, plan, {0, 0, 28.0_mm}, {0, 0, 1});
    ASSERT_TRUE(hole);
    EXPECT_NEAR(hole->narrowest_depth, 15.0_mm, 0.6_mm);
    EXPECT_NEAR(hole->waist_end, 22.5_mm, 0.8_mm) << "3 mm + 1.5 mm";
}

TEST(DrilledHole, AWaistEndsWhereBoneIsHalfAsWideAgain) {
    const Body body = waisted();
    const auto hole = measure_hole(body, plan_along({}, {0, 0, 1}, 28.0_mm), [&](Vec3 p) {
        const double bone = std::clamp(0.5 - uncut_distance(body, locate(body, p)) / spacing, 0.0, 1.0);
        const double drilled = std::clamp(0.5 + (radius - std::hypot(p.x, p.y)) / spacing, 0.0, 1.0);
        return Drilled{bone * drilled, 0.0};
    });
    ASSERT_TRUE(hole);
    EXPECT_NEAR(hole->narrowest_depth, 15.0_mm, 0.6_mm);
    EXPECT_NEAR(hole->waist_end, 22.5_mm, 0.8_mm);
}

TEST(HoleAlong, WithoutAWaistItEndsWithTheHole) {
    const HolePlan plan = plan_along({}, {0, 0, 1}, 20.0_mm);
    const auto hole = hole_along(block(), plan, {0, 0, 20.0_mm}, {0, 0, 1});
    ASSERT_TRUE(hole);
    EXPECT_EQ(hole->narrowest_depth, 0.0);
    EXPECT_EQ(hole->waist_end, hole->end_depth);
}

}  // namespace
}  // namespace kerf::bone
