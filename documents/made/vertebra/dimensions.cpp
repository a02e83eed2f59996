// SPDX-License-Identifier: Apache-2.0
#include "documents/made/vertebra/dimensions.h"

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
using Sex = MakeRequest::Sex;

/// Means of adults of both sexes [mm, deg], and of the wedge for each sex.
struct Level {
    const char* name;
    double upper_width, upper_depth, lower_width, lower_depth, height, canal_width, canal_depth, pedicle_width,
        pedicle_height, transverse_angle, sagittal_angle, processes;
    double wedge_women, wedge_men;
    double spinous;         // from the posterior wall of the body to its tip
    double pedicle_cortex;  // mean of the medial and the lateral wall
    double pedicle_width_sd;
};
constexpr std::array levels{
    Level{"T11", 35.1, 31.9, 39.1, 31.8, 22.5, 19.6, 16.0, 8.4, 16.2, 2, 13, 53, 4.6, 5.4, 46, 0.9, 1.3},
    Level{"T12", 39.2, 32.8, 42.1, 33.4, 23.8, 22.5, 17.2, 8.0, 15.5, 0, 11, 49, 3.5, 4.9, 44, 1.0, 1.3},
    Level{"L1", 41.1, 34.1, 43.3, 35.3, 26.6, 23.7, 16.8, 7.7, 15.4, 10.9, 2.4, 72, 2.6, 4.1, 50, 1.1, 1.8},
    Level{"L2", 43.0, 34.6, 45.5, 34.9, 27.0, 23.8, 16.2, 8.0, 15.0, 12.0, 1.8, 79, 0.7, 2.6, 52, 1.1, 1.8},
    Level{"L3", 44.8, 35.2, 48.0, 34.8, 26.7, 24.3, 15.7, 9.7, 14.7, 14.4, 0.2, 88, -1.1, 1.3, 53, 1.1, 1.8},
    Level{"L4", 47.5, 35.5, 49.5, 33.9, 25.8, 25.4, 16.2, 11.9, 14.5, 17.7, 0.2, 84, -3.1, -0.7, 52, 1.4, 2.1},
    Level{"L5", 48.8, 34.7, 49.4, 33.2, 24.1, 28.0, 17.0, 15.5, 14.0, 29.8, -1.8, 93, -7.8, -4.6, 45, 1.7, 2.6},
};

const Level& level_of(const std::string& name) {
    return *std::find_if(levels.begin(), levels.end(), [&](const Level& level) { return name == level.name; });
}

/// How much larger men are than the mean of both sexes, and women smaller [–].
struct SexEffect {
    double heights = 0.035, widths = 0.06, depths = 0.05, processes = 0.065, canal = 0.03, pedicles = 0.06;
};

/// The apparent density of cancellous bone by age [years, g/cm³].
struct AtAge {
    double age, women, men;
};
constexpr std::array densities{AtAge{25, 0.29, 0.28},   AtAge{45, 0.25, 0.24},  AtAge{55, 0.21, 0.215},
                               AtAge{65, 0.175, 0.195}, AtAge{75, 0.15, 0.175}, AtAge{85, 0.13, 0.155}};
constexpr double default_age = 45.0;
constexpr double min_density = 65.0;  // [kg/m³] the middle of the body has 0.78 of it, and a tissue at least 50
constexpr double osteoporotic = 0.11, max_osteoporotic = 133.0;  // [g/cm³], [kg/m³]: a QCT of 80 mg/cm³ over 0.6

double density_at_age(double age, Sex sex) {
    const auto of = [&](const AtAge& at) {
        return sex == Sex::female ? at.women : sex == Sex::male ? at.men : 0.5 * (at.women + at.men);
    };
    if (age <= densities.front().age) return of(densities.front());
    for (std::size_t i = 1; i < densities.size(); ++i)
        if (age <= densities[i].age) {
            const double weight = (age - densities[i - 1].age) / (densities[i].age - densities[i - 1].age);
            return (1.0 - weight) * of(densities[i - 1]) + weight * of(densities[i]);
        }
    return of(densities.back());
}

std::vector<Dimension> dimensions_at(const Level& level, const MakeRequest& request) {
    const double sign = sign_of(request.sex);
    const SexEffect effect;
    const auto of_sex = [&](double mean, double part) { return mean * (1.0 + sign * part); };
    const bool is_lumbar = level.name[0] == 'L', is_lowest = std::string(level.name) == "L5";
    const double width_sd = is_lumbar ? 0.07 : 0.06;
    DimensionTable table;
    const auto size = [&](const char* name, const char* help, double mean, double part, double sd, Evidence evidence,
                          const char* source) -> Dimension& {
        const double own = of_sex(mean, part);
        return table.length(name, help, own, sd * own, 0.55, evidence, source);
    };
    size("upper_end_plate.width", "Width of the body's upper end-plate.", level.upper_width, effect.widths, width_sd,
         Evidence::read, is_lumbar ? "Bonczar 2024" : "Panjabi 1991");
    size("upper_end_plate.depth", "Depth of the body's upper end-plate, from front to back.", level.upper_depth,
         effect.depths, 0.07, Evidence::recalled, "Panjabi 1991, 1992");
    Dimension& lower_width = size("lower_end_plate.width", "Width of the body's lower end-plate.", level.lower_width,
                                  effect.widths, 0.07, Evidence::recalled, "Panjabi 1991, 1992");
    lower_width.partner = "upper_end_plate.width", lower_width.shared = 0.7;
    Dimension& lower_depth = size("lower_end_plate.depth", "Depth of the body's lower end-plate, from front to back.",
                                  level.lower_depth, effect.depths, 0.07, Evidence::recalled, "Panjabi 1991, 1992");
    lower_depth.partner = "upper_end_plate.depth", lower_depth.shared = 0.7;
    table.length("body.height", "Height of the body at its back.", of_sex(level.height, effect.heights),
                 is_lumbar ? 2.1 : 2.0, 0.6, Evidence::read,
                 is_lumbar ? "Bonczar 2024" : "Panjabi 1991, 5 % more as in the living");
    const double wedge = request.sex == Sex::female ? level.wedge_women
                         : request.sex == Sex::male ? level.wedge_men
                                                    : 0.5 * (level.wedge_women + level.wedge_men);
    table.angle("body.wedge", "Angle between the end-plates; positive: the body is lower in front.", wedge, 2.5,
                Evidence::read, "Masharawi (PMC2899959)");
    table.length("canal.width", "Width of the spinal canal, between the inner walls of the pedicles.",
                 of_sex(level.canal_width, effect.canal), is_lowest ? 3.5 : 2.3, 0.45, Evidence::read,
                 "Panjabi 1991, 1992; CTSpinoPelvic1K", is_lumbar ? 18.0 : 13.0);
    table.length("canal.depth", "Depth of the spinal canal, from front to back.", level.canal_depth,
                 is_lowest ? 2.3 : 1.7, 0.1, is_lumbar ? Evidence::computed : Evidence::recalled,
                 is_lumbar ? "mean of four series" : "Panjabi 1991", 12.0);
    table.length("pedicle.width", "Width of the pedicle where it is narrowest, outer cortex.",
                 of_sex(level.pedicle_width, effect.pedicles), level.pedicle_width_sd, 0.4, Evidence::computed,
                 is_lowest   ? "between 12 series, 16.3 mm, and CT"
                 : is_lumbar ? "mean of 12 series"
                             : "mean of Zindrick 1987, Lien and Panjabi 1991",
                 is_lowest ? 9.0 : 3.0);
    table.length("pedicle.height", "Height of the pedicle where it is narrowest.",
                 of_sex(level.pedicle_height, effect.pedicles), 1.5, 0.45, Evidence::recalled,
                 "Zindrick 1987, and series after Lien");
    table.angle("pedicle.transverse_angle", "Angle by which the pedicle leads to the midline, from back to front.",
                level.transverse_angle, is_lowest ? 5.0 : 4.0, Evidence::recalled, "Zindrick 1987");
    table.angle("pedicle.sagittal_angle", "Angle by which the pedicle leads down, from back to front.",
                level.sagittal_angle, 3.0, Evidence::recalled, "Zindrick 1987");
    const double processes = of_sex(level.processes, effect.processes);
    table.length("transverse_processes.width", "From tip to tip of the transverse processes.", processes,
                 0.08 * processes, 0.6, is_lumbar ? Evidence::computed : Evidence::recalled,
                 is_lumbar ? "between CTSpinoPelvic1K and Panjabi 1992" : "composite of two sources");
    const bool is_modelled = is_lumbar && std::string(level.name) != "L1";
    const double spinous = of_sex(level.spinous, effect.depths);
    table.length("spinous_process.length", "From the posterior wall of the body to the tip of the spinous process.",
                 spinous, 0.08 * spinous, 0.55, is_modelled ? Evidence::computed : Evidence::recalled,
                 is_modelled ? "morphable-lumbar-model; runs large" : "shorter than at L2");
    table.length("body.shell", "Thickness of the body's cortical shell.", 0.45, 0.08, 0.0, Evidence::read,
                 "Fazzalari 2006: 0.52 mm in front, 0.37 mm behind; the SD between people is assumed", 0.2);
    table.length("end_plates.thickness", "Thickness of the end-plates.", 0.5, 0.08, 0.0, Evidence::recalled,
                 "0.35 to 0.6 mm", 0.2);
    table.length("pedicle.cortex", "Thickness of the pedicle's cortex: the mean of its medial and lateral walls.",
                 level.pedicle_cortex, 0.15, 0.0, Evidence::derived, "outer less inner width, Makino; SD assumed", 0.4);
    const double density =
        request.is_osteoporotic ? osteoporotic : density_at_age(request.age.value_or(default_age), request.sex);
    Dimension& cancellous = table.density("cancellous.density", "Mean apparent density of the body's cancellous bone.",
                                          density * 1e3, request.is_osteoporotic ? 20.0 : 45.0, Evidence::recalled,
                                          "QCT by age, over 0.6; Morgan 2003", min_density);
    cancellous.is_along_spine = true;
    if (request.is_osteoporotic) cancellous.max_drawn = cancellous.max_set = max_osteoporotic;
    return std::move(table.all);
}

/// How far the pedicle's outer wall lies outside the lower end-plate [m].
double excess_of(const DimensionValues& v) {
    return 0.5 * v["canal.width"] + v["pedicle.width"] / std::cos(v["pedicle.transverse_angle"]) -
           0.5 * v["lower_end_plate.width"];
}

std::string contradiction_of(const DimensionValues& v, const DimensionValues& mean, const Level& level) {
    const bool is_lumbar = level.name[0] == 'L';
    const double max_excess = excess_of(mean) + (std::string(level.name) == "L5" ? 6.0_mm : 4.5_mm);
    if (const double excess = excess_of(v); excess > max_excess)
        return "the outer wall of the pedicle lies too far outside the lower end-plate: got " +
               dimension_text(excess, "mm") + ", expected at most " + dimension_text(max_excess, "mm") +
               ". It follows from `canal.width`, `pedicle.width`, `pedicle.transverse_angle` and "
               "`lower_end_plate.width`";
    if (const double max = (is_lumbar ? 0.70 : 0.85) * v["body.height"]; v["pedicle.height"] > max)
        return "`pedicle.height` is out of range: got " + dimension_text(v["pedicle.height"], "mm") +
               ", expected at most " + dimension_text(max, "mm") + " at this `body.height`";
    const auto ratio = [](const DimensionValues& of, const char* a, const char* b) { return of[a] / of[b]; };
    const double lower = v["upper_end_plate.width"] * ratio(mean, "lower_end_plate.width", "upper_end_plate.width");
    if (const double max = 0.12 * v["upper_end_plate.width"]; std::abs(v["lower_end_plate.width"] - lower) > max)
        return "`lower_end_plate.width` is out of range: got " + dimension_text(v["lower_end_plate.width"], "mm") +
               ", expected " + dimension_text(lower - max, "mm") + " to " + dimension_text(lower + max, "mm") +
               " at this `upper_end_plate.width`";
    const double depth = v["upper_end_plate.width"] * ratio(mean, "upper_end_plate.depth", "upper_end_plate.width");
    if (std::abs(v["upper_end_plate.depth"] - depth) > 0.2 * depth)
        return "`upper_end_plate.depth` is out of range: got " + dimension_text(v["upper_end_plate.depth"], "mm") +
               ", expected " + dimension_text(0.8 * depth, "mm") + " to " + dimension_text(1.2 * depth, "mm") +
               " at this `upper_end_plate.width`";
    if (const double front = anterior_height(v); std::abs(front - v["body.height"]) > 0.3 * v["body.height"])
        return "`body.wedge` is out of range: the front of the body is " + dimension_text(front, "mm") +
               " high, expected " + dimension_text(0.7 * v["body.height"], "mm") + " to " +
               dimension_text(1.3 * v["body.height"], "mm") + " at this `body.height`";
    if (const double min = v["upper_end_plate.width"] + (is_lumbar ? 20.0_mm : 4.0_mm);
        v["transverse_processes.width"] <= min)
        return "`transverse_processes.width` is out of range: got " +
               dimension_text(v["transverse_processes.width"], "mm") + ", expected more than " +
               dimension_text(min, "mm") + " at this `upper_end_plate.width`";
    if (const double max = 0.35 * v["pedicle.width"]; v["pedicle.cortex"] > max)
        return "`pedicle.cortex` is out of range: got " + dimension_text(v["pedicle.cortex"], "mm") +
               ", expected at most " + dimension_text(max, "mm") + " at this `pedicle.width`";
    return {};
}

}  // namespace

const std::vector<std::string>& vertebra_levels() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const Level& level : levels) all.emplace_back(level.name);
        return all;
    }();
    return names;
}

double anterior_height(const DimensionValues& v) {
    return v["body.height"] -
           0.5 * (v["upper_end_plate.depth"] + v["lower_end_plate.depth"]) * std::tan(v["body.wedge"]);
}

Population vertebra_population(const MakeRequest& request) {
    const Level& level = level_of(request.level);
    Population population;
    population.dimensions = dimensions_at(level, request);
    for (const Level& each : levels) {
        population.levels.emplace_back(each.name);
        if (&each == &level) break;
    }
    population.stature = stature_of(request.sex);
    population.find_contradiction = [&level, dimensions = population.dimensions](const DimensionValues& values) {
        DimensionValues mean;
        for (const Dimension& dimension : dimensions) mean.set(dimension.name, dimension.mean);
        return contradiction_of(values, mean, level);
    };
    return population;
}

}  // namespace kerf::documents
