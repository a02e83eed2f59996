// SPDX-License-Identifier: Apache-2.0
// Holes whose axis, place and volume are known because they were made so.
#include "bone/measure/drilled_hole.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/field/cut/cut_field.h"
#include "core/field/cut/removed_volume.h"
#include "tests/support/block.h"

namespace kerf::bone {
namespace {

using namespace literals;

constexpr double pi = 3.14159265358979323846;
constexpr double radius = 1.6_mm;
const ToolSolid drill = test::drill_outline(radius, 59.0_deg, 60.0_mm);
const double point = radius / std::tan(59.0_deg);

/// Bone from z = 0 upwards, 24 mm wide and 40 mm deep, drilled along +z.
struct DrilledBlock {
    explicit DrilledBlock(double h = 0.25_mm) : spacing(h) {}

    double spacing;
    Body body = test::block({-12.0_mm, -12.0_mm, 0}, {12.0_mm, 12.0_mm, 40.0_mm}, spacing, {0.3, 0.1, 0.7});
    CutField cut{body, 4096}, earlier{body, 0};
    ToolSolid cutting = drill;
    HolePlan plan{.entry = {0, 0, 0}, .along = {0, 0, 1}, .depth = 0.0, .cutting = drill};

    /// From 5 mm above to `depth` along `direction`, through a point of the planned entry's plane.
    void drill_in(Vec3 through, Vec3 direction, double depth) {
        const Vec3 unit = normalized(direction);
        for (double at = -5.0_mm; at < depth; at += 1.0_mm) {
            CutRecord record;
            record.sequence = sequence++;
            record.from = test::pointing(through + at * unit, unit);
            record.to = test::pointing(through + std::min(at + 1.0_mm, depth) * unit, unit);
            cut.reserve(512);
            cut.stamp(record, cutting);
        }
        plan.depth = std::max(plan.depth, depth * unit.z);
    }
    [[nodiscard]] std::optional<DrilledHole> hole() const {
        return measure_hole(body, plan, [this](Vec3 p) {
            const LocatedPoint place = locate(body, p);
            const double bone = std::clamp(0.5 - uncut_distance(body, place) / spacing, 0.0, 1.0);
            const double removed = std::clamp(0.5 + cut.at(place) / spacing, 0.0, 1.0),
                         removed_before = std::clamp(0.5 + earlier.at(place) / spacing, 0.0, 1.0);
            return Drilled{bone * (removed - removed_before), bone * removed_before};
        });
    }
    /// From here on, what is drilled already is an earlier hole; the next drill has this radius [m].
    void widen_by(double wider) {
        earlier = cut;
        cutting = test::drill_outline(wider, 59.0_deg, 60.0_mm);
        plan = {.entry = {0, 0, 0}, .along = {0, 0, 1}, .depth = 0.0, .cutting = cutting};
    }

private:
    std::uint64_t sequence = 0;
};

TEST(DrilledHole, AHoleAlongItsAxisIsNowhereOffAndHoldsWhatThePlanTakes) {
    DrilledBlock block;
    block.drill_in({0, 0, 0}, {0, 0, 1}, 30.0_mm);
    const auto hole = block.hole();
    ASSERT_TRUE(hole);
    EXPECT_LT(hole->entry_offset.value(), 0.02_mm);
    EXPECT_LT(hole->narrowest_offset.value(), 0.02_mm);
    EXPECT_LT(hole->end_offset, 0.02_mm);
    ASSERT_TRUE(hole->angle);
    EXPECT_LT(*hole->angle, 0.1_deg);
    const double exact = pi * radius * radius * (30.0_mm - point + point / 3.0);
    EXPECT_NEAR(hole->ideal / exact, 1.0, 0.01);
    EXPECT_NEAR(hole->drilled / exact, 1.0, 0.01);
    // The circle is whole from the face on, and bitten one diameter behind it.
    EXPECT_NEAR(hole->entry_depth, 2.0 * radius, 1.0_mm) << "two sections";
    EXPECT_NEAR(hole->end_depth, 30.0_mm - point, 0.6_mm);
}

TEST(DrilledHole, AWidenedHoleIsMeasuredAgainstTheHoleThatItWidens) {
    constexpr double wide = 2.5_mm, wide_point = 1.502_mm;  // [m] of a drill with a point of 118°
    struct Case {
        double aside, widened_aside;  ///< [m] of the earlier hole and of the one that widens it
    };
    for (const auto [aside, widened_aside] : {Case{0.0, 0.0}, Case{0.6_mm, 0.0}, Case{0.0, 0.5_mm}}) {
        DrilledBlock block;
        block.drill_in({aside, 0, 0}, {0, 0, 1}, 30.0_mm);
        block.widen_by(wide);
        block.drill_in({widened_aside, 0, 0}, {0, 0, 1}, 20.0_mm);
        const auto hole = block.hole();
        ASSERT_TRUE(hole) << aside;
        // The earlier hole goes through the whole of the wider one, point and all.
        const double left = pi * wide * wide * (20.0_mm - 2.0 / 3.0 * wide_point) -
                            (pi * radius * radius * (20.0_mm - wide_point) +
                             pi * radius * radius * wide_point * (1.0 - 2.0 / 3.0 * radius / wide));
        if (aside == 0.0) {
            EXPECT_NEAR(hole->ideal / left, 1.0, 0.02);
        }
        EXPECT_NEAR(hole->drilled / hole->ideal, 1.0, 0.02) << aside << ' ' << widened_aside;
        ASSERT_TRUE(hole->entry_offset);
        EXPECT_NEAR(*hole->entry_offset, widened_aside, 0.06_mm) << aside;
        EXPECT_NEAR(hole->end_offset, widened_aside, 0.06_mm) << aside;
        ASSERT_TRUE(hole->angle);
        EXPECT_LT(*hole->angle, 0.5_deg);
    }
}

// π R² (depth − 2/3 of the point), by voxels across the hole.
TEST(BlindHole, HoldsItsVolumeTheBetterTheMoreVoxelsItIsWide) {
    struct Case {
        double spacing, most;  ///< [m], [–]
    };
    for (const auto [spacing, most] :
         {Case{0.125_mm, 0.003}, Case{0.25_mm, 0.01}, Case{0.5_mm, 0.015}, Case{0.8_mm, 0.07}}) {
        DrilledBlock block(spacing);
        block.drill_in({0, 0, 0}, {0, 0, 1}, 15.0_mm);
        const double removed = bone_volume(block.body, CutField(block.body, 0)) - bone_volume(block.body, block.cut);
        const double exact = pi * radius * radius * (15.0_mm - 2.0 / 3.0 * point);
        EXPECT_NEAR(removed / exact, 1.0, most) << spacing;
    }
}

TEST(DrilledHole, AHoleBesideItsAxisIsOffByThatMuchAllTheWay) {
    DrilledBlock block;
    block.drill_in({1.2_mm, -0.9_mm, 0}, {0, 0, 1}, 25.0_mm);
    const auto hole = block.hole();
    ASSERT_TRUE(hole && hole->angle);
    EXPECT_NEAR(hole->entry_offset.value(), 1.5_mm, 0.02_mm);
    EXPECT_NEAR(hole->narrowest_offset.value(), 1.5_mm, 0.02_mm);
    EXPECT_NEAR(hole->end_offset, 1.5_mm, 0.02_mm);
    EXPECT_LT(*hole->angle, 0.1_deg);
}

TEST(DrilledHole, ATiltedHoleHasThatAngleAndLeavesTheAxisByItsTangent) {
    for (const double tilt : {2.0_deg, 6.0_deg}) {
        DrilledBlock block;
        block.drill_in({0, 0, 0}, {std::sin(tilt), 0, std::cos(tilt)}, 30.0_mm);
        const auto hole = block.hole();
        ASSERT_TRUE(hole && hole->angle);
        EXPECT_NEAR(*hole->angle, tilt, 0.1_deg);
        EXPECT_NEAR(hole->end_offset, hole->end_depth * std::tan(tilt), 0.05_mm);
        EXPECT_NEAR(hole->entry_offset.value(), hole->entry_depth * std::tan(tilt), 0.05_mm);
    }
}

// A start that slid aside, and a second hole beside it: what was drilled beyond the plan shows as volume.
TEST(DrilledHole, ASecondHoleInTheWindowDoublesWhatWasDrilled) {
    DrilledBlock block;
    block.drill_in({-2.5_mm, 0, 0}, {0, 0, 1}, 20.0_mm);
    block.drill_in({2.5_mm, 0, 0}, {0, 0, 1}, 20.0_mm);
    const auto hole = block.hole();
    ASSERT_TRUE(hole);
    EXPECT_NEAR(hole->drilled / hole->ideal, 2.0, 0.02);
}

TEST(DrilledHole, AShortHoleHasNoAngleAndAScratchIsNoHole) {
    DrilledBlock block;
    block.drill_in({0, 0, 0}, {0, 0, 1}, 6.0_mm);
    const auto shallow = block.hole();
    ASSERT_TRUE(shallow);
    EXPECT_FALSE(shallow->angle);
    DrilledBlock too_shallow;
    too_shallow.drill_in({0, 0, 0}, {0, 0, 1}, 3.0_mm);
    const auto start = too_shallow.hole();
    ASSERT_TRUE(start);
    EXPECT_FALSE(start->entry_offset) << "the drill has not bitten";
    EXPECT_FALSE(start->narrowest_offset);
    DrilledBlock scratched;
    scratched.drill_in({0, 0, 0}, {0, 0, 1}, 0.5_mm);
    EXPECT_FALSE(scratched.hole());
}

// 3 mm from the face x = 12 mm runs a hole; a screw of 8 mm along it reaches 1 mm beyond that face, and no other.
TEST(DrilledHole, ACylinderAlongTheHoleBreachesByWhatItReachesBeyondTheFace) {
    DrilledBlock block;
    block.plan.entry = {8.0_mm, 0, 0};
    block.drill_in({9.0_mm, 0, 0}, {0, 0, 1}, 30.0_mm);
    const auto hole = block.hole();
    ASSERT_TRUE(hole);
    const Breach breach = breach_of(block.body, block.plan, *hole, 4.0_mm, {1, 0, 0}, {0, 1, 0});
    EXPECT_NEAR(breach.towards[0], 1.0_mm, 0.05_mm);
    EXPECT_EQ(breach.towards[1], 0.0);
    EXPECT_EQ(breach.towards[2], 0.0);
    EXPECT_EQ(breach.towards[3], 0.0);
    EXPECT_EQ(breach.worst(), breach.towards[0]);
    EXPECT_EQ(breach_of(block.body, block.plan, *hole, 2.9_mm, {1, 0, 0}, {0, 1, 0}).worst(), 0.0);
}

// Screws of 6 mm that enter the face z = 0 at a slant, in the middle of the bone and next to its wall y = 12 mm.
TEST(DrilledHole, TheFaceOfEntryIsNoBreachAtAnyAngle) {
    for (const double slant : {0.0_deg, 20.0_deg, 40.0_deg, 60.0_deg, 70.0_deg})
        for (const double lean : {-8.0_deg, 0.0_deg, 5.0_deg}) {
            DrilledBlock block;
            const auto leading = [](double angle) { return Vec3{std::sin(angle), 0, std::cos(angle)}; };
            const Vec3 entry{-9.0_mm, 0, 0}, direction = leading(slant + lean);
            block.plan.entry = entry;
            block.plan.along = leading(slant);
            const auto breach_at = [&](double y) {
                const Vec3 tip = entry + Vec3{0, y, 0} + 14.0_mm * direction;
                const auto hole = hole_along(block.body, block.plan, tip, direction);
                return breach_of(block.body, block.plan, hole.value(), 3.0_mm, {0, 1, 0},
                                 normalized(cross(Vec3{0, 1, 0}, block.plan.along)));
            };
            const double angle = (slant + lean) / 1.0_deg;
            if (slant + lean >= 0.0_deg) {  // the others lead towards the wall x = -12 mm
                EXPECT_EQ(breach_at(0.0).worst(), 0.0) << angle << " deg, of " << slant / 1.0_deg;
            }
            EXPECT_NEAR(breach_at(10.5_mm).towards[0], 1.5_mm, 0.05_mm) << angle << " deg: the wall counts";
        }
}

// An implant 9 mm off the middle of the block and tilted by 3 degrees towards its face, 12 mm away.
TEST(DrilledHole, TheAxisOfAnImplantIsOffByItsPlaceAndItsTangent) {
    DrilledBlock block;
    const double tangent = std::tan(3.0_deg);
    const Vec3 direction = normalized(Vec3{tangent, 0, 1});
    const Vec3 tip{9.0_mm + 30.0_mm * tangent, 0, 30.0_mm};
    block.plan.entry = {8.0_mm, 0, 0};
    const auto hole = hole_along(block.body, block.plan, tip, direction);
    ASSERT_TRUE(hole);
    EXPECT_NEAR(hole->entry_offset.value(), 1.0_mm, 1e-9);
    EXPECT_NEAR(hole->end_offset, 1.0_mm + 30.0_mm * tangent, 1e-9);
    EXPECT_NEAR(hole->angle.value(), 3.0_deg, 1e-12);
    EXPECT_EQ(hole->end_depth, 30.0_mm);
    const double reach = 3.0_mm;
    const Breach breach = breach_of(block.body, block.plan, *hole, reach, {1, 0, 0}, {0, 1, 0});
    // Looked at across the implant: the face is nearer to its axis by the cosine
    EXPECT_NEAR(breach.worst(), reach - (12.0_mm - tip.x) / std::cos(3.0_deg), 0.05_mm);
    EXPECT_EQ(breach.worst(), breach.towards[0]);
    EXPECT_FALSE(hole_along(block.body, block.plan, tip, normalized(Vec3{1, 0, 0.5}))) << "it lies across the plan";
}

// A waist of 3 mm radius 15 mm deep; the rim where the bone ends is none, however thin.
TEST(DrilledHole, TheNarrowestPlaceIsAWaistAndNotTheFarEnd) {
    const auto waisted = [](double waist) {
        DrilledBlock block;
        block.body.surface = LevelSet::build(block.body.grid(), [=](Vec3 p) {
            const double narrower = waist * std::exp(-std::pow((p.z - 15.0_mm) / 4.0_mm, 2.0));
            return std::max({std::hypot(p.x, p.y) - (6.0_mm - narrower), -p.z, p.z - 30.0_mm});
        });
        block.cut = CutField(block.body, 4096);
        const double tilt = 3.0_deg;
        block.drill_in({0, 0, 0}, {std::sin(tilt), 0, std::cos(tilt)}, 40.0_mm);
        return block.hole();
    };
    const auto with = waisted(3.0_mm), without = waisted(0.0);
    ASSERT_TRUE(with && without);
    EXPECT_NEAR(with->narrowest_depth, 15.0_mm, 0.6_mm);
    EXPECT_NEAR(with->narrowest_offset.value(), 15.0_mm * std::tan(3.0_deg), 0.1_mm);
    EXPECT_EQ(without->narrowest_depth, without->entry_depth);
}

// Where the line itself is outside, only the side to which it strayed counts.
TEST(DrilledHole, AHoleOutsideTheBoneBreachesOnTheSideToWhichItStrayed) {
    DrilledBlock block;
    block.drill_in({0, 0, 0}, {0, 0, 1}, 30.0_mm);
    DrilledHole hole = block.hole().value();
    hole.at = hole.at + Vec3{14.0_mm, 0, 0};
    const Breach breach = breach_of(block.body, block.plan, hole, 3.0_mm, {1, 0, 0}, {0, 1, 0});
    EXPECT_EQ(breach.towards[0], 3.0_mm);
    for (const std::size_t side : {1u, 2u, 3u}) EXPECT_EQ(breach.towards[side], 0.0);
}

// Along a tilted hole the cylinder comes nearer to the face with every millimetre.
TEST(DrilledHole, ATiltedCylinderBreachesMostWhereItEnds) {
    DrilledBlock block;
    const double tilt = 6.0_deg;
    block.plan.entry = {7.0_mm, 0, 0};
    block.drill_in({7.0_mm, 0, 0}, {std::sin(tilt), 0, std::cos(tilt)}, 30.0_mm);
    const auto hole = block.hole();
    ASSERT_TRUE(hole);
    const Breach breach = breach_of(block.body, block.plan, *hole, 3.5_mm, {1, 0, 0}, {0, 1, 0});
    // From the line at that depth the face stands (5 mm − depth · tan) cos away, across the line.
    const double left = (5.0_mm - hole->end_depth * std::tan(tilt)) / std::cos(tilt);
    EXPECT_NEAR(breach.towards[0], 3.5_mm - left, 0.1_mm);
    EXPECT_NEAR(breach.depth, hole->end_depth, 0.6_mm);
}

}  // namespace
}  // namespace kerf::bone
