// SPDX-License-Identifier: Apache-2.0
// Bone with rooms in it: two one-sided fields, combined after interpolation.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/field/cut/body_query.h"
#include "core/field/cut/removed_volume.h"
#include "core/field/surface/bone_surface.h"
#include "tests/support/block.h"
#include "tests/support/mesh_checks.h"

namespace kerf {
namespace {

using namespace literals;

constexpr double half_edge = 8.0_mm, half_angle = 59.0_deg;

/// A box whose wall at +z is `sheet` thick; the other walls are 4 mm.
Body box_with_room(double sheet, double h, bool has_two_fields) {
    const Vec3 low{-half_edge, -half_edge, -half_edge}, high{half_edge, half_edge, half_edge};
    const Vec3 wall{4.0_mm, 4.0_mm, 4.0_mm}, room_high = high - Vec3{wall.x, wall.y, sheet};
    Body body = test::block(low, high, h, {0.3, 0.7, 0.11});
    const auto room = [=](Vec3 p) { return test::box_distance(p, low + wall, room_high); };
    if (has_two_fields)
        body.hollow = LevelSet::build(body.grid(), room);
    else
        body.surface =
            LevelSet::build(body.grid(), [=](Vec3 p) { return std::max(test::box_distance(p, low, high), -room(p)); });
    return body;
}

/// Bone along a line through the middle of the sheet [m]: ∫ engagement dz.
double felt_thickness(const Body& body, double sheet) {
    const CutField cut(body, 16);
    const double h = body.grid().spacing, step = 1e-3 * h;
    double sum = 0.0;
    for (double z = half_edge - sheet - 2.0 * h; z < half_edge + 2.0 * h; z += step) {
        const LocatedPoint place = locate(body, {0.1_mm, 0.2_mm, z});
        sum += step * static_cast<double>(engagement(body.surface.quanta_at(place), cut.quanta_at(place)));
    }
    return sum;
}

TEST(Hollow, ASheetIsAsThickAsItIsHoweverThin) {
    const double h = 0.5_mm;
    for (const double voxels : {0.4, 0.7, 1.0, 2.0, 2.9}) {
        const double sheet = voxels * h;
        const Body body = box_with_room(sheet, h, true);
        double there = 0.0;
        for (double z = half_edge - sheet - h; z < half_edge + h; z += 1e-3 * h)
            there += uncut_distance(body, locate(body, {0.1_mm, 0.2_mm, z})) < 0.0 ? 1e-3 * h : 0.0;
        EXPECT_NEAR(there, sheet, 0.003 * h) << voxels;
        EXPECT_NEAR(felt_thickness(body, sheet), sheet, 0.03 * h /* ramps of a quarter and a tenth of a voxel */)
            << voxels;
    }
}
TEST(Hollow, OneFieldLosesASheetThinnerThanAVoxel) {
    const double h = 0.5_mm;
    EXPECT_LT(felt_thickness(box_with_room(0.4 * h, h, false), 0.4 * h), 0.2 * h);
    EXPECT_NEAR(felt_thickness(box_with_room(4.0_mm, h, false), 4.0_mm), 4.0_mm, 0.01 * h)
        << "and carries a thick wall";
}

TEST(Hollow, IsTheSameBoneAsOneFieldWhereWallsAreThick) {
    const double h = 0.5_mm;
    const Body one = box_with_room(4.0_mm, h, false), two = box_with_room(4.0_mm, h, true);
    const CutField cut(two, 16);
    const Grid& g = one.grid();
    for (int k = 0; k < g.samples(2); ++k)
        for (int j = 0; j < g.samples(1); ++j)
            for (int i = 0; i < g.samples(0); ++i)
                ASSERT_NEAR(one.surface.sample(i, j, k), std::max(two.surface.sample(i, j, k), cut.sample(i, j, k)), 1)
                    << i << ' ' << j << ' ' << k;
}

TEST(Hollow, CuttingAddsToIt) {
    // The larger of what is hollow and what the tool took, sample by sample
    const double h = 0.5_mm;
    const Body solid =
        test::block({-half_edge, -half_edge, -half_edge}, {half_edge, half_edge, half_edge}, h, {0.3, 0.7, 0.11});
    const Body hollow = box_with_room(1.0_mm, h, true);
    const ToolSolid tool = test::drill_outline(1.6_mm, half_angle, 20.0_mm);
    CutRecord record;
    record.from = test::pointing({1.0_mm, 0, 9.0_mm}, {0.1, 0.05, -1});
    record.to = test::pointing({0, 0, -(6.0_mm)}, {0.1, 0.05, -1});
    CutField plain(solid, 256), begun(hollow, 256);
    plain.stamp(record, tool);
    begun.stamp(record, tool);
    const Grid& g = solid.grid();
    for (int k = 0; k < g.samples(2); ++k)
        for (int j = 0; j < g.samples(1); ++j)
            for (int i = 0; i < g.samples(0); ++i)
                ASSERT_EQ(begun.sample(i, j, k), std::max<int>(plain.sample(i, j, k), -hollow.hollow.sample(i, j, k)));
}

TEST(Hollow, WhatIsHollowWasNotRemoved) {
    const double h = 0.25_mm, r = 1.6_mm;
    const Body body = box_with_room(4.0_mm, h, true);
    CutField cut(body, 256);
    RemovedVolume removed(body);
    removed.update(cut);
    EXPECT_EQ(removed.total(), 0.0);

    // Down through the wall of 4 mm into the room
    CutRecord record;
    record.from = test::pointing({0, 0, 10.0_mm}, {0, 0, -1});
    record.to = test::pointing({0, 0, 1.0_mm}, {0, 0, -1});
    cut.stamp(record, test::drill_outline(r, half_angle, 20.0_mm));
    removed.update(cut);
    const double hole = 3.14159265358979 * r * r * 4.0_mm;
    EXPECT_NEAR(removed.total(), hole, 0.01 * hole);
}

TEST(Hollow, IsNoBoneForContactAndInTheSurface) {
    const double h = 0.5_mm;
    const Body body = box_with_room(1.0_mm, h, true);
    CutField committed(body, 64);
    const ToolSolid tool = test::drill_outline(1.6_mm, half_angle, 20.0_mm);
    CutTracker tracker(body, tool, committed);
    tracker.restart(test::pointing({0, 0, 20.0_mm}, {0, 0, -1}));
    const BodyQuery view(body, committed, tracker);
    EXPECT_NEAR(view.present_distance({0, 0, 6.5_mm}), 0.5_mm, 1e-6)
        << "in the room, half a millimetre under the sheet";
    EXPECT_NEAR(view.present_distance({0, 0, 8.5_mm}), 0.5_mm, 1e-6);
    EXPECT_LT(view.present_distance({0, 0, 7.5_mm}), -0.4_mm);

    const double volume = test::volume(bone_surface(body, committed));
    const double exact = 16.0_mm * 16.0_mm * 16.0_mm - 8.0_mm * 8.0_mm * 11.0_mm;
    EXPECT_NEAR(volume, exact, 0.01 * exact);
}

}  // namespace
}  // namespace kerf
