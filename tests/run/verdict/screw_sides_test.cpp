// SPDX-License-Identifier: Apache-2.0
// The sides that a screw leaves, and its distance from the hole of a plate, for axes of both sides of a patient.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <utility>

#include "run/verdict/cut_results.h"
#include "tests/support/block.h"

namespace kerf::run {
namespace {

using namespace literals;

constexpr std::size_t medial = 0, lateral = 1, cranial = 2, caudal = 3;

/// A screw of 6 mm in a block of 24 mm, along an axis through the block's middle.
struct Screwed {
    Body block = test::block({-12.0_mm, -12.0_mm, -12.0_mm}, {12.0_mm, 12.0_mm, 12.0_mm}, 0.5_mm, {0.3, 0.1, 0.7});
    Scene scene;
    AxisFrame frame;

    Screwed(Vec3 along, Vec3 towards_midline) {
        scene.procedure.steps.resize(1);
        ToolOutline outline;
        outline.cutting = test::drill_outline(2.0_mm, 60.0_deg, 20.0_mm);
        outline.thread_radius = 3.0_mm;
        scene.tools = {{{}, outline}};
        scene.tool_of_step = {0};
        frame = {.entry = -12.0_mm * along, .along = along, .medial = towards_midline};
    }
    /// The screw 16 mm deep, parallel to the axis at `off` from it.
    [[nodiscard]] InsertedScrew at(Vec3 off) const { return of(test::pointing(frame.entry + off, frame.along)); }
    [[nodiscard]] InsertedScrew of(Pose screw) const {
        screw.position = screw * Vec3{0, 0, 16.0_mm};
        return screw_at(scene, 0, frame, block, screw).screw.value();
    }
};

TEST(ScrewAt, NamesTheSideOfABreachForEitherSideOfThePatient) {
    for (const double side : {1.0, -1.0}) {
        // A pedicle of the left side has the midline to the right; both lead to the front
        const Vec3 along{0, -1, 0}, inwards{-side, 0, 0};
        const Screwed pedicle(along, inwards);
        constexpr double off = 12.0_mm - 2.5_mm;  // 0.5 mm of the thread leaves the bone
        const Vec3 sides[] = {inwards, -inwards, {0, 0, 1}, {0, 0, -1}};
        for (const std::size_t leaves : {medial, lateral, cranial, caudal}) {
            const InsertedScrew screw = pedicle.at(off * sides[leaves]);
            for (const std::size_t s : {medial, lateral, cranial, caudal})
                EXPECT_NEAR(screw.breach.towards[s], s == leaves ? 0.5_mm : 0.0, 0.05_mm) << side << ' ' << leaves;
        }
    }
}

TEST(ScrewAt, GivesABreachHalfAVoxelToEitherSide) {
    const Screwed pedicle({0, -1, 0}, {1, 0, 0});
    const InsertedScrew screw = pedicle.at({12.0_mm - 2.5_mm, 0, 0});
    const auto& [diameter, breach, smallest, largest, grade, hole_offset, hole_angle] = screw;
    EXPECT_NEAR(diameter, 6.0_mm, 1e-12);
    EXPECT_NEAR(smallest, 0.25_mm, 0.05_mm);
    EXPECT_NEAR(breach.worst(), 0.5_mm, 0.05_mm);
    EXPECT_NEAR(largest, 0.75_mm, 0.05_mm);
}

// Half a voxel is 0.25 mm. The tip is 16 mm deep in a block of 24 mm, so the screw breaches no side.
TEST(ScrewAt, GradesAZoneHalfAVoxelToEitherSide) {
    const Vec3 along{0, -1, 0};
    for (const auto& [distance, grade] :
         {std::pair<double, const char*>{0.3_mm, "I"}, {0.1_mm, "I/V"}, {-(0.1_mm), "I/V"}, {-(0.3_mm), "V"}}) {
        Screwed pedicle(along, {1, 0, 0});
        const Vec3 tip = pedicle.frame.entry + 16.0_mm * along;
        pedicle.scene.anatomy.zones = {{"canal", {documents::SphereSolid{tip + (1.0_mm + distance) * along, 1.0_mm}}}};
        EXPECT_EQ(pedicle.at({}).heary_grade, grade) << distance;
    }
}

TEST(ScrewAt, MeasuresItsOffsetAndAngleAtThePlate) {
    // Given a plate 2 mm before the bone, and a screw through (1 mm, 0, 0.5 mm) there that leans by atan 0.1 to +x
    Screwed plated({0, -1, 0}, {});
    plated.frame.plate = -2.0_mm;
    const Vec3 middle = plated.frame.entry - 2.0_mm * plated.frame.along, lean = normalized(Vec3{0.1, -1, 0});
    const InsertedScrew screw = plated.of(test::pointing(middle + Vec3{1.0_mm, 0, 0.5_mm}, lean));
    ASSERT_TRUE(screw.hole_offset && screw.hole_angle);
    EXPECT_NEAR(*screw.hole_offset, std::hypot(1.0_mm, 0.5_mm), 1e-9);
    EXPECT_NEAR(*screw.hole_angle, std::atan(0.1), 1e-9);
}

}  // namespace
}  // namespace kerf::run
