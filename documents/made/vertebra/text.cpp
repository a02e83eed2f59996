// SPDX-License-Identifier: Apache-2.0
#include "documents/made/vertebra/text.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>
#include <vector>

#include "documents/made/anatomy_text.h"
#include "documents/made/vertebra/dimensions.h"
#include "documents/solids.h"

namespace kerf::documents {
namespace {

constexpr double core_density = 0.85 / 1.15;  // [–] density of the middle of the body over that at its rim
constexpr double superior_process = 19.5;     // [mm] from the midline, at L3
constexpr double degree = std::numbers::pi / 180.0;

/// What the posterior elements of a level look like, beyond its dimensions [mm, deg, –].
struct Arch {
    double interfacet;   ///< width over the articular processes, in widths of the upper end-plate
    double articular;    ///< height from tip to tip of the articular processes
    double slope;        ///< of the spinous process below the horizontal
    double bulk;         ///< [–] size of the processes, relative to a lumbar vertebra
    double canal_taper;  ///< of the canal's section: 0 is round
};
Arch arch_of(const std::string& level) {
    if (level == "T11") return {0.77, 40, 24, 0.85, 0.3};
    if (level == "T12") return {0.75, 44, 13, 0.85, 0.3};
    if (level == "L1") return {0.70, 50, 7, 1.0, 0.5};
    if (level == "L2") return {0.665, 51, 7, 1.0, 0.6};
    if (level == "L3") return {0.675, 50, 7, 1.0, 0.6};
    if (level == "L4") return {0.695, 47, 7, 1.0, 0.6};
    return {0.755, 44, 7, 1.0, 0.7};
}

/// Returns the largest width of an ellipse with a taper, in its `width` [–].
double widest_of_tapered(double taper) {
    double widest = 1.0;
    for (double t = 0.0; t <= 1.0; t += 1e-3) widest = std::max(widest, std::sqrt(1.0 - t * t) * (1.0 + taper * t));
    return widest;
}

/// All in mm and radians; x is that of the left half, written mirrored.
class VertebraWriter {
public:
    VertebraWriter(const std::string& level, const DimensionValues& v) : level_(level), arch_(arch_of(level)), v_(v) {
        const double front = 1e3 * anterior_height(v);
        middle_height_ = 0.5 * (mm("body.height") + front);
        wall_ = 0.25 * (mm("upper_end_plate.depth") + mm("lower_end_plate.depth"));
        canal_back_ = wall_ + mm("canal.depth");
        const double width = mm("pedicle.width"), inwards = v_["pedicle.transverse_angle"];
        outwards_ = std::tan(inwards), upwards_ = std::tan(v_["pedicle.sagittal_angle"]);
        const double height = mm("body.height");
        isthmus_ = {0.5 * (mm("canal.width") + width / std::cos(inwards)), wall_ + 4.0,
                    std::min(0.15 * height, 0.5 * height - 0.5 * mm("pedicle.height") - 0.3)};
        pedicle_end_ = on_pedicle(8.5);
        tall_ = height / 26.7;
        // The axis of the pedicle meets the lateral flank of the superior process, or passes next to it.
        const double facets = 1.26 * 0.5 * arch_.interfacet * mm("upper_end_plate.width");
        const double axis = on_pedicle(canal_back_ - isthmus_.y).x;
        wide_ = std::min(facets / 19.0, (axis - 0.66) / superior_process);
    }

    [[nodiscard]] std::string parts() const {
        return body() + end_plates() + pedicle() + lamina() + spinous_process() + transverse_process() +
               articular_processes() + canal_part();
    }
    [[nodiscard]] std::string tissues() const;
    [[nodiscard]] std::string landmarks() const;
    [[nodiscard]] std::string zones() const;

private:
    [[nodiscard]] double mm(const char* name) const { return 1e3 * v_[name]; }
    /// Returns the middle of the pedicle at a distance behind its narrowest section.
    [[nodiscard]] Vec3 on_pedicle(double behind) const { return isthmus_ + behind * Vec3{outwards_, 1.0, upwards_}; }
    /// Returns a point on the left, side 1, or on the right, −1.
    static Vec3 on_side(double side, Vec3 at) { return {side * at.x, at.y, at.z}; }
    static Vec3 right(Vec3 at) { return on_side(-1.0, at); }

    [[nodiscard]] std::string body() const;
    [[nodiscard]] std::string end_plates() const;
    [[nodiscard]] std::string pedicle() const;
    [[nodiscard]] std::string lamina() const;
    [[nodiscard]] std::string spinous_process() const;
    [[nodiscard]] std::string transverse_process() const;
    [[nodiscard]] std::string articular_processes() const;
    [[nodiscard]] std::string canal_part() const;
    [[nodiscard]] WrittenLoft canal() const;
    [[nodiscard]] TissueRegion core() const;
    /// Returns whether a point is at least 3 mm inside the narrowest section of the body.
    [[nodiscard]] bool is_in_waist(Vec3 p) const {
        const double x = p.x / (0.42 * mm("lower_end_plate.width") - 3.0), y = p.y / (0.93 * wall_ - 3.0);
        return std::pow(std::abs(x), 2.2) + std::pow(std::abs(y), 2.2) <= 1.0;
    }
    [[nodiscard]] double mean_over_outer() const;
    [[nodiscard]] bool is_lumbar() const { return level_[0] == 'L'; }

    std::string level_;
    Arch arch_;
    const DimensionValues& v_;
    double middle_height_, wall_, canal_back_, outwards_, upwards_;
    Vec3 isthmus_, pedicle_end_;
    double tall_, wide_;  ///< [–] sizes of the arch, in those of a third lumbar vertebra
};

std::string VertebraWriter::body() const {
    const double w0 = mm("lower_end_plate.width"), d0 = mm("lower_end_plate.depth"), w1 = mm("upper_end_plate.width"),
                 d1 = mm("upper_end_plate.depth"), half = 0.5 * middle_height_, wedge = v_["body.wedge"];
    const auto section = [&](double z, double width, double depth) {
        return WrittenSection{{0, -0.5 * wedge / middle_height_ * z * z, z}, width, depth, 2.2, 0};
    };
    const double waist = -0.3 * half;  // at 35 % of the height
    return loft_part("body",
                     {{0, -1, 0},
                      1.5,
                      {section(-half, w0, d0), section(-half + 1.85, w0 + 0.1, d0 + 0.2),
                       section(waist, 0.84 * w0, 0.93 * std::min(d0, d1)), section(half - 1.85, w1 + 0.1, d1 + 0.2),
                       section(half, w1, d1)}},
                     {0, false, false,
                      "Waist: 0.84 of the width and 0.93 of the depth at 35 % of the height, from the mean of 87 "
                      "patients (morphable-lumbar-model)."});
}

std::string VertebraWriter::end_plates() const {
    const auto hollow = [&](const char* id, double sign, double depth, double width, double height) {
        const double tilt = sign * 0.5 * v_["body.wedge"];
        const Vec3 normal{0, -std::sin(tilt), std::cos(tilt)};
        const Vec3 centre = sign * (0.5 * middle_height_ + 15.0 - depth) * normal;
        return std::string("    - id: ") + id + "\n      superellipsoid: {centre: " + vector_text(centre) +
               " mm, length: 30 mm, width: " + rounded_text(width) + " mm, height: " + rounded_text(height) +
               " mm, along: " + direction_text(normal) + "}\n" +
               "      subtract: true\n      blend: 1 mm\n      source: Hollow by " + rounded_text(depth) +
               " mm [recalled].\n";
    };
    return hollow("upper_end_plate", 1, 1.5, 1.74 * mm("upper_end_plate.width"), 1.7 * mm("upper_end_plate.depth")) +
           hollow("lower_end_plate", -1, 2.5, 1.35 * mm("lower_end_plate.width"), 1.35 * mm("lower_end_plate.depth"));
}

std::string VertebraWriter::pedicle() const {
    const double w = mm("pedicle.width"), h = mm("pedicle.height");
    return loft_part("pedicle",
                     {{0, 0, 1},
                      0,
                      {{right(on_pedicle(-11.5)), 1.13 * w, 1.055 * h},
                       {right(isthmus_), w, h},
                       {right(pedicle_end_), 1.19 * w, 1.055 * h}}},
                     {4, true, false,
                      "The narrowest place is 4 mm behind the body's wall, at 65 % of its height "
                      "(morphable-lumbar-model)."});
}

std::string VertebraWriter::lamina() const {
    const auto section = [&](double x, double behind, double z, double thickness, double height, double exponent) {
        return WrittenSection{{x * wide_, canal_back_ + behind, z * tall_}, thickness, height * tall_, exponent, 0};
    };
    return loft_part(
        "lamina",
        {{0, 0.25, 1},
         0,
         {section(-17, -2.7, -1, 8, 18, 2.5), section(-9, 1.2, -5, 6.5, 19, 3), section(0, 3.3, -6.5, 7, 19, 3),
          section(9, 1.2, -5, 6.5, 19, 3), section(17, -2.7, -1, 8, 18, 2.5)}},
        {3, false, false, "Thickness 6 to 7 mm [recalled]."});
}

std::string VertebraWriter::spinous_process() const {
    const double down = std::tan(arch_.slope * degree), size = arch_.bulk, tip_height = 22.0 * size * tall_, rim = 2.5;
    // Its end is square to its path, so the upper edge lies farthest behind.
    const double from = canal_back_ + 3.8,
                 to = wall_ + mm("spinous_process.length") - (0.5 * tip_height - rim) * std::sin(arch_.slope * degree);
    const auto section = [&](double fraction, double width, double height) {
        const double behind = fraction * (to - from);
        return WrittenSection{
            {0, from + behind, -7.0 * tall_ - down * behind}, size * width, size * height * tall_, 2.5, 0};
    };
    return loft_part(
        "spinous_process",
        {{0, 0, 1}, rim, {section(0, 9, 17), section(0.388, 6, 19), section(0.806, 7.5, 23.5), section(1, 7, 22)}},
        {4, false, false, "Height 23.5 mm at L3 (morphable-lumbar-model)."});
}

std::string VertebraWriter::transverse_process() const {
    const Vec3 root = pedicle_end_ + Vec3{-0.3, -1, 1};
    const double backwards = is_lumbar() ? 0.2 : 0.6, upwards = 0.1, rim = 1.0;
    // Its end is square to its path, so an edge reaches farther than the middle.
    const double slope = is_lumbar() ? 1.4 * backwards : backwards;
    const double edge = std::hypot((3.5 - rim) * slope, (4.5 - rim) * upwards) / std::hypot(1.0, slope);
    const double reach = std::max(0.5 * mm("transverse_processes.width") - edge - root.x, 3.0),
                 back = backwards * reach, up = upwards * reach;
    const auto section = [&](double fraction, double behind, double width, double height) {
        const double y = (is_lumbar() ? behind : fraction) * back;  // short thoracic ones are straight
        return WrittenSection{right(root + Vec3{fraction * reach, y, fraction * up}), width, height, 2.0, 0};
    };
    return loft_part(
        "transverse_process",
        {{0, 0, 1},
         rim,
         {section(0, 0, 8, 13), section(0.36, 0.3, 6, 10), section(0.72, 0.6, 6, 9.5), section(1, 1, 7, 9)}},
        {3, true, false, "Height 8 to 11 mm."});
}

std::string VertebraWriter::articular_processes() const {
    const double top = 0.4 * arch_.articular, bottom = -0.58 * arch_.articular, size = arch_.bulk;
    const auto section = [&](double x, double behind, double z, double width, double height, double exponent) {
        return WrittenSection{{-x * wide_, canal_back_ + behind, z}, size * width, size * height, exponent, 0};
    };
    return loft_part("superior_articular_process",
                     {{0, 1, 0},
                      1,
                      {section(superior_process, -3.7, 0, 10, 9, 2),
                       section(superior_process, -1.7, 0.5 * top, 10, 11, 2.4), section(18.5, -0.7, top, 9, 10, 2.4)}},
                     {3, true, false, "Width over both processes: Masharawi. Height of the facet 18 mm."}) +
           loft_part("inferior_articular_process",
                     {{0, 1, 0},
                      1,
                      {section(11, 3.8, -5 * tall_, 12, 7, 2), section(12.5, 5.3, 0.55 * bottom, 11, 8.5, 2.4),
                       section(13.5, 5.3, bottom, 11, 9, 2.4)}},
                     {3, true, false,
                      rounded_text(arch_.articular) + " mm from tip to tip of the articular processes "
                                                      "(morphable-lumbar-model; above L2 recalled)."});
}

WrittenLoft VertebraWriter::canal() const {
    // The fillets around it remove 0.3 mm more on each side, and the pedicles bound it.
    const double depth = mm("canal.depth"), far = 40.0;
    const double width = (mm("canal.width") - 0.8) / widest_of_tapered(arch_.canal_taper);
    const auto section = [&](double z) {
        return WrittenSection{{0, 0.5 * (wall_ + canal_back_), z}, width, depth - 0.6, 2.0, arch_.canal_taper};
    };
    return {{0, 1, 0}, 0, {section(-far), section(far)}};
}

std::string VertebraWriter::canal_part() const {
    return loft_part("canal", canal(), {1, false, true, "A rounded triangle (morphable-lumbar-model)."});
}

std::string elliptic_tube(Vec3 from, Vec3 to, double width, double height) {
    return "elliptic_tube: {from: " + vector_text(from) + " mm, to: " + vector_text(to) +
           " mm, width: " + rounded_text(width) + " mm, height: " + rounded_text(height) + " mm, up: 0 0 1}";
}

/// The middle of the body, where cancellous bone is least dense [m].
TissueRegion VertebraWriter::core() const {
    SuperellipsoidSolid solid;
    solid.length = 0.5e-3 * middle_height_;
    solid.width = 0.45e-3 * mm("lower_end_plate.width");
    solid.height = 0.5e-3 * mm("lower_end_plate.depth");
    TissueRegion region;
    region.solids = {solid};
    region.over = 5e-3;
    return region;
}

/// Returns the mean density of the body over that of its bone near the end-plates [–].
double VertebraWriter::mean_over_outer() const {
    constexpr int samples = 20;  // along each axis
    Tissue cancellous;
    cancellous.density = 1.0;
    cancellous.regions = {core()};
    cancellous.regions[0].density = core_density;
    const Vec3 half = 0.5e-3 * Vec3{0.9 * mm("lower_end_plate.width"), mm("lower_end_plate.depth"), middle_height_};
    double sum = 0.0;
    int count = 0;
    for (int i = 0; i < samples * samples * samples; ++i) {
        const auto at = [&](int n) { return 2.0 * (n % samples + 0.5) / samples - 1.0; };
        const Vec3 p{at(i), at(i / samples), at(i / (samples * samples))};
        if (std::pow(std::abs(p.x), 2.2) + std::pow(std::abs(p.y), 2.2) > 1.0) continue;
        sum += density_at(cancellous, {p.x * half.x, p.y * half.y, p.z * half.z});
        ++count;
    }
    return sum / count;
}

std::string VertebraWriter::tissues() const {
    const double cortex = mm("pedicle.cortex"), w = mm("pedicle.width"), h = mm("pedicle.height");
    const auto lateral = [&](double side) {
        const auto at = [&](double behind) { return on_side(side, on_pedicle(behind) + Vec3{0.5 * w, 0, 0}); };
        return "          - " + elliptic_tube(at(-7), at(7), 0.5 * w, h) + "\n";
    };
    const auto region = [](const char* part, double thickness) {
        return std::string("      - {part: ") + part + ", thickness: " + rounded_text(thickness) + " mm}\n";
    };
    std::string text = "tissues:\n  - id: cortical\n    thickness: 1.2 mm\n    density: 1.85 g/cm3\n    regions:\n";
    text += region("upper_end_plate", mm("end_plates.thickness")) +
            region("lower_end_plate", mm("end_plates.thickness")) + region("body", mm("body.shell"));
    text += "      - thickness: " + rounded_text(0.6 * cortex) +
            " mm  # of the lateral wall of the pedicle\n        solids:\n" + lateral(-1) + lateral(1);
    text += region("pedicle", 1.4 * cortex);
    text += folded(
        "source",
        "Density: apparent density of cortical bone, 1.8 to 2.0 g/cm3. Body and pedicle: the dimensions above; the "
        "lateral wall of the pedicle has 0.6 times the mean, its other walls 1.4 times. Lamina and processes: "
        "1.2 mm, of 1.0 to 1.5 mm [recalled].",
        4);
    const double outer = 1e-3 * v_["cancellous.density"] / mean_over_outer();
    const TissueRegion middle = core();
    const auto& solid = std::get<SuperellipsoidSolid>(middle.solids[0]);
    text += "  - id: cancellous\n    density: " + with_decimals(outer, 3) +
            " g/cm3\n    regions:\n      - density: " + with_decimals(core_density * outer, 3) +
            " g/cm3  # in the middle of the body\n        over: " + rounded_text(1e3 * middle.over) +
            " mm\n        solids:\n          - superellipsoid: {centre: 0 0 0 mm, length: " +
            rounded_text(1e3 * solid.length) + " mm, width: " + rounded_text(1e3 * solid.width) +
            " mm, height: " + rounded_text(1e3 * solid.height) + " mm}\n";
    text += folded(
        "source",
        "The mean over the body is the dimension above. The middle has 0.74 times the density of the end-plates and "
        "pedicle roots [recalled].",
        4);
    return text;
}

std::string VertebraWriter::landmarks() const {
    double ahead = 4.0 + 1.34 * wall_;
    while (ahead > 10.0 && !is_in_waist(on_pedicle(-ahead))) ahead -= 0.5;  // along the side of a thoracic body
    const auto axis = [&](const char* id, double side) {
        const auto written = [&](double behind) { return vector_text(on_side(side, on_pedicle(behind))); };
        return std::string("    ") + id + ": {from: " + written(25.5) + " mm, to: " + written(-ahead) +
               " mm, tolerance: 1.5 mm}\n";
    };
    return "landmarks:\n  points:\n    midline: {at: " + vector_text({0, wall_ + 7.5, isthmus_.z}) +
           " mm, tolerance: 1.5 mm}  # in the canal, level with both pedicles\n"
           "  axes:\n    # Through the middle of the pedicle.\n" +
           axis("right_pedicle", -1) + axis("left_pedicle", 1);
}

std::string VertebraWriter::zones() const {
    const auto tube = [](Vec3 from, Vec3 to, double radius) { return "    - {" + tube_text(from, to, radius) + "}\n"; };
    std::string text = "zones:\n  canal:\n" + loft_item(canal(), 4);
    const double below = isthmus_.z - 0.5 * mm("pedicle.height");
    text += "  nerve_roots:  # below the pedicles [recalled]\n";
    for (const double side : {-1.0, 1.0})
        text += tube({side * 0.35 * mm("canal.width"), wall_ + 6, below - 2.5},
                     {side * (isthmus_.x + 6.0), wall_ + 5, below - 5.5}, 2);
    const double front = -0.5 * mm("upper_end_plate.depth");
    text += "  vessels:  # in front of the body [recalled]\n";
    if (level_ == "L5") {
        for (const double side : {-1.0, 1.0}) text += tube({side * 8, front - 11, 15}, {side * 26, front - 9, -20}, 6);
        return text;
    }
    text += tube({6, front - 13, 30}, {4, front - 13, -30}, 9);                         // aorta
    if (is_lumbar()) text += tube({-15, front - 12, 30}, {-15, front - 12, -30}, 9.5);  // inferior vena cava
    return text;
}

}  // namespace

std::string vertebra_text(const MakeRequest& request, const DimensionValues& values) {
    const VertebraWriter vertebra(request.level, values);
    return "phantom:\n  parts:\n" + vertebra.parts() + "\n" + vertebra.tissues() + "\n" + vertebra.landmarks() + "\n" +
           vertebra.zones();
}

}  // namespace kerf::documents
