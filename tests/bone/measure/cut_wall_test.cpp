// SPDX-License-Identifier: Apache-2.0
// Walls of cuts whose tilt, place and steps are known because they were made so.
#include "bone/measure/cut_wall.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "tests/support/block.h"

namespace kerf::bone {
namespace {

using namespace literals;

// A bar along x is sawn along y; the blade is wider than the bar and lies across x.
constexpr double kerf_width = 1.2_mm;
const ToolSolid blade = test::blade_outline(60.0_mm, 8.0_mm, 1.0_mm, kerf_width);

/// The blade's pose at a depth below y = −5 mm: turned by `tilt` about its feed, `beside` the plane x = 0 along its
/// normal.
Pose blade_at(double depth, double tilt, double beside, double aside = 0.0) {
    const Quat fed = quat_between({0, 0, 1}, {0, 1, 0});                        // its normal is along −z now,
    const Quat turned = quat_between(rotate(fed, {0, 1, 0}), {1, 0, 0}) * fed;  // and along x
    return {{beside, -5.0_mm + depth, aside}, turned * quat_from_rotation_vector({0, 0, tilt})};
}

struct SawnBar {
    Body body = test::block({-10.0_mm, -5.0_mm, -5.0_mm}, {10.0_mm, 5.0_mm, 5.0_mm}, 0.4_mm, {0.3, 0.1, 0.7});
    CutField cut{body, 4096};
    WallWindow window{
        .entry = {0, -5.0_mm, 0}, .along = {0, 1, 0}, .normal = {1, 0, 0}, .half_width = 8.0_mm, .depth = 12.0_mm};
    std::uint64_t sequence = 0;

    void saw(double tilt, double beside = 0.0, double aside = 0.0) {
        for (double depth = -2.0_mm; depth < 12.0_mm; depth += 1.0_mm) {
            CutRecord record;
            record.sequence = sequence++;
            record.from = blade_at(depth, tilt, beside, aside);
            record.to = blade_at(depth + 1.0_mm, tilt, beside, aside);
            cut.reserve(512);
            cut.stamp(record, blade);
        }
    }
    CutWall wall() const {
        std::vector<Vec3> points;
        add_wall_points(body, cut, window, points);
        const auto found = fit_wall(points, window, kerf_width);
        if (!found) throw std::runtime_error("no wall");
        return *found;
    }
};

constexpr double sharp = 0.05 * 0.4_mm;  // a wall is known to a twentieth of a voxel

TEST(CutWall, ACutInThePlaneHasNoAngleNoOffsetAndIsFlat) {
    SawnBar bar;
    bar.saw(0.0);
    const CutWall wall = bar.wall();
    EXPECT_LT(wall.angle, 0.1_deg);
    EXPECT_LT(wall.offset, sharp);
    EXPECT_LT(wall.flatness, 2.0 * sharp);
    EXPECT_GT(wall.points, 300u) << "8 by 8 mm, less a voxel, at 0.4 mm";
}

TEST(CutWall, ACutThatWasTiltedHasThatAngle) {
    for (const double tilt : {2.0_deg, -5.0_deg, 11.0_deg}) {
        SawnBar bar;
        bar.saw(tilt);
        const CutWall wall = bar.wall();
        EXPECT_NEAR(wall.angle, std::abs(tilt), 0.1_deg);
        EXPECT_LT(wall.flatness, 2.0 * sharp) << "tilted, but flat";
    }
}

TEST(CutWall, ACutBesideThePlaneIsOffByThatMuchToEitherSide) {
    for (const double beside : {0.7_mm, -1.5_mm}) {
        SawnBar bar;
        bar.saw(0.0, beside);
        const CutWall wall = bar.wall();
        EXPECT_NEAR(wall.offset, std::abs(beside), sharp);
        EXPECT_LT(wall.angle, 0.1_deg);
    }
}

TEST(CutWall, AStepBetweenTwoCutsIsNotFlat) {
    // Given two cuts that meet in the middle, one 0.8 mm beside the other
    SawnBar bar;
    bar.saw(0.0, 0.0, 8.0_mm);
    bar.saw(0.0, 0.8_mm, -8.0_mm);

    // Then the plane of least squares leans, and the wall stands off it by half of the step's height at the step:
    // h (3/4 x − sign x)/… for two equal halves leaves h/2 at the step and −h/4 at the ends, and so again: h between
    // the two at the step.
    const CutWall wall = bar.wall();
    EXPECT_GT(wall.flatness, 0.8 * 0.8_mm);
    EXPECT_LT(wall.flatness, 1.1 * 0.8_mm);
    EXPECT_NEAR(wall.offset, 0.4_mm, 0.1_mm) << "the middle, if not for a vertex or two";
}

TEST(CutWall, TheBonesOwnSurfaceIsNoWall) {
    SawnBar bar;
    bar.window.entry.x = 10.0_mm;  // around the bar's end, which looks the same way
    std::vector<Vec3> points;
    add_wall_points(bar.body, bar.cut, bar.window, points);
    EXPECT_TRUE(points.empty());
}

TEST(CutWall, PointsInALineSpanNoPlane) {
    const WallWindow window{
        .entry = {}, .along = {0, 1, 0}, .normal = {1, 0, 0}, .half_width = 1.0_mm, .depth = 1.0_mm};
    EXPECT_FALSE(fit_wall({{0, 0, 0}, {0, 0.1_mm, 0}, {0, 0.2_mm, 0}, {0, 0.3_mm, 0}}, window, 1.0_mm));
    EXPECT_FALSE(fit_wall({}, window, 1.0_mm));
}

}  // namespace
}  // namespace kerf::bone
