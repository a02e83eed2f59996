// SPDX-License-Identifier: Apache-2.0
#include "plugins/burring/displace/swept_burr.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "core/field/cut/sweep.h"
#include "studies/chart/surfaces/burr_on_slab.h"
#include "tests/support/block.h"

namespace kerf {
namespace {

using namespace literals;
using burring::displacement::Source;
using burring::displacement::SweptBurr;

SweptBurr swept(const ToolSolid& tool, const Pose& from, const Pose& to) {
    std::string why;
    auto burr = SweptBurr::make(tool.outline(), tool.thickness(), from, to, why);
    EXPECT_TRUE(burr) << why;
    return *burr;
}
const Pose start{{1.0_mm, 2.0_mm, 3.0_mm}, quat_from_rotation_vector({0.3, -0.8, 0.2})};

TEST(SweptBurr, OfABallIsACapsule) {
    const Pose end{start.position + Vec3{3.0_mm, -1.0_mm, 2.0_mm}, start.rotation};
    const ToolSolid ball = chart::ball_burr(2.0_mm, 512);
    const SweptBurr burr = swept(ball, start, end);
    const Vec3 a = start * Vec3{0, 0, -2.0_mm}, way = end.position - start.position;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> any(-8.0_mm, 8.0_mm);
    for (int n = 0; n < 2000; ++n) {
        const Vec3 p{any(random), any(random), any(random)};
        const double t = std::clamp(dot(p - a, way) / dot(way, way), 0.0, 1.0);
        EXPECT_NEAR(burr.outside(p), length(p - a - t * way) - 2.0_mm, 0.1_um);  // chords of 1/512 of half a turn
    }
}

TEST(SweptBurr, AgreesWithTheSweepOfTheField) {
    // Between poses that differ by 3 degrees, as in a stretch of a hand's path.
    const Pose end{start.position + Vec3{2.0_mm, 1.0_mm, -1.0_mm},
                   quat_from_rotation_vector({0.03, 0.02, 0.04}) * start.rotation};
    const ToolSolid drill = test::drill_outline(2.0_mm, 60.0_deg, 8.0_mm);
    const SweptBurr burr = swept(drill, start, end);
    const Sweep sweep(drill, start, end, 0.1_mm, 0.0);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> any(-8.0_mm, 8.0_mm);
    int inside = 0;
    for (int n = 0; n < 5000; ++n) {
        const Vec3 p{any(random), any(random), any(random)};
        const double outside = burr.outside(p);
        if (std::abs(outside) < 1.0_um) continue;
        EXPECT_EQ(outside < 0.0, sweep.contains(p, 0.0)) << 1e6 * outside << " um";
        inside += outside < 0.0;
    }
    EXPECT_GT(inside, 50);
}

TEST(SweptBurr, RaysEndOnItsSurface) {
    const Pose end{start.position + Vec3{3.0_mm, -1.0_mm, 2.0_mm},
                   quat_from_rotation_vector({0.02, 0.01, 0.0}) * start.rotation};
    const SweptBurr burr = swept(test::drill_outline(2.0_mm, 60.0_deg, 8.0_mm), start, end);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(-8.0_mm, 8.0_mm);
    for (const Source& source : burr.sources()) {
        EXPECT_LT(burr.outside(source.from), 0.0);
        EXPECT_LT(burr.outside(source.to), 0.0);
        for (int n = 0; n < 50; ++n) {
            const Vec3 through{any(random), any(random), any(random)}, on = burr.exit(source, through);
            EXPECT_NEAR(burr.outside(on), 0.0, 1e-9);
            const Vec3 begin = source.nearest(through);
            EXPECT_LT(length(cross(normalized(on - begin), normalized(through - begin))), 1e-9);
        }
    }
}

TEST(SweptBurr, TakesConvexSolidsOfRevolutionOnly) {
    const auto why_not = [](const std::vector<kerf_profile_point>& outline, double kerf, const Pose& pose = start) {
        std::string why;
        return SweptBurr::make(outline, kerf, pose, pose, why) ? std::string() : why;
    };
    const std::vector<kerf_profile_point> ball = chart::ball_burr(2.0_mm).outline();
    EXPECT_EQ(why_not(ball, 0.0), "");
    EXPECT_EQ(why_not(ball, 0.4_mm), "a blade is no burr: its slot has edges");
    EXPECT_EQ(why_not({}, 0.0), "the tool has no outline");
    EXPECT_EQ(why_not({{0.0, 0.0}, {-1.0_mm, 0.0}}, 0.0), "the tool has no volume");
    EXPECT_EQ(why_not({{0.0, 1.0_mm}, {0.0, 2.0_mm}}, 0.0), "the tool's outline turns back");
    EXPECT_EQ(why_not({{0.0, 1.0_mm}, {-1.0_mm, 0.5_mm}, {-2.0_mm, 1.0_mm}}, 0.0), "the tool is not convex");
    EXPECT_EQ(why_not({{0.0, 1.0_mm}, {-1.0_mm, NAN}}, 0.0), "a point of the tool's outline is no number");
    EXPECT_EQ(why_not(ball, 0.0, {{NAN, 0, 0}, {1, 0, 0, 0}}), "a pose of the tool is no number");
}

}  // namespace
}  // namespace kerf
