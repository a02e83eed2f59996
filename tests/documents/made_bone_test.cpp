// SPDX-License-Identifier: Apache-2.0
// Bones made from published dimensions: what is drawn, what is written, and what of it the bone has.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "core/plugin/number_text.h"
#include "documents/made/make_bone.h"
#include "documents/made/normal.h"
#include "documents/made/vertebra/dimensions.h"
#include "documents/read_anatomy.h"
#include "documents/solids.h"
#include "kerf/units.hpp"
#include "tests/documents/made_request.h"

namespace kerf::documents {
namespace {

using namespace literals;
using Sex = MakeRequest::Sex;

MakeRequest vertebra(const std::string& level, Sex sex = Sex::unsaid) {
    return {.kind = "vertebra", .level = level, .sex = sex};
}

struct Moments {
    double mean = 0.0, sd = 0.0;
};
Moments moments_of(const std::vector<double>& values) {
    Moments found;
    for (const double v : values) found.mean += v / static_cast<double>(values.size());
    for (const double v : values)
        found.sd += (v - found.mean) * (v - found.mean) / static_cast<double>(values.size() - 1);
    found.sd = std::sqrt(found.sd);
    return found;
}

double correlation_of(const std::vector<double>& a, const std::vector<double>& b) {
    const Moments of_a = moments_of(a), of_b = moments_of(b);
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - of_a.mean) * (b[i] - of_b.mean);
    return sum / (static_cast<double>(a.size() - 1) * of_a.sd * of_b.sd);
}

/// Draws of one level and sex.
struct Draws {
    std::map<std::string, std::vector<double>> values;
    double redrawn = 0.0;  // fraction of the first draws that were not plausible
    Population population;
};
Draws draws_of(const MakeRequest& request, std::uint32_t count) {
    Draws draws;
    draws.population = vertebra_population(request);
    int first_refused = 0;
    for (std::uint32_t seed = 0; seed < count; ++seed) {
        const DrawnBone bone = draw_bone(draws.population, with_seed(request, seed));
        EXPECT_EQ(bone.contradiction, "");
        first_refused += bone.redraws > 0;
        for (const Dimension& d : draws.population.dimensions) draws.values[d.name].push_back(bone.values[d.name]);
    }
    draws.redrawn = static_cast<double>(first_refused) / count;
    return draws;
}

TEST(NormalSource, HasUnitVarianceAndIndependentNames) {
    std::vector<double> values;
    for (std::uint32_t seed = 0; seed < 20000; ++seed) values.push_back(NormalSource(seed).at("width", 0));
    const Moments found = moments_of(values);
    EXPECT_NEAR(found.mean, 0.0, 0.03);
    EXPECT_NEAR(found.sd, 1.0, 0.02);
    const auto within = [&](double limit) {
        return static_cast<double>(
                   std::count_if(values.begin(), values.end(), [&](double v) { return std::abs(v) < limit; })) /
               20000.0;
    };
    EXPECT_NEAR(within(1.0), 0.6827, 0.01);
    EXPECT_NEAR(within(2.0), 0.9545, 0.005);
    std::vector<double> of_another;
    for (std::uint32_t seed = 0; seed < 20000; ++seed) of_another.push_back(NormalSource(seed).at("widtj", 0));
    EXPECT_NEAR(correlation_of(values, of_another), 0.0, 0.03);
}

class Drawn : public ::testing::TestWithParam<std::tuple<std::string, Sex>> {};
TEST_P(Drawn, BonesHaveTheMeansAndDeviationsOfTheirSource) {
    const auto [level, sex] = GetParam();
    const Draws draws = draws_of(vertebra(level, sex), 4000);
    EXPECT_LE(draws.redrawn, 0.18);
    for (const Dimension& d : draws.population.dimensions) {
        const Moments found = moments_of(draws.values.at(d.name));
        const bool is_cut_short =
            d.min_drawn > d.mean - 2.6 * d.sd || d.max_drawn < d.mean + 2.6 * d.sd;  // by an absolute bound
        EXPECT_NEAR(found.mean, d.mean, (is_cut_short ? 0.25 : 0.15) * d.sd) << d.name;
        EXPECT_NEAR(found.sd, d.sd, (is_cut_short ? 0.25 : 0.08) * d.sd) << d.name;
    }
}
INSTANTIATE_TEST_SUITE_P(MadeBone, Drawn,
                         ::testing::Combine(::testing::Values("T11", "L1", "L3", "L5"),
                                            ::testing::Values(Sex::female, Sex::male)));

TEST(MadeBone, LargePeopleHaveLargeBonesAtAllLevels) {
    const Draws l2 = draws_of(vertebra("L2", Sex::male), 3000), l3 = draws_of(vertebra("L3", Sex::male), 3000);
    const auto& height = l3.values.at("body.height");
    const double of_neighbours = correlation_of(height, l2.values.at("body.height"));
    EXPECT_GT(of_neighbours, 0.7) << "CTSpinoPelvic1K: 0.7 to 0.8";
    EXPECT_LT(of_neighbours, 0.8);
    EXPECT_NEAR(correlation_of(height, l3.values.at("transverse_processes.width")), 0.36, 0.06);
    EXPECT_NEAR(correlation_of(height, l3.values.at("pedicle.transverse_angle")), 0.0, 0.05);
    const auto& upper = l3.values.at("upper_end_plate.width");
    EXPECT_GT(correlation_of(upper, l3.values.at("lower_end_plate.width")), 0.68);
    EXPECT_LT(correlation_of(upper, l3.values.at("lower_end_plate.width")), 0.85);
}

TEST(MadeBone, SizesFollowTheHeightOfThePerson) {
    MakeRequest tall = vertebra("L3", Sex::male), small = tall;
    tall.stature = 1.76 + 2.0 * 0.07, small.stature = 1.76 - 2.0 * 0.07;
    const MadeBone of_tall = make_bone(tall), of_small = make_bone(small);
    const Dimension& height = dimension_of(of_tall.population, "body.height");
    // Size is 0.6 of 2 SD; the loading of heights on it is 0.6.
    EXPECT_NEAR(of_tall.drawn.values["body.height"] - height.mean, 1.048 * height.sd * 0.6 * 0.6 * 2.0, 1e-6);
    EXPECT_NEAR(of_small.drawn.values["body.height"] + of_tall.drawn.values["body.height"], 2.0 * height.mean, 1e-6);
    EXPECT_DOUBLE_EQ(of_tall.drawn.values["pedicle.transverse_angle"],
                     of_small.drawn.values["pedicle.transverse_angle"]);
}

TEST(MadeBone, CanBeReadWithEveryDensityThatCanBeSet) {
    for (const std::string bone :
         {"vertebra, level: L3", "vertebra, level: T11", "femur, level: proximal", "femur, level: distal", "mandible"})
        for (const std::string more : {"", ", osteoporosis: true"}) {
            std::optional<MakeRequest> plain;
            ASSERT_EQ(problem_with("{make: " + bone + more + "}", &plain), "");
            for (const Dimension& dimension : make_bone(*plain).population.dimensions) {
                if (std::string(dimension.unit) != "g/cm3") continue;
                for (const double density : {dimension.min_set, dimension.max_set}) {
                    const std::string text = "{make: " + bone + more + ", set: {" + dimension.name + ": " +
                                             number_text(1e-3 * density, 12) + " g/cm3}}";
                    SCOPED_TRACE(text);
                    std::optional<MakeRequest> request;
                    ASSERT_EQ(problem_with(text, &request), "");
                    text::Diagnostics found;
                    EXPECT_TRUE(read_anatomy_text("made.yaml", make_bone(*request).text).take(found));
                    EXPECT_FALSE(text::has_error(found)) << to_text(found);
                }
            }
        }
}

TEST(MadeBone, DensityFollowsAgeAndOsteoporosis) {
    const auto density = [](double age, Sex sex, bool is_osteoporotic) {
        MakeRequest request = vertebra("L3", sex);
        request.age = age, request.is_osteoporotic = is_osteoporotic;
        return make_bone(request).drawn.values["cancellous.density"];
    };
    EXPECT_NEAR(density(75, Sex::female, false), 150.0, 1e-6);
    EXPECT_NEAR(density(50, Sex::female, false), 230.0, 1e-6);
    EXPECT_NEAR(density(90, Sex::male, false), 155.0, 1e-6);
    EXPECT_NEAR(density(45, Sex::male, true), 110.0, 1e-6);
}

TEST(MadeBone, ASeedAlwaysGivesTheSameBone) {
    const MakeRequest request = with_seed(vertebra("L2"), 7);
    const MadeBone first = make_bone(request), again = make_bone(request);
    EXPECT_EQ(first.text, again.text);
    EXPECT_NE(first.text, make_bone(with_seed(request, 8)).text);
    EXPECT_NE(first.request.sex, Sex::unsaid);
    EXPECT_EQ(make_bone(with_seed(vertebra("L4"), 7)).request.sex, first.request.sex) << "one person has one sex";
}

class Made : public ::testing::TestWithParam<std::string> {};
TEST_P(Made, BoneHasItsDimensions) {
    // Drawn ones, too: a mean bone alone could be right by adjustment.
    for (const int seed : {-1, 3, 11}) {
        const MadeBone bone = make_bone(seed < 0 ? vertebra(GetParam()) : with_seed(vertebra(GetParam()), seed));
        ASSERT_EQ(bone.drawn.contradiction, "");
        EXPECT_EQ(bone.measured.size(), 14u);
        for (const MeasuredDimension& measured : bone.measured) {
            const Dimension& d = dimension_of(bone.population, measured.name);
            const bool is_angle = d.unit == "deg", is_thoracic = GetParam()[0] == 'T';
            // Pedicles at 30 degrees lead apart by 1.2 mm for each millimetre to the back.
            const bool is_between_oblique = GetParam() == "L5" && measured.name == "canal.width";
            EXPECT_NEAR(measured.value, bone.drawn.values[measured.name],
                        is_angle             ? 1.5_deg
                        : is_between_oblique ? 2.5_mm
                        : is_thoracic        ? 1.2_mm
                                             : 0.8_mm)
                << measured.name << " of person " << seed;
        }
    }
}
INSTANTIATE_TEST_SUITE_P(MadeBone, Made, ::testing::Values("T12", "L1", "L3", "L5"));

TEST(MadeBone, IsAnAnatomyWithItsLandmarksAndZones) {
    for (const std::string& level : vertebra_levels())
        for (std::uint32_t seed = 0; seed < 6; ++seed) {
            const MadeBone bone = make_bone(with_seed(vertebra(level), seed));
            const auto anatomy = read_anatomy_text(bone.name, bone.text);
            ASSERT_TRUE(anatomy) << level << " " << seed << to_text(anatomy.diagnostics());
            EXPECT_TRUE(anatomy.diagnostics().empty()) << to_text(anatomy.diagnostics());
            const auto inside = [&](Vec3 p) { return distance_to(anatomy->phantom, p) < 0.0; };
            for (const LandmarkAxis& axis : anatomy->axes) {
                EXPECT_FALSE(inside(axis.from)) << level << " " << seed;
                EXPECT_TRUE(inside(axis.to)) << level << " " << seed;
            }
            ASSERT_EQ(anatomy->axes.size(), 2u);
            ASSERT_EQ(anatomy->zones.size(), 3u);
            EXPECT_EQ(anatomy->zones[0].id, "canal");
            for (double z = -30.0_mm; z <= 30.0_mm; z += 2.0_mm)
                EXPECT_FALSE(inside({0, anatomy->points[0].at.y, z})) << "the canal is open, " << level << " " << seed;
        }
}

TEST(MadeBone, HasItsDensityOnAverageAndItsCortex) {
    for (const char* level : {"L1", "L5"}) {
        const MadeBone bone = make_bone(vertebra(level));
        const auto anatomy = read_anatomy_text(bone.name, bone.text);
        ASSERT_TRUE(anatomy) << to_text(anatomy.diagnostics());
        const Tissue &cortical = anatomy->tissues.at(0), &cancellous = anatomy->tissues.at(1);
        double sum = 0.0;
        int count = 0;
        const Solid& body = anatomy->phantom.parts.at(0).solid;
        const Box box = bounds_of(body);
        for (double x = box.low.x; x < box.high.x; x += 1.5_mm)
            for (double y = box.low.y; y < box.high.y; y += 1.5_mm)
                for (double z = box.low.z; z < box.high.z; z += 1.5_mm)
                    if (distance_to(body, {x, y, z}) < 0.0) sum += density_at(cancellous, {x, y, z}), ++count;
        EXPECT_NEAR(sum / count, bone.drawn.values["cancellous.density"], 0.03 * sum / count) << level;

        const LandmarkAxis& axis = anatomy->axes.at(0);  // the right one: lateral is at smaller x
        const Vec3 along = normalized(axis.to - axis.from), side = normalized(cross(Vec3{0, 0, 1}, along));
        const double half = 0.5 * bone.drawn.values["pedicle.width"], cortex = bone.drawn.values["pedicle.cortex"];
        const Vec3 isthmus = axis.from + 25.5_mm / -along.y * along;
        const Vec3 lateral = side.x < 0.0 ? side : -side;
        EXPECT_NEAR(thickness_at(cortical, isthmus + half * lateral), 0.6 * cortex, 0.05_mm) << level;
        EXPECT_NEAR(thickness_at(cortical, isthmus - half * lateral), 1.4 * cortex, 0.1_mm) << level;
    }
}

TEST(MadeBone, TheShippedLumbarVertebraIsTheMeanOne) {
    std::ifstream file(KERF_SOURCE_DIR "/procedures/anatomy/vertebra-l3.yaml");
    std::ostringstream shipped;
    shipped << file.rdbuf();
    EXPECT_EQ(shipped.str(), make_bone(vertebra("L3")).text)
        << "`kerf anatomy make vertebra --level L3 -o procedures/anatomy/vertebra-l3.yaml` writes it";
}

TEST(MadeBone, SetsDimensions) {
    std::optional<MakeRequest> request;
    EXPECT_EQ(problem_with("{make: vertebra, level: L3, seed: 7, sex: f, set: {pedicle.width: 6 mm}}", &request), "");
    ASSERT_TRUE(request);
    const MadeBone bone = make_bone(*request);
    EXPECT_DOUBLE_EQ(bone.drawn.values["pedicle.width"], 6.0_mm);
    MakeRequest without = *request;
    without.fixed.clear();
    EXPECT_DOUBLE_EQ(make_bone(without).drawn.values["canal.width"], bone.drawn.values["canal.width"])
        << "what is set changes nothing else, unless the bone is drawn again";
}

TEST(MadeBone, RefusesImpossibleRequests) {
    expect_parts(problem_with("{make: vertebra}"), {"has no `level:`", "`T11`", "Write `level: L3`"});
    expect_parts(problem_with("{make: femora, level: L3}"), {"femora", "vertebra"});
    expect_parts(problem_with("{make: vertebra, level: L3, seed: 1.5}"), {"1.5", "whole number"});
    expect_parts(problem_with("{make: vertebra, level: L3, seed: -1}"), {"-1", "0"});
    expect_parts(problem_with("{make: vertebra, level: L3, set: {pedicle.widht: 6 mm}}"),
                 {"pedicle.widht", "pedicle.width:"});
    expect_parts(problem_with("{make: vertebra, level: L3, set: {pedicle.width: 60 mm}}"), {"60 mm", "17.24 mm"});
    expect_parts(problem_with("{make: vertebra, level: L3, set: {pedicle.width: 6}}"), {"mm"});
    expect_parts(problem_with("{make: vertebra, level: L3, set: {pedicle.width: 17 mm, canal.width: 32 mm, "
                              "lower_end_plate.width: 44 mm}}"),
                 {"contradict", "outer wall of the pedicle", "expected at most"});
    expect_parts(problem_with("{make: vertebra, level: L3, set: {pedicle.cortex: 1.7 mm, pedicle.width: 3 mm}}"),
                 {"`pedicle.cortex` is out of range: got 1.7 mm, expected at most 1.05 mm"});
    expect_parts(problem_with("{make: vertebra, level: L3, height: 165 mm}"), {"height", "cm"});
    expect_parts(problem_with("{make: vertebra, level: L3, age: 7}"), {"age", "20"});
}

TEST(MadeBone, SuggestsOnlyLevelsOfItsKind) {
    const auto expect_advice = [](const char* request, const std::string& advice) {
        const std::string problem = problem_with(request);
        expect_parts(problem, {"E0207", "expected `T11`, ", advice});
        EXPECT_EQ(problem.find("proximal"), std::string::npos) << problem;
    };
    expect_advice("{make: vertebra, level: L9}", "Write one of these.");
    expect_advice("{make: vertebra, level: C5}", "Write one of these.");
    expect_advice("{make: vertebra, level: l4}", "Write `L4`.");
    expect_parts(problem_with("{make: femur, level: L3}"), {"expected `proximal` or `distal`. Write one of these."});
}

}  // namespace
}  // namespace kerf::documents
