// SPDX-License-Identifier: Apache-2.0
#include "bone/image/scan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bone/image/write_nrrd.h"
#include "kerf/units.hpp"
#include "tests/support/temporary_folder.h"

namespace kerf::bone {
namespace {

using namespace literals;

struct ScanFile : testing::Test {
    test::TemporaryFolder folder;
    text::Diagnostics diagnostics;

    std::optional<Scan> open(const std::string& name, const std::string& bytes) {
        std::ofstream(folder / name, std::ios::binary) << bytes;
        diagnostics.clear();
        return open_scan(folder / name, {}, {}).take(diagnostics);
    }
    std::optional<VoxelImage> read(const std::optional<Scan>& scan, int layer = 0) {
        return scan ? scan->read(scan->grid().all(), layer, {}).take(diagnostics) : std::nullopt;
    }
};

// ---- segmentations of 3D Slicer
// ---------------------------------------------------------------------------------------

const std::string segments = "Segment0_Name:=L3 vertebra\nSegment0_LabelValue:=7\nSegment0_Layer:=0\n"
                             "Segment1_Name:=Canal\nSegment1_LabelValue:=1\nSegment1_Layer:=";

TEST_F(ScanFile, KnowsTheNamesOfASegmentation) {
    const auto scan = open("bone.seg.nrrd",
                           "NRRD0004\ntype: unsigned char\ndimension: 3\nspace: left-posterior-superior\nsizes: 3 2 2\n"
                           "space directions: (1,0,0) (0,1,0) (0,0,1)\nkinds: domain domain domain\nencoding: raw\n"
                           "space origin: (0,0,0)\n" +
                               segments + "0\n\n" + std::string("\7\7\0\0\1\1\0\0\0\0\0\7", 12));
    ASSERT_TRUE(scan) << to_text(diagnostics);
    ASSERT_EQ(scan->segments().size(), 2u);
    EXPECT_EQ(scan->segments()[0].name, "L3 vertebra");
    EXPECT_EQ(scan->segments()[0].label, 7);
    EXPECT_EQ(scan->segments()[1].name, "Canal");
    const auto labels = read(scan);
    ASSERT_TRUE(labels) << to_text(diagnostics);
    EXPECT_EQ(labels->at(1, 0, 0), 7.0f);
    EXPECT_EQ(labels->at(1, 1, 0), 1.0f);
    EXPECT_EQ(labels->at(2, 1, 1), 7.0f);
}

TEST_F(ScanFile, ReadsTheLayersOfStructuresThatOverlap) {
    // Given two layers, whose numbers alternate: voxel n holds n in the first and 100 + n in the second
    std::string voxels;
    for (int n = 0; n < 12; ++n) {
        voxels.push_back(static_cast<char>(n));
        voxels.push_back(static_cast<char>(100 + n));
    }
    const auto scan = open(
        "bone.seg.nrrd", "NRRD0004\ntype: unsigned char\ndimension: 4\nspace: left-posterior-superior\nsizes: 2 3 2 2\n"
                         "space directions: none (1,0,0) (0,1,0) (0,0,1)\nkinds: list domain domain domain\n"
                         "encoding: raw\nspace origin: (0,0,0)\n" +
                             segments + "1\n\n" + voxels);
    ASSERT_TRUE(scan) << to_text(diagnostics);
    for (const int layer : {0, 1}) {
        const auto labels = read(scan, layer);
        ASSERT_TRUE(labels) << to_text(diagnostics);
        EXPECT_EQ(labels->at(0, 0, 0), 100.0f * static_cast<float>(layer));
        EXPECT_EQ(labels->at(2, 1, 1), 100.0f * static_cast<float>(layer) + 11.0f);
    }
}

TEST_F(ScanFile, RefusesALayerThatIsNotThere) {
    EXPECT_FALSE(open("bone.seg.nrrd",
                      "NRRD0004\ntype: unsigned char\ndimension: 3\nspace: left-posterior-superior\nsizes: 3 2 2\n"
                      "space directions: (1,0,0) (0,1,0) (0,0,1)\nencoding: raw\nspace origin: (0,0,0)\n" +
                          segments + "4\n\n" + std::string(12, '\0')));
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_EQ(diagnostics[0].code, "E0622");
}

/// A segmentation of 3 × 2 × 2 voxels with some keys.
std::string segmentation(int layers, const std::string& keys) {
    const std::string count = std::to_string(layers);
    const std::string axes = layers > 1 ? "dimension: 4\nsizes: " + count +
                                              " 3 2 2\nkinds: list domain domain domain\n"
                                              "space directions: none (1,0,0) (0,1,0) (0,0,1)\n"
                                        : "dimension: 3\nsizes: 3 2 2\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n";
    return "NRRD0005\ntype: unsigned char\nspace: left-posterior-superior\n" + axes +
           "encoding: raw\nspace origin: (0,0,0)\n" + keys + "\n" +
           std::string(12 * static_cast<std::size_t>(layers), '\1');
}

TEST_F(ScanFile, TakesTheSegmentsNumberForALayerWithoutKeys) {
    // As 3D Slicer 4.10 wrote it; the order of lines says nothing.
    const auto scan =
        open("a.seg.nrrd", segmentation(3, "Segment2_Name:=canal\nSegment0_Name:=skin\nSegment1_Name:=bone\n"));
    ASSERT_TRUE(scan) << to_text(diagnostics);
    ASSERT_EQ(scan->segments().size(), 3u);
    for (int n = 0; n < 3; ++n) {
        EXPECT_EQ(scan->segments()[static_cast<std::size_t>(n)].layer, n);
        EXPECT_EQ(scan->segments()[static_cast<std::size_t>(n)].label, 1);
    }
    EXPECT_EQ(scan->segments()[1].name, "bone");
    EXPECT_TRUE(open("b.seg.nrrd", segmentation(1, "Segment0_Name:=bone\n"))) << to_text(diagnostics);
}

TEST_F(ScanFile, RefusesStructuresThatCannotBeToldApart) {
    const std::pair<const char*, std::string> files[]{
        // no label where two share a layer
        {"E0636", segmentation(1, "Segment0_Name:=skin\nSegment1_Name:=bone\n")},
        {"E0636", segmentation(1, "Segment0_Name:=skin\nSegment0_LabelValue:=1\nSegment1_Name:=bone\n")},
        {"E0636", segmentation(2, "Segment0_Name:=skin\nSegment0_Layer:=0\nSegment1_Name:=bone\nSegment1_Layer:=0\n")},
        // a layer for one alone
        {"E0636", segmentation(2, "Segment0_Name:=skin\nSegment0_Layer:=1\nSegment1_Name:=bone\n")},
        // more segments than layers, and none says where it is
        {"E0622", segmentation(2, "Segment0_Name:=a\nSegment1_Name:=b\nSegment2_Name:=c\n")},
        {"E0622", segmentation(1, "Segment0_Name:=a\nSegment0_Name:=b\n")},
        {"E0622", segmentation(1, "Segment0_Name:=a\nSegment0_LabelValue:=one\n")},
        {"E0622", segmentation(1, "Segment0_Name:=a\nSegment0_LabelValue:=0\n")},
        {"E0622", segmentation(1, "Segment0_LabelValue:=2\n")},
        // two numbers for each voxel that nothing names
        {"E0623", segmentation(2, "")},
    };
    for (const auto& [code, bytes] : files) {
        EXPECT_FALSE(open("a.seg.nrrd", bytes)) << bytes;
        ASSERT_EQ(diagnostics.size(), 1u);
        EXPECT_EQ(diagnostics[0].code, code) << to_text(diagnostics);
    }
}

// ---- places
// -----------------------------------------------------------------------------------------------------------

/// A NIfTI-1 file of 3 × 4 × 5 voxels of 1 mm, value = 100 i + 10 j + k, in either byte order.
std::string nifti(bool is_big, const std::vector<std::pair<std::size_t, float>>& reals, std::int16_t sform,
                  std::int16_t qform) {
    std::string bytes(352, '\0');
    const auto put = [&](std::size_t at, auto value) {
        char raw[sizeof value];
        std::memcpy(raw, &value, sizeof value);
        if (is_big) std::reverse(raw, raw + sizeof value);
        std::memcpy(bytes.data() + at, raw, sizeof value);
    };
    put(0, std::int32_t{348});
    const std::int16_t dims[] = {3, 3, 4, 5, 1, 1, 1, 1};
    for (std::size_t n = 0; n < 8; ++n) put(40 + 2 * n, dims[n]);
    put(70, std::int16_t{4});
    put(72, std::int16_t{16});
    for (const std::size_t at : {76, 80, 84, 88, 112}) put(at, 1.0f);
    put(108, 352.0f);
    put(252, qform);
    put(254, sform);
    for (const auto& [at, value] : reals) put(at, value);
    bytes[123] = 2;
    std::memcpy(bytes.data() + 344, "n+1", 4);
    for (int k = 0; k < 5; ++k)
        for (int j = 0; j < 4; ++j)
            for (int i = 0; i < 3; ++i) {
                bytes.append(2, '\0');
                put(bytes.size() - 2, static_cast<std::int16_t>(100 * i + 10 * j + k));
            }
    return bytes;
}

using Reals = std::vector<std::pair<std::size_t, float>>;
const Reals straight{{280, 1.0f}, {292, -5.0f}, {300, 1.0f}, {308, -6.0f}, {320, 1.0f}, {324, 7.0f}};  // RAS

TEST_F(ScanFile, ReadsNiftiInBothByteOrders) {
    for (const bool is_big : {false, true}) {
        const auto image = read(open("a.nii", nifti(is_big, straight, 1, 0)));
        ASSERT_TRUE(image) << to_text(diagnostics);
        EXPECT_EQ(image->at(2, 3, 4), 234.0f);
        EXPECT_NEAR(length(image->lps({2, 3, 4}) - Vec3{3.0_mm, 3.0_mm, 11.0_mm}), 0.0,
                    1e-9);  // LPS: −(2 − 5), −(3 − 6), 4 + 7
    }
}

TEST_F(ScanFile, TurnsByTheQuaternionWhereThereIsNoMatrix) {
    // Given a quarter turn about z (b = c = 0, d = √½), which takes i to y and j to −x
    const float half = 0.70710678f;
    const auto image = read(open("a.nii", nifti(false, {{264, half}, {268, 1.0f}, {272, 2.0f}, {276, 3.0f}}, 0, 1)));
    ASSERT_TRUE(image) << to_text(diagnostics);
    EXPECT_NEAR(length(image->step(0) - Vec3{0, -(1.0_mm), 0}), 0.0, 1e-9);  // RAS (0, 1, 0)
    EXPECT_NEAR(length(image->step(1) - Vec3{1.0_mm, 0, 0}), 0.0, 1e-9);     // RAS (−1, 0, 0)
    EXPECT_NEAR(length(image->origin() - Vec3{-(1.0_mm), -(2.0_mm), 3.0_mm}), 0.0, 1e-9);

    // And a negative pixdim[0] turns the third axis round
    const auto mirrored = read(open("a.nii", nifti(false, {{76, -1.0f}, {264, half}, {268, 1.0f}}, 0, 1)));
    ASSERT_TRUE(mirrored);
    EXPECT_NEAR(length(mirrored->step(2) - Vec3{0, 0, -(1.0_mm)}), 0.0, 1e-9);
}

TEST_F(ScanFile, TellsWhenMatrixAndQuaternionDisagree) {
    Reals both = straight;
    both.push_back({268, -5.0f});
    both.push_back({272, -6.0f});
    both.push_back({276, 7.0f});
    EXPECT_TRUE(open("a.nii", nifti(false, both, 1, 1)));
    EXPECT_TRUE(diagnostics.empty()) << to_text(diagnostics);
    both.back().second = 12.0f;
    const auto scan = open("a.nii", nifti(false, both, 1, 1));
    ASSERT_TRUE(scan);
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_EQ(diagnostics[0].code, "W0673");
    EXPECT_NE(diagnostics[0].message.find("5 mm apart"), std::string::npos) << diagnostics[0].message;
    EXPECT_NEAR(scan->grid().origin().z, 7.0_mm, 1e-9);
}

TEST_F(ScanFile, PutsAShearedImageStraight) {
    // Given slices that slide by half a voxel along y for each voxel along z
    Reals sheared = straight;
    sheared.push_back({304, 0.5f});
    const auto scan = open("a.nii", nifti(false, sheared, 1, 0));
    ASSERT_TRUE(scan) << to_text(diagnostics);
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_EQ(diagnostics[0].code, "W0671");
    EXPECT_TRUE(scan->is_resampled());
    const auto image = read(scan);
    ASSERT_TRUE(image) << to_text(diagnostics);
    EXPECT_FALSE(image->is_sheared());
    // Voxel (1, 2, 2) lay at RAS (1 − 5, 2 + 0.5 × 2 − 6, 2 + 7)
    EXPECT_NEAR(image->sample_trilinear({4.0_mm, 3.0_mm, 9.0_mm}, -1.0), 122.0, 1e-3);
}

// ---- writing
// ----------------------------------------------------------------------------------------------------------

TEST_F(ScanFile, IsReadAsItWasWritten) {
    for (const bool as_short : {true, false}) {
        VoxelImage image;
        image.size = {5, 4, 3};
        image.place({0.3_mm, 0.4_mm, 0}, {-(0.8_mm), 0.6_mm, 0}, {0, 0, 2.5_mm}, {10.0_mm, -(20.0_mm), 30.0_mm});
        for (int n = 0; n < 60; ++n)
            image.values.push_back(as_short ? static_cast<float>(n - 1000) : 0.25f * static_cast<float>(n));
        NrrdWriter writer(folder / "out.nrrd", image, "a remark", as_short);
        writer.add({image.values.data(), 20});
        writer.add({image.values.data() + 20, 40});
        ASSERT_EQ(writer.finish(), "");
        const auto scan = open_scan(folder / "out.nrrd", {}, {}).take(diagnostics);
        const auto again = read(scan);
        ASSERT_TRUE(again) << to_text(diagnostics);
        EXPECT_TRUE(on_one_grid(image, *again));
        EXPECT_EQ(image.values, again->values);
        EXPECT_EQ(test::contents_of(folder / "out.nrrd").find("# a remark\n"), 9u);
    }
}

TEST_F(ScanFile, LeavesNoHalfOfAFile) {
    VoxelImage image;
    image.size = {5, 4, 3};
    image.place({1e-3, 0, 0}, {0, 1e-3, 0}, {0, 0, 1e-3}, {});
    {
        NrrdWriter writer(folder / "out.nrrd", image, "a remark", true);
        const std::vector<float> few(20, 1.0f);
        writer.add(few);
        EXPECT_NE(writer.finish(), "");
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    NrrdWriter nowhere(folder / "no/such/folder/out.nrrd", image, "a remark", true);
    EXPECT_NE(nowhere.finish(), "");
}

}  // namespace
}  // namespace kerf::bone
