// SPDX-License-Identifier: Apache-2.0
#include "documents/made/mandible/dimensions.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "documents/made/anatomy_text.h"
#include "documents/made/dimension_table.h"
#include "documents/made/mandible/bone.h"
#include "documents/made/mandible/frame.h"
#include "documents/made/mandible/teeth.h"
#include "documents/made/people.h"
#include "kerf/units.hpp"

namespace kerf::documents {
namespace {

using namespace literals;

constexpr double osteoporotic_cortex = 0.85;  // [–] of the thickness without osteoporosis
constexpr double canal_diameter = 3e-3;       // [m]

std::vector<Dimension> dimensions_of(const MakeRequest& request) {
    const double sign = sign_of(request.sex);
    DimensionTable table;
    // `men` is how much larger the mean of men is than that of both sexes [mm].
    const auto size = [&](const char* name, const char* help, double mean, double men, double sd, double loading,
                          Evidence evidence, const char* source, double floor = 0.1) -> Dimension& {
        return table.length(name, help, mean + sign * men, sd, loading, evidence, source, floor);
    };
    const auto correlate = [](Dimension& dimension, const char* partner, double correlation) {
        dimension.partner = partner, dimension.shared = correlation;
    };
    size("bigonial.width", "Width of the jaw at its angles.", 93.5, 3.5, 6, 0.45, Evidence::recalled,
         "near 95.7 and 88.7 mm in Bosnia, read");
    correlate(size("bicondylar.width", "Width of the jaw over both condyles.", 115, 3, 6, 0.45, Evidence::recalled,
                   "near 112.7 and 107.5 mm in Bosnia, read"),
              "bigonial.width", 0.4);
    size("condyle.width", "Width of a condyle.", 17.1, 0.1, 2.2, 0.2, Evidence::read,
         "mean of 800 CBCT; the SD is recalled", 9.0);
    size("condyle.depth", "Depth of a condyle, from front to back.", 8.9, 0, 1.0, 0.2, Evidence::read,
         "mean of 800 CBCT; the SD is assumed", 5.0);
    table.angle("gonial.angle", "Angle between the posterior and the lower border.", 123.5 - 1.5 * sign, 6,
                Evidence::recalled, "with teeth; 124.8 deg in 150 rami");
    size("gonial.flare", "How far the angle lies outside of the ramus.", 2, 0, 0.7, 0, Evidence::recalled, "0 to 8 mm",
         0.2);
    correlate(table.angle("mandibular_plane.angle", "Angle of the lower border to the Frankfort horizontal.",
                          24.5 - 0.5 * sign, 5, Evidence::recalled, "24 deg in men, 25 deg in women"),
              "gonial.angle", 0.65);
    size("ramus.height", "From the corner of both borders to the top of the condyle, along the posterior border.", 60,
         3, 5, 0.5, Evidence::recalled, "63 mm in men, 57 mm in women");
    size("ramus.width", "Width of the ramus where it is narrowest, seen from the side.", 30.75, 0.75, 3, 0.4,
         Evidence::recalled, "31.5 mm in men, 30 mm in women; 31.3 mm in 150 rami");
    size("ramus.thickness", "Thickness of the ramus in its middle.", 7.5, 0.2, 0.45, 0.2, Evidence::recalled,
         "6 to 9 mm", 6.1);
    correlate(size("coronoid.height",
                   "From the corner of both borders to the tip of the coronoid process, along the "
                   "posterior border.",
                   59, 3, 5, 0.5, Evidence::recalled, "62 mm in men, 56 mm in women"),
              "ramus.height", 0.7);
    size("notch.depth", "Depth of the notch between condyle and coronoid process.", 13.5, 0.5, 2, 0.3,
         Evidence::recalled, "14 mm in men, 13 mm in women");
    size("body.length", "From the corner of both borders to the front of the chin, along the lower border.", 82.5, 2.5,
         5, 0.5, Evidence::recalled, "85 mm in men, 80 mm in women, of lateral radiographs");
    size("body.height", "Height of the body at the first molar, without the tooth.", 27, 1, 3, 0.45, Evidence::recalled,
         "28 mm in men, 26 mm in women");
    size("body.thickness", "Thickness of the body at the first molar.", 12.6, 0.4, 1.2, 0.3, Evidence::derived,
         "bone on both sides of the canal in 1997 dry jaws and 106 CBCT; SD assumed");
    correlate(size("symphysis.height", "Height of the chin in its middle.", 30.5, 1.5, 3, 0.45, Evidence::recalled,
                   "32 mm in men, 29 mm in women"),
              "body.height", 0.6);
    size("symphysis.thickness", "Thickness of the chin in its middle.", 13.5, 0.5, 1.5, 0.3, Evidence::recalled,
         "14 mm in men, 13 mm in women");
    correlate(size("canal.buccal", "Bone between the canal and the buccal surface at the first molar.", 5.5, 0.2, 1.1,
                   0, Evidence::computed, "between 6.6 mm in 1997 dry jaws and 2.6 to 5.4 mm in 106 CBCT", 2.0),
              "body.thickness", 0.5);
    correlate(size("canal.below", "Bone between the canal and the lower border at the first molar.", 8, 0.4, 1.5, 0,
                   Evidence::computed, "8.8 mm in 1997 dry jaws", 3.0),
              "body.height", 0.4);
    size("first_molar.width", "Width of the first molar along the row; all teeth are of its size.", 11, 0.33, 0.5, 0.4,
         Evidence::recalled, "Wheeler; men 3 % more, women 3 % less");
    const double cortex = request.is_osteoporotic ? osteoporotic_cortex : 1.0;
    const char* const thinned = "; with osteoporosis 0.85 times, recalled";
    size("body.cortex", "Thickness of the cortex of the body.", 2.1 * cortex, 0.05, 0.25, 0, Evidence::read,
         (std::string("2.2 and 2.0 mm in 1997 dry jaws, SD assumed") + thinned).c_str(), 1.0);
    size("ramus.cortex", "Thickness of the cortex of the ramus.", 1.8 * cortex, 0.05, 0.2, 0, Evidence::recalled,
         (std::string("1.6 to 1.8 mm") + thinned).c_str(), 0.8);
    table.density("cancellous.density", "Apparent density of cancellous bone.", 500.0, 80.0, Evidence::recalled,
                  "0.45 behind to 0.6 in front; in jaws it does not fall with age (Kingsmill 1998, read)", 200.0);
    return std::move(table.all);
}

std::string degrees(double angle) { return with_decimals(angle / 1.0_deg, 1) + " deg"; }

std::string contradiction_of(const DimensionValues& v) {
    const auto is = [](const char* name, double value, double min, double max, const std::string& at) {
        return "`" + std::string(name) + "` is out of range: got " + dimension_text(value, "mm") + ", expected " +
               dimension_text(min, "mm") + " to " + dimension_text(max, "mm") + " at this " + at;
    };
    if (const double width = v["bigonial.width"];
        v["bicondylar.width"] < width + 5.0_mm || v["bicondylar.width"] > width + 38.0_mm)
        return is("bicondylar.width", v["bicondylar.width"], width + 5.0_mm, width + 38.0_mm, "`bigonial.width`");
    if (const double body = v["body.length"]; v["ramus.height"] < 0.58 * body || v["ramus.height"] > 0.92 * body)
        return is("ramus.height", v["ramus.height"], 0.58 * body, 0.92 * body, "`body.length`");
    if (const double condyle = v["ramus.height"]; std::abs(v["coronoid.height"] - condyle) > 12.0_mm)
        return is("coronoid.height", v["coronoid.height"], condyle - 12.0_mm, condyle + 12.0_mm, "`ramus.height`");
    if (const double min = 10.0_mm, max = 0.32 * v["ramus.height"]; v["notch.depth"] > max)
        return is("notch.depth", v["notch.depth"], min, max, "`ramus.height`");
    const MandibleFrame frame(v);
    if (frame.rise < 64.0_deg || frame.rise > 98.0_deg)
        return "`gonial.angle` is out of range: got " + degrees(v["gonial.angle"]) + ", expected " +
               degrees(v["mandibular_plane.angle"] + 82.0_deg) + " to " +
               degrees(v["mandibular_plane.angle"] + 116.0_deg) + " at this `mandibular_plane.angle`";
    const double lingual = v["body.thickness"] - v["canal.buccal"] - canal_diameter;
    if (lingual < 1.8_mm)
        return "`canal.buccal` is out of range: got " + dimension_text(v["canal.buccal"], "mm") +
               ", expected at most " + dimension_text(v["canal.buccal"] + lingual - 1.8_mm, "mm") +
               " at this `body.thickness`";
    if (const double max = v["body.height"] - canal_diameter - 10.0_mm; v["canal.below"] > max)
        return "`canal.below` is out of range: got " + dimension_text(v["canal.below"], "mm") + ", expected at most " +
               dimension_text(max, "mm") + " at this `body.height`: the roots of the molars need 10 mm";
    if (const double body = v["body.height"]; v["symphysis.height"] < 0.9 * body || v["symphysis.height"] > 1.4 * body)
        return is("symphysis.height", v["symphysis.height"], 0.9 * body, 1.4 * body, "`body.height`");
    const MandibleBone bone(v);
    constexpr double sharpest = 0.97;  // [–] below 1, as the text is rounded
    if (const double bend = bone.bend_of_body(); bend > sharpest)
        return "`symphysis.thickness` is out of range: got " + dimension_text(v["symphysis.thickness"], "mm") +
               ", expected at most about " + dimension_text(v["symphysis.thickness"] * sharpest / bend, "mm") +
               " at this `bigonial.width` and `body.length`: the chin bends too sharply";
    if (bone.bend_of_others() > sharpest)
        return "`bicondylar.width` is out of range: got " + dimension_text(v["bicondylar.width"], "mm") +
               ": the ramus bends too sharply at this `bigonial.width` and `ramus.height`. Expected a value closer to "
               "`bigonial.width`";
    if (const double row = row_of_teeth(v["first_molar.width"]), room = 1e-3 * bone.crest().back().from_midline;
        row > 1.05 * room)
        return "`first_molar.width` is out of range: the row of teeth is " + dimension_text(row, "mm") +
               " long, expected at most " + dimension_text(1.05 * room, "mm") +
               " at this `body.length`, `ramus.width` and `bigonial.width`";
    return {};
}

}  // namespace

Population mandible_population(const MakeRequest& request) {
    Population population;
    population.dimensions = dimensions_of(request);
    population.stature = stature_of(request.sex);
    population.find_contradiction = contradiction_of;
    return population;
}

}  // namespace kerf::documents
