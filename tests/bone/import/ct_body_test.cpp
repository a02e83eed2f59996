// SPDX-License-Identifier: Apache-2.0
#include "bone/import/ct_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "bone/import/bone_mask.h"
#include "bone/import/fit_landmarks.h"
#include "bone/import/make_body.h"
#include "core/field/fnv1a.h"
#include "documents/read_anatomy.h"
#include "kerf/units.hpp"
#include "tests/support/temporary_folder.h"

namespace kerf::bone {
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

std::string to_string(const std::vector<std::string>& notes) {
    std::string all;
    for (const std::string& note : notes) all += note + "\n";
    return all;
}

/// One axis through the origin; the threshold is half way up the ramp.
documents::Anatomy anatomy() {
    documents::Anatomy result;
    result.file = "bone.yaml";
    result.ct.emplace().threshold = bright / 2.0;
    result.ct->intensity = documents::CtSource::Intensity::grey;  // nothing here is darker than 0
    result.tissues = {{"cortical", 1850.0, 1.0_mm, ""}, {"cancellous", 250.0, 0.0, ""}};
    result.axes = {{"axis", {-(8.0_mm), 0.0, 0.0}, {8.0_mm, 0.0, 0.0}, 0.0}};
    return result;
}

TEST(CtBody, PutsTheBorderBetweenTheVoxels) {
    text::Diagnostics diagnostics;
    const auto bone = make_ct_bone(anatomy(), ball(), nullptr).take(diagnostics);
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
    documents::Anatomy one = anatomy();
    one.ct->keep = {1};
    const VoxelImage image = image_of([](Vec3) { return bright; });
    const VoxelImage labels = image_of([](Vec3 p) { return p.x < 0.5 * spacing ? 1.0 : 2.0; });

    text::Diagnostics diagnostics;
    const auto bone = make_ct_bone(one, image, &labels).take(diagnostics);

    // Then the border lies where the labels meet: half way between voxels 0 and 1
    ASSERT_TRUE(bone) << to_text(diagnostics);
    EXPECT_NEAR(bone->distance.sample_trilinear({0.5 * spacing, 0.0, 0.0}, 1.0), 0.0, 1e-6);
    EXPECT_LT(bone->distance.sample_trilinear({0.0, 0.0, 0.0}, 1.0), 0.0);
}

TEST(CtBody, MovesTheLabelsBorderToWhereTheGreyValuesCross) {
    documents::Anatomy one = anatomy();
    one.ct->keep = {1};
    const VoxelImage labels = image_of([](Vec3 p) { return length(p) < radius - 0.7 * spacing ? 1.0 : 0.0; });

    text::Diagnostics diagnostics;
    const auto bone = make_ct_bone(one, ball(), &labels).take(diagnostics);

    ASSERT_TRUE(bone) << to_text(diagnostics);
    EXPECT_NEAR(bone->distance.sample_trilinear({radius, 0.0, 0.0}, 1.0), 0.0, 0.1 * spacing);
}

TEST(CtBody, FillsACavityOnlyWhenTold) {
    for (const bool fill : {false, true}) {
        documents::Anatomy one = anatomy();
        one.ct->fill = fill;
        text::Diagnostics diagnostics;
        const auto bone = make_ct_bone(one, hollow_ball(), nullptr).take(diagnostics);
        ASSERT_TRUE(bone) << to_text(diagnostics);
        EXPECT_EQ(bone->distance.sample_trilinear({0.0, 0.0, 0.0}, 1.0) < 0.0, fill);
    }
}

TEST(CtBody, ClosesASlitNarrowerThanTwiceItsRadius) {
    for (const double closing : {0.0_mm, 2.0_mm}) {
        documents::Anatomy one = anatomy();
        one.ct->keep = {1};
        one.ct->closing = closing;
        const VoxelImage image = image_of([](Vec3) { return bright / 2.0 - 1.0; });  // the grey values say nothing
        const VoxelImage labels =
            image_of([](Vec3 p) { return length(p) < radius && std::abs(p.x) > 0.5 * spacing ? 1.0 : 0.0; });
        text::Diagnostics diagnostics;
        const auto bone = make_ct_bone(one, image, &labels).take(diagnostics);
        ASSERT_TRUE(bone) << to_text(diagnostics);
        EXPECT_EQ(bone->distance.sample_trilinear({0.0, 0.0, 0.0}, 1.0) < 0.0, closing > 0.0);
    }
}

TEST(CtBody, TakesTheNearestLabelWhereTheLabelsHaveAnotherGrid) {
    // Given labels on half the spacing, cropped to the ball, a quarter voxel beside the image's grid
    documents::Anatomy one = anatomy();
    one.ct->keep = {7};
    VoxelImage labels;
    labels.size = {45, 45, 45};
    const double low = -22.0 * 0.5 * spacing + 0.25 * spacing, step = 0.5 * spacing;
    labels.place({step, 0, 0, low, 0, step, 0, low, 0, 0, step, low});
    for_each_voxel(labels, [&](int i, int j, int k, std::size_t) {
        const Vec3 p = labels.lps({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
        labels.values.push_back(length(p) < radius ? 7.0f : 0.0f);
    });

    text::Diagnostics diagnostics;
    const auto bone = make_ct_bone(one, ball(), &labels).take(diagnostics);

    // Then the bone is the ball all the same, and the notes say so
    ASSERT_TRUE(bone) << to_text(diagnostics);
    for (const Vec3 along : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, -1}})
        EXPECT_NEAR(bone->distance.sample_trilinear(radius * along, 1.0), 0.0, 0.1 * spacing);
    EXPECT_NE(to_string(bone->report.notes).find("another grid"), std::string::npos);
}

/// Two balls that do not touch: the larger one at the left.
VoxelImage two_balls() {
    return image_of([](Vec3 p) {
        return blurred(
            std::min(length(p - Vec3{-(5.0_mm), 0.0, 0.0}) - 6.0_mm, length(p - Vec3{9.0_mm, 0.0, 0.0}) - 4.0_mm));
    });
}

TEST(CtBody, KeepsTheLargestPieceOrTheOneAtALandmark) {
    documents::Anatomy one = anatomy();
    one.points = {{"small", {9.0_mm, 0.0, 0.0}, 2.0_mm}};
    for (const bool is_named : {false, true}) {
        one.ct->component_at = is_named ? "small" : "";
        text::Diagnostics diagnostics;
        const auto bone = make_ct_bone(one, two_balls(), nullptr).take(diagnostics);
        ASSERT_TRUE(bone) << to_text(diagnostics);
        EXPECT_EQ(bone->distance.sample_trilinear({-(5.0_mm), 0.0, 0.0}, 1.0) < 0.0, !is_named);
        EXPECT_EQ(bone->distance.sample_trilinear({9.0_mm, 0.0, 0.0}, 1.0) < 0.0, is_named);
    }
}

TEST(CtBody, VoxelsOfExactlyTheThresholdAreBone) {
    // Given two balls that a row of single voxels joins, which have the value of the threshold or just less
    const auto joined_by = [](double value) {
        const VoxelImage balls = two_balls();
        const VoxelImage image = image_of([&](Vec3 p) {
            const double ball = balls.sample_trilinear(p, 0.0);
            const bool is_between = std::abs(p.y) < 0.1_mm && std::abs(p.z) < 0.1_mm && std::abs(p.x) < 9.0_mm;
            return is_between ? std::max(ball, value) : ball;
        });
        text::Diagnostics diagnostics;
        const auto bone = make_ct_bone(anatomy(), image, nullptr).take(diagnostics);
        EXPECT_TRUE(bone) << to_text(diagnostics);
        return bone && bone->distance.sample_trilinear({9.0_mm, 0.0, 0.0}, 1.0) < 0.0;
    };
    constexpr double threshold = bright / 2.0;
    EXPECT_TRUE(joined_by(threshold));
    EXPECT_FALSE(joined_by(threshold - 1e-3)) << "the smaller ball is another piece";
}

TEST(CtBody, DoubtsValuesThatAreNoHounsfieldUnits) {
    documents::Anatomy one = anatomy();
    one.ct->intensity = documents::CtSource::Intensity::hounsfield;
    text::Diagnostics diagnostics;
    EXPECT_TRUE(make_ct_bone(one, ball(), nullptr).take(diagnostics));
    ASSERT_EQ(diagnostics.size(), 1u) << to_text(diagnostics);
    EXPECT_EQ(diagnostics[0].code, "W0675");
    EXPECT_NE(diagnostics[0].message.find("ct.intensity: grey"), std::string::npos);
}

TEST(CtBody, WarnsOfMetal) {
    // Given a rod of 27 voxels, 91 mm³, beside the axis
    documents::Anatomy one = anatomy();
    one.ct->intensity = documents::CtSource::Intensity::hounsfield;
    VoxelImage image = ball();
    for (float& value : image.values) value -= 100.0f;
    one.ct->threshold -= 100.0;
    for (int k = 11; k < 14; ++k)
        for (int j = 11; j < 14; ++j)
            for (int i = 11; i < 14; ++i) image.values[image.offset(i, j, k)] = 3071.0f;
    text::Diagnostics diagnostics;
    EXPECT_TRUE(make_ct_bone(one, image, nullptr).take(diagnostics));
    ASSERT_EQ(diagnostics.size(), 1u) << to_text(diagnostics);
    EXPECT_NE(diagnostics[0].message.find("91 mm3"), std::string::npos) << diagnostics[0].message;
}

TEST(CtBody, TellsHowFarTheEntryMovesWithTheThreshold) {
    // Given a ramp of 500 over two voxels of 1.5 mm, along x: 5 % of the threshold of 250 are 12.5, or 0.075 mm
    documents::Anatomy one = anatomy();
    one.axes = {{"axis", {-(16.0_mm), 0.0, 0.0}, {0.0, 0.0, 0.0}, 0.0}};
    text::Diagnostics diagnostics;
    const auto bone = make_ct_bone(one, ball(), nullptr, {.with_shifts = true}).take(diagnostics);
    ASSERT_TRUE(bone) << to_text(diagnostics);
    ASSERT_EQ(bone->report.shifts.size(), 1u);
    ASSERT_TRUE(bone->report.shifts[0].lower && bone->report.shifts[0].upper);
    EXPECT_NEAR(*bone->report.shifts[0].lower, -0.075_mm, 0.03_mm /* the ball's ramp is not the grid's */);
    EXPECT_NEAR(*bone->report.shifts[0].upper, 0.075_mm, 0.03_mm);
}

void expect_refused(const std::string& code, const documents::Anatomy& one, const VoxelImage& image,
                    const VoxelImage* labels) {
    text::Diagnostics diagnostics;
    EXPECT_FALSE(make_ct_bone(one, image, labels).take(diagnostics));
    ASSERT_EQ(diagnostics.size(), 1u) << to_text(diagnostics);
    EXPECT_EQ(diagnostics[0].code, code) << to_text(diagnostics);
}

TEST(CtBody, RefusesWhatCannotBeABone) {
    VoxelImage another_patient = ball();
    auto moved = another_patient.lps_from_index;
    moved[3] += 500.0_mm;
    another_patient.place(moved);
    expect_refused("E0630", anatomy(), ball(), &another_patient);

    documents::Anatomy elsewhere = anatomy();
    elsewhere.axes = {{"axis", {1.0, 1.0, 1.0}, {1.1, 1.0, 1.0}, 0.0}};
    expect_refused("E0631", elsewhere, ball(), nullptr);

    VoxelImage sheared = ball();
    auto tilted = sheared.lps_from_index;
    tilted[6] += 0.3 * spacing;
    sheared.place(tilted);
    expect_refused("E0632", anatomy(), sheared, nullptr);

    expect_refused("E0633", anatomy(), image_of([](Vec3) { return 0.0; }), nullptr);
}

/// An image as a file.
void write_image(const test::TemporaryFolder& folder, const std::string& name, const VoxelImage& image) {
    std::ofstream file(folder / name, std::ios::binary);
    file << "ObjectType = Image\nNDims = 3\nBinaryData = True\nOffset = -18 -18 -18\nElementSpacing = 1.5 1.5 1.5\n"
            "DimSize = 25 25 25\nElementType = MET_FLOAT\nElementDataFile = LOCAL\n";
    file.write(reinterpret_cast<const char*>(image.values.data()),
               static_cast<std::streamsize>(image.values.size() * sizeof(float)));
}

/// One layer of labels for the ball: 3 in it, 4 around it, with some keys.
void write_segments(const test::TemporaryFolder& folder, const std::string& keys, int layers = 1) {
    std::ofstream file(folder / "labels.seg.nrrd", std::ios::binary);
    file
        << "NRRD0005\ntype: unsigned char\nspace: left-posterior-superior\nencoding: raw\nspace origin: (-18,-18,-18)\n"
        << (layers > 1 ? "dimension: 4\nkinds: list domain domain domain\nsizes: 2 25 25 25\nspace directions: none "
                       : "dimension: 3\nsizes: 25 25 25\nspace directions: ")
        << "(1.5,0,0) (0,1.5,0) (0,0,1.5)\n"
        << keys << "\n";
    for (const float in : image_of([](Vec3 p) { return length(p) < radius ? 1.0 : 0.0; }).values) {
        if (layers > 1) file << (in > 0.0f ? '\0' : '\1');
        file << (in > 0.0f ? (layers > 1 ? '\1' : '\3') : (layers > 1 ? '\0' : '\4'));
    }
}

std::string name_and_label(int n, const std::string& name, int label) {
    const std::string key = "Segment" + std::to_string(n) + "_";
    return key + "Name:=" + name + "\n" + key + "LabelValue:=" + std::to_string(label) + "\n" + key + "Layer:=0\n";
}

TEST(CtBody, KeepsTheOneStructureThatIsMeantOrNone) {
    struct Case {
        std::string keys;
        std::vector<int> keep;
        std::vector<std::string> named;
        std::string code;  ///< empty: it is the ball
        int layers = 1;
    };
    const std::vector<Case> cases{
        {name_and_label(0, "skin", 4) + name_and_label(1, "bone", 3), {}, {"bone"}, ""},
        {name_and_label(0, "bone", 3) + name_and_label(1, "bone", 4), {}, {"bone"}, "E0636"},
        {name_and_label(0, "bone", 3) + name_and_label(1, "bone", 4), {3}, {}, ""},
        {name_and_label(0, "skin", 3) + name_and_label(1, "bone", 3), {}, {"bone"}, "E0636"},
        {name_and_label(0, "skin", 3) + name_and_label(1, "bone", 3), {3}, {}, "E0636"},
        {name_and_label(0, "skin", 4), {}, {"bone"}, "E0635"},
        {name_and_label(0, "skin", 4), {3}, {}, ""},  // a label without a name
        {"Segment0_Name:=skin\nSegment1_Name:=bone\n", {}, {"bone"}, "", 2},
        {"Segment0_Name:=skin\nSegment1_Name:=bone\n", {1}, {}, "E0636", 2},  // the label 1 is in both layers
        {"Segment0_Name:=skin\nSegment1_Name:=bone\n", {3}, {}, "E0635", 2},
    };
    for (const Case& one : cases) {
        SCOPED_TRACE(one.keys);
        const test::TemporaryFolder folder;
        write_image(folder, "ball.mha", ball());
        write_segments(folder, one.keys, one.layers);
        documents::Anatomy bone = anatomy();
        bone.file = folder / "bone.yaml";
        bone.ct->image = "ball.mha";
        bone.ct->labels = "labels.seg.nrrd";
        bone.ct->keep = one.keep;
        bone.ct->keep_named = one.named;
        text::Diagnostics diagnostics;
        const auto made = make_ct_bone(bone).take(diagnostics);
        ASSERT_EQ(made.has_value(), one.code.empty()) << to_text(diagnostics);
        if (!made) {
            EXPECT_EQ(diagnostics.back().code, one.code) << to_text(diagnostics);
            continue;
        }
        EXPECT_LT(made->distance.sample_trilinear({}, 1.0), -5.0_mm);
    }
}

TEST(CtBody, RefusesASegmentationAsTheScan) {
    const test::TemporaryFolder folder;
    write_segments(folder, name_and_label(0, "bone", 3));
    documents::Anatomy bone = anatomy();
    bone.file = folder / "bone.yaml";
    bone.ct->image = "labels.seg.nrrd";
    text::Diagnostics diagnostics;
    EXPECT_FALSE(make_ct_bone(bone).take(diagnostics));
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_EQ(diagnostics[0].code, "E0623") << to_text(diagnostics);
}

TEST(CtBody, NeverFollowsALinkOutOfTheFolder) {
    const test::TemporaryFolder folder, other;
    write_image(other, "ball.mha", ball());
    std::filesystem::create_symlink(other / "ball.mha", folder / "link.mha");
    std::filesystem::create_directory_symlink(other.path(), folder / "away");
    for (const char* name : {"link.mha", "away/ball.mha"}) {
        documents::Anatomy bone = anatomy();
        bone.file = folder / "bone.yaml";
        bone.ct->image = name;
        text::Diagnostics diagnostics;
        EXPECT_FALSE(make_ct_bone(bone).take(diagnostics));
        ASSERT_EQ(diagnostics.size(), 1u);
        EXPECT_EQ(diagnostics[0].code, "E0619") << to_text(diagnostics);
    }
}

/// The ball as a file, and a document beside it.
std::string write_ball(const test::TemporaryFolder& folder) {
    write_image(folder, "ball.mha", ball());
    return folder / "bone.yaml";
}

TEST(CtBody, BecomesABodyWithAPrescribedCortexAndTheDensityOfItsVoxels) {
    const test::TemporaryFolder folder;
    documents::Anatomy one = anatomy();
    one.file = write_ball(folder);
    one.ct->image = "ball.mha";
    one.ct->density = documents::DensityLine{.at_zero = 50.0, .per_unit = 0.5, .floor = 100.0, .source = ""};

    text::Diagnostics diagnostics;
    const auto body = make_body(one, 0.5_mm).take(diagnostics);

    ASSERT_TRUE(body) << to_text(diagnostics);
    const auto place = [&](double x) { return locate(body->grid(), {x, 0.0, 0.0}); };
    EXPECT_NEAR(body->surface.at(place(radius)), 0.0, 0.1 * spacing);
    EXPECT_NEAR(body->materials[0].border.at(place(radius - 1.0_mm)), 0.0, 0.1 * spacing);
    EXPECT_LT(body->materials[0].border.at(place(radius - 0.5_mm)), 0.0);
    EXPECT_NEAR(body->materials[1].densities.at(place(0.0), -1.0), 50.0 + 0.5 * bright, 1e-3);
    EXPECT_NEAR(body->materials[1].density, 50.0 + 0.5 * bright, 1e-3) << "the largest";
    EXPECT_TRUE(body->materials[0].densities.is_empty()) << "the cortex's is prescribed";
    const AxisInBone found = axis_in_bone(*body, {"axis", {-(15.0_mm), 0.0, 0.0}, {8.0_mm, 0.0, 0.0}, 0.0});
    EXPECT_NEAR(found.entry, 5.0_mm, 0.2_mm);
    EXPECT_EQ(found.share, 1.0);
}

TEST(CtBody, FitsLandmarksToTheBorderOfItsVoxels) {
    // Given a ball of 10 mm at the origin, and a point that is written 6 mm beside it
    const test::TemporaryFolder folder;
    documents::Anatomy one = anatomy();
    one.file = write_ball(folder);
    one.ct->image = "ball.mha";
    one.points = {{"middle", {0, 6.0_mm, 0}, 1.0_mm, {}, documents::LandmarkFit{.radius = 11.0_mm, .within = 8.0_mm}}};

    // When it becomes a bone
    text::Diagnostics diagnostics;
    const auto bone = make_ct_bone(one).take(diagnostics);

    // Then the point is the ball's centre, to a fraction of a voxel
    ASSERT_TRUE(bone) << to_text(diagnostics);
    use_fits(one, bone->report);
    EXPECT_LT(length(one.points[0].at), 0.1 * spacing);
    EXPECT_FALSE(one.points[0].fit);
    EXPECT_NE(to_string(bone->report.notes).find("Point middle: fitted"), std::string::npos);
}

/// A ball by its labels in a CT of any grey values; density [kg/m³] = value, not under 100.
std::optional<Body> labelled_ball(const VoxelImage& values, text::Diagnostics& diagnostics, double cortex = 1.0_mm) {
    const test::TemporaryFolder folder;
    write_image(folder, "values.mha", values);
    write_image(folder, "labels.mha", image_of([](Vec3 p) { return length(p) < radius ? 1.0 : 0.0; }));
    documents::Anatomy one = anatomy();
    one.file = folder / "bone.yaml";
    one.ct->image = "values.mha";
    one.ct->labels = "labels.mha";
    one.ct->keep = {1};
    one.ct->threshold = -4000.0;
    one.ct->density = documents::DensityLine{.at_zero = 0.0, .per_unit = 1.0, .floor = 100.0, .source = ""};
    one.tissues[0].thickness = cortex;
    return make_body(one, 0.5_mm).take(diagnostics);
}

/// Imports a ball of these values with this density line. Returns its densities near the middle and at the rim [kg/m³].
std::array<double, 2> densities_of(documents::DensityLine line, double middle, double rim,
                                   text::Diagnostics& diagnostics) {
    documents::Anatomy one = anatomy();
    one.ct->density = std::move(line);
    const VoxelImage image =
        image_of([&](Vec3 p) { return length(p) < radius ? length(p) < 3.0_mm ? middle : rim : 0.0; });
    const auto bone = make_ct_bone(one, image, nullptr).take(diagnostics);
    EXPECT_TRUE(bone && bone->density) << to_text(diagnostics);
    if (!bone || !bone->density) return {};
    return {bone->density->sample_trilinear({0, 0, 0}, -1.0), bone->density->sample_trilinear({6.0_mm, 0, 0}, -1.0)};
}

bool has_warning(const text::Diagnostics& diagnostics, const std::string& words) {
    return std::any_of(diagnostics.begin(), diagnostics.end(), [&](const text::Diagnostic& d) {
        return d.code == "W0675" && d.message.find(words) != std::string::npos;
    });
}

TEST(CtBody, LimitsDensityToThatOfBone) {
    text::Diagnostics diagnostics;
    const auto [middle, rim] =
        densities_of({.at_zero = 0.0, .per_unit = 1.0, .floor = 100.0, .source = ""}, 30000.0, 1000.0, diagnostics);
    EXPECT_EQ(middle, 3000.0);
    EXPECT_EQ(rim, 1000.0);
    EXPECT_TRUE(has_warning(diagnostics, "gives up to 30.00 g/cm3, expected at most 3.00 g/cm3"));
    std::size_t bright_voxels = 0;
    for (const float value : image_of([](Vec3 p) { return length(p) < 3.0_mm ? 1.0 : 0.0; }).values)
        bright_voxels += value > 0.0f;
    const double volume = static_cast<double>(bright_voxels) * spacing * spacing * spacing * 1e9;
    EXPECT_TRUE(has_warning(diagnostics, "to 3.00 g/cm3 in " + rounded(volume, 0) + " mm3")) << to_text(diagnostics);
}

TEST(CtBody, DoubtsADensityLineThatDoesNotRise) {
    text::Diagnostics falling, constant, floor, sound;
    (void)densities_of({.at_zero = 2000.0, .per_unit = -1.0, .floor = 100.0, .source = ""}, 1500.0, 1000.0, falling);
    (void)densities_of({.at_zero = 800.0, .per_unit = 0.0, .floor = 100.0, .source = ""}, 1500.0, 1000.0, constant);
    (void)densities_of({.at_zero = -3000.0, .per_unit = 1.0, .floor = 100.0, .source = ""}, 1500.0, 1000.0, floor);
    (void)densities_of({.at_zero = 0.0, .per_unit = 1.0, .floor = 100.0, .source = ""}, 1500.0, 1000.0, sound);
    EXPECT_TRUE(has_warning(falling, "falls as the value rises: got -0.001000 g/cm3"));
    EXPECT_TRUE(has_warning(constant, "got 0.80 g/cm3 everywhere, as `per_unit` is 0"));
    EXPECT_TRUE(has_warning(floor, "got 0.10 g/cm3 everywhere, the floor"));
    EXPECT_FALSE(has_warning(sound, "ensity")) << to_text(sound);
}

std::string joined(const std::vector<std::string>& notes) {
    std::string all;
    for (const std::string& note : notes) all += note + "\n";
    return all;
}

TEST(CtBody, SaysWhatItDidAndNothingOfWhereItLooked) {
    const test::TemporaryFolder folder;
    documents::Anatomy one = anatomy();
    one.file = write_ball(folder);
    one.ct->image = "ball.mha";
    one.ct->closing = 2.0_mm;
    one.ct->fill = true;
    one.ct->density = documents::DensityLine{.at_zero = 50.0, .per_unit = 0.5, .floor = 100.0, .source = "A phantom."};
    text::Diagnostics diagnostics;
    ImportReport report;
    const auto body = make_body(one, 0.5_mm, &report).take(diagnostics);
    ASSERT_TRUE(body) << to_text(diagnostics);

    const std::string notes = joined(report.notes);
    std::size_t within = 0;
    for (const float value : ball().values) within += value >= bright / 2.0;
    for (const std::string& fact :
         {"Mask: " + std::to_string(within) + " voxels of 250 and more; of 1 pieces the largest is kept",
          std::string("closing by 2.00 mm added "), std::string("filling cavities added 0"),
          std::string("values cross 250, at 100 % of it"), std::string("Tissue cortical: 1.00 mm, prescribed"),
          std::string("0.05 + 0.000500 × value g/cm3, at least 0.10 g/cm3"), std::string("to 0.30 g/cm3"),
          std::string("A phantom."), std::string("Axis axis: meets bone after 0.0 mm; 100 %")})
        EXPECT_NE(notes.find(fact), std::string::npos) << fact << "\n" << notes;
    EXPECT_EQ(notes.find("ball"), std::string::npos) << "a file's name";
    EXPECT_EQ(notes.find(folder / ""), std::string::npos) << "a path";
}

TEST(CtBody, HashesTheBytesOfItsFiles) {
    const test::TemporaryFolder folder;
    documents::Anatomy one = anatomy();
    one.file = write_ball(folder);
    one.ct->image = "ball.mha";
    const auto hashes = [&] {
        text::Diagnostics diagnostics;
        ImportReport report;
        EXPECT_TRUE(make_body(one, 1.0_mm, &report).take(diagnostics)) << to_text(diagnostics);
        return report.file_hashes;
    };
    const auto first = hashes();
    std::ifstream file(folder / "ball.mha", std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    Fnv1a whole;
    whole.add(bytes);
    ASSERT_EQ(first.size(), 1u);
    EXPECT_EQ(first[0], whole.value());

    // One voxel of the air darker, and it is another scan; with labels there are two files
    VoxelImage darker = ball();
    darker.values[0] -= 1.0f;
    write_image(folder, "ball.mha", darker);
    EXPECT_NE(hashes(), first);
    write_image(folder, "labels.mha", image_of([](Vec3 p) { return length(p) < radius ? 1.0 : 0.0; }));
    one.ct->labels = "labels.mha";
    one.ct->keep = {1};
    EXPECT_EQ(hashes().size(), 2u);
}

TEST(CtBody, GoesOnBeyondTheBoxAroundItsAxes) {
    // Given a bar that goes through the whole image, and an axis in its middle third
    const test::TemporaryFolder folder;
    write_image(folder, "bar.mha",
                image_of([](Vec3 p) { return blurred(std::max(std::abs(p.y), std::abs(p.z)) - 6.0_mm); }));
    documents::Anatomy one = anatomy();
    one.file = folder / "bone.yaml";
    one.ct->image = "bar.mha";
    one.axes = {{"axis", {-(1.0_mm), 0.0, 0.0}, {1.0_mm, 0.0, 0.0}, 0.0}};

    text::Diagnostics diagnostics;
    const auto body = make_body(one, 0.5_mm).take(diagnostics);

    // Then it is bone as far as the box goes, 15 mm, and beyond
    ASSERT_TRUE(body) << to_text(diagnostics);
    EXPECT_NEAR(body->region.high.x, 16.0_mm, 0.5_mm);
    EXPECT_NEAR(body->region.low.x, -16.0_mm, 0.5_mm);
    for (const double x : {0.0_mm, 15.9_mm, 16.1_mm, 40.0_mm, -40.0_mm}) {
        EXPECT_LT(body->surface.at(locate(*body, {x, 0.0, 0.0})), -1.5_mm) << x;
        EXPECT_GT(body->surface.at(locate(*body, {x, 9.0_mm, 0.0})), 1.5_mm) << x;
    }
    EXPECT_NEAR(outside_region(*body, {40.0_mm, 0.0, 0.0}), 24.0_mm, 0.5_mm);
}

TEST(CtBody, ReproducesALinearDensity) {
    // P7
    const auto linear = [](Vec3 p) { return 500.0 + 1e4 * p.x - 2e4 * p.y + 5e3 * p.z; };
    text::Diagnostics diagnostics;
    const auto body = labelled_ball(image_of(linear), diagnostics);
    ASSERT_TRUE(body) << to_text(diagnostics);

    // Inside by two voxels' diagonals, of the CT and of the field: there every value that is mixed in is its own
    const double inside = radius - 1.0_mm - 2.0 * std::sqrt(3.0) * spacing;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> at(-inside, inside);
    int asked = 0;
    for (int n = 0; n < 5000; ++n) {
        const Vec3 p{at(random), at(random), at(random)};
        if (length(p) > inside) continue;
        ASSERT_NEAR(body->materials[1].densities.at(locate(body->grid(), p), -1.0) / linear(p), 1.0, 1e-6);
        ++asked;
    }
    EXPECT_GT(asked, 2000);
}

TEST(CtBody, ExtendsTheDensityFromInsideItsTissue) {
    // Given a core of 400 in a rim of 3000, and air of −1000 around
    const auto step = [](Vec3 p) { return length(p) < 7.0_mm ? 400.0 : length(p) < 12.0_mm ? 3000.0 : -1000.0; };
    text::Diagnostics diagnostics;
    const auto body = labelled_ball(image_of(step), diagnostics, 6.0_mm);  // the core is well inside its cortex
    ASSERT_TRUE(body) << to_text(diagnostics);

    // Then wherever the base has a share, up to its border and over it, its density is the core's and nothing else's
    std::mt19937 random(8);
    std::uniform_real_distribution<double> at(-radius, radius);
    int at_border = 0;
    for (int n = 0; n < 20000; ++n) {
        const Vec3 p{at(random), at(random), at(random)};
        const LocatedPoint place = locate(body->grid(), p);
        double weight[KERF_MAX_TISSUES];
        material_weights(*body, place, weight);
        if (body->surface.at(place) >= 0.0 || weight[1] <= 0.0) continue;
        ASSERT_EQ(body->materials[1].densities.at(place, -1.0), 400.0) << length(p);
        at_border += weight[1] < 1.0;
    }
    EXPECT_GT(at_border, 20);
    EXPECT_EQ(body->materials[1].density, 400.0);
}

TEST(CtBody, HasNoDensityUnderTheFloor) {
    text::Diagnostics diagnostics;
    const auto body = labelled_ball(image_of([](Vec3 p) { return p.x > 0.0 ? 300.0 : -50.0; }), diagnostics);
    ASSERT_TRUE(body) << to_text(diagnostics);
    const auto density = [&](double x) {
        return body->materials[1].densities.at(locate(body->grid(), {x, 0, 0}), -1.0);
    };
    EXPECT_EQ(density(-4.0_mm), 100.0);
    EXPECT_EQ(density(4.0_mm), 300.0);
}

TEST(CtBody, RefusesAMissingImageByName) {
    documents::Anatomy one = anatomy();
    one.ct->image = "missing.nii.gz";
    text::Diagnostics diagnostics;
    EXPECT_FALSE(make_body(one, 0.5_mm).take(diagnostics));
    ASSERT_EQ(diagnostics.size(), 1u);
    EXPECT_EQ(diagnostics[0].code, "E0620");
    EXPECT_NE(diagnostics[0].place.file.find("missing.nii.gz"), std::string::npos);
}

class RealVertebra : public testing::TestWithParam<const char*> {};

TEST_P(RealVertebra, HasItsPlannedAxesInBoneAndItsCanalEmpty) {
    if (const char* data = std::getenv("KERF_DATA"); !data || !std::filesystem::exists(std::string(data) + "/volumes"))
        GTEST_SKIP() << "KERF_DATA names no folder with volumes/, so no real CT was read.";
    text::Diagnostics diagnostics;
    const auto one =
        documents::read_anatomy(std::string(KERF_SOURCE_DIR) + "/tests/real-data/" + GetParam()).take(diagnostics);
    ASSERT_TRUE(one) << to_text(diagnostics);
    const auto body = make_body(*one, 0.5_mm).take(diagnostics);
    ASSERT_TRUE(body) << to_text(diagnostics);

    for (const documents::LandmarkAxis& axis : one->axes) {
        const AxisInBone found = axis_in_bone(*body, axis);
        EXPECT_GT(found.entry, 1.0_mm) << axis.id << " begins in bone";
        EXPECT_GE(found.share, 0.95) << axis.id;
        // Room for the hole that the procedure drills: 32 mm, and 38 mm before it is too deep
        EXPECT_GT(length(axis.to - axis.from) - found.entry, 32.0_mm) << axis.id;
    }
    EXPECT_GT(body->surface.at(locate(body->grid(), one->points.at(0).at)), 1.0_mm);
}

INSTANTIATE_TEST_SUITE_P(TwoVertebrae, RealVertebra, testing::Values("l3.yaml", "t12.yaml"));

TEST(CtBody, MoreVoxelsThanMemoryMayHoldAreRefusedBeforeOneIsRead) {
    // Given a scan of 192 million voxels, all of them around the axis; a file with a hole in place of them
    const test::TemporaryFolder folder;
    const std::string header =
        "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 620 620 500\nencoding: "
        "raw\nendian: little\n"
        "space directions: (0.05,0,0) (0,0.05,0) (0,0,0.05)\nspace origin: (-15.5,-15.5,-12.5)\n\n";
    std::ofstream(folder / "scan.nrrd", std::ios::binary) << header;
    std::filesystem::resize_file(folder / "scan.nrrd", header.size() + 2ull * 620 * 620 * 500);
    documents::Anatomy large = anatomy();
    large.file = folder / "large.yaml";
    large.ct->image = "scan.nrrd";
    large.axes = {{"way", {0, 0, 12.0_mm}, {0, 0, -12.0_mm}, 1.0_mm}};

    text::Diagnostics diagnostics;
    EXPECT_FALSE(make_ct_bone(large).take(diagnostics));
    ASSERT_FALSE(diagnostics.empty());
    EXPECT_EQ(diagnostics.back().code, "E0602") << to_text(diagnostics);
    EXPECT_NE(diagnostics.back().message.find("GB of memory, must be at most 4.0 GB"), std::string::npos)
        << to_text(diagnostics);
}

}  // namespace
}  // namespace kerf::bone
