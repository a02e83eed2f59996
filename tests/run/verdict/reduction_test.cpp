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

TEST(Reduction, IsTheSameForBothSignsOfAQuaternion) {
    const documents::Anatomy anatomy = broken_femur();
    const Quat q = quat_from_rotation_vector({0.1, -0.2, 0.15});
    for (const Quat turn : {q, Quat{-q.w, -q.x, -q.y, -q.z}}) {
        const std::array<Pose, 2> bodies{identity_pose(), Pose{{}, turn}};
        EXPECT_NEAR(reduction_of(anatomy, bodies)->angle, std::sqrt(0.01 + 0.04 + 0.0225), 1e-12);
    }
}

TEST(Reduction, OffsetIsThatOfTheFracture) {
    // A fragment that turns about the line of its own middle by 90 degrees, 20 mm from the origin
    const documents::Anatomy anatomy = broken_femur();
    const Vec3 at = anatomy.fracture->at;
    const Quat turn = quat_from_rotation_vector({0, 0, 90.0_deg});
    const auto offset_at = [&](Vec3 position) {
        const std::array<Pose, 2> bodies{identity_pose(), Pose{position, turn}};
        return reduction_of(anatomy, bodies)->offset;
    };
    EXPECT_NEAR(offset_at({}), std::sqrt(2.0) * std::hypot(at.x, at.y), 1e-12);
    EXPECT_NEAR(offset_at(at - rotate(turn, at)), 0.0, 1e-12);
}

TEST(AngleBetween, TakesAnAxisForThePieceOfItsMiddle) {
    // Across the fracture at 20 mm, with its middle at 15 and at 25 mm
    documents::Anatomy anatomy = broken_femur();
    const Vec3 neck = normalized(anatomy.axes[0].to);
    anatomy.axes.push_back({"rest", {}, 30.0_mm * neck, 0.0, {}});
    anatomy.axes.push_back({"fragment", {}, 50.0_mm * neck, 0.0, {}});
    const std::array<Pose, 2> bodies{identity_pose(), Pose{{}, quat_from_rotation_vector({0, -12.0_deg, 0})}};
    EXPECT_NEAR(*angle_between(anatomy, bodies, "rest", "shaft"), 125.0_deg, 1e-9);
    EXPECT_NEAR(*angle_between(anatomy, bodies, "fragment", "shaft"), 113.0_deg, 1e-9);
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

// A neck that also leads 30° to the front: its second view is across it and across the view from behind.
TEST(TipApexDistance, OfANeckToTheFrontIsTheSumOfTwoViews) {
    documents::Anatomy anatomy = broken_femur();
    const Vec3 neck = normalized(Vec3{-0.6, -0.5, 0.624});
    anatomy.axes[0].to = 50.0_mm * neck;
    anatomy.points[0].at = 75.0_mm * neck;
    anatomy.fracture.reset();
    const Vec3 apex = anatomy.points[0].at, across = normalized(cross(Vec3{0, 1, 0}, neck));
    const auto of = [&](Vec3 off) { return *tip_apex_distance(anatomy, {}, apex + off, "apex", "neck"); };
    EXPECT_NEAR(of(6.0_mm * across), 6.0_mm + 0.0, 1e-9) << "along the second view it shows in the first alone";
    EXPECT_NEAR(of(Vec3{0, 6.0_mm, 0}), 0.0 + 6.0_mm, 1e-9) << "to the back it shows in the second alone";
    const Vec3 along = cross(across, Vec3{0, 1, 0});
    EXPECT_NEAR(of(5.0_mm * along), 10.0_mm, 1e-9) << "in both";
}

}  // namespace
}  // namespace kerf::run
