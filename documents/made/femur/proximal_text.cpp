// SPDX-License-Identifier: Apache-2.0
#include "documents/made/femur/proximal_text.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "documents/made/anatomy_text.h"
#include "documents/made/femur/dimensions.h"

namespace kerf::documents {
namespace {

constexpr double plate_angle = 35.0 * std::numbers::pi / 180.0;  // of its screw, off the normal of the plate
constexpr double screw_above_plate = 38.97;  // [mm] from the plate's origin up to where the screw meets bone
constexpr double plate_below = 47.0, plate_above = 47.0;  // [mm] how far plate and bone reach from that origin

/// All in mm and radians.
class ProximalFemurWriter {
public:
    ProximalFemurWriter(const MakeRequest& request, const DimensionValues& v) : request_(request), v_(v) {
        const double angle = v_["neck.angle"];
        along_ = {-std::sin(angle), 0, -std::cos(angle)};
        across_ = {-along_.z, 0, along_.x};  // down and to the middle
        length_ = 1e3 * neck_length(v_), radius_ = 0.5 * mm("head.diameter");
        width_ = mm("shaft.width"), girth_ = width_ / 26.5;
        tip_ = 1e3 * greater_trochanter_height(v_), lesser_ = 1e3 * lesser_trochanter_height(v_) - 1.3 * girth_;
        // The screw of the plate leads through the middle of the head.
        screw_ = head().z - (0.5 * width_ - head().x) * std::tan(plate_angle);
        plate_ = screw_ - screw_above_plate;
        bottom_ = std::min(plate_ - plate_below, lesser_ - 52.0);
    }

    [[nodiscard]] std::string parts() const { return shaft() + greater_trochanter() + neck() + small_parts(); }
    [[nodiscard]] std::string tissues() const;
    [[nodiscard]] std::string fracture() const;
    [[nodiscard]] std::string landmarks() const;
    [[nodiscard]] std::string zones() const;

private:
    [[nodiscard]] double mm(const char* name) const { return 1e3 * v_[name]; }
    /// Returns a point on the axis of the neck, and one off it: above where `below` is negative.
    [[nodiscard]] Vec3 on_neck(double distance, double below = 0.0) const {
        return distance * along_ + below * across_;
    }
    [[nodiscard]] Vec3 head() const { return on_neck(length_); }
    /// Returns a point that moves with the thickness of the shaft, but at its own height.
    [[nodiscard]] Vec3 girded(double x, double y, double z) const { return {girth_ * x, girth_ * y, z}; }

    [[nodiscard]] std::string shaft() const;
    [[nodiscard]] std::string greater_trochanter() const;
    [[nodiscard]] std::string neck() const;
    [[nodiscard]] std::string small_parts() const;
    [[nodiscard]] double canal_at(double below_lesser) const;
    [[nodiscard]] WrittenLoft marrow() const;

    const MakeRequest& request_;
    const DimensionValues& v_;
    Vec3 along_, across_;  // along the neck into the head; across it
    double length_, radius_, width_, girth_;
    double tip_, lesser_;            // heights of the tip of the greater, and of the middle of the lesser trochanter
    double screw_, plate_, bottom_;  // heights of the screw at the side of the bone, the plate, the end of the bone
};

std::string ProximalFemurWriter::shaft() const {
    const auto section = [&](double x, double y, double z, double width, double height, double exponent, double taper) {
        return WrittenSection{girded(x, y, z), girth_ * width, girth_ * height, exponent, taper};
    };
    return loft_part(
               "shaft",
               {{0, 1, 0},
                0,
                {section(0, 0, bottom_ - 5, 26.5, 27, 2, 0.12),
                 section(0, 0, std::max(lesser_ - 38, bottom_ + 3), 26.5, 27, 2, 0.12),
                 section(-0.1, 0, lesser_ - 19, 26.6, 27, 2, 0.1), section(-2.5, 0.5, lesser_ + 1, 31.4, 29, 2.2, 0),
                 section(-3.5, 1.5, -2, 33.4, 31, 2.2, 0), section(-2, 3, 12, 24, 26, 2, 0)}},
               {0, false, false, "Wider below the trochanters [recalled]."}) +
           solid_part("linea_aspera",
                      elliptic_tube_text(girded(1, 11.5, bottom_ - 5), girded(-3, 8, lesser_ - 7), 8 * girth_,
                                         7.5 * girth_, "0 1 0"),
                      {4, false, false, "Schematic."});
}

std::string ProximalFemurWriter::greater_trochanter() const {
    // It begins to bulge above the plate. Its end is square to its path, so its edge is higher than the middle.
    const double base = plate_ + plate_above - 1.0, top = tip_ - 1.3 * girth_;
    // A low trochanter bends less to the side, so that its sections do not cross.
    const double tall = std::min((top - base) / (36.0 * girth_), 1.0), bend = tall * tall;
    const auto section = [&](double x, double y, double fraction, double width, double height, double exponent) {
        const double z = base + fraction * (top - base), along = (z - base + 10.0) / (top - base + 10.0);
        const double straight_x = 1.0 + 5.5 * along, straight_y = 4.0 + 7.5 * along;
        const Vec3 at = girded(straight_x + bend * (x - straight_x), straight_y + bend * (y - straight_y), z);
        return WrittenSection{at, girth_ * width, girth_ * height, exponent, 0};
    };
    const double start = -10.0 / (top - base);
    return loft_part(
        "greater_trochanter",
        {{0, 1, 0},
         4 * std::min(girth_, 1.0),
         {section(1, 4, start, 14, 20, 2), section(4, 5, 0, 16, 25, 2), section(8.5, 6.5, 0.35, 25, 30, 2.3),
          section(8.5, 9, 0.69, 21, 26, 2.3), section(6.5, 11.5, 1, 14, 17, 2)}},
        {5, false, false, "Shape schematic."});
}

std::string ProximalFemurWriter::neck() const {
    const double w = mm("neck.depth"), h = mm("neck.height"), waist = length_ - 0.98 * radius_;
    const auto section = [&](double distance, double below, double width, double height) {
        return WrittenSection{on_neck(distance, below), width, height, 2.0, 0};
    };
    return loft_part("neck",
                     {{-across_.x, 0, -across_.z},
                      0,
                      {section(-0.4, 1.15, 0.885 * w, 1.06 * h), section(0.53 * waist, 0, 1.02 * w, 1.09 * h),
                       section(waist, 0, w, h), section(length_, 0, 1.39 * radius_, 1.56 * radius_)}},
                     {5, false, false, "Narrowest where the head begins [recalled]."});
}

std::string ProximalFemurWriter::small_parts() const {
    const Vec3 fovea = head() + radius_ * (0.81 * along_ + 0.33 * Vec3{0, 1, 0} + 0.76 * across_);
    const Vec3 tip{girth_ * -0.75, girth_ * 0.62, girth_ * 0.2};
    return solid_part("intertrochanteric_crest",
                      elliptic_tube_text(girded(9, 15.5, 0.53 * tip_), girded(-9, 15, lesser_ + 4), 11 * girth_,
                                         11 * girth_, "0 1 0"),
                      {5, false, false, "Schematic."}) +
           solid_part("lesser_trochanter",
                      "superellipsoid: {centre: " + vector_text(girded(-10.5, 9.5, lesser_)) +
                          " mm, length: " + rounded_text(26 * girth_) + " mm, width: " + rounded_text(18 * girth_) +
                          " mm, height: " + rounded_text(24 * girth_) + " mm, along: " + direction_text(tip) + "}",
                      {5, false, false, "Shape schematic."}) +
           solid_part("trochanteric_fossa", sphere_text(girded(-5, 15, 0.73 * tip_), 7 * girth_),
                      {4, false, true, "Schematic."}) +
           solid_part("head", sphere_text(head(), radius_), {4, false, false, ""}) +
           solid_part("fovea", sphere_text(fovea, 0.26 * radius_),
                      {3, false, true, "Schematic; behind and below the axis of the neck."}) +
           solid_part("beyond  # the bone ends flat",
                      "box: {centre: " + vector_text({0, 0, bottom_ - 10}) + " mm, size: 80 80 20 mm}",
                      {0, false, true, ""});
}

/// Returns the width of the marrow canal at a distance below the lesser trochanter.
double ProximalFemurWriter::canal_at(double below_lesser) const {
    const double isthmus = mm("shaft.canal"), flare = 8.6 * std::min(12.3 / isthmus, 1.0);
    return isthmus + flare * std::exp2(-(below_lesser - 20.0) / 20.0);
}

WrittenLoft ProximalFemurWriter::marrow() const {
    const double top = std::min(canal_at(-3.0), 0.78 * 31.4 * girth_), middle = std::min(canal_at(29.0), 0.8 * width_);
    const double low = canal_at(lesser_ - bottom_ + 12.0);
    return {{0, 1, 0},
            7,
            {{girded(0, 0, bottom_ - 12), low, low, 2, 0},
             {girded(-0.3, 0, lesser_ - 29), middle, middle, 2, 0},
             {girded(-2.5, 0.5, lesser_ + 3), top, 0.92 * top, 2, 0}}};
}

std::string ProximalFemurWriter::tissues() const {
    const WrittenLoft canal = marrow();
    const double age = request_.age.value_or(75.0);
    // Old bone is more porous.
    const double cortical = request_.is_osteoporotic ? 1.75 : 1.85 - 0.05 * std::clamp((age - 45.0) / 30.0, 0.0, 1.0);
    const double wall = 0.5 * (width_ - canal.sections[0].width) + 1.0;
    const std::string dense = with_decimals(cortical, 3) + " g/cm3\n";
    std::string text = "tissues:\n  - id: marrow\n    density: 0.05 g/cm3\n    solids:\n" + loft_item(canal, 6);
    text +=
        folded("source",
               "Fat with hardly any bone in it. 20 mm below the lesser trochanter the canal is 8.6 mm wider than at "
               "the isthmus, where that is 12.3 mm wide (Noble 1988) [recalled]; less in a wider one [assumed].",
               4);
    text += "  - id: diaphysis  # up to the canal\n    thickness: " + rounded_text(wall) +
            " mm\n    density: " + dense + "    solids:\n      - " +
            elliptic_tube_text(girded(0, 0, bottom_ - 3), girded(-2.5, 0.5, lesser_ + 3), 34 * girth_, 36 * girth_,
                               "0 1 0") +
            "\n";
    text += folded("source",
                   "Cortical bone: 1.85 g/cm3 up to 45 years, 1.8 g/cm3 from 75 years on, 1.75 g/cm3 with osteoporosis "
                   "[assumed].",
                   4);
    const double half = 0.5 * mm("neck.height");
    text += "  - id: cortical\n    thickness: " + rounded_text(mm("trochanters.cortex")) +
            " mm\n    density: " + dense + "    regions:\n";
    text += "      - thickness: " + rounded_text(mm("neck.lower_cortex")) +
            " mm  # calcar: the lower wall of the neck\n        over: 4 mm\n        solids:\n          - " +
            elliptic_tube_text(girded(-14, 1, lesser_ + 1), on_neck(0.45 * length_, 0.86 * half), 16 * girth_,
                               10 * girth_, "-0.9 0 -0.4") +
            "\n";
    text += "      - thickness: " + rounded_text(mm("neck.upper_cortex")) +
            " mm  # the upper wall\n        over: 3 mm\n        solids:\n          - " +
            elliptic_tube_text(on_neck(0.3 * length_, -half), on_neck(0.7 * length_, -half), 20 * girth_, 10 * girth_,
                               vector_text({-across_.x, 0, -across_.z})) +
            "\n";
    text += "      - {part: head, thickness: 0.7 mm}\n";
    text += folded("source", "Head: 0.7 mm [recalled]; the others are the dimensions above.", 4);
    text += "  - id: cancellous\n    density: " + with_decimals(1e-3 * v_["trochanters.density"], 3) +
            " g/cm3\n    regions:\n      - density: " + with_decimals(1e-3 * v_["neck.density"], 3) +
            " g/cm3  # in head and neck\n        over: 6 mm\n        solids:\n          - " +
            tube_text(on_neck(0.25 * length_), on_neck(length_ + radius_), radius_ + 2.0) + "\n";
    text += folded("source", "The dimensions above.", 4);
    return text;
}

std::string ProximalFemurWriter::fracture() const {
    return "# The head has fallen into varus and to the front.\nfracture:\n  at: " +
           vector_text(on_neck(0.381 * length_)) + " mm\n  normal: " + direction_text(along_) +
           "\n  gap: 0.5 mm\n  shift: -7 -4 3 mm\n  turn: {by: -14 deg, about: 0 1 0}\n";
}

std::string ProximalFemurWriter::landmarks() const {
    const auto axis = [](const char* id, Vec3 from, Vec3 to) { return axis_text(id, from, to, 1.0); };
    const Vec3 grip = on_neck(length_ - 8.5);
    return "landmarks:\n  points:\n    apex: {at: " + vector_text(on_neck(length_ + radius_)) +
           " mm, tolerance: 1 mm, lies: on_bone}  # of the head, on the axis of the neck\n    head: {at: " +
           vector_text(head()) + " mm, fit: {sphere: {radius: " + rounded_text(radius_) +
           " mm}}, tolerance: 1 mm}\n  axes:\n"
           "    # From the base of the neck into the head, and down the shaft: the neck-shaft angle is between these "
           "directions.\n" +
           axis("neck", {}, head()) + axis("shaft", {0, 0, 10}, {0, 0, bottom_ + 15}) +
           "    # From outside into the side of the bone.\n" +
           axis("lag", on_neck(-45), on_neck(length_ + radius_ - 9.5)) +
           axis("plate", {0.5 * width_ + 27, 0, plate_}, {-0.46 * width_, 0, plate_}) +
           "    # Onto the front of the neck, where the fragment is taken.\n" +
           axis("grip", grip + Vec3{0, -radius_ - 27, 0}, grip + Vec3{0, 15, 0});
}

std::string ProximalFemurWriter::zones() const {
    return "zones:\n  joint:  # the socket above the head\n    - {" +
           tube_text(on_neck(length_ + radius_ + 3.5), on_neck(length_ + radius_ + 15.5), radius_ + 1.0) + "}\n";
}

}  // namespace

std::string proximal_femur_text(const MakeRequest& request, const DimensionValues& values) {
    const ProximalFemurWriter femur(request, values);
    return "phantom:\n  parts:\n" + femur.parts() + "\n" + femur.tissues() + "\n" + femur.fracture() + "\n" +
           femur.landmarks() + "\n" + femur.zones();
}

}  // namespace kerf::documents
