// SPDX-License-Identifier: Apache-2.0
// Measures of a made mandible, as a procedure declares them.
#include "bone/measure/evaluate.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "bone/measure/mandible.h"
#include "bone/measure/mesh_surface.h"
#include "tests/support/made_mandible.h"

namespace kerf::bone {
namespace {

using namespace literals;
using test::MadeMandible;

struct MeasuredMandible {
    MadeMandible made;
    SurfaceMesh mesh = made.mesh();
    MeshSurface surface{mesh, 0.1_mm};
    documents::Anatomy anatomy;
    std::vector<documents::Construction> constructions;
    std::vector<Pose> poses;

    MeasuredMandible() {
        anatomy.points = {{.id = "gonion", .at = made.gonion(), .tolerance = 1.0_mm},
                          {.id = "condylion", .at = made.condylion(), .tolerance = 1.0_mm},
                          {.id = "menton", .at = made.menton(), .tolerance = 1.0_mm},
                          {.id = "side", .at = made.at(made.forwards(), 35.0_mm) + Vec3{0, 0, 10.0_mm}},
                          {.id = "porion_l", .at = {60.0_mm, 5.0_mm, 100.0_mm}},
                          {.id = "porion_r", .at = {-60.0_mm, 5.0_mm, 100.0_mm}},
                          {.id = "orbitale_l", .at = {40.0_mm, -70.0_mm, 100.0_mm}}};
        anatomy.axes = {{.id = "across", .from = {0, -30.0_mm, 0}, .to = {80.0_mm, -30.0_mm, 0}, .tolerance = 0.5_mm}};
        anatomy.planes = {{.id = "level", .at = {0, 0, 60.0_mm}, .normal = {0, 0, 1}}};
        using Kind = documents::Construction::Kind;
        constructions = {
            {.id = "sagittal", .kind = Kind::mirror, .of = {"porion_l"}, .right = {"porion_r"}},
            {.id = "ramus",
             .kind = Kind::tangent,
             .of = {"gonion", "condylion"},
             .in = "sagittal",
             .side = "posterior"},
            {.id = "border", .kind = Kind::tangent, .of = {"gonion", "menton"}, .in = "sagittal", .side = "inferior"},
            {.id = "frankfort", .kind = Kind::plane, .of = {"porion_l", "porion_r", "orbitale_l"}},
            {.id = "ears", .kind = Kind::middle, .of = {"porion_l", "porion_r"}},
            {.id = "skin", .kind = Kind::entry, .of = {"across"}},
            {.id = "far",
             .kind = Kind::tangent,
             .of = {"porion_l", "orbitale_l"},
             .in = "sagittal",
             .side = "superior"},
            {.id = "spot", .kind = Kind::line, .of = {"gonion", "same"}}};
        anatomy.points.push_back({.id = "same", .at = made.gonion()});
    }
    std::vector<documents::Measure> measures;  ///< that differences are made of

    [[nodiscard]] documents::MeasureReading read(documents::Measure::Kind kind, const std::string& of,
                                                 const std::string& to = "", const std::string& in = "") const {
        return evaluate({.id = "m", .kind = kind, .of = of, .to = to, .in = in}, {.constructions = constructions,
                                                                                  .measures = measures,
                                                                                  .anatomy = &anatomy,
                                                                                  .world_from_body = poses,
                                                                                  .surface = &surface});
    }
};

TEST(Evaluate, AgreesWithTheGonialAngleOfTheLibrary) {
    const MeasuredMandible bone;
    const documents::MeasureReading reading = bone.read(documents::Measure::Kind::angle, "ramus", "border");
    const auto angle = gonial_angle(bone.surface, {.condylion = {bone.made.condylion(), 1.0_mm},
                                                   .gonion = {bone.made.gonion(), 1.0_mm},
                                                   .menton = {bone.made.menton(), 1.0_mm}});
    ASSERT_TRUE(reading.value && angle) << reading.why_not;
    EXPECT_NEAR(*reading.value, bone.made.gonial_angle, 0.2_deg);
    EXPECT_NEAR(*reading.value, angle->value, 1e-9);
    EXPECT_NEAR(reading.uncertainty, angle->uncertainty, 1e-6);
}

TEST(Evaluate, MeasuresTheMandibularPlaneInTheSagittalView) {
    const MeasuredMandible bone;
    for (const char* reference : {"frankfort", "level"}) {
        const documents::MeasureReading reading =
            bone.read(documents::Measure::Kind::angle, "border", reference, "sagittal");
        ASSERT_TRUE(reading.value) << reading.why_not;
        EXPECT_NEAR(*reading.value, bone.made.slope, 0.2_deg);
    }
}

TEST(Evaluate, MeasuresDistancesOfAllSorts) {
    const MeasuredMandible bone;
    const auto distance = [&](const char* of, const char* to) {
        const documents::MeasureReading reading = bone.read(documents::Measure::Kind::distance, of, to);
        EXPECT_TRUE(reading.value) << reading.why_not;
        return reading.value.value_or(-1.0);
    };
    EXPECT_NEAR(distance("gonion", "menton"), MadeMandible::body_length, 1e-12);
    EXPECT_NEAR(distance("gonion", "level"), 60.0_mm, 1e-12);
    EXPECT_NEAR(distance("level", "gonion"), 60.0_mm, 1e-12);
    EXPECT_NEAR(distance("gonion", "across"), 30.0_mm, 1e-12);
    EXPECT_NEAR(distance("ears", "sagittal"), 0.0, 1e-12);
    EXPECT_NEAR(distance("skin", "sagittal"), bone.made.middle - bone.made.half_width, 1e-9);
}

TEST(Evaluate, PropagatesTheTolerances) {
    const MeasuredMandible bone;
    const double u = 1.0_mm / std::sqrt(3.0);
    EXPECT_NEAR(bone.read(documents::Measure::Kind::distance, "gonion", "menton").uncertainty, std::sqrt(2.0) * u,
                1e-6);
    EXPECT_NEAR(bone.read(documents::Measure::Kind::distance, "gonion", "level").uncertainty, u, 1e-9);
    EXPECT_NEAR(bone.read(documents::Measure::Kind::distance, "gonion", "gonion").uncertainty, 0.0, 1e-12)
        << "a point is itself";
}

TEST(Evaluate, MeasuresThicknessAndDepth) {
    const MeasuredMandible bone;
    const documents::MeasureReading thickness = bone.read(documents::Measure::Kind::thickness, "side", "across");
    ASSERT_TRUE(thickness.value) << thickness.why_not;
    EXPECT_NEAR(*thickness.value, 2.0 * bone.made.half_width, 1e-9);
    EXPECT_NEAR(thickness.uncertainty, std::sqrt(2.0) * 0.1_mm, 1e-9);
    const documents::MeasureReading depth = bone.read(documents::Measure::Kind::surface_distance, "side");
    ASSERT_TRUE(depth.value);
    EXPECT_NEAR(*depth.value, -bone.made.half_width, 1e-9);
    EXPECT_NEAR(depth.uncertainty, 0.1_mm, 1e-9);
    const documents::MeasureReading roughness = bone.read(documents::Measure::Kind::roughness, "ramus");
    ASSERT_TRUE(roughness.value);
    EXPECT_LT(*roughness.value, 0.15_mm) << "sampled every half millimetre";
}

TEST(Evaluate, ADifferenceIsHowMuchLargerOneMeasureIs) {
    MeasuredMandible bone;
    using Kind = documents::Measure::Kind;
    bone.measures = {{.id = "angle", .kind = Kind::angle, .of = "ramus", .to = "border"},
                     {.id = "slope", .kind = Kind::angle, .of = "border", .to = "level", .in = "sagittal"}};
    const documents::MeasureReading angle = bone.read(Kind::angle, "ramus", "border"),
                                    slope = bone.read(Kind::angle, "border", "level", "sagittal"),
                                    difference = bone.read(Kind::difference, "slope", "angle"),
                                    itself = bone.read(Kind::difference, "angle", "angle");
    ASSERT_TRUE(angle.value && slope.value && difference.value && itself.value);
    EXPECT_NEAR(*difference.value, *slope.value - *angle.value, 1e-12);
    EXPECT_GT(difference.uncertainty, 0.0);
    EXPECT_EQ(*itself.value, 0.0);
    EXPECT_EQ(itself.uncertainty, 0.0) << "what is uncertain in both alike cancels";
    EXPECT_NE(bone.read(Kind::difference, "angle", "none").why_not.find("no measure `none`"), std::string::npos);
}

TEST(Evaluate, DifferencesOfDifferencesTakeNoLonger) {
    MeasuredMandible bone;
    using Kind = documents::Measure::Kind;
    bone.measures = {{.id = "d0", .kind = Kind::distance, .of = "gonion", .to = "menton"}};
    for (int i = 1; i < 60; ++i) {  // each uses the one before twice
        const std::string before = "d" + std::to_string(i - 1);
        bone.measures.push_back({.id = "d" + std::to_string(i), .kind = Kind::difference, .of = before, .to = before});
    }
    const documents::MeasureReading last = bone.read(Kind::difference, "d0", "d59");
    ASSERT_TRUE(last.value);
    EXPECT_EQ(*last.value, *bone.read(Kind::distance, "gonion", "menton").value);
}

TEST(Evaluate, NothingMovesWhenTheWholeBoneMoves) {
    MeasuredMandible bone;
    const documents::MeasureReading before = bone.read(documents::Measure::Kind::angle, "ramus", "border");
    bone.poses = {{{1, 2, 3}, quat_from_rotation_vector({0.3, -0.5, 0.7})}};
    const documents::MeasureReading after = bone.read(documents::Measure::Kind::angle, "ramus", "border");
    ASSERT_TRUE(before.value && after.value);
    EXPECT_EQ(*before.value, *after.value);
    EXPECT_EQ(before.uncertainty, after.uncertainty);
}

TEST(Evaluate, LandmarksOfAFragmentMoveWithIt) {
    MeasuredMandible bone;
    bone.anatomy.fracture =
        documents::Fracture{.at = bone.made.at(bone.made.forwards(), 40.0_mm), .normal = {0, -1, 0}};
    bone.poses = {identity_pose(), {{0, 0, 5.0_mm}, {1, 0, 0, 0}}};
    const documents::MeasureReading chin = bone.read(documents::Measure::Kind::distance, "menton", "level");
    ASSERT_TRUE(chin.value);
    EXPECT_NEAR(*chin.value, 60.0_mm - bone.made.menton().z - 5.0_mm, 1e-12);
}

TEST(Evaluate, ReportsWhyThereIsNone) {
    const MeasuredMandible bone;
    EXPECT_NE(bone.read(documents::Measure::Kind::angle, "far", "border")
                  .why_not.find("no bone lies within 15 mm of the way from "
                                "`porion_l` to `orbitale_l`"),
              std::string::npos);
    EXPECT_NE(bone.read(documents::Measure::Kind::angle, "spot", "border").why_not.find("at one spot"),
              std::string::npos);
    EXPECT_NE(bone.read(documents::Measure::Kind::thickness, "porion_r", "across").why_not.find("no bone lies"),
              std::string::npos)
        << "the ray passes above the bone";
    EXPECT_NE(bone.read(documents::Measure::Kind::angle, "nothing", "border").why_not.find("there is no `nothing`"),
              std::string::npos);
    EXPECT_NE(
        bone.read(documents::Measure::Kind::angle, "across", "border", "sagittal").why_not.find("has no direction"),
        std::string::npos);
}

}  // namespace
}  // namespace kerf::bone
