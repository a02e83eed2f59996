// SPDX-License-Identifier: Apache-2.0
// Lower jaws made from published dimensions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "documents/made/make_bone.h"
#include "documents/made/mandible/dimensions.h"
#include "documents/made/mandible/frame.h"
#include "documents/made/mandible/teeth.h"
#include "documents/read_anatomy.h"
#include "documents/solids.h"
#include "kerf/units.hpp"
#include "tests/documents/made_request.h"

namespace kerf::documents {
namespace {

using namespace literals;
using Sex = MakeRequest::Sex;

MakeRequest mandible(Sex sex = Sex::unsaid, std::optional<std::uint32_t> seed = {}) {
    return {.kind = "mandible", .level = "", .sex = sex, .seed = seed};
}

/// The jaw of the shipped operation: that of a man, with the prominent angles of the paper.
MakeRequest shipped() {
    MakeRequest request = mandible(Sex::male);
    request.fixed = {{"gonial.angle", 115.0_deg}, {"mandibular_plane.angle", 20.0_deg}};
    return request;
}
const MadeBone& shipped_bone() {
    static const MadeBone bone = make_bone(shipped());
    return bone;
}
Anatomy anatomy_of(const MadeBone& bone) {
    auto read = read_anatomy_text(bone.name, bone.text);
    EXPECT_TRUE(read) << to_text(read.diagnostics());
    EXPECT_TRUE(read.diagnostics().empty()) << to_text(read.diagnostics());
    return std::move(*read);
}
const Anatomy& shipped_anatomy() {
    static const Anatomy anatomy = anatomy_of(shipped_bone());
    return anatomy;
}

Vec3 point_of(const Anatomy& anatomy, const std::string& id) {
    for (const LandmarkPoint& point : anatomy.points)
        if (point.id == id) return point.at;
    ADD_FAILURE() << "no point " << id;
    return {};
}
const LandmarkPlane& plane_of(const Anatomy& anatomy, const std::string& id) {
    return *std::find_if(anatomy.planes.begin(), anatomy.planes.end(),
                         [&](const LandmarkPlane& plane) { return plane.id == id; });
}

TEST(MadeMandible, HasTheMeansOfItsSources) {
    const Population men = mandible_population(mandible(Sex::male)), women = mandible_population(mandible(Sex::female));
    EXPECT_NEAR(dimension_of(men, "bigonial.width").mean, 97.0_mm, 1e-9);
    EXPECT_NEAR(dimension_of(women, "bigonial.width").mean, 90.0_mm, 1e-9);
    EXPECT_NEAR(dimension_of(men, "gonial.angle").mean, 122.0_deg, 1e-9);
    EXPECT_NEAR(dimension_of(women, "gonial.angle").mean, 125.0_deg, 1e-9);
    EXPECT_NEAR(dimension_of(men, "ramus.height").mean, 63.0_mm, 1e-9);
    EXPECT_NEAR(dimension_of(women, "body.length").mean, 80.0_mm, 1e-9);
    EXPECT_NEAR(row_of_teeth(11.0), 53.0, 1e-9) << "mm, seven teeth of Wheeler";
    EXPECT_NEAR(first_molar_from_midline(11.0), 37.0, 1e-9) << "mm, five teeth and half a molar";
}

TEST(MadeMandible, DrawsTheMeansAndDeviationsOfItsSources) {
    const Population population = mandible_population(mandible(Sex::male));
    constexpr std::uint32_t people = 400;  // the mean of so many is known to 0.05 SD
    std::vector<std::vector<double>> values(population.dimensions.size());
    int redrawn = 0;
    for (std::uint32_t seed = 0; seed < people; ++seed) {
        const DrawnBone bone = draw_bone(population, mandible(Sex::male, seed));
        ASSERT_EQ(bone.contradiction, "");
        redrawn += bone.redraws > 0;
        for (std::size_t i = 0; i < values.size(); ++i) values[i].push_back(bone.values[population.dimensions[i].name]);
    }
    EXPECT_LT(redrawn, 0.18 * people);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const Dimension& d = population.dimensions[i];
        double mean = 0.0, square = 0.0;
        for (const double v : values[i]) mean += v / people;
        for (const double v : values[i]) square += (v - mean) * (v - mean) / (people - 1);
        EXPECT_NEAR(mean, d.mean, 0.22 * d.sd) << d.name;
        EXPECT_NEAR(std::sqrt(square), d.sd, 0.14 * d.sd) << d.name;
    }
}

TEST(MadeMandible, BordersMeetAtTheGonialAngle) {
    const MandibleFrame frame(115.0_deg, 20.0_deg);
    EXPECT_NEAR(frame.rise, 85.0_deg, 1e-12) << "180 + 20 - 115";
    EXPECT_NEAR(std::acos(dot(frame.up, frame.ahead)), 115.0_deg, 1e-9);
    EXPECT_NEAR(dot(frame.up, frame.behind), 0.0, 1e-12);
    EXPECT_NEAR(dot(frame.ahead, frame.above), 0.0, 1e-12);
    const Vec3 on_border = frame.in_ramus(0, 30, 0), on_lower = frame.in_body(0, 50, 0);
    EXPECT_NEAR(on_border.y, 30.0 * std::cos(85.0_deg), 1e-9);
    EXPECT_NEAR(on_lower.z, -50.0 * std::sin(20.0_deg), 1e-9);
}

void expect_measured(const MadeBone& bone) {
    ASSERT_EQ(bone.drawn.contradiction, "");
    EXPECT_EQ(bone.measured.size(), 19u);
    for (const MeasuredDimension& measured : bone.measured) {
        const Dimension& d = dimension_of(bone.population, measured.name);
        // Fillets widen a condyle where it lies close to the ramus.
        const bool is_of_condyle = measured.name.starts_with("condyle.");
        EXPECT_NEAR(measured.value, bone.drawn.values[measured.name],
                    d.unit == "deg" ? 0.8_deg
                    : is_of_condyle ? 1.2_mm
                                    : 0.8_mm)
            << measured.name << " of " << bone.name;
    }
}
TEST(MadeMandible, BoneHasItsDimensions) { expect_measured(shipped_bone()); }
TEST(MadeMandible, DrawnBoneHasItsDimensions) {
    for (const std::uint32_t seed : {3u, 11u}) expect_measured(make_bone(mandible(Sex::unsaid, seed)));
}

TEST(MadeMandible, IsItsOwnMirrorImage) {
    const PhantomSource& bone = shipped_anatomy().phantom;
    for (double y = -80.0_mm; y < 10.0_mm; y += 9.0_mm)
        for (double z = -20.0_mm; z < 65.0_mm; z += 9.0_mm)
            for (const double x : {3.0_mm, 25.0_mm, 44.0_mm})
                EXPECT_NEAR(distance_to(bone, {x, y, z}), distance_to(bone, {-x, y, z}), 0.3_mm)
                    << "parts are joined one after the other";
}

TEST(MadeMandible, LandmarksLieOnTheBone) {
    for (const std::uint32_t seed : {1u, 5u}) {
        const Anatomy anatomy = anatomy_of(make_bone(mandible(Sex::unsaid, seed)));
        const auto depth = [&](Vec3 p) { return distance_to(anatomy.phantom, p); };
        for (const char* id : {"gonion_right", "gonion_left", "condylion_right", "condylion_left", "menton"})
            EXPECT_LT(std::abs(depth(point_of(anatomy, id))), 0.6_mm) << id << " of person " << seed;
        EXPECT_EQ(anatomy.axes.size(), 8u);
        for (const LandmarkAxis& axis : anatomy.axes) {
            EXPECT_GT(depth(axis.from), 5.0_mm) << axis.id << " begins outside, person " << seed;
            EXPECT_LT(depth(axis.to), 0.0) << axis.id << " ends in bone, person " << seed;
        }
        for (const Zone& zone : anatomy.zones)
            for (const Solid& solid : zone.solids)
                if (const auto* nerve = std::get_if<LoftSolid>(&solid))
                    for (std::size_t i = 1; i + 1 < nerve->path.size(); ++i) {
                        const double from_bone = depth(nerve->path[i].at);
                        EXPECT_GT(from_bone, 0.0) << "the canal is open, person " << seed;
                        EXPECT_LT(from_bone, 2.0_mm) << "the canal lies in bone, person " << seed;
                    }
    }
}

// The plan is geometry: 8 degrees at the lower border, 3 at the posterior one.
TEST(MadeMandible, PlansElevenDegreesMore) {
    for (const double gonial : {115.0_deg, 124.0_deg}) {
        MakeRequest request = shipped();
        request.fixed[0].value = gonial;
        const Anatomy anatomy = anatomy_of(make_bone(request));
        const Vec3 corner = point_of(anatomy, "planned_corner_right"),
                   up = normalized(point_of(anatomy, "planned_up_right") - corner),
                   front = normalized(point_of(anatomy, "planned_front_right") - corner);
        EXPECT_NEAR(std::acos(dot(up, front)), gonial + 11.0_deg, 0.02_deg);
        EXPECT_NEAR(std::atan2(-front.z, -front.y), 28.0_deg, 0.02_deg);
        const LandmarkPlane& cut = plane_of(anatomy, "right_ostectomy");
        EXPECT_NEAR(dot(cut.normal, front), 0.0, 1e-4);
        const MandibleFrame frame(gonial, 20.0_deg);
        EXPECT_NEAR(dot(cut.normal, frame.in_body(0, 56.0_mm, 0) - Vec3{0, cut.at.y, cut.at.z}), 0.0, 0.02_mm);
    }
}

TEST(MadeMandible, OsteoporosisThinsTheCortexAndNoAgeChangesDensity) {
    MakeRequest request = mandible(Sex::female), ill = request, old = request;
    ill.is_osteoporotic = true, old.age = 80;
    const auto value = [](const MakeRequest& of, const char* name) {
        return draw_bone(mandible_population(of), of).values[name];
    };
    EXPECT_NEAR(value(ill, "body.cortex"), 0.85 * 2.1_mm - 0.05_mm, 1e-6);
    EXPECT_DOUBLE_EQ(value(ill, "cancellous.density"), value(request, "cancellous.density"));
    EXPECT_DOUBLE_EQ(value(old, "cancellous.density"), value(request, "cancellous.density"));
}

TEST(MadeMandible, TheShippedJawIsOneOfAMan) {
    std::ifstream file(KERF_SOURCE_DIR "/procedures/anatomy/mandible.yaml");
    std::ostringstream text;
    text << file.rdbuf();
    EXPECT_EQ(text.str(), shipped_bone().text)
        << "`kerf anatomy make mandible --sex m --set gonial.angle=115deg --set mandibular_plane.angle=20deg -o "
           "procedures/anatomy/mandible.yaml` writes it";
}

TEST(MadeMandible, RefusesImpossibleRequests) {
    EXPECT_EQ(problem_with("{make: mandible}"), "");
    expect_parts(problem_with("{make: mandible, set: {symphysis.thickness: 19 mm, bigonial.width: 70 mm, "
                              "bicondylar.width: 92 mm}}"),
                 {"`symphysis.thickness` is out of range: got 19 mm, expected at most about 14.5 mm"});
    MakeRequest bent{.kind = "mandible", .level = ""};
    bent.seed = 58;  // whose chin is too thick for its arch at first
    EXPECT_GT(make_bone(bent).drawn.redraws, 0);
    expect_parts(problem_with("{make: mandible, level: L3}"), {"`level` does not belong to a mandible"});
    expect_parts(problem_with("{make: mandible, set: {ramus.height: 200 mm}}"), {"ramus.height", "200 mm"});
    expect_parts(problem_with("{make: mandible, set: {bigonial.width: 115 mm, bicondylar.width: 95 mm}}"),
                 {"contradict", "`bicondylar.width` is out of range: got 95 mm, expected 120 mm to 153 mm"});
    expect_parts(problem_with("{make: mandible, set: {ramus.height: 45 mm, body.length: 100 mm}}"),
                 {"`ramus.height` is out of range: got 45 mm, expected 58 mm to 92 mm at this `body.length`"});
    expect_parts(problem_with("{make: mandible, set: {canal.buccal: 9 mm, body.thickness: 10 mm}}"),
                 {"`canal.buccal` is out of range: got 9 mm, expected at most 5.2 mm"});
    expect_parts(problem_with("{make: mandible, set: {gonial.angle: 145 deg, mandibular_plane.angle: 8 deg}}"),
                 {"`gonial.angle` is out of range: got 145 deg, expected 90 deg to 124 deg"});
    expect_parts(
        problem_with("{make: mandible, set: {body.length: 64 mm, first_molar.width: 13 mm, ramus.width: 38 mm}}"),
        {"contradict"});
}

}  // namespace
}  // namespace kerf::documents
