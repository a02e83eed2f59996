// SPDX-License-Identifier: Apache-2.0
#include "core/import/ct_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/import/make_body.h"
#include "core/procedure/read_anatomy.h"
#include "kerf/units.hpp"
#include "tests/support/temporary_folder.h"

namespace kerf {
namespace {

using namespace literals;

constexpr double spacing = 1.5_mm;
constexpr int edge = 25;  // [voxels]; the middle one lies at the origin
constexpr double bright = 500.0;

/// A cube of voxels around the origin, filled by a function of the place.
template <class Value>
VoxelImage image_of(const Value& value) {
    VoxelImage image;
    image.size = {edge, edge, edge};
    const double low = -0.5 * (edge - 1) * spacing;
    image.place({spacing, 0, 0, low, 0, spacing, 0, low, 0, 0, spacing, low});
    for (int k = 0; k < edge; ++k)
        for (int j = 0; j < edge; ++j)
            for (int i = 0; i < edge; ++i)
                image.values.push_back(static_cast<float>(
                    value(image.lps({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)}))));
    return image;
}

/// What a scanner makes of a border at signed distance `d`: a ramp as wide as a voxel.
double blurred(double d) { return bright * std::clamp(0.5 - d / (2.0 * spacing), 0.0, 1.0); }

constexpr double radius = 10.0_mm;
VoxelImage ball() {
    return image_of([](Vec3 p) { return blurred(length(p) - radius); });
}
VoxelImage hollow_ball() {
    return image_of([](Vec3 p) { return blurred(std::max(length(p) - radius, 5.0_mm - length(p))); });
}

/// One axis through the origin; the threshold is half way up the ramp.
Anatomy anatomy() {
    Anatomy result;
    result.file = "bone.yaml";
    result.ct.emplace().threshold = bright / 2.0;
    result.tissues = {{"cortical", 1850.0, 1.0_mm, ""}, {"cancellous", 250.0, 0.0, ""}};
    result.axes = {{"axis", {-(8.0_mm), 0.0, 0.0}, {8.0_mm, 0.0, 0.0}, 0.0}};
    return result;
}

TEST(CtBody, PutsTheBorderBetweenTheVoxels) {
    Diagnostics diagnostics;
    const auto bone = make_ct_bone(anatomy(), ball(), nullptr, diagnostics);
    ASSERT_TRUE(bone) << to_text(diagnostics);

    // A hundred directions, at the border and a voxel beside it
    double worst_on = 0.0, worst_beside = 0.0;
    for (int n = 0; n < 100; ++n) {
        const double z = -0.95 + 0.019 * n, angle = 2.4 * n, across = std::sqrt(1.0 - z * z);
        const Vec3 outward{across * std::cos(angle), across * std::sin(angle), z};
        const auto distance_at = [&](double r) { return bone->distance.sample_trilinear(r * outward, 1.0); };
        worst_on = std::max(worst_on, std::abs(distance_at(radius)));
        for (const double beside : {-spacing, spacing})
            worst_beside = std::max(worst_beside, std::abs(distance_at(radius + beside) - beside));
    }
    EXPECT_LT(worst_on, 0.1 * spacing);
    EXPECT_LT(worst_beside, 0.2 * spacing /* sweeping is of first order */);
}

TEST(CtBody, KeepsOneBoneApartFromTheNextThatTouchesIt) {
    // Given a bright block whose left half has label 1 and whose right half has label 2
    Anatomy one = anatomy();
    one.ct->keep = {1};
    const VoxelImage image = image_of([](Vec3) { return bright; });
    const VoxelImage labels = image_of([](Vec3 p) { return p.x < 0.5 * spacing ? 1.0 : 2.0; });

    Diagnostics diagnostics;
    const auto bone = make_ct_bone(one, image, &labels, diagnostics);

    // Then the border lies where the labels meet: half way between voxels 0 and 1
    ASSERT_TRUE(bone) << to_text(diagnostics);
    EXPECT_NEAR(bone->distance.sample_trilinear({0.5 * spacing, 0.0, 0.0}, 1.0), 0.0, 1e-6);
    EXPECT_LT(bone->distance.sample_trilinear({0.0, 0.0, 0.0}, 1.0), 0.0);
}

TEST(CtBody, MovesTheLabelsBorderToWhereTheGreyValuesCross) {
    Anatomy one = anatomy();
    one.ct->keep = {1};
    const VoxelImage labels = image_of([](Vec3 p) { return length(p) < radius - 0.7 * spacing ? 1.0 : 0.0; });

    Diagnostics diagnostics;
    const auto bone = make_ct_bone(one, ball(), &labels, diagnostics);

    ASSERT_TRUE(bone) << to_text(diagnostics);
    EXPECT_NEAR(bone->distance.sample_trilinear({radius, 0.0, 0.0}, 1.0), 0.0, 0.1 * spacing);
}

TEST(CtBody, FillsACavityOnlyWhenTold) {
    for (const bool fill : {false, true}) {
        Anatomy one = anatomy();
        one.ct->fill = fill;
        Diagnostics diagnostics;
        const auto bone = make_ct_bone(one, hollow_ball(), nullptr, diagnostics);
        ASSERT_TRUE(bone) << to_text(diagnostics);
        EXPECT_EQ(bone->distance.sample_trilinear({0.0, 0.0, 0.0}, 1.0) < 0.0, fill);
    }
}

TEST(CtBody, ClosesASlitNarrowerThanTwiceItsRadius) {
    for (const double closing : {0.0, 2.0_mm}) {
        Anatomy one = anatomy();
        one.ct->keep = {1};
        one.ct->closing = closing;
        const VoxelImage image = image_of([](Vec3) { return bright / 2.0 - 1.0; });  // the grey values say nothing
        const VoxelImage labels =
            image_of([](Vec3 p) { return length(p) < radius && std::abs(p.x) > 0.5 * spacing ? 1.0 : 0.0; });
        Diagnostics diagnostics;
        const auto bone = make_ct_bone(one, image, &labels, diagnostics);
        ASSERT_TRUE(bone) << to_text(diagnostics);
        EXPECT_EQ(bone->distance.sample_trilinear({0.0, 0.0, 0.0}, 1.0) < 0.0, closing > 0.0);
    }
}

void expect_refused(const std::string& code, const Anatomy& one, const VoxelImage& image, const VoxelImage* labels) {
    Diagnostics diagnostics;
    EXPECT_FALSE(make_ct_bone(one, image, labels, diagnostics));
    ASSERT_EQ(diagnostics.size(), 1u) << to_text(diagnostics);
    EXPECT_EQ(diagnostics[0].code, code) << to_text(diagnostics);
}

TEST(CtBody, RefusesWhatCannotBeABone) {
    VoxelImage shifted = ball();
    auto moved = shifted.lps_from_index;
    moved[3] += 1.0_mm;
    shifted.place(moved);
    expect_refused("E0630", anatomy(), ball(), &shifted);

    Anatomy elsewhere = anatomy();
    elsewhere.axes = {{"axis", {1.0, 1.0, 1.0}, {1.1, 1.0, 1.0}, 0.0}};
    expect_refused("E0631", elsewhere, ball(), nullptr);

    VoxelImage sheared = ball();
    auto tilted = sheared.lps_from_index;
    tilted[6] += 0.3 * spacing;
    sheared.place(tilted);
    expect_refused("E0632", anatomy(), sheared, nullptr);

    expect_refused("E0633", anatomy(), image_of([](Vec3) { return 0.0; }), nullptr);
}

/// The ball as a file, and a document beside it.
std::string write_ball(const test::TemporaryFolder& folder) {
    const VoxelImage image = ball();
    std::ofstream file(folder / "ball.mha", std::ios::binary);
    file << "ObjectType = Image\nNDims = 3\nBinaryData = True\nOffset = -18 -18 -18\nElementSpacing = 1.5 1.5 1.5\n"
            "DimSize = 25 25 25\nElementType = MET_FLOAT\nElementDataFile = LOCAL\n";
    file.write(reinterpret_cast<const char*>(image.values.data()),
               static_cast<std::streamsize>(image.values.size() * sizeof(float)));
    return folder / "bone.yaml";
}

TEST(CtBody, BecomesABodyWithAPrescribedCortexAndTheDensityOfItsVoxels) {
    const test::TemporaryFolder folder;
    Anatomy one = anatomy();
    one.file = write_ball(folder);
    one.ct->image = "ball.mha";
    one.ct->density = DensityLine{.at_zero = 50.0, .per_unit = 0.5, .floor = 100.0, .source = ""};

    Diagnostics diagnostics;
    const auto body = make_body(one, 0.5_mm, diagnostics);

    ASSERT_TRUE(body) << to_text(diagnostics);
    const auto place = [&](double x) { return locate(body->grid(), {x, 0.0, 0.0}); };
    EXPECT_NEAR(body->surface.at(place(radius)), 0.0, 0.1 * spacing);
    EXPECT_NEAR(body->materials[0].border.at(place(radius - 1.0_mm)), 0.0, 0.1 * spacing);
    EXPECT_LT(body->materials[0].border.at(place(radius - 0.5_mm)), 0.0);
    EXPECT_NEAR(body->materials[1].density, 50.0 + 0.5 * bright, 0.05 * bright /* the ramp reaches inside */);
    const AxisInBone found = axis_in_bone(*body, {"axis", {-(15.0_mm), 0.0, 0.0}, {8.0_mm, 0.0, 0.0}, 0.0});
    EXPECT_NEAR(found.entry, 5.0_mm, 0.2_mm);
    EXPECT_EQ(found.share, 1.0);
}

TEST(CtBody, RefusesAMissingImageByName) {
    Anatomy one = anatomy();
    one.ct->image = "missing.nii.gz";
    Diagnostics diagnostics;
    EXPECT_FALSE(make_body(one, 0.5_mm, diagnostics));
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_EQ(diagnostics[0].code, "E0620");
    EXPECT_NE(diagnostics[0].place.file.find("missing.nii.gz"), std::string::npos);
}

class RealVertebra : public testing::TestWithParam<const char*> {};

TEST_P(RealVertebra, HasItsPlannedAxesInBoneAndItsCanalEmpty) {
    if (const char* data = std::getenv("KERF_DATA"); !data || !std::filesystem::exists(std::string(data) + "/volumes"))
        GTEST_SKIP() << "KERF_DATA names no folder with volumes/, so no real CT was read.";
    Diagnostics diagnostics;
    const auto one = read_anatomy(std::string(KERF_SOURCE_DIR) + "/tests/real-data/" + GetParam(), diagnostics);
    ASSERT_TRUE(one) << to_text(diagnostics);
    const auto body = make_body(*one, 0.5_mm, diagnostics);
    ASSERT_TRUE(body) << to_text(diagnostics);

    for (const LandmarkAxis& axis : one->axes) {
        const AxisInBone found = axis_in_bone(*body, axis);
        EXPECT_GT(found.entry, 1.0_mm) << axis.id << " begins in bone";
        EXPECT_GE(found.share, 0.95) << axis.id;
        // Room for the hole that the procedure drills: 32 mm, and 38 mm before it is too deep
        EXPECT_GT(length(axis.to - axis.from) - found.entry, 32.0_mm) << axis.id;
    }
    EXPECT_GT(body->surface.at(locate(body->grid(), one->points.at(0).at)), 1.0_mm);
}

INSTANTIATE_TEST_SUITE_P(TwoVertebrae, RealVertebra, testing::Values("l3.yaml", "t12.yaml"));

}  // namespace
}  // namespace kerf
