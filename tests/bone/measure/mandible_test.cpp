// SPDX-License-Identifier: Apache-2.0
// Angles of a mandible that is made with them, on a mesh and on a field, before and after a cut.
#include "bone/measure/mandible.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "bone/measure/field_surface.h"
#include "bone/measure/mesh_surface.h"
#include "core/field/cut/cut_field.h"
#include "tests/support/block.h"
#include "tests/support/made_mandible.h"

namespace kerf::bone {
namespace {

using namespace literals;
using test::MadeMandible;

constexpr double known_to = 1.0_mm;  // of each landmark

MandibleSide side_of(const MadeMandible& made, Quat turned = {1, 0, 0, 0}) {
    return {.condylion = {rotate(turned, made.condylion()), known_to},
            .gonion = {rotate(turned, made.gonion()), known_to},
            .menton = {rotate(turned, made.menton()), known_to}};
}
SagittalView view_of(Quat turned = {1, 0, 0, 0}) {
    return {rotate(turned, {1, 0, 0}), rotate(turned, {0, 1, 0}), rotate(turned, {0, 0, -1})};
}
const Plane horizontal{{0, 0, 50.0_mm}, {0, 0, 1}};

/// Tilts of the head: none, nodded, turned and rolled.
const Quat tilts[] = {
    {1, 0, 0, 0}, quat_from_rotation_vector({0.3, 0, 0}), quat_from_rotation_vector({-0.2, 0.35, 0.15})};

struct Angles {
    double gonial, slope;
};
class MadeAngles : public testing::TestWithParam<Angles> {
protected:
    [[nodiscard]] static MadeMandible mandible() {
        MadeMandible made;
        made.gonial_angle = GetParam().gonial;
        made.slope = GetParam().slope;
        return made;
    }
};
INSTANTIATE_TEST_SUITE_P(All, MadeAngles,
                         testing::Values(Angles{105.0_deg, 18.0_deg}, Angles{115.0_deg, 20.0_deg},
                                         Angles{126.0_deg, 28.0_deg}, Angles{140.0_deg, 35.0_deg}));

TEST_P(MadeAngles, AreMeasuredOnAMesh) {
    for (const Quat& tilt : tilts) {
        const MadeMandible made = mandible();
        const SurfaceMesh mesh = test::turned(made.mesh(), tilt);
        const MeshSurface surface(mesh);
        const auto angle = gonial_angle(surface, side_of(made, tilt), view_of(tilt));
        const Plane reference{rotate(tilt, horizontal.point), rotate(tilt, horizontal.normal)};
        const auto plane = mandibular_plane_angle(surface, side_of(made, tilt), reference, view_of(tilt));
        ASSERT_TRUE(angle && plane);
        EXPECT_NEAR(angle->value, made.gonial_angle, 0.2_deg);
        EXPECT_NEAR(plane->value, made.slope, 0.2_deg);
        EXPECT_GE(angle->uncertainty, 0.0);
        EXPECT_LT(angle->uncertainty, 1.0_deg) << "a landmark only chooses the border, which is straight";
    }
}

TEST_P(MadeAngles, AreMeasuredOnAField) {
    double worst_gonial = 0.0, worst_plane = 0.0;
    for (const Quat& tilt : tilts) {
        MadeMandible made = mandible();
        const Body body = made.body(0.5_mm, tilt);
        const CutField uncut(body, 0);
        const FieldSurface surface(body, uncut);
        const auto angle = gonial_angle(surface, side_of(made, tilt), view_of(tilt));
        const Plane reference{rotate(tilt, horizontal.point), rotate(tilt, horizontal.normal)};
        const auto plane = mandibular_plane_angle(surface, side_of(made, tilt), reference, view_of(tilt));
        ASSERT_TRUE(angle && plane);
        EXPECT_GT(angle->uncertainty, 0.1_deg);
        EXPECT_LT(angle->uncertainty, 1.5_deg);
        EXPECT_NEAR(angle->value, made.gonial_angle, angle->uncertainty);
        EXPECT_NEAR(plane->value, made.slope, plane->uncertainty);
        worst_gonial = std::max(worst_gonial, std::abs(angle->value - made.gonial_angle));
        worst_plane = std::max(worst_plane, std::abs(plane->value - made.slope));
    }
    RecordProperty("gonial_error_deg", std::to_string(worst_gonial / 1.0_deg));
    RecordProperty("plane_error_deg", std::to_string(worst_plane / 1.0_deg));
}

TEST(GonialAngle, IsTheSameOnTheOtherSide) {
    const MadeMandible left;
    MadeMandible right;
    right.middle = -left.middle;
    const SurfaceMesh mesh = left.mesh(), mirrored = test::mirrored(mesh);
    const auto one = gonial_angle(MeshSurface(mesh), side_of(left)),
               other = gonial_angle(MeshSurface(mirrored), side_of(right));
    ASSERT_TRUE(one && other);
    EXPECT_NEAR(one->value, other->value, 1e-12);
    EXPECT_NEAR(one->uncertainty, other->uncertainty, 1e-9);
}

TEST(GonialAngle, IgnoresTheOtherSide) {
    const MadeMandible left;
    MadeMandible right;
    right.middle = -left.middle;
    right.gonial_angle = 140.0_deg;
    SurfaceMesh both = left.mesh();
    const auto count = static_cast<std::uint32_t>(both.vertices.size());
    const SurfaceMesh more = right.mesh();
    both.vertices.insert(both.vertices.end(), more.vertices.begin(), more.vertices.end());
    for (Triangle t : more.triangles) both.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
    const MeshSurface surface(both);
    const auto one = gonial_angle(surface, side_of(left)), other = gonial_angle(surface, side_of(right));
    ASSERT_TRUE(one && other);
    EXPECT_NEAR(one->value, 120.0_deg, 0.2_deg);
    EXPECT_NEAR(other->value, 140.0_deg, 0.2_deg);
}

TEST(GonialAngle, BridgesTheNotch) {
    MadeMandible made;
    for (const double notch : {0.0_mm, 3.0_mm, 5.0_mm}) {
        made.notch = notch;
        const SurfaceMesh mesh = made.mesh();
        const auto angle = gonial_angle(MeshSurface(mesh), side_of(made));
        ASSERT_TRUE(angle);
        EXPECT_NEAR(angle->value, made.gonial_angle, 0.2_deg) << notch;
    }
}

TEST(GonialAngle, NeedsBoneAtBothBorders) {
    const MadeMandible made;
    const SurfaceMesh mesh = made.mesh();
    MandibleSide side = side_of(made);
    side.menton.at = {-40.0_mm, -60.0_mm, -200.0_mm};
    side.gonion.at = {-40.0_mm, 0, -200.0_mm};
    EXPECT_FALSE(gonial_angle(MeshSurface(mesh), side));
}

// A plate of bone is milled off the lower border: from the back of the ramus to near the chin the border is now the
// face of the tool. How the tool lies says by how much the angles have changed.
TEST(GonialAngle, FollowsACut) {
    MadeMandible made;
    const Body body = made.body(0.5_mm);
    CutField cut(body, 4096);
    const Vec3 from = made.at(made.upwards(), 10.0_mm), to = made.at(made.forwards(), 62.0_mm);
    const Vec3 way = normalized(to - from), up = normalized(cross(way, Vec3{1, 0, 0}));
    const Vec3 out = up.z < 0.0 ? up : -up;
    constexpr double thick = 40e-3;
    // The tool's z is its feed, its y the normal of its faces.
    const Quat fed = quat_between({0, 0, 1}, way);
    const Vec3 y = rotate(fed, {0, 1, 0});
    const double angle = std::atan2(dot(cross(y, out), way), dot(y, out));
    CutRecord record;
    const Quat rotation = quat_from_rotation_vector(angle * way) * fed;
    ASSERT_GT(dot(rotate(rotation, {0, 1, 0}), out), 0.999);
    record.from = record.to = {to + 20.0_mm * way + 0.5 * thick * out, rotation};
    const ToolSolid plate = test::blade_outline(500.0_mm, 20.0_mm, 120.0_mm, thick);
    cut.stamp(record, plate);

    const FieldSurface surface(body, cut);
    const auto after = gonial_angle(surface, side_of(made));
    const auto plane = mandibular_plane_angle(surface, side_of(made), horizontal);
    ASSERT_TRUE(after && plane);
    const auto up_ramus = made.upwards();
    const double made_angle = std::acos(dot(way, Vec3{0, up_ramus[0], up_ramus[1]}));
    EXPECT_GT(std::abs(made_angle - made.gonial_angle), 5.0_deg) << "the cut changes something";
    EXPECT_NEAR(after->value, made_angle, after->uncertainty);
    EXPECT_NEAR(plane->value, std::asin(-way.z), plane->uncertainty);
}

}  // namespace
}  // namespace kerf::bone
