// SPDX-License-Identifier: Apache-2.0
#include "run/verdict/reduction.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "documents/fracture.h"
#include "kerf/units.hpp"

namespace kerf::run {
namespace {

using namespace literals;

/// A neck at 125° to a shaft along z, broken 20 mm from where their axes meet.
documents::Anatomy broken_femur() {
    const double s = std::sin(55.0_deg), c = std::cos(55.0_deg);
    const Vec3 neck{-s, 0, c};
    documents::Anatomy anatomy;
    anatomy.axes = {{"neck", {0, 0, 0}, 50.0_mm * neck, 1.0_mm, {}},
                    {"shaft", {0, 0, 0}, {0, 0, -80.0_mm}, 1.0_mm, {}}};
    anatomy.points.emplace_back();
    anatomy.points.back().id = "apex";
    anatomy.points.back().at = 75.0_mm * neck;
    anatomy.fracture = documents::Fracture{.at = 20.0_mm * neck, .normal = neck};
    return anatomy;
}

TEST(Reduction, IsWhereTheFragmentWasMovedTo) {
    documents::Anatomy anatomy = broken_femur();
    anatomy.fracture->shift = {3.0_mm, 0, 4.0_mm};
    anatomy.fracture->about = {0, 1, 0};
    anatomy.fracture->turn = 10.0_deg;
    const std::array<Pose, 2> bodies{identity_pose(), documents::world_from_fragment(*anatomy.fracture)};
    const auto found = reduction_of(anatomy, bodies);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->offset, 5.0_mm, 1e-12);
    EXPECT_NEAR(found->angle, 10.0_deg, 1e-12);
}

TEST(Reduction, IsOfTheFragmentToTheRestWhereverBothAre) {
    const documents::Anatomy anatomy = broken_femur();
    const Pose both{{0.1, 0.2, -0.3}, quat_from_rotation_vector({0.4, -0.2, 0.9})};
    const std::array<Pose, 2> bodies{both, both};
    EXPECT_NEAR(reduction_of(anatomy, bodies)->offset, 0.0, 1e-12);
    EXPECT_NEAR(reduction_of(anatomy, bodies)->angle, 0.0, 1e-7);
    EXPECT_NEAR(*angle_between(anatomy, bodies, "neck", "shaft"), 125.0_deg, 1e-9);
    EXPECT_FALSE(reduction_of({}, bodies)) << "a whole bone";
}

TEST(AngleBetween, FollowsEachAxisWithItsPart) {
    const documents::Anatomy anatomy = broken_femur();
    // About +y, z turns to x: the neck sinks into varus by what it is turned back.
    const Pose varus{{}, quat_from_rotation_vector({0, -12.0_deg, 0})};
    const std::array<Pose, 2> bodies{identity_pose(), varus};
    EXPECT_NEAR(*angle_between(anatomy, bodies, "neck", "shaft"), 113.0_deg, 1e-9);
    EXPECT_FALSE(angle_between(anatomy, bodies, "neck", "nobody"));
}

// 10 mm short of the apex on the axis both views show 10 mm; 6 mm beside it in one view adds to that view alone.
TEST(TipApexDistance, IsTheSumOfTwoViews) {
    const documents::Anatomy anatomy = broken_femur();
    const Vec3 neck = normalized(anatomy.axes[0].to), apex = anatomy.points[0].at;
    const auto of = [&](Vec3 tip) { return *tip_apex_distance(anatomy, {}, tip, "apex", "neck"); };
    EXPECT_NEAR(of(apex - 10.0_mm * neck), 20.0_mm, 1e-9);
    EXPECT_NEAR(of(apex - 8.0_mm * neck + Vec3{0, 6.0_mm, 0}), 8.0_mm + 10.0_mm, 1e-9) << "to the back";
    EXPECT_NEAR(of(apex - 8.0_mm * neck + 6.0_mm * cross(Vec3{0, 1, 0}, neck)), 10.0_mm + 8.0_mm, 1e-9) << "upwards";
    const Pose moved{{0.02, -0.01, 0.03}, quat_from_rotation_vector({0.1, 0.2, -0.3})};
    const std::array<Pose, 2> bodies{identity_pose(), moved};
    EXPECT_NEAR(*tip_apex_distance(anatomy, bodies, moved * (apex - 10.0_mm * neck), "apex", "neck"), 20.0_mm, 1e-9);
}

}  // namespace
}  // namespace kerf::run
