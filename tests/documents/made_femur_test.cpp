// SPDX-License-Identifier: Apache-2.0
// Femora made from published dimensions: what is drawn, what is written, and what of it the bone has.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "documents/made/femur/dimensions.h"
#include "documents/made/make_bone.h"
#include "documents/read_anatomy.h"
#include "documents/solids.h"
#include "kerf/units.hpp"
#include "tests/documents/made_request.h"

namespace kerf::documents {
namespace {

using namespace literals;
using Sex = MakeRequest::Sex;

MakeRequest proximal(Sex sex = Sex::unsaid) { return {.kind = "femur", .level = "proximal", .sex = sex}; }

MakeRequest distal(Sex sex = Sex::unsaid) { return {.kind = "femur", .level = "distal", .sex = sex}; }

DimensionValues means_of(const MakeRequest& request) {
    DimensionValues means;
    for (const Dimension& d : femur_population(request).dimensions) means.set(d.name, d.mean);
    return means;
}

Anatomy anatomy_of(const MadeBone& bone) {
    text::Diagnostics diagnostics;
    auto anatomy = read_anatomy_text(bone.name, bone.text).take(diagnostics);
    EXPECT_TRUE(diagnostics.empty()) << to_text(diagnostics);
    return anatomy ? std::move(*anatomy) : Anatomy{};
}

const LandmarkAxis& axis_of(const Anatomy& anatomy, const std::string& id) {
    return *std::find_if(anatomy.axes.begin(), anatomy.axes.end(), [&](const LandmarkAxis& a) { return a.id == id; });
}

TEST(MadeFemur, MeanDimensionsGiveFiguresThatAPersonCanCheck) {
    DimensionValues v;
    v.set("neck.offset", 42.5_mm), v.set("neck.angle", 125.0_deg);
    v.set("greater_trochanter.rise", 2.0_mm);
    EXPECT_NEAR(neck_length(v), 42.5_mm / 0.81915, 1e-6);
    EXPECT_NEAR(greater_trochanter_height(v), 2.0_mm + 42.5_mm * 0.70021, 1e-6);
}

// From the top of the head along the neck to the far side of the bone: 97.8 mm in men and 87.8 mm in women (Northern
// Greece). This was not used to make the bone.
TEST(MadeFemur, IsAsLongAlongItsNeckAsInPeople) {
    for (const auto& [sex, length] : {std::pair{Sex::male, 97.8_mm}, std::pair{Sex::female, 87.8_mm}}) {
        const DimensionValues v = means_of(proximal(sex));
        const double found =
            0.5 * v["head.diameter"] + neck_length(v) + 0.5 * v["shaft.width"] / std::sin(v["neck.angle"]);
        EXPECT_NEAR(found, length, 1.5_mm);
    }
}

TEST(MadeFemur, BonesHaveTheMeansAndDeviationsOfTheirSource) {
    constexpr std::uint32_t people = 3000;
    for (const MakeRequest& request :
         {proximal(Sex::female), proximal(Sex::male), distal(Sex::female), distal(Sex::male)}) {
        const Population population = femur_population(request);
        std::map<std::string, std::vector<double>> drawn;
        int redrawn = 0;
        for (std::uint32_t seed = 0; seed < people; ++seed) {
            const DrawnBone bone = draw_bone(population, with_seed(request, seed));
            ASSERT_EQ(bone.contradiction, "");
            redrawn += bone.redraws > 0;
            for (const Dimension& d : population.dimensions) drawn[d.name].push_back(bone.values[d.name]);
        }
        EXPECT_LE(redrawn, 0.16 * people);
        for (const Dimension& d : population.dimensions) {
            double mean = 0.0, square = 0.0;
            for (const double v : drawn[d.name]) mean += v / people, square += (v - d.mean) * (v - d.mean) / people;
            EXPECT_NEAR(mean, d.mean, 0.15 * d.sd) << d.name;
            EXPECT_NEAR(std::sqrt(square), d.sd, 0.1 * d.sd) << d.name;
        }
    }
}

TEST(MadeFemur, CanalAndDensityFollowAgeAndOsteoporosis) {
    const auto with = [](const char* name, double age, bool is_osteoporotic) {
        MakeRequest request = proximal(Sex::male);
        request.age = age, request.is_osteoporotic = is_osteoporotic;
        return means_of(request)[name];
    };
    EXPECT_NEAR(with("shaft.canal", 45, false), 0.42 * 28.6_mm, 1e-9);
    EXPECT_NEAR(with("shaft.canal", 70, false), 0.50 * 28.6_mm, 1e-9);
    EXPECT_NEAR(with("shaft.canal", 70, true), 0.58 * 28.6_mm, 1e-9);
    EXPECT_NEAR(with("neck.density", 67, false), 560.0, 1e-6);
    EXPECT_NEAR(with("neck.density", 67, true), 364.0, 1e-6);
    EXPECT_NEAR(with("neck.upper_cortex", 70, false), 1.1_mm, 1e-9);
}

TEST(MadeFemur, HasItsDimensions) {
    for (const int seed : {-1, 1, 3, 11, 14}) {
        const MadeBone bone =
            make_bone(seed < 0 ? proximal() : with_seed(proximal(), static_cast<std::uint32_t>(seed)));
        ASSERT_EQ(bone.drawn.contradiction, "");
        EXPECT_EQ(bone.measured.size(), 8u);
        for (const MeasuredDimension& measured : bone.measured)
            EXPECT_NEAR(measured.value, bone.drawn.values[measured.name],
                        dimension_of(bone.population, measured.name).unit == "deg" ? 1.0_deg : 1.0_mm)
                << measured.name << " of person " << seed;
    }
}

TEST(MadeFemur, LowerEndHasItsDimensions) {
    for (const int seed : {-1, 1, 3, 5, 8}) {
        const MadeBone bone = make_bone(seed < 0 ? distal() : with_seed(distal(), static_cast<std::uint32_t>(seed)));
        ASSERT_EQ(bone.drawn.contradiction, "");
        EXPECT_EQ(bone.measured.size(), 7u);
        for (const MeasuredDimension& measured : bone.measured)
            EXPECT_NEAR(measured.value, bone.drawn.values[measured.name], 0.8_mm)
                << measured.name << " of person " << seed;
    }
}

TEST(MadeFemur, BothEndsOfAPersonHaveOneShaft) {
    MakeRequest upper = proximal(), lower = distal();
    upper.age = lower.age = 60.0;
    for (const std::uint32_t seed : {2u, 9u}) {
        const MadeBone a = make_bone(with_seed(upper, seed)), b = make_bone(with_seed(lower, seed));
        if (a.drawn.redraws != 0 || b.drawn.redraws != 0) continue;
        EXPECT_DOUBLE_EQ(a.drawn.values["shaft.width"], b.drawn.values["shaft.width"]) << seed;
        EXPECT_DOUBLE_EQ(a.drawn.values["shaft.canal"], b.drawn.values["shaft.canal"]) << seed;
    }
}

TEST(MadeFemur, LowerEndIsAnAnatomyWithItsLandmarks) {
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
        const MadeBone bone = make_bone(with_seed(distal(), seed));
        const Anatomy anatomy = anatomy_of(bone);
        ASSERT_EQ(anatomy.axes.size(), 5u) << seed;
        for (const LandmarkAxis& axis : anatomy.axes) {
            EXPECT_GT(distance_to(anatomy.phantom, axis.from), 0.0) << axis.id << " " << seed;
            EXPECT_LT(distance_to(anatomy.phantom, 0.3 * axis.from + 0.7 * axis.to), 0.0) << axis.id << " " << seed;
        }
        for (const std::size_t epicondyle : {1u, 2u})
            EXPECT_NEAR(distance_to(anatomy.phantom, anatomy.points.at(epicondyle).at), 0.0, 0.5_mm) << seed;
        // Four cuts of 14 mm cover the width of the bone.
        const double outermost = axis_of(anatomy, "cut_1").from.x, inner = axis_of(anatomy, "cut_2").from.x;
        EXPECT_LT(outermost - inner, 13.5_mm) << seed;
        EXPECT_GT(outermost + 7.0_mm, 0.5 * distal_cut_width(bone.drawn.values)) << seed;
    }
}

TEST(MadeFemur, IsAnAnatomyWithItsLandmarks) {
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
        const MadeBone bone = make_bone(with_seed(proximal(), seed));
        const Anatomy anatomy = anatomy_of(bone);
        ASSERT_EQ(anatomy.axes.size(), 5u) << seed;
        const auto inside = [&](Vec3 p) { return distance_to(anatomy.phantom, p) < 0.0; };
        for (const char* id : {"lag", "plate", "grip"}) {
            EXPECT_FALSE(inside(axis_of(anatomy, id).from)) << id << " " << seed;
            EXPECT_TRUE(inside(axis_of(anatomy, id).to)) << id << " " << seed;
        }
        EXPECT_NEAR(distance_to(anatomy.phantom, anatomy.points.at(0).at), 0.0, 0.1_mm) << "apex, " << seed;
        // The screw of the plate, at 145° to it, leads through the middle of the head.
        const LandmarkAxis& plate = axis_of(anatomy, "plate");
        const double side = 0.5 * bone.drawn.values["shaft.width"];
        const Vec3 entry{side, 0, plate.from.z + 38.97_mm}, head = anatomy.points.at(1).at;
        EXPECT_NEAR(std::atan2(head.z - entry.z, entry.x - head.x), 35.0_deg, 0.05_deg) << seed;
    }
}

TEST(MadeFemur, CanalLeavesTheCortexThatItsIndexStates) {
    const MadeBone bone = make_bone(proximal());
    const Anatomy anatomy = anatomy_of(bone);
    const auto marrow =
        std::find_if(anatomy.tissues.begin(), anatomy.tissues.end(), [](const Tissue& t) { return t.id == "marrow"; });
    ASSERT_NE(marrow, anatomy.tissues.end());
    const double z = axis_of(anatomy, "shaft").to.z - 14.0_mm;  // about 70 mm below the lesser trochanter
    double x = 0.0;
    while (distance_to(marrow->solids.at(0), {x, 0, z}) < 0.0) x += 0.01_mm;
    // Noble 1988: 8.6 mm wider 20 mm below it, and half of the rest at each further 20 mm.
    EXPECT_NEAR(2.0 * x, bone.drawn.values["shaft.canal"] + 8.6_mm * std::exp2(-2.5), 0.7_mm);
}

TEST(MadeFemur, TheShippedBrokenFemurIsTheMeanOsteoporoticOne) {
    std::ifstream file(KERF_SOURCE_DIR "/procedures/anatomy/femur-fractured.yaml");
    std::ostringstream shipped;
    shipped << file.rdbuf();
    MakeRequest request = proximal();
    request.is_osteoporotic = true;
    EXPECT_EQ(shipped.str(), make_bone(request).text)
        << "`kerf anatomy make femur --level proximal --osteoporosis -o procedures/anatomy/femur-fractured.yaml` "
           "writes it";
}

TEST(MadeFemur, TheShippedKneeIsTheMeanOne) {
    std::ifstream file(KERF_SOURCE_DIR "/procedures/anatomy/knee.yaml");
    std::ostringstream shipped;
    shipped << file.rdbuf();
    EXPECT_EQ(shipped.str(), make_bone(distal()).text)
        << "`kerf anatomy make femur --level distal -o procedures/anatomy/knee.yaml` writes it";
}

TEST(MadeFemur, RefusesImpossibleRequests) {
    EXPECT_EQ(problem_with("{make: femur, level: proximal, seed: 7, sex: m, set: {neck.angle: 120 deg}}"), "");
    expect_parts(problem_with("{make: femur}"), {"has no `level:`", "`proximal`"});
    expect_parts(problem_with("{make: femur, level: L3}"), {"L3", "`proximal`"});
    expect_parts(problem_with("{make: femur, level: proximal, set: {neck.angle: 150 deg}}"), {"150 deg", "140 deg"});
    const auto with = [](const std::string& set) {
        return problem_with("{make: femur, level: proximal, set: {" + set + "}}");
    };
    expect_parts(with("neck.height: 38.5 mm"), {"`neck.height` is out of range: got 38.5 mm", "26.04 mm to 38.13 mm"});
    expect_parts(with("neck.depth: 32 mm"), {"`neck.depth` is out of range", "`neck.height`"});
    expect_parts(with("neck.offset: 60 mm"), {"`neck.offset` is out of range", "`head.diameter` and `neck.angle`"});
    expect_parts(with("greater_trochanter.rise: 22 mm"), {"`greater_trochanter.rise` is out of range"});
    expect_parts(with("trochanters.distance: 45 mm"), {"`trochanters.distance` is out of range"});
    expect_parts(problem_with("{make: femur, level: distal, set: {medial_condyle.depth: 48 mm}}"),
                 {"`medial_condyle.depth` is out of range: got 48 mm", "at this `condyles.width`"});
    expect_parts(problem_with("{make: femur, level: distal, set: {notch.width: 26 mm}}"),
                 {"`notch.width` is out of range"});
    expect_parts(with("shaft.canal: 18 mm"),
                 {"`shaft.canal` is out of range: got 18 mm", "to 17.02 mm at this `shaft.width`"});
}

}  // namespace
}  // namespace kerf::documents
