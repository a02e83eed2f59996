// SPDX-License-Identifier: Apache-2.0
#include "documents/made/mandible/teeth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "documents/made/anatomy_text.h"

namespace kerf::documents {
namespace {

/// Mean lower teeth [mm]: the crown's height, and widths of crown and neck along the row (mesiodistal) and across it.
struct Tooth {
    const char* name;
    double crown, along, along_neck, across, across_neck;
    double exponent;  ///< [–] of the crown: larger is squarer
    double lean;      ///< [–] of the crown's axis to the front
};
constexpr std::array teeth{
    Tooth{"i1", 9, 5, 3.5, 6, 5.3, 2.5, 0.12},      Tooth{"i2", 9.5, 5.5, 4, 6.5, 5.8, 2.5, 0.12},
    Tooth{"canine", 11, 7, 5.5, 7.5, 7, 2.5, 0.12}, Tooth{"premolar_1", 8.5, 7, 5, 7.5, 6.5, 2.6, 0.06},
    Tooth{"premolar_2", 8, 7, 5, 8, 7, 2.8, 0.06},  Tooth{"molar_1", 7.5, 11, 9, 10.5, 9, 3.2, 0.06},
    Tooth{"molar_2", 7, 10.5, 8, 10, 9, 3.2, 0.06}};
constexpr std::size_t first_molar = 5;
constexpr double above_crest = 1.5;  // [mm] of the border of the enamel
const char* const source = "Mean teeth (Wheeler), of the size of the first molar.";

/// Returns the crest at a distance from the midline.
CrestPoint on_crest(const std::vector<CrestPoint>& crest, double from_midline) {
    std::size_t i = 1;
    while (i + 1 < crest.size() && crest[i].from_midline < from_midline) ++i;
    const CrestPoint &a = crest[i - 1], &b = crest[i];
    const double t = (from_midline - a.from_midline) / (b.from_midline - a.from_midline);
    return {.at = a.at + t * (b.at - a.at),
            .along = normalized(a.along + t * (b.along - a.along)),
            .from_midline = from_midline};
}

double from_midline(std::size_t tooth) {
    double sum = 0.5 * teeth[tooth].along;
    for (std::size_t i = 0; i < tooth; ++i) sum += teeth[i].along;
    return sum;
}

std::string tooth_parts(const Tooth& tooth, const CrestPoint& crest, double size) {
    const Vec3 axis = normalized(Vec3{0, -tooth.lean, 1});
    const Vec3 along = normalized(Vec3{crest.along.x, crest.along.y, 0});
    const auto at = [&](double above) { return vector_text(crest.at + above * axis); };
    const auto mm = [&](double value) { return rounded_text(size * value) + " mm"; };
    const double crown = size * (tooth.crown + above_crest), top = above_crest + size * tooth.crown;
    const std::string end = "      mirror: true\n      source: " + std::string(source) + "\n";
    return std::string("    - id: ") + tooth.name + "_neck\n      elliptic_tube: {from: " + at(-2.5) +
           " mm, to: " + at(top - 0.5 * crown) + " mm, width: " + mm(tooth.across_neck) +
           ", height: " + mm(tooth.along_neck) + ", up: " + direction_text(along) + "}\n" + end +
           "    - id: " + tooth.name + "_crown\n      superellipsoid: {centre: " + at(top - 0.5 * crown) +
           " mm, length: " + rounded_text(crown) + " mm, width: " + mm(tooth.across) + ", height: " + mm(tooth.along) +
           ", exponent: " + rounded_text(tooth.exponent) + ", along: " + direction_text(axis) +
           ", up: " + direction_text(along) + "}\n" + end;
}

double size_of(double first_molar_width) { return first_molar_width / teeth[first_molar].along; }

}  // namespace

double row_of_teeth(double first_molar_width) {
    double sum = 0.0;
    for (const Tooth& tooth : teeth) sum += tooth.along;
    return sum * size_of(first_molar_width);
}

double first_molar_from_midline(double first_molar_width) {
    return from_midline(first_molar) * size_of(first_molar_width);
}

std::string teeth_parts(const std::vector<CrestPoint>& crest, double first_molar_width) {
    const double size = size_of(first_molar_width);
    std::string text;
    for (std::size_t i = 0; i < teeth.size(); ++i)
        text += tooth_parts(teeth[i], on_crest(crest, size * from_midline(i)), size);
    return text;
}

}  // namespace kerf::documents
