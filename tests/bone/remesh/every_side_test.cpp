// SPDX-License-Identifier: Apache-2.0
// Checks of results and of earlier sweeps, to every side and for each of two tools.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "bone/remesh/accept.h"
#include "bone/remesh/base_mesh.h"
#include "bone/remesh/swept_before.h"
#include "kerf/units.hpp"
#include "tests/bone/surface/shapes.h"
#include "tests/support/block.h"

namespace kerf::bone {
namespace {

using namespace literals;

constexpr Vec3 sides[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
const Quat askew = quat_from_rotation_vector({0.4, -0.9, 0.5});

TEST(AcceptResult, RefusesWhatReachesBeyondAnySideOfTheBase) {
    RemeshRequest request;
    request.base = tagged(test::cube(10.0_mm));
    for (const Vec3 side : sides) {
        const auto flaw_at = [&](double by) { return flaw_of_result(request, tagged(test::cube(8.0_mm, by * side))); };
        EXPECT_EQ(flaw_at(1.0_mm), "") << "in the plane of the face";
        EXPECT_NE(flaw_at(2.1_mm).find("beyond"), std::string::npos) << flaw_at(2.1_mm);
    }
}

/// A cylinder of 2 mm radius, 10 mm long, and one of 1 mm.
const ToolSolid wide({{0.0, 2.0_mm}, {-10.0_mm, 2.0_mm}}), narrow({{0.0, 1.0_mm}, {-10.0_mm, 1.0_mm}});

CutStretch stretch_of(std::uint16_t solid, Vec3 moved = {}) {
    const Vec3 from = Vec3{1.0_mm, 2.0_mm, 3.0_mm} + moved;
    return {{from, askew}, {from + rotate(askew, {4.0_mm, 0, 0}), askew}, solid};
}

TEST(SweptBox, ContainsTheToolAtBothEnds) {
    const CutStretch stretch = stretch_of(0);
    const Box box = swept_box(wide, stretch);
    Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high = -low;
    for (const Pose& pose : {stretch.from, stretch.to})
        for (const double z : {0.0_mm, -10.0_mm})
            for (int i = 0; i < 360; ++i) {
                const Vec3 p = pose * Vec3{2.0_mm * std::cos(i * 1.0_deg), 2.0_mm * std::sin(i * 1.0_deg), z};
                low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
                high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
            }
    EXPECT_LE(box.low.x, low.x);
    EXPECT_LE(box.low.y, low.y);
    EXPECT_LE(box.low.z, low.z);
    EXPECT_GE(box.high.x, high.x);
    EXPECT_GE(box.high.y, high.y);
    EXPECT_GE(box.high.z, high.z);
}

TEST(SweptBefore, CoversTheSameStretchAndNoneThatLeavesItToAnySide) {
    SweptBefore swept({&wide, &narrow}, 20e-6, 0.5_mm);
    swept.add(stretch_of(0));
    EXPECT_TRUE(swept.covers(stretch_of(0)));
    for (const Vec3 side : sides) {
        EXPECT_TRUE(swept.covers(stretch_of(0, rotate(askew, 10e-6 * side))));
        EXPECT_FALSE(swept.covers(stretch_of(0, rotate(askew, 0.1_mm * side))));
    }
}

TEST(SweptBefore, CoversANarrowToolByAWideOneAlone) {
    SweptBefore after_wide({&wide, &narrow}, 20e-6, 0.5_mm), after_narrow = after_wide;
    after_wide.add(stretch_of(0));
    EXPECT_TRUE(after_wide.covers(stretch_of(1)));
    EXPECT_TRUE(after_wide.covers(stretch_of(1, rotate(askew, {0, 0.9_mm, 0}))));
    after_narrow = SweptBefore({&wide, &narrow}, 20e-6, 0.5_mm);
    after_narrow.add(stretch_of(1));
    EXPECT_TRUE(after_narrow.covers(stretch_of(1)));
    EXPECT_FALSE(after_narrow.covers(stretch_of(0)));
}

}  // namespace
}  // namespace kerf::bone
