// SPDX-License-Identifier: Apache-2.0
// Uncertainties of measures where the first derivative vanishes, against plain formulas of drawn landmarks.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <optional>
#include <ostream>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "bone/measure/evaluate.h"
#include "kerf/units.hpp"

namespace kerf::bone {
namespace {

using namespace literals;
using Kind = documents::Measure::Kind;
using Made = documents::Construction::Kind;
using Points = std::vector<Vec3>;

constexpr double half_plate = 2.0_mm, wall = 0.1_mm, contact = 0.2_mm;
/// Contacts of the borders from the left and from the right, seen along x.
constexpr double from_y = 0.0, to_y = 30.0_mm, border_z = 10.0_mm, beside = 20.0_mm;

/// A plate across z, and two straight borders along y above it.
class PlateAndBorders final : public MeasuredSurface {
public:
    [[nodiscard]] std::vector<Vec3> points_in(const Path& region) const override {
        std::vector<Vec3> points;
        for (const double x : {-beside, beside})
            for (const double y : {from_y, to_y})
                if (const Vec3 p{x, y, border_z}; distance_to(region, p) <= region.within) points.push_back(p);
        return points;
    }
    [[nodiscard]] std::vector<Stretch> stretches_on(const Line& line, double low, double high) const override {
        const double one = (half_plate - line.point.z) / line.direction.z,
                     other = (-half_plate - line.point.z) / line.direction.z, cosine = std::abs(line.direction.z);
        return {{std::max(low, std::min(one, other)), std::min(high, std::max(one, other)), cosine, cosine}};
    }
    [[nodiscard]] std::optional<double> distance_to(Vec3 p) const override { return std::abs(p.z) - half_plate; }
    [[nodiscard]] double wall_uncertainty() const noexcept override { return wall; }
    [[nodiscard]] double contact_uncertainty() const noexcept override { return contact; }

private:
    [[nodiscard]] static double distance_to(const Path& path, Vec3 p) { return bone::distance_to(path, p); }
};

// ---- plain formulas

double angle_of(Vec3 u, Vec3 v) { return std::acos(std::clamp(dot(u, v) / (length(u) * length(v)), -1.0, 1.0)); }
double acute(double angle) { return std::min(angle, pi - angle); }
double angle_to_plane(Vec3 u, Vec3 normal) { return 0.5 * pi - acute(angle_of(u, normal)); }
Vec3 normal_of(Vec3 a, Vec3 b, Vec3 c) { return normalized(cross(b - a, c - a)); }
double from_line(Vec3 p, Vec3 a, Vec3 b) { return length(cross(p - a, b - a)) / length(b - a); }
double from_plane(Vec3 p, Vec3 a, Vec3 normal) { return std::abs(dot(p - a, normal)); }
double between_lines(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    const Vec3 across = cross(b - a, d - c);
    if (length(across) < 1e-15) return from_line(c, a, b);
    return std::abs(dot(c - a, across)) / length(across);
}
Vec3 seen_along_y(Vec3 v) { return {v.x, 0.0, v.z}; }

// ---- cases

/// A measure of landmarks `p0`, `p1`, …, and a plain formula for it.
struct Fold {
    std::string name;
    double tolerance;  ///< [m] of each landmark
    Points at;
    std::vector<documents::Construction> constructions;
    documents::Measure measure;
    std::function<double(const Points&)> formula;
    std::vector<documents::Measure> operands{};  ///< of a difference
    std::size_t shifts = 0;                      ///< [–] further arguments of the formula: x of these points [m]
    double shift_uncertainty = 0.0;              ///< [m] of each
};
std::ostream& operator<<(std::ostream& out, const Fold& fold) { return out << fold.name; }

documents::Construction line(const std::string& id, std::vector<std::string> of) {
    return {.id = id, .kind = Made::line, .of = std::move(of)};
}
documents::Construction plane(const std::string& id, std::vector<std::string> of) {
    return {.id = id, .kind = Made::plane, .of = std::move(of)};
}
documents::Measure angle(const std::string& of, const std::string& to, const std::string& in = "") {
    return {.id = "m", .kind = Kind::angle, .of = of, .to = to, .in = in};
}
documents::Measure distance(const std::string& of, const std::string& to) {
    return {.id = "m", .kind = Kind::distance, .of = of, .to = to};
}

const std::vector<documents::Construction> fan{line("one", {"p0", "p1"}), line("two", {"p0", "p2"}),
                                               line("back", {"p2", "p0"})};
const std::vector<documents::Construction> pair{line("one", {"p0", "p1"}), line("two", {"p2", "p3"})};
const std::vector<documents::Construction> planes{plane("one", {"p0", "p1", "p2"}), plane("two", {"p3", "p4", "p5"}),
                                                  line("up", {"p3", "p4"})};
const std::vector<documents::Construction> mirror{
    {.id = "mid", .kind = Made::mirror, .of = {"p0", "p2"}, .right = {"p1", "p3"}},
    {.id = "nose", .kind = Made::middle, .of = {"p4", "p5"}}};
const std::vector<documents::Construction> borders{
    {.id = "left", .kind = Made::tangent, .of = {"p0", "p1"}, .in = "side", .side = "superior", .within = 5.0_mm},
    {.id = "right", .kind = Made::tangent, .of = {"p2", "p3"}, .in = "side", .side = "superior", .within = 5.0_mm}};
const std::vector<documents::Construction> skin{line("down", {"p0", "p1"}),
                                                {.id = "skin", .kind = Made::entry, .of = {"down"}}};

double of_fan(const Points& p) { return angle_of(p[1] - p[0], p[2] - p[0]); }
double of_pair(const Points& p) { return angle_of(p[1] - p[0], p[3] - p[2]); }
double of_fan_seen(const Points& p) { return angle_of(seen_along_y(p[1] - p[0]), seen_along_y(p[2] - p[0])); }
double of_planes(const Points& p) { return acute(angle_of(normal_of(p[0], p[1], p[2]), normal_of(p[3], p[4], p[5]))); }
double of_line_and_plane(const Points& p) { return angle_to_plane(p[4] - p[3], normal_of(p[0], p[1], p[2])); }
double of_points(const Points& p) { return length(p[1] - p[0]); }
double of_point_and_line(const Points& p) { return from_line(p[2], p[0], p[1]); }
double of_point_and_plane(const Points& p) { return from_plane(p[3], p[0], normal_of(p[0], p[1], p[2])); }
double of_lines(const Points& p) { return between_lines(p[0], p[1], p[2], p[3]); }
double of_nose(const Points& p) {
    const Vec3 middle = 0.25 * (p[0] + p[1] + p[2] + p[3]);
    return from_plane(0.5 * (p[4] + p[5]), middle, normalized((p[0] - p[1]) + (p[2] - p[3])));
}
double of_plate(const Points& p) { return std::abs(p[0].z) - half_plate + p[1].x; }
/// The first four points are the landmarks, which only choose the borders.
double of_borders(const Points& p) {
    return std::abs(std::atan((p[5].x - p[4].x) / (to_y - from_y)) - std::atan((p[7].x - p[6].x) / (to_y - from_y)));
}
/// The wall is known along the line.
double of_skin(const Points& p) {
    const Vec3 along = normalized(p[1] - p[0]);
    return std::abs(p[2].x * along.z);
}

/// A line along x, and one that `off` [m] turns at its end.
Points fan_of(double off) { return {{0, 0, 0}, {10.0_mm, 0, 0}, {10.0_mm, 0, off}}; }
Points pair_of(double off) { return {{0, 0, 0}, {16.0_mm, 0, 0}, {0, 5.0_mm, 0}, {16.0_mm, 5.0_mm + off, 0}}; }
Points triangle_and(std::initializer_list<Vec3> more) {
    Points all{{8.0_mm, 0, 0}, {-8.0_mm, 0, 0}, {0, 8.0_mm, 0}};
    all.insert(all.end(), more);
    return all;
}
const Points over_borders{
    {beside, 0, 9.0_mm}, {beside, 30.0_mm, 9.0_mm}, {-beside, 0, 9.0_mm}, {-beside, 30.0_mm, 9.0_mm}};
Points sides(double off) {
    return {{30.0_mm, 0, 0},        {-30.0_mm, 0, 0},           {20.0_mm, 40.0_mm, 0},
            {-20.0_mm, 40.0_mm, 0}, {5.0_mm + off, 60.0_mm, 0}, {-5.0_mm + off, 60.0_mm, 0}};
}

constexpr double u = 0.5_mm / 1.7320508075688772;  // of a coordinate that is known to 0.5 mm

std::vector<Fold> angles_at_folds() {
    return {
        {"LinesFromOnePoint", 0.1_mm, {{0, 0, 0}, {10.0_mm, 0, 0}, {5.0_mm, 0, 0}}, fan, angle("one", "two"), of_fan},
        {"LinesReversed",
         0.1_mm,
         {{0, 0, 0}, {10.0_mm, 0, 0}, {5.0_mm, 0, 0}},
         fan,
         angle("one", "back"),
         [](const Points& p) { return angle_of(p[1] - p[0], p[0] - p[2]); }},
        {"LinesSeenAlong", 0.1_mm, fan_of(0), fan, angle("one", "two", "front"), of_fan_seen},
        {"LinesSeenNearlyAlong", 0.5_mm, fan_of(0.7 * std::sqrt(2.0) * u), fan, angle("one", "two", "front"),
         of_fan_seen},
        {"LinesParallel", 0.5_mm, pair_of(0), pair, angle("one", "two"), of_pair},
        {"LinesHalfASigmaOff", 0.5_mm, pair_of(u), pair, angle("one", "two"), of_pair},
        {"LinesOneSigmaOff", 0.5_mm, pair_of(2.0 * u), pair, angle("one", "two"), of_pair},
        {"LinesTwoSigmaOff", 0.5_mm, pair_of(4.0 * u), pair, angle("one", "two"), of_pair},
        {"LineInALandmarkPlane",
         0.1_mm,
         {{0, 0, 0}, {10.0_mm, 0, 0}},
         {line("one", {"p0", "p1"})},
         angle("one", "front"),
         [](const Points& p) {
             return angle_to_plane(p[1] - p[0], {0, 1, 0});
         }},
        {"LineInAPlane", 0.5_mm, triangle_and({{0, 0, 0}, {12.0_mm, 0, 0}}), planes, angle("up", "one"),
         of_line_and_plane},
        {"LineAcrossAPlane", 0.5_mm, triangle_and({{0, 0, 0}, {0, 0, 12.0_mm}}), planes, angle("up", "one"),
         of_line_and_plane},
        {"PlanesParallel", 0.5_mm, triangle_and({{8.0_mm, 0, 5.0_mm}, {-8.0_mm, 0, 5.0_mm}, {0, 8.0_mm, 5.0_mm}}),
         planes, angle("one", "two"), of_planes},
        {"PlanesAcross", 0.5_mm, triangle_and({{8.0_mm, 0, 0}, {-8.0_mm, 0, 0}, {0, 0, 8.0_mm}}), planes,
         angle("one", "two"), of_planes},
    };
}

std::vector<Fold> distances_at_folds() {
    return {
        {"PointsCoincide", 0.5_mm, {{0, 0, 0}, {0, 0, 0}}, {}, distance("p0", "p1"), of_points},
        {"PointsOneSigmaApart", 0.5_mm, {{0, 0, 0}, {u, u, 0}}, {}, distance("p0", "p1"), of_points},
        {"PointOnALine",
         0.5_mm,
         {{0, 0, 0}, {16.0_mm, 0, 0}, {4.0_mm, 0, 0}},
         pair,
         distance("p2", "one"),
         of_point_and_line},
        {"PointNearALine",
         0.5_mm,
         {{0, 0, 0}, {16.0_mm, 0, 0}, {4.0_mm, u, 0}},
         pair,
         distance("p2", "one"),
         of_point_and_line},
        {"PointOnAPlane", 0.5_mm, triangle_and({{0, 0, 0}}), planes, distance("p3", "one"), of_point_and_plane},
        {"PointNearAPlane", 0.5_mm, triangle_and({{0, 0, 0.8 * u}}), planes, distance("p3", "one"), of_point_and_plane},
        {"PointNearerAPlane", 0.5_mm, triangle_and({{0, 0, 1.6 * u}}), planes, distance("p3", "one"),
         of_point_and_plane},
        {"LinesThatMeet",
         0.5_mm,
         {{-8.0_mm, 0, 0}, {8.0_mm, 0, 0}, {0, -8.0_mm, 0}, {0, 8.0_mm, 0}},
         pair,
         distance("one", "two"),
         of_lines},
        {"DistanceOfParallels", 0.5_mm, pair_of(0), pair, distance("one", "two"), of_lines},
        {"MiddleOnAMirror", 1.0_mm, sides(0), mirror, distance("nose", "mid"), of_nose},
        {"MiddleNearAMirror", 1.0_mm, sides(0.5_mm), mirror, distance("nose", "mid"), of_nose},
    };
}

std::vector<Fold> others_at_folds() {
    return {
        {"PointInTheMiddleOfAPlate",
         0.5_mm,
         {{0, 0, 0}},
         {},
         {.id = "m", .kind = Kind::surface_distance, .of = "p0"},
         of_plate,
         {},
         1,
         wall},
        {"PointNearTheMiddleOfAPlate",
         0.5_mm,
         {{0, 0, 0.8 * u}},
         {},
         {.id = "m", .kind = Kind::surface_distance, .of = "p0"},
         of_plate,
         {},
         1,
         wall},
        {"BordersAlike", 0.1_mm, over_borders, borders, angle("left", "right"), of_borders, {}, 4, contact},
        {"EntryInAPlane",
         0.1_mm,
         {{0, 0, 19.0_mm}, {0, 0, 9.0_mm}},
         skin,
         distance("skin", "face"),
         of_skin,
         {},
         1,
         wall},
        {"DifferenceOfAnglesAtFolds",
         0.1_mm,
         {{0, 0, 0}, {10.0_mm, 0, 0}, {5.0_mm, 0, 0}},
         fan,
         {.id = "m", .kind = Kind::difference, .of = "between", .to = "flat"},
         [](const Points& p) {
             return of_fan(p) - angle_to_plane(p[1] - p[0], {0, 1, 0});
         },
         {{.id = "between", .kind = Kind::angle, .of = "one", .to = "two"},
          {.id = "flat", .kind = Kind::angle, .of = "one", .to = "front"}}},
        {"DifferenceOfOneAtAFold",
         0.5_mm,
         triangle_and({{0, 0, 0}, {0, 0, 12.0_mm}}),
         planes,
         {.id = "m", .kind = Kind::difference, .of = "off", .to = "away"},
         [](const Points& p) {
             const Vec3 normal = normal_of(p[0], p[1], p[2]);
             return from_plane(p[3], p[0], normal) - from_plane(p[4], p[0], normal);
         },
         {{.id = "off", .kind = Kind::distance, .of = "p3", .to = "one"},
          {.id = "away", .kind = Kind::distance, .of = "p4", .to = "one"}}},
    };
}

std::vector<Fold> folds() {
    std::vector<Fold> all = angles_at_folds();
    for (const auto& more : {distances_at_folds(), others_at_folds()}) all.insert(all.end(), more.begin(), more.end());
    return all;
}

/// Measures that are far from their folds, for their uncertainty.
std::vector<Fold> smooth() {
    return {
        {"LinesAtThirtyDegrees",
         0.1_mm,
         {{0, 0, 0}, {10.0_mm, 0, 0}, {8.660_mm, 0, 5.0_mm}},
         fan,
         angle("one", "two"),
         of_fan},
        {"LinesFiveSigmaOff", 0.1_mm, pair_of(0.6_mm), pair, angle("one", "two"), of_pair},
        {"LinesSeenAtThirtyDegrees",
         0.1_mm,
         {{0, 0, 0}, {10.0_mm, 0, 0}, {8.660_mm, 0, 5.0_mm}},
         fan,
         angle("one", "two", "front"),
         of_fan_seen},
        {"LineAndPlaneAtFortyDegrees", 0.1_mm, triangle_and({{0, 0, 0}, {0, 8.391_mm, 7.041_mm}}), planes,
         angle("up", "one"), of_line_and_plane},
        {"PointsApart", 0.5_mm, {{0, 0, 0}, {12.0_mm, 9.0_mm, 0}}, {}, distance("p0", "p1"), of_points},
        {"PointBesideALine",
         0.5_mm,
         {{0, 0, 0}, {16.0_mm, 0, 0}, {4.0_mm, 8.0_mm, 0}},
         pair,
         distance("p2", "one"),
         of_point_and_line},
        {"PointAboveAPlane", 0.5_mm, triangle_and({{0, 0, 8.0_mm}}), planes, distance("p3", "one"), of_point_and_plane},
        {"PointUnderTheFaceOfAPlate",
         0.5_mm,
         {{0, 0, 1.8_mm}},
         {},
         {.id = "m", .kind = Kind::surface_distance, .of = "p0"},
         of_plate,
         {},
         1,
         wall},
    };
}

documents::MeasureReading read(const Fold& fold) {
    documents::Anatomy anatomy;
    for (std::size_t i = 0; i < fold.at.size(); ++i)
        anatomy.points.push_back({.id = "p" + std::to_string(i), .at = fold.at[i], .tolerance = fold.tolerance});
    anatomy.planes = {{.id = "front", .at = {0, 0, 0}, .normal = {0, 1, 0}},
                      {.id = "side", .at = {0, 0, 0}, .normal = {1, 0, 0}},
                      {.id = "face", .at = {0, 0, half_plate}, .normal = {0, 0, 1}}};
    const PlateAndBorders surface;
    return evaluate(fold.measure, {.constructions = fold.constructions,
                                   .measures = fold.operands,
                                   .anatomy = &anatomy,
                                   .world_from_body = {},
                                   .surface = &surface});
}

/// Returns the landmarks, and the further arguments of the formula, all shifted by `shift` of their numbers.
Points shifted(const Fold& fold, const std::function<double(std::size_t)>& shift) {
    Points at = fold.at;
    std::size_t next = 0;
    const double of_coordinate = fold.tolerance / std::sqrt(3.0);
    for (Vec3& p : at)
        for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) p.*axis += of_coordinate * shift(next++);
    for (std::size_t i = 0; i < fold.shifts; ++i) at.push_back({fold.shift_uncertainty * shift(next++), 0, 0});
    return at;
}
double value_of(const Fold& fold) {
    return fold.formula(shifted(fold, [](std::size_t) { return 0.0; }));
}

/// Returns the root mean square of the formula about its value, for landmarks anywhere within their tolerances.
double drawn_spread(const Fold& fold) {
    std::mt19937_64 generator(20240611);
    std::uniform_real_distribution<double> even(-std::sqrt(3.0), std::sqrt(3.0));
    constexpr int draws = 40000;
    const double value = value_of(fold);
    double squares = 0.0;
    for (int i = 0; i < draws; ++i) {
        const double change = fold.formula(shifted(fold, [&](std::size_t) { return even(generator); })) - value;
        squares += change * change;
    }
    return std::sqrt(squares / draws);
}

/// Returns the figure of the first order of the formula.
double first_order(const Fold& fold) {
    double squares = 0.0;
    for (std::size_t i = 0; i < 3 * fold.at.size() + fold.shifts; ++i) {
        const auto moved = [&](double by) {
            return fold.formula(shifted(fold, [&](std::size_t input) { return input == i ? by : 0.0; }));
        };
        const double change = 0.5 * (moved(1.0) - moved(-1.0));
        squares += change * change;
    }
    return std::sqrt(squares);
}

class Folds : public testing::TestWithParam<Fold> {};
INSTANTIATE_TEST_SUITE_P(All, Folds, testing::ValuesIn(folds()), [](const auto& one) { return one.param.name; });

TEST_P(Folds, UncertaintyIsTheSpreadOfDrawnLandmarks) {
    const documents::MeasureReading reading = read(GetParam());
    ASSERT_TRUE(reading.value) << reading.why_not;
    const double spread = drawn_spread(GetParam());
    RecordProperty("stated_over_drawn", std::to_string(reading.uncertainty / spread));
    EXPECT_NEAR(*reading.value, value_of(GetParam()), 1e-7 /* arccosine of a rounded product */);
    EXPECT_NEAR(reading.uncertainty, spread, 0.2 * spread);
}

class AwayFromFolds : public testing::TestWithParam<Fold> {};
INSTANTIATE_TEST_SUITE_P(All, AwayFromFolds, testing::ValuesIn(smooth()),
                         [](const auto& one) { return one.param.name; });

TEST_P(AwayFromFolds, UncertaintyIsOfTheFirstOrder) {
    const documents::MeasureReading reading = read(GetParam());
    ASSERT_TRUE(reading.value) << reading.why_not;
    EXPECT_NEAR(*reading.value, value_of(GetParam()), 1e-7);
    EXPECT_NEAR(reading.uncertainty, first_order(GetParam()), 1e-6 * reading.uncertainty /* rounding */);
    EXPECT_NEAR(reading.uncertainty, drawn_spread(GetParam()), 0.05 * reading.uncertainty);
}

TEST(Fold, SpreadShrinksToTheFirstOrderWithTheDistance) {
    // The first order is the same everywhere; about a fold the spread is less, at it the same again.
    const auto at = [&](double height) {
        return read({"", 0.5_mm, triangle_and({{0, 0, height}}), planes, distance("p3", "one"), of_point_and_plane})
            .uncertainty;
    };
    EXPECT_NEAR(at(8.0_mm), at(0), 0.1 * at(0));
    EXPECT_LT(at(0.8 * u), 0.9 * at(8.0_mm));
}

TEST(Fold, KnownLandmarksLeaveNoUncertainty) {
    const documents::MeasureReading reading = read({"", 0, fan_of(0), fan, angle("one", "two"), of_fan});
    ASSERT_TRUE(reading.value);
    EXPECT_EQ(*reading.value, 0.0);
    EXPECT_EQ(reading.uncertainty, 0.0);
}

TEST(Fold, GivesTheSameBitsAgain) {
    for (const Fold& fold : folds()) EXPECT_EQ(read(fold).uncertainty, read(fold).uncertainty) << fold.name;
}

}  // namespace
}  // namespace kerf::bone
