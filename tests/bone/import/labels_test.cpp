// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "bone/image/scan.h"
#include "bone/import/ct_body.h"
#include "bone/import/label_fit.h"
#include "documents/read_anatomy.h"
#include "kerf/units.hpp"

namespace kerf::bone {
namespace {

using namespace literals;

constexpr double spacing = 1.0_mm;

/// A grid of 48 × 44 × 40 voxels that is symmetric about no plane of the patient.
VoxelImage blank() {
    VoxelImage image;
    image.size = {48, 44, 40};
    image.place({spacing, 0, 0, -(20.0_mm), 0, spacing, 0, -(18.0_mm), 0, 0, spacing, -(17.0_mm)});
    return image;
}

template <class Value>
VoxelImage image_of(const Value& value) {
    VoxelImage image = blank();
    for_each_voxel(image, [&](int i, int j, int k, std::size_t) {
        image.values.push_back(static_cast<float>(
            value(image.lps({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)}))));
    });
    return image;
}

/// Signed distance to a bone without a plane of symmetry: a ball and a process out of it.
double bone_at(Vec3 p) {
    const Vec3 from{2.0_mm, -(1.0_mm), 1.0_mm}, along = normalized(Vec3{1.0, 0.6, -0.8});
    const double t = std::clamp(dot(p - from, along), 0.0, 16e-3);
    return std::min(length(p - from) - 8.0_mm, length(p - from - t * along) - 3.5_mm);
}

/// HU: a cortex of 1.5 mm around cancellous bone, in soft tissue.
double hounsfield(double d) { return d > 0.0 ? 40.0 : d > -(1.5_mm) ? 900.0 : 180.0; }

VoxelImage scan() {
    return image_of([](Vec3 p) { return hounsfield(bone_at(p)); });
}

VoxelImage labels_at(Vec3 shift, double grown = 0.0) {
    return image_of([&](Vec3 p) { return bone_at(p - shift) < grown ? 5.0 : 0.0; });
}
VoxelImage labels() { return labels_at({}); }

/// The axis spans the grid, so that the whole bone is read.
documents::Anatomy anatomy() {
    documents::Anatomy result;
    result.file = "bone.yaml";
    result.ct.emplace().threshold = 300.0;
    result.ct->keep = {5};
    result.tissues = {{"bone", 1500.0, 0.0, ""}};
    result.axes = {{"axis", {-(20.0_mm), -(18.0_mm), -(17.0_mm)}, {27.0_mm, 25.0_mm, 22.0_mm}, 0.0}};
    return result;
}

struct Made {
    bool is_bone = false;
    text::Diagnostics diagnostics;

    [[nodiscard]] std::string codes() const {
        std::string all;
        for (const auto& one : diagnostics)
            if (one.code != "W0675") all += (all.empty() ? "" : " ") + std::string(one.code);
        return all;
    }
    [[nodiscard]] std::string text() const { return to_text(diagnostics); }
};

Made made(const VoxelImage& image, const VoxelImage& map, const documents::Anatomy& one = anatomy()) {
    Made result;
    result.is_bone = make_ct_bone(one, image, &map).take(result.diagnostics).has_value();
    return result;
}

double fit_of(const VoxelImage& map) {
    const VoxelImage image = scan();
    BoneMask mask(image);
    const LabelMap source{map, {}, [&](const VoxelRange& range, int) { return map.cropped(range); }};
    EXPECT_TRUE(mark_labels(mask, *anatomy().ct, source));
    return label_fit(mask, 2).brighter_inside;
}

TEST(LabelFit, IsOneForLabelsOfTheScan) {
    EXPECT_DOUBLE_EQ(fit_of(labels()), 1.0);
    EXPECT_EQ(made(scan(), labels()).codes(), "");
}

TEST(LabelFit, IsHalfOrLessForUnrelatedLabels) {
    const VoxelImage unrelated = image_of([](Vec3 p) {
        return length(p - Vec3{6.0_mm, 9.0_mm, 4.0_mm}) < 9.0_mm ? 5.0 : 0.0;
    });
    EXPECT_LT(fit_of(unrelated), 0.55);
    EXPECT_EQ(made(scan(), unrelated).codes(), "W0678");
}

TEST(LabelFit, RefusesMirroredLabelsAndNamesTheAxis) {
    const char* directions[] = {"mirrored left to right", "mirrored front to back", "mirrored head to feet"};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        VoxelImage mirrored = labels();
        const VoxelImage own = labels();
        for_each_voxel(own, [&](int i, int j, int k, std::size_t at) {
            std::array<int, 3> other{i, j, k};
            other[axis] = own.size[axis] - 1 - other[axis];
            mirrored.values[own.offset(other[0], other[1], other[2])] = own.values[at];
        });
        const Made result = made(scan(), mirrored);
        EXPECT_EQ(result.codes(), "E0630");
        EXPECT_NE(result.text().find(std::string("at 100 % when they are ") + directions[axis]), std::string::npos)
            << result.text();
    }
}

TEST(LabelFit, RefusesLabelsWrittenAsRas) {
    VoxelImage ras = labels();
    auto matrix = ras.lps_from_index;
    for (std::size_t n = 0; n < 8; ++n) matrix[n] = -matrix[n];
    ras.place(matrix);
    const Made result = made(scan(), ras);
    EXPECT_EQ(result.codes(), "E0630");
    EXPECT_NE(result.text().find("at 100 % when they are read as RAS"), std::string::npos) << result.text();
}

TEST(LabelFit, RefusesMovedLabelsAndNamesTheShift) {
    const Made result = made(scan(), labels_at({4.0_mm, -(3.0_mm), 5.0_mm}));
    EXPECT_EQ(result.codes(), "E0630");
    EXPECT_NE(result.text().find("moved by -4.00 3.00 -5.00 mm"), std::string::npos) << result.text();
}

TEST(LabelFit, WarnsOfLabelsOneVoxelOff) {
    const Made result = made(scan(), labels_at({0.0, 1.0_mm, 0.0}));
    EXPECT_EQ(result.codes(), "W0678");
    EXPECT_NE(result.text().find("moved by 0.00 -1.00 0.00 mm"), std::string::npos) << result.text();
}

TEST(LabelFit, RefusesLabelsInAir) {
    // Given noise about air beyond 20 mm, and labels there
    unsigned state = 1;
    const VoxelImage image = image_of([&](Vec3 p) {
        state = state * 1664525u + 1013904223u;
        return p.x > 14.0_mm ? -1000.0 + static_cast<double>(state >> 28) : hounsfield(bone_at(p));
    });
    const Made result = made(image, image_of([](Vec3 p) {
                                 return length(p - Vec3{21.0_mm, 3.0_mm, 2.0_mm}) < 5.0_mm ? 5.0 : 0.0;
                             }));
    EXPECT_EQ(result.codes(), "E0630");
    EXPECT_NE(result.text().find("100 % of the kept voxels are as dark as air"), std::string::npos) << result.text();
}

TEST(LabelFit, AcceptsDryBoneWithAirInItsMarrow) {
    const VoxelImage dry = image_of([](Vec3 p) {
        const double d = bone_at(p);
        return d > 0.0 || d < -(1.5_mm) ? -1000.0 : 900.0;
    });
    EXPECT_EQ(made(dry, labels()).codes(), "");
}

TEST(LabelFit, AcceptsLabelsHalfAVoxelTooLargeOrTooSmall) {
    for (const double grown : {-(0.5_mm), 0.5_mm}) EXPECT_EQ(made(scan(), labels_at({}, grown)).codes(), "") << grown;
}

TEST(LabelFit, NamesLabelsThatAreTooLargeOrTooSmall) {
    const Made large = made(scan(), labels_at({}, 1.5_mm)), small = made(scan(), labels_at({}, -(1.5_mm)));
    EXPECT_NE(large.text().find("when they are shrunk by one voxel"), std::string::npos) << large.text();
    EXPECT_NE(small.text().find("when they are grown by one voxel"), std::string::npos) << small.text();
}

TEST(LabelFit, IgnoresTheBorderToAnotherLabel) {
    // Given the next bone beyond a joint, as bright as this one
    const VoxelImage image = image_of([](Vec3 p) { return p.z < 0.0 ? 900.0 : hounsfield(bone_at(p)); });
    const VoxelImage map = image_of([](Vec3 p) { return p.z < 0.0 ? 6.0 : bone_at(p) < 0.0 ? 5.0 : 0.0; });
    EXPECT_EQ(made(image, map).codes(), "");
}

TEST(LabelFit, WarnsOfALabelMapThatEndsWithinBone) {
    VoxelImage half = labels();
    half = half.cropped({{0, 0, 0}, {22, 44, 40}});
    const Made result = made(scan(), half);
    EXPECT_EQ(result.codes(), "W0678");
    EXPECT_NE(result.text().find("the label map ends within the bone"), std::string::npos) << result.text();
}

TEST(LabelFit, AcceptsALabelMapCutToItsBone) {
    // Given a map that ends at the bone, as 3D Slicer writes one
    const VoxelImage own = labels();
    std::array<int, 3> low = own.size, high{};
    for_each_voxel(own, [&](int i, int j, int k, std::size_t at) {
        const std::array<int, 3> voxel{i, j, k};
        for (std::size_t axis = 0; own.values[at] > 0.0f && axis < 3; ++axis) {
            low[axis] = std::min(low[axis], voxel[axis]);
            high[axis] = std::max(high[axis], voxel[axis] + 1);
        }
    });
    const VoxelRange range{low, {high[0] - low[0], high[1] - low[1], high[2] - low[2]}};
    EXPECT_EQ(made(scan(), own.cropped(range)).codes(), "");
}

// ---- pieces ---------------------------------------------------------------------------------------------------------

VoxelImage with_island(VoxelImage image, float value) {
    for (int k = 3; k < 7; ++k)
        for (int j = 30; j < 33; ++j)
            for (int i = 5; i < 7; ++i) image.values[image.offset(i, j, k)] = value;
    return image;
}

TEST(LabelPieces, WarnsOfAStrayPiece) {
    const Made result = made(with_island(scan(), 900.0f), with_island(labels(), 5.0f));
    EXPECT_EQ(result.codes(), "W0679");
    EXPECT_NE(result.text().find(" and 24 voxels; one of 24 lies at -15.0 12.0 -14.0 mm"), std::string::npos)
        << result.text();
}

TEST(LabelPieces, AcceptsOnePieceForEachLabel) {
    documents::Anatomy two = anatomy();
    two.ct->keep = {5, 6};
    EXPECT_EQ(made(with_island(scan(), 900.0f), with_island(labels(), 6.0f), two).codes(), "");
}

TEST(LabelPieces, AcceptsAPieceAtTheEndOfTheRegion) {
    // Given an island that the region's end cuts
    VoxelImage image = scan(), map = labels();
    for (int k = 0; k < 4; ++k)
        for (int j = 30; j < 33; ++j)
            for (int i = 5; i < 7; ++i) {
                image.values[image.offset(i, j, k)] = 900.0f;
                map.values[map.offset(i, j, k)] = 5.0f;
            }
    EXPECT_EQ(made(image, map).codes(), "");
}

// ---- values ---------------------------------------------------------------------------------------------------------

TEST(LabelMap, RefusesValuesThatAreNoLabels) {
    for (const float odd : {14.5f, 0.002f, -1.0f, -1000.0f, 1e30f, 16777300.0f}) {
        VoxelImage map = labels();
        map.values[map.offset(7, 9, 11)] = odd;
        EXPECT_EQ(made(scan(), map).codes(), "E0637") << odd;
    }
}

TEST(LabelMap, AcceptsWholeNumbersRoundedByAScale) {
    VoxelImage map = labels();
    for (float& value : map.values) value *= 0.99999f;
    EXPECT_EQ(made(scan(), map).codes(), "");
}

TEST(LabelMap, RefusesSmoothedLabelsThatWereRounded) {
    const VoxelImage smooth =
        image_of([](Vec3 p) { return std::round(29.0 * std::clamp(0.5 - bone_at(p) / 4.0_mm, 0.0, 1.0)); });
    documents::Anatomy one = anatomy();
    one.ct->keep = {29};
    EXPECT_EQ(made(scan(), smooth, one).codes(), "E0637");
}

TEST(LabelMap, AcceptsACortexWithALabelOfItsOwn) {
    const VoxelImage nested = image_of([](Vec3 p) {
        return bone_at(p) < -(1.5_mm) ? 5.0 : bone_at(p) < 0.0 ? 3.0 : 0.0;
    });
    EXPECT_EQ(made(scan(), nested).codes(), "");
}

TEST(LabelMap, ListsTheLabelsWhenNoneIsKept) {
    documents::Anatomy one = anatomy();
    one.ct->keep = {29};
    VoxelImage map = labels();
    map.values[map.offset(7, 9, 11)] = 8.0f;
    const Made result = made(scan(), map, one);
    EXPECT_EQ(result.codes(), "E0633");
    EXPECT_NE(result.text().find("The label map has 5, 8 there"), std::string::npos) << result.text();
}

// ---- a real scan ----------------------------------------------------------------------------------------------------

struct RealLabels : testing::Test {
    std::optional<VoxelImage> scan, labels;
    std::optional<documents::Anatomy> anatomy;

    void SetUp() override {
        const char* root = std::getenv("KERF_DATA");
        const std::filesystem::path volumes = std::filesystem::path(root == nullptr ? "" : root) / "volumes";
        if (root == nullptr || !std::filesystem::exists(volumes))
            GTEST_SKIP() << "KERF_DATA names no folder with volumes/.";
        text::Diagnostics diagnostics;
        const auto read = [&](const char* name) -> std::optional<VoxelImage> {
            const auto opened = open_scan((volumes / name).string(), {}, {}).take(diagnostics);
            return opened ? opened->read(opened->grid().all(), 0, {}).take(diagnostics) : std::nullopt;
        };
        scan = read("lumbar_l3_tptbox_ct.nii.gz");
        labels = read("lumbar_l3_tptbox_seg_vertebra.nii.gz");
        anatomy = documents::read_anatomy(KERF_SOURCE_DIR "/tests/real-data/l3.yaml").take(diagnostics);
        ASSERT_TRUE(scan && labels && anatomy) << to_text(diagnostics);
    }
    /// The labels of this scan, moved along x by whole voxels.
    [[nodiscard]] Made moved(int voxels) const {
        VoxelImage other = *labels;
        const Vec3 offset = static_cast<double>(voxels) * other.step(0);
        other.place(other.step(0), other.step(1), other.step(2), other.origin() + offset);
        return made(*scan, other, *anatomy);
    }
};

TEST_F(RealLabels, FitTheirScan) { EXPECT_EQ(moved(0).codes(), ""); }

TEST_F(RealLabels, AreRefusedWhenMovedByThreeVoxels) {
    for (const int voxels : {-3, 3}) EXPECT_EQ(moved(voxels).codes(), "E0630") << moved(voxels).text();
}

TEST_F(RealLabels, AreDoubtedWhenMovedByOneVoxel) {
    for (const int voxels : {-1, 1}) EXPECT_EQ(moved(voxels).codes(), "W0678") << moved(voxels).text();
}

}  // namespace
}  // namespace kerf::bone
