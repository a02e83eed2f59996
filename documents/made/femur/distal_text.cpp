// SPDX-License-Identifier: Apache-2.0
#include "documents/made/femur/distal_text.h"

#include <algorithm>
#include <cmath>

#include "documents/made/anatomy_text.h"
#include "documents/made/femur/dimensions.h"

namespace kerf::documents {
namespace {

constexpr double top = 110.0;  // [mm] where the bone ends, above the cut

/// All in mm; medial is at positive x.
class DistalFemurWriter {
public:
    explicit DistalFemurWriter(const DimensionValues& v) : v_(v) {
        half_ = 0.5 * mm("condyles.width");
        wide_ = half_ / 40.0, thick_ = mm("shaft.width") / 26.5;
        deep_ = 0.5 * (mm("medial_condyle.depth") + mm("lateral_condyle.depth")) / 60.0;
        cut_ = distal_cut_width(v_) * 1e3;
        back_ = 13.75 * (0.35 * thick_ + 0.65 * deep_);
    }

    [[nodiscard]] std::string parts() const { return shaft() + condyles() + holes(); }
    [[nodiscard]] std::string tissues() const;
    [[nodiscard]] std::string landmarks() const;
    [[nodiscard]] std::string zones() const;

private:
    [[nodiscard]] double mm(const char* name) const { return 1e3 * v_[name]; }
    [[nodiscard]] std::string shaft() const;
    [[nodiscard]] std::string condyles() const;
    [[nodiscard]] std::string holes() const;

    const DimensionValues& v_;
    double half_;                 // of the width over both condyles
    double wide_, thick_, deep_;  // [–] width of the condyles, thickness of the shaft and depth, in those of an adult
    double cut_, back_;           // width of the bone level with the cut; its back there
};

std::string DistalFemurWriter::shaft() const {
    return loft_part("shaft",
                     {{0, 1, 0},
                      0,
                      {{{0, 0, top + 5}, 26.4 * thick_, 27 * thick_, 2, 0.1},
                       {{0, 0, 45}, 28.5 * thick_, 27.5 * thick_, 2, 0},
                       {{0, 0, 0}, cut_, 2 * back_, 2.7, 0},
                       {{0, 1.5, -35}, 63 * wide_, 36 * deep_, 2.4, 0},
                       {{0, 4, -70}, 74 * wide_, 42 * deep_, 2.4, 0}}},
                     {0, false, false, "Width level with the cut: assumed."});
}

std::string DistalFemurWriter::condyles() const {
    const auto condyle = [&](const char* id, double side, double depth, double z, const char* source) {
        const double inner = std::min(6.0 * wide_, 0.5 * mm("notch.width") - 5.0);  // the notch cuts it
        const double outer = 38.6 * wide_, size = depth / 60.0;
        return solid_part(id,
                          "superellipsoid: {centre: " + vector_text({0.5 * side * (inner + outer), 9.5 * size, z}) +
                              " mm, length: " + rounded_text(outer - inner) + " mm, width: " + rounded_text(46 * size) +
                              " mm, height: " + rounded_text(depth - 0.2) +
                              " mm, along: 1 0 0, up: 0 1 0, exponent: 2.4}",
                          {4, false, false, source});
    };
    return condyle("condyle_medial", 1, mm("medial_condyle.depth"), -65, "Elliptic outline from the side: 90 CTs.") +
           condyle("condyle_lateral", -1, mm("lateral_condyle.depth"), -63.5,
                   "The axis of the shaft leans by 6 deg to the medial side further down, so the lateral condyle ends "
                   "higher.") +
           solid_part("epicondyle", sphere_text({half_ - 9.55, 6 * deep_, -62}, 9), {4, true, false, "Schematic."}) +
           solid_part("trochlea  # in front, between the condyles",
                      elliptic_tube_text({-22 * wide_, -3 * deep_, -62}, {22 * wide_, -3 * deep_, -62}, 31 * deep_, 42,
                                         "0 0 1"),
                      {4, false, false, "Its groove is 3 mm deep. Schematic."});
}

std::string DistalFemurWriter::holes() const {
    // Its roof rises to the back.
    const double bottom = -65.0 - 23.0 * mm("medial_condyle.depth") / 60.0;
    const double low = bottom + 1.0, rise = std::hypot(1.0, 20.0 / (43.0 * deep_));  // of the roof over the half height
    const double height = 2.0 * (mm("notch.depth") - 6.1) / rise;
    return solid_part("notch",
                      elliptic_tube_text({0, 7 * deep_, low}, {0, 50 * deep_, low + 20}, mm("notch.width") - 0.5,
                                         height, "0 0 1"),
                      {3, false, true, ""}) +
           solid_part("canal", tube_text({0, 0, 20}, {0, 0, top + 5}, 0.5 * mm("shaft.canal")),
                      {0, false, true, "Where it ends: assumed."}) +
           solid_part("beyond  # the bone ends flat",
                      "box: {centre: 0 0 " + rounded_text(top + 10) + " mm, size: 80 80 20 mm}", {0, false, true, ""});
}

std::string DistalFemurWriter::tissues() const {
    const double wall = 0.5 * (mm("shaft.width") - mm("shaft.canal"));
    return "tissues:\n  - id: cortical\n    thickness: " + rounded_text(0.5 * wall + 0.05) +
           " mm\n    density: 1.85 g/cm3\n    solids: [{box: {centre: 0 0 42.5 mm, size: 90 90 145 mm}}]\n" +
           folded(
               "source",
               "Density: apparent density of cortical bone, 1.8 to 2.0 g/cm3. Thickness: half of the shaft's wall of " +
                   rounded_text(wall) +
                   " mm, counted from outside and from the canal, so that all of that wall is cortical.",
               4) +
           "  - id: condylar\n    thickness: " + rounded_text(mm("condyles.cortex")) +
           " mm\n    density: 1.85 g/cm3\n    source: The dimension above.\n  - id: cancellous\n    density: " +
           with_decimals(1e-3 * v_["condyles.density"], 3) + " g/cm3\n    source: The dimension above.\n";
}

std::string DistalFemurWriter::landmarks() const {
    const auto cut = [&](const char* id, double x, double to) {
        return axis_text(id, {x * cut_ / 41.0, -back_ - 16.25, 0}, {x * cut_ / 41.0, to * back_ / 13.75, 0}, 1.0);
    };
    const auto point = [](const char* id, Vec3 at) {
        return std::string("    ") + id + ": {at: " + vector_text(at) + " mm, tolerance: 1 mm, lies: on_bone}\n";
    };
    return "landmarks:\n  points:\n    midline: {at: 90 0 0 mm, tolerance: 10 mm}  # of the body; assumed\n" +
           point("medial_epicondyle", {half_, 6 * deep_, -62}) + point("lateral_epicondyle", {-half_, 6 * deep_, -62}) +
           "  axes:\n    # Side by side; from 16 mm before the bone to its back. A saw of 14 mm covers the width.\n" +
           cut("cut_1", 16.5, 12) + cut("cut_2", 5.5, 16) + cut("cut_3", -5.5, 16) + cut("cut_4", -16.5, 12) +
           "    # From the foot into the medial condyle: where the distal piece is taken.\n" +
           axis_text("distal_grip", {24 * wide_, 6 * deep_, -120}, {24 * wide_, 6 * deep_, -60}, 3.0) +
           "  planes:\n    # Looks to the foot: out of the stump.\n"
           "    osteotomy: {at: 0 0 0 mm, normal: 0 0 -1, tolerance: 1 mm}\n";
}

std::string DistalFemurWriter::zones() const {
    const double y = back_ + 9.75, behind = 2.5 + 39.5 * deep_;
    return "zones:\n  # Width of 7 mm, and 6 mm behind the bone level with the cut: assumed. Below, it is behind the "
           "condyles.\n  popliteal_artery:\n    - {" +
           tube_text({0, y, -20}, {0, y, 105}, 3.5) + "}\n    - {" + sphere_text({0, y, -20}, 3.5) + "}\n    - {" +
           tube_text({0, y, -20}, {0, behind, -85}, 3.5) + "}\n";
}

}  // namespace

std::string distal_femur_text(const MakeRequest&, const DimensionValues& values) {
    const DistalFemurWriter femur(values);
    return "phantom:\n  parts:\n" + femur.parts() + "\n" + femur.tissues() + "\n" + femur.landmarks() + "\n" +
           femur.zones();
}

}  // namespace kerf::documents
