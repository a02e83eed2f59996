// SPDX-License-Identifier: Apache-2.0
#include "documents/made/femur/dimensions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "documents/made/dimension_table.h"
#include "documents/made/people.h"
#include "kerf/units.hpp"

namespace kerf::documents {
namespace {

using namespace literals;

constexpr double age_of_broken = 75.0, age_of_whole = 45.0;  // [years] unless one is requested

/// Values by age [years], between which it changes linearly.
template <std::size_t N>
double at_age(double age, const std::array<std::array<double, 2>, N>& points) {
    if (age <= points.front()[0]) return points.front()[1];
    for (std::size_t i = 1; i < N; ++i)
        if (age <= points[i][0]) {
            const double weight = (age - points[i - 1][0]) / (points[i][0] - points[i - 1][0]);
            return (1.0 - weight) * points[i - 1][1] + weight * points[i][1];
        }
    return points.back()[1];
}

/// The canal in widths of the shaft [–]: 1 less the index of the cortex.
constexpr std::array<std::array<double, 2>, 4> canals{{{25, 0.40}, {45, 0.42}, {70, 0.50}, {85, 0.54}}};
constexpr double osteoporotic_canal = 0.58;
/// Thickness of the neck's cortex above and below [mm].
constexpr std::array<std::array<double, 2>, 3> upper_cortex{{{40, 2.0}, {60, 1.5}, {80, 0.7}}};
constexpr std::array<std::array<double, 2>, 3> lower_cortex{{{40, 3.7}, {60, 3.5}, {80, 3.2}}};
/// Density of cancellous bone in what it is at 67 years [–]: 194 HU, 0.39 HU less each year after 50.
constexpr std::array<std::array<double, 2>, 3> densities{{{50, 1.034}, {67, 1.0}, {85, 0.964}}};
constexpr double osteoporotic_density = 0.65;

/// Returns a figure of men or of women; the mean of both if the sex is unsaid.
struct OfSex {
    double sign;
    double operator()(double man, double woman) const { return 0.5 * (man + woman + sign * (man - woman)); }
};

void add_shaft(const MakeRequest& request, double age, const char* where, DimensionTable& table) {
    const OfSex of_sex{sign_of(request.sex)};
    const double width = of_sex(28.6, 26.3);
    table.length("shaft.width", "Width of the shaft.", width, of_sex(3.2, 2.2), 0.4, Evidence::derived,
                 "perimeter of the shaft, Northern Greece, over pi");
    Dimension& canal = table.length(
        "shaft.canal", where, (request.is_osteoporotic ? osteoporotic_canal : at_age(age, canals)) * width, 1.9, 0.15,
        Evidence::recalled, "index of the cortex 0.58, 0.50 and 0.42 in shafts of type A, B and C (Dorr 1993)", 5.0);
    canal.partner = "shaft.width", canal.shared = 0.6;
}

void add_proximal(const MakeRequest& request, DimensionTable& table) {
    const OfSex of_sex{sign_of(request.sex)};
    const double age = request.age.value_or(age_of_broken);

    table.length("head.diameter", "Diameter of the head.", of_sex(49, 44), 3.0, 0.55, Evidence::read,
                 "Germany, 100 men, 70 women");
    Dimension& angle = table.angle("neck.angle", "Angle between the axes of neck and shaft.", 125, of_sex(5, 5.5),
                                   Evidence::read, "between 122.2 deg (PMC4775021) and 129.2 deg");
    constexpr double flattest = 112.0_deg, steepest = 140.0_deg;
    angle.min_drawn = std::max(angle.min_drawn, flattest), angle.min_set = std::max(angle.min_set, flattest);
    angle.max_drawn = std::min(angle.max_drawn, steepest), angle.max_set = std::min(angle.max_set, steepest);
    Dimension& offset =
        table.length("neck.offset", "Distance from the centre of the head to the axis of the shaft.", of_sex(45, 40),
                     of_sex(6, 5.5), 0.35, Evidence::recalled, "Noble 1988: 43.0 mm; split by sex");
    offset.partner = "head.diameter", offset.shared = 0.3;
    Dimension& height =
        table.length("neck.height", "Height of the neck where it is narrowest, across its axis.", of_sex(34, 30),
                     of_sex(2.5, 2), 0.4, Evidence::recalled, "neck and head correlate by 0.5 (PMC9532221)");
    height.partner = "head.diameter", height.shared = 0.35;
    Dimension& depth =
        table.length("neck.depth", "Depth of the neck where it is narrowest, from front to back.", of_sex(27, 23.5),
                     of_sex(2.5, 2), 0.4, Evidence::recalled, "narrower from front to back than it is high");
    depth.partner = "neck.height", depth.shared = 0.4;
    Dimension& rise = table.add({.name = "greater_trochanter.rise",
                                 .help = "How far the tip of the greater trochanter lies above the centre of the head.",
                                 .dimension = dimension::length,
                                 .unit = "mm",
                                 .mean = 0.0,
                                 .sd = 6.0_mm,
                                 .evidence = Evidence::recalled,
                                 .source = "level with the centre; lower at a steep neck (Soodmand)"},
                                -HUGE_VAL, 0.01_mm);
    rise.partner = "neck.angle", rise.shared = -0.7;
    Dimension& apart =
        table.length("trochanters.distance", "From the tip of the greater to the tip of the lesser trochanter.",
                     of_sex(67.2, 59.9), of_sex(7.5, 5.3), 0.35, Evidence::read, "Northern Greece, 443 femora");
    apart.partner = "greater_trochanter.rise", apart.shared = 0.65;
    add_shaft(request, age, "Width of the marrow canal, 100 mm below the lesser trochanter.", table);
    table.length("neck.upper_cortex", "Thickness of the upper wall of the neck.", at_age(age, upper_cortex), 0.25, 0.0,
                 Evidence::recalled, "it loses three times as much as the lower wall; SD assumed", 0.3);
    table.length("neck.lower_cortex", "Thickness of the lower wall of the neck.", at_age(age, lower_cortex), 0.5, 0.0,
                 Evidence::recalled, "3.5 mm at 60 years, 3.2 mm at 80; SD assumed", 1.0);
    table.length("trochanters.cortex", "Thickness of the cortex of the trochanters.", 1.5, 0.25, 0.0,
                 Evidence::recalled, "1 to 2 mm", 0.5);
    const double density = request.is_osteoporotic ? osteoporotic_density : at_age(age, densities);
    table.density("neck.density", "Apparent density of the cancellous bone of head and neck.", 560.0 * density,
                  110.0 * density, Evidence::recalled,
                  "Morgan 2003: 0.58 g/cm3 at 67 years; -0.2 % a year; 0.65 of it with osteoporosis", 150.0);
    table.density("trochanters.density", "Apparent density of the cancellous bone of the trochanters.", 220.0 * density,
                  50.0 * density, Evidence::recalled, "Morgan 2003: 0.22 g/cm3 at 67 years", 60.0);
}

void add_distal(const MakeRequest& request, DimensionTable& table) {
    const OfSex of_sex{sign_of(request.sex)};
    const double age = request.age.value_or(age_of_whole);
    table.length("condyles.width", "Width over both condyles.", of_sex(85, 76), of_sex(4, 3.5), 0.55,
                 Evidence::computed, "between Northern Greece, 360 femora, and Bosnia");
    Dimension& medial = table.length("medial_condyle.depth", "Depth of the medial condyle, from front to back.",
                                     of_sex(61.1, 55.9), of_sex(3.4, 2.9), 0.55, Evidence::read, "Northern Greece");
    medial.partner = "condyles.width", medial.shared = 0.45;
    Dimension& lateral = table.length("lateral_condyle.depth", "Depth of the lateral condyle, from front to back.",
                                      of_sex(61.1, 55.4), of_sex(3.3, 2.1), 0.55, Evidence::read, "Northern Greece");
    lateral.partner = "medial_condyle.depth", lateral.shared = 0.65;
    table.length("notch.width", "Width of the notch between the condyles.", of_sex(22.0, 18.7), of_sex(1.8, 1.0), 0.3,
                 Evidence::read, "Northern Greece");
    table.length("notch.depth", "Depth of the notch from the ends of the condyles.", of_sex(27.8, 23.7),
                 of_sex(1.6, 1.2), 0.3, Evidence::read, "Northern Greece");
    add_shaft(request, age, "Width of the marrow canal.", table);
    table.length("condyles.cortex", "Thickness of the shell of the condyles.", 1.2, 0.2, 0.0, Evidence::assumed,
                 "thinner than the shaft's", 0.4);
    const double density = request.is_osteoporotic ? osteoporotic_density : at_age(age, densities);
    table.density("condyles.density", "Apparent density of the cancellous bone.", 340.0 * density, 80.0 * density,
                  Evidence::assumed, "between the neck and the upper end of the tibia; 0.65 of it with osteoporosis",
                  100.0);
}

/// Returns the message for a dimension outside its bounds; empty if it lies within.
std::string outside(const char* name, double value, double min, double max, const char* at) {
    if (value >= min && value <= max) return {};
    return std::string("`") + name + "` is out of range: got " + dimension_text(value, "mm") + ", expected " +
           dimension_text(min, "mm") + " to " + dimension_text(max, "mm") + " at this " + at;
}

std::string contradiction_of_canal(const DimensionValues& v, bool is_osteoporotic) {
    const double width = v["shaft.width"];
    return outside("shaft.canal", v["shaft.canal"], 0.25 * width, (is_osteoporotic ? 0.70 : 0.62) * width,
                   "`shaft.width`");
}

std::string contradiction_of_proximal(const DimensionValues& v, bool is_osteoporotic) {
    const double head = v["head.diameter"], width = v["shaft.width"];
    if (std::string s = outside("neck.height", v["neck.height"], 0.56 * head, 0.82 * head, "`head.diameter`");
        !s.empty())
        return s;
    if (std::string s =
            outside("neck.depth", v["neck.depth"], 0.6 * v["neck.height"], 0.98 * v["neck.height"], "`neck.height`");
        !s.empty())
        return s;
    const double across = std::sin(v["neck.angle"]);
    if (std::string s = outside("neck.offset", v["neck.offset"], 0.8 * head * across, 1.5 * head * across,
                                "`head.diameter` and `neck.angle`");
        !s.empty())
        return s;
    const double rise = v["greater_trochanter.rise"], height = greater_trochanter_height(v);
    if (std::string s = outside("greater_trochanter.rise", rise, rise - height + 15.0_mm, rise - height + 50.0_mm,
                                "`neck.offset` and `neck.angle`");
        !s.empty())
        return s;
    const double distance = v["trochanters.distance"];
    const double across_tips = width * std::hypot(greater_tip.x - lesser_tip.x, greater_tip.y - lesser_tip.y);
    if (std::string s = outside("trochanters.distance", distance, std::hypot(height + 12.0_mm, across_tips),
                                std::hypot(height + 52.0_mm, across_tips),
                                "`greater_trochanter.rise`, `neck.offset` and `neck.angle`");
        !s.empty())
        return s;
    return contradiction_of_canal(v, is_osteoporotic);
}

std::string contradiction_of_distal(const DimensionValues& v, bool is_osteoporotic) {
    const double width = v["condyles.width"], medial = v["medial_condyle.depth"];
    if (std::string s = outside("medial_condyle.depth", medial, 0.62 * width, 0.84 * width, "`condyles.width`");
        !s.empty())
        return s;
    if (std::string s = outside("lateral_condyle.depth", v["lateral_condyle.depth"], 0.9 * medial, 1.1 * medial,
                                "`medial_condyle.depth`");
        !s.empty())
        return s;
    if (std::string s = outside("notch.width", v["notch.width"], 0.18 * width, 0.31 * width, "`condyles.width`");
        !s.empty())
        return s;
    if (std::string s =
            outside("notch.depth", v["notch.depth"], 0.34 * medial, 0.55 * medial, "`medial_condyle.depth`");
        !s.empty())
        return s;
    if (std::string s = outside("shaft.width", v["shaft.width"], 0.25 * width, 0.43 * width, "`condyles.width`");
        !s.empty())
        return s;
    return contradiction_of_canal(v, is_osteoporotic);
}

}  // namespace

double neck_length(const DimensionValues& v) { return v["neck.offset"] / std::sin(v["neck.angle"]); }

double greater_trochanter_height(const DimensionValues& v) {
    return v["greater_trochanter.rise"] - v["neck.offset"] / std::tan(v["neck.angle"]);
}

double lesser_trochanter_height(const DimensionValues& v) {
    const double across = v["shaft.width"] * std::hypot(greater_tip.x - lesser_tip.x, greater_tip.y - lesser_tip.y);
    const double distance = v["trochanters.distance"];
    return greater_trochanter_height(v) - std::sqrt(std::max(distance * distance - across * across, 0.0));
}

double distal_cut_width(const DimensionValues& v) {
    return 41.0_mm * std::sqrt(v["condyles.width"] / 80.0_mm * v["shaft.width"] / 26.5_mm);
}

Population femur_population(const MakeRequest& request) {
    const bool is_proximal = request.level == "proximal";
    Population population;
    DimensionTable table;
    (is_proximal ? add_proximal : add_distal)(request, table);
    population.dimensions = std::move(table.all);
    population.stature = stature_of(request.sex);
    population.find_contradiction = [is_proximal,
                                     is_osteoporotic = request.is_osteoporotic](const DimensionValues& values) {
        return (is_proximal ? contradiction_of_proximal : contradiction_of_distal)(values, is_osteoporotic);
    };
    return population;
}

}  // namespace kerf::documents
