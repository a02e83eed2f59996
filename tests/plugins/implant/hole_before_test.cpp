// SPDX-License-Identifier: Apache-2.0
// The width of a hole, depth by depth, as a screw finds it.
#include "plugins/implant/hole_before.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "kerf/units.hpp"
#include "tests/plugins/implant/weidling.h"

namespace kerf::implant {
namespace {

using namespace literals;

constexpr double step = 0.1_mm;  // of the tip in a tick

/// A round hole around the axis, whose radius depends on the depth of the tool.
struct Hole {
    double radius = 2.0_mm;
    ScrewThread thread = test::thread_of(test::weidling[0]);
    HoleBefore before;

    void move(double along) {
        kerf_bone_query query{};
        query.reach = 1.0_mm;
        query.bone = reinterpret_cast<const kerf_bone*>(this);
        query.nearest = [](const kerf_bone* bone, const kerf_vec3* points, std::uint32_t count,
                           kerf_surface_point* out) {
            const auto& hole = *reinterpret_cast<const Hole*>(bone);
            for (std::uint32_t i = 0; i < count; ++i) {
                const double r = std::hypot(points[i].x, points[i].y);
                out[i] = {};
                out[i].distance = hole.radius - r;
                out[i].normal = {-points[i].x / r, -points[i].y / r, 0};
            }
        };
        before.measure(thread, BoneQuery(query), along);
    }
    void go_in(double distance) {
        for (double moved = 0.5 * step; moved < distance; moved += step) move(step);
    }
};

TEST(HoleBefore, IsAsWideAsItWasAtEachDepth) {
    // Given a hole of 2 mm radius that is 1.5 mm wide from a depth of 4 mm on
    Hole hole;
    hole.move(0.0);
    hole.go_in(4.0_mm);
    hole.radius = 1.5_mm;
    hole.go_in(4.0_mm);

    // Then the thread that is 6 mm behind the tip lies in the wide part
    EXPECT_NEAR(hole.before.radius_at(-6.0_mm), 2.0_mm, 1e-8);
    EXPECT_NEAR(hole.before.radius_at(-2.0_mm), 1.5_mm, 1e-8);
    EXPECT_NEAR(hole.before.radius_at(0.0), 1.5_mm, 1e-8);
}

TEST(HoleBefore, KeepsWhatItMeasuredFirst) {
    Hole hole;
    hole.move(0.0);
    hole.go_in(4.0_mm);
    hole.radius = 2.4_mm;  // the core has widened it
    for (double moved = 0.0; moved < 2.0_mm; moved += step) hole.move(-step);
    hole.go_in(2.0_mm);
    EXPECT_NEAR(hole.before.radius_at(-2.0_mm), 2.0_mm, 1e-8);
}

TEST(HoleBefore, MeasuresAgainAfterTheToolHasLeft) {
    Hole hole;
    for (const double radius : {2.0_mm, 1.7_mm, 2.2_mm}) {
        hole.radius = radius;
        hole.move(0.0);
        hole.go_in(4.0_mm);
        EXPECT_NEAR(hole.before.radius_at(-2.0_mm), radius, 1e-8);
        hole.radius = 9.0_mm;  // in front of the bone
        for (double moved = 0.0; moved < 6.0_mm; moved += step) hole.move(-step);
    }
}

}  // namespace
}  // namespace kerf::implant
