// SPDX-License-Identifier: Apache-2.0
// Volumes of bone and cut that share voxels, against those of their exact overlap.
#include "core/field/cut/removed_volume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/block.h"

namespace kerf {
namespace {

using namespace literals;

constexpr double h = 0.5_mm;

/// Bone below z = 0, as far as the grid goes. Samples lie 0.25 h above the face.
Body half_space() {
    Grid grid = Grid::covering({-3.0_mm, -3.0_mm, -3.0_mm}, {3.0_mm, 3.0_mm, 3.0_mm}, h);
    grid.origin.z = h * (std::floor(grid.origin.z / h) + 0.25);
    Body body;
    body.id = "half space";
    body.surface = LevelSet::build(grid, [](Vec3 p) { return p.z; });
    body.materials.push_back({"cortical", 1850.0, {}});
    return body;
}

/// Flat at its front, and wider than the grid.
ToolSolid plunger() { return ToolSolid::prism({{0.0, 20.0_mm}, {-4.0_mm, 20.0_mm}}, 40.0_mm); }

CutField cut_to(const Body& body, double depth) {
    CutField cut(body, 256);
    CutRecord record;
    record.from = record.to = test::pointing({0, 0, -depth}, {0, 0, -1});
    cut.stamp(record, plunger());
    return cut;
}

TEST(BoneVolume, FlatCutShortOfTheFaceTakesNothing) {
    const Body body = half_space();
    const double whole = bone_volume(body, CutField(body, 0));
    for (const double above : {0.45 * h, 0.3 * h, 0.2 * h, 0.1 * h, 0.02 * h})
        EXPECT_EQ(bone_volume(body, cut_to(body, -above)), whole) << above / h << " voxels above the face";
}

TEST(BoneVolume, AFlatCutTakesWhatItOverlaps) {
    const Body body = half_space();
    const double whole = bone_volume(body, CutField(body, 0));
    const double area = (bone_volume(body, cut_to(body, h)) - bone_volume(body, cut_to(body, 2.0 * h))) / h;
    ASSERT_GT(area, 6.0_mm * 6.0_mm);
    for (double depth = 0.05 * h; depth < 3.0 * h; depth += 0.05 * h)
        EXPECT_NEAR((whole - bone_volume(body, cut_to(body, depth))) / area, depth, 0.01 * h) << depth / h;
}

TEST(RemovedVolume, OfATubeIsThatOfItsRing) {
    constexpr double outer = 2.0_mm, inner = 1.3_mm, deep = 1.5_mm, fine = 0.1_mm;
    const Body body = test::block({-3.0_mm, -3.0_mm, -3.0_mm}, {3.0_mm, 3.0_mm, 0}, fine, {0.31, 0.17, 0.73});
    CutField cut(body, 4096);
    CutRecord record;
    record.from = test::pointing({0, 0, 0.5_mm}, {0, 0, -1});
    record.to = test::pointing({0, 0, -deep}, {0, 0, -1});
    cut.stamp(record, ToolSolid::hollow({{0.0, outer}, {-5.0_mm, outer}}, inner));
    RemovedVolume removed(body);
    removed.update(cut);
    const double ring = pi * (outer * outer - inner * inner) * deep;
    EXPECT_NEAR(removed.total(), ring, 0.01 * ring);
}

TEST(RemovedVolume, IsWhatTheBoneLost) {
    const Body body = half_space();
    const double whole = bone_volume(body, CutField(body, 0));
    for (const double depth : {-0.1 * h, 0.3 * h, 2.2 * h}) {
        CutField cut = cut_to(body, depth);
        RemovedVolume removed(body);
        removed.update(cut);
        EXPECT_NEAR(removed.total(), whole - bone_volume(body, cut), 1e-6 * whole /* single precision */) << depth / h;
    }
}

TEST(RemovedVolume, IsNeverNegativeForAGrazingCut) {
    const Body body = test::block({-4.0_mm, -4.0_mm, -4.0_mm}, {4.0_mm, 4.0_mm, 0}, h, {0.31, 0.17, 0.73});
    const double whole = bone_volume(body, CutField(body, 0));
    const ToolSolid drill = test::drill_outline(1.3_mm, 59.0_deg, 3.0_mm), flat({{0.0, 1.3_mm}, {-3.0_mm, 1.3_mm}});
    std::mt19937 random(4);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    int missed = 0;
    for (int i = 0; i < 300; ++i) {
        CutRecord record;
        record.from = test::pointing({3.0_mm * unit(random), 3.0_mm * unit(random), h * unit(random)},
                                     {0.2 * unit(random), 0.2 * unit(random), -1.0});
        record.to = record.from;
        CutField cut(body, 256);
        cut.stamp(record, i % 2 == 0 ? drill : flat);
        RemovedVolume removed(body);
        removed.update(cut);
        EXPECT_GE(removed.total(), 0.0) << i;
        EXPECT_LE(bone_volume(body, cut), whole) << i;
        missed += removed.total() == 0.0;
    }
    EXPECT_GT(missed, 10) << "some came near without touching";
    EXPECT_LT(missed, 200);
}

TEST(RemovedVolume, CountsEachMaterialAlone) {
    // Bone below z = −1 mm is cancellous, the rest cortical
    Body body = test::block({-4.0_mm, -4.0_mm, -4.0_mm}, {4.0_mm, 4.0_mm, 0}, h, {0.31, 0.17, 0.73});
    body.materials = {{"cortical", 1850.0, LevelSet::build(body.grid(), [](Vec3 p) { return -1.0_mm - p.z; })},
                      {"cancellous", 250.0, {}}};
    const ToolSolid rod({{0.0, 2.0_mm}, {-20.0_mm, 2.0_mm}});
    CutField cut(body, 512);
    CutRecord record;
    record.from = record.to = test::pointing({0, 0, -3.0_mm}, {0, 0, -1});
    cut.stamp(record, rod);
    RemovedVolume removed(body);
    removed.update(cut);
    const double disc = pi * 2.0_mm * 2.0_mm;
    EXPECT_NEAR(removed.of_material(0) / disc, 1.0_mm, 0.3 * h /* tissues mix at their border */);
    EXPECT_NEAR(removed.of_material(1) / disc, 2.0_mm, 0.3 * h);
    EXPECT_DOUBLE_EQ(removed.total(), removed.of_material(0) + removed.of_material(1));
}

}  // namespace
}  // namespace kerf
