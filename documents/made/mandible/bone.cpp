// SPDX-License-Identifier: Apache-2.0
#include "documents/made/mandible/bone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "documents/made/mandible/teeth.h"

namespace kerf::documents {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double turn = 8.0;  // [deg] of the ramus about its long axis: its back lies farther to the side
constexpr double canal_diameter = 3.0;
const Vec3 body_up{0, 0.08, 1};  // the axis of the chin, which leans back

/// How far the border of a section lies from its middle, in a direction of its own axes (side, up).
double reach(const WrittenSection& section, double side, double up) {
    constexpr int samples = 240;
    const auto power = [&](double c) { return std::copysign(std::pow(std::abs(c), 2.0 / section.exponent), c); };
    double farthest = 0.0;
    for (int i = 0; i < samples; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / samples;
        const double y = power(std::sin(angle)), x = power(std::cos(angle)) * (1.0 - section.taper * y);
        farthest = std::max(farthest, 0.5 * section.width * x * side + 0.5 * section.height * y * up);
    }
    return farthest;
}

/// Returns the largest width of a section, in its `width` [–].
double widest(double exponent, double taper) {
    return reach({.width = 2, .height = 2, .exponent = exponent, .taper = taper}, 1.0, 0.0);
}

/// Half of an ellipsoid's size in a direction. Columns of unit vectors and half axes.
double reach(const std::array<Vec3, 3>& axes, Vec3 half, Vec3 direction) {
    return std::sqrt(std::pow(half.x * dot(axes[0], direction), 2) + std::pow(half.y * dot(axes[1], direction), 2) +
                     std::pow(half.z * dot(axes[2], direction), 2));
}

/// Axes of the right condyle: its lateral pole lies farther in front.
std::array<Vec3, 3> condyle_axes() {
    const Vec3 lateral = normalized(Vec3{-1, -0.18, 0}), up{0, 0, 1};
    return {lateral, cross(up, lateral), up};
}

LoftSolid laid(const WrittenLoft& written) {
    LoftSolid loft;
    loft.up = normalized(written.up);
    for (const WrittenSection& s : written.sections)
        loft.sections.push_back({.at = 1e-3 * s.at,
                                 .width = 1e-3 * s.width,
                                 .height = 1e-3 * s.height,
                                 .exponent = s.exponent,
                                 .taper = s.taper,
                                 .turn = s.turn * degree});
    lay_path(loft);
    return loft;
}

}  // namespace

MandibleBone::MandibleBone(const DimensionValues& values) : v_(values), frame_(values) {
    const double across = mm("condyle.width"), along = mm("condyle.depth");
    condyle_half_ = 0.5 * Vec3{across, along, 1.06 * along};
    const auto axes = condyle_axes();
    const auto reaches = [&](Vec3 direction) { return reach(axes, condyle_half_, direction); };
    const double x = -0.5 * mm("bicondylar.width") + reaches({1, 0, 0});
    condyle_at_ = frame_.in_ramus(x, mm("ramus.height") - reaches(frame_.up), reaches(frame_.behind));
    const WrittenSection blade{.width = mm("ramus.thickness"), .height = mm("ramus.width"), .exponent = 3.0};
    ramus_middle_ = 0.5 * mm("bigonial.width") - mm("gonial.flare") -
                    reach(blade, std::cos(turn * degree), std::sin(turn * degree));
    const LoftSolid laid_body = laid(body());
    crest_ = crest_of(laid_body);
    bend_of_body_ = crossing(laid_body);
}

/// |x| of the middle of the ramus at a height. It leads outwards to the condyle, most of it in the neck.
double MandibleBone::ramus_x(double height) const {
    return ramus_middle_ + 0.12 * (-condyle_at_.x - ramus_middle_) * (height / mm("ramus.height") - 0.5);
}

WrittenLoft MandibleBone::body() const {
    struct Station {
        double ahead, x;  // on the path
        double height, width, exponent, taper;
    };
    const double first = mm("body.height"), chin = mm("symphysis.height"), thick = mm("body.thickness"),
                 chin_thick = mm("symphysis.thickness");
    const auto between = [](double a, double b, double t) { return a + t * (b - a); };
    const double at_molar = thick / widest(2.8, 0.1), at_chin = chin_thick / widest(2.6, 0.28);
    // The chin reaches the length of the body, and every section touches the lower border from above.
    const WrittenSection middle{.width = at_chin, .height = chin, .exponent = 2.6, .taper = 0.28};
    const Vec3 up = normalized(body_up), front = cross(up, Vec3{1, 0, 0});
    const double to_chin = mm("body.length") - reach(middle, dot(front, frame_.ahead), dot(up, frame_.ahead));
    const double round = 0.13 * ramus_middle_;  // the chin is as round in a long jaw as in a short one
    const auto x = [&](double part) { return part * ramus_middle_; };
    const std::array stations{
        Station{0.080 * to_chin, x(0.980), 0.60 * first, 0.48 * at_molar, 2.6, 0.10},
        Station{0.251 * to_chin, x(0.862), 0.83 * first, 0.87 * at_molar, 2.6, 0.12},
        Station{0.484 * to_chin, x(0.689), 0.96 * first, at_molar, 2.8, 0.10},
        Station{0.717 * to_chin, x(0.512), between(first, chin, 0.2), at_molar, 2.8, 0.10},
        Station{to_chin - round, x(0.310), between(first, chin, 0.75), 0.5 * (at_molar + at_chin), 2.7, 0.22},
        Station{to_chin - 0.25 * round, x(0.155), between(first, chin, 0.94), at_chin, 2.6, 0.28},
        Station{to_chin, 0.0, chin, at_chin, 2.6, 0.28}};
    WrittenLoft loft{.up = body_up, .rim = 2.0};
    const std::size_t count = 2 * stations.size() - 1;
    const auto station = [&](std::size_t i) { return stations[std::min(i, count - 1 - i)]; };
    for (std::size_t i = 0; i < count; ++i) {
        const Station s = station(i);
        loft.sections.push_back({.at = frame_.in_body(2 * i < count ? -s.x : s.x, s.ahead, 0.5 * s.height),
                                 .width = s.width,
                                 .height = s.height,
                                 .exponent = s.exponent,
                                 .taper = s.taper});
    }
    constexpr std::size_t in_front = 4, chin_at = 6;  // stations of the chin, between which the path is a parabola
    constexpr int passes = 5;                         // the path turns a little by what is moved
    double grown = 1.0;
    const double in_gap = first_molar_from_midline(mm("first_molar.width")) - 0.5 * mm("first_molar.width");
    for (int pass = 0; pass < passes; ++pass) {
        const LoftSolid path = laid(loft);
        // The body has its height in front of the first molar, wherever that is.
        for (const CrestPoint& point : crest_of(path))
            if (point.from_midline >= in_gap) {
                const WrittenSection there{.width = 2e3 * point.body.half_width,
                                           .height = 2e3 * point.body.half_height,
                                           .exponent = point.body.exponent,
                                           .taper = point.body.taper};
                const double side = dot(point.body.side, frame_.above), along_up = dot(point.body.up, frame_.above);
                grown *= pass == 0 ? 1.0 : first / (reach(there, -side, -along_up) + reach(there, side, along_up));
                break;
            }
        const std::size_t step = (path.path.size() - 1) / (count - 1);
        std::array<double, stations.size()> lifts{};
        for (std::size_t i = 0; i < stations.size(); ++i) {
            const LoftFrame& frame = path.path[i * step];
            WrittenSection& one = loft.sections[i];
            const auto reaches = [&](double sign) {
                return reach(one, sign * dot(frame.side, frame_.above), sign * dot(frame.up, frame_.above));
            };
            // Heights of the body are seen from the side; that of the chin lies in its axis.
            if (i < in_front) one.height *= grown * stations[i].height / (reaches(-1.0) + reaches(1.0));
            lifts[i] = reaches(-1.0);
        }
        lifts[0] += 0.13 * stations[0].height;  // inside of the ramus, clear of the border
        const double part = stations[in_front + 1].x / stations[in_front].x;
        lifts[in_front + 1] = between(lifts[chin_at], lifts[in_front], part * part);
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t of = std::min(i, count - 1 - i);
            loft.sections[i].height = loft.sections[of].height;
            loft.sections[i].at = frame_.in_body(loft.sections[i].at.x, stations[of].ahead, lifts[of]);
        }
    }
    return loft;
}

/// Returns the crest of the right side, from the chin back, with the frames of the body below it. It ends where it
/// meets the ramus.
std::vector<CrestPoint> MandibleBone::crest_of(const LoftSolid& body) const {
    std::vector<CrestPoint> crest;
    for (std::size_t i = body.path.size() / 2 + 1; i-- > 0;) {  // the path begins on the right
        const LoftFrame& frame = body.path[i];
        CrestPoint point{.at = 1e3 * (frame.at + frame.half_height * frame.up), .along = frame.along, .body = frame};
        if (!crest.empty()) {
            point.from_midline = crest.back().from_midline + length(point.at - crest.back().at);
            if (-dot(point.at, frame_.behind) < 0.88 * mm("ramus.width")) break;
        }
        crest.push_back(point);
    }
    return crest;
}

WrittenLoft MandibleBone::ramus() const {
    const double width = mm("ramus.width"), thick = mm("ramus.thickness"), height = mm("ramus.height");
    const WrittenSection blade{.width = thick, .height = width, .exponent = 3.0};
    const double full = width * 0.5 * width / reach(blade, std::sin(turn * degree), std::cos(turn * degree));
    const double top = notch_height() + 2.5, upper = std::min(0.6 * height, top - 6.0);
    WrittenLoft loft{.up = {0, 1, 0}, .rim = 1.0};
    const auto add = [&](double at, double thickness, double across, double exponent) {
        loft.sections.push_back({.at = frame_.in_ramus(-ramus_x(at), at, 0.5 * width),
                                 .width = thickness,
                                 .height = across,
                                 .exponent = exponent,
                                 .turn = turn});
    };
    add(0.094 * width, 0.73 * thick, 0.69 * width, 2.6);
    add(0.44 * width, 1.06 * thick, full, 3);
    add(0.5 * (0.44 * width + upper), thick, full, 3);
    add(upper, 0.92 * thick, full, 3);
    add(top, 0.83 * thick, 0.72 * width, 3);
    return loft;
}

std::string MandibleBone::angle() const {
    // A disc that touches both borders, turned out.
    const double radius = 0.372 * mm("ramus.width"), half = 0.55 * mm("ramus.thickness"), exponent = 2.4;
    const Vec3 along = normalized(Vec3{-1, -0.25, 0.2});
    const double q = exponent / (exponent - 1.0), in_disc = std::hypot(along.y, along.z);
    const double reaches = std::pow(std::pow(-half * along.x, q) + std::pow(radius * in_disc, q), 1.0 / q);
    // Its fillet reaches a little farther than the disc.
    const Vec3 centre = (radius + 1.3) / std::sin(v_["gonial.angle"]) * (frame_.up + frame_.ahead) +
                        Vec3{-0.5 * mm("bigonial.width") + reaches, 0, 0};
    return "    - id: angle\n      superellipsoid: {centre: " + vector_text(centre) +
           " mm, length: " + rounded_text(2 * half) + " mm, width: " + rounded_text(2 * radius) +
           " mm, height: " + rounded_text(2 * radius) + " mm, exponent: " + rounded_text(exponent) +
           ", along: 1 0.25 -0.2, up: 0 0.8 0.6}\n      blend: 3 mm\n      mirror: true\n";
}

/// Height of the notch's lowest point: it is measured from the line between condyle and coronoid process.
double MandibleBone::notch_height() const {
    const double condyle = mm("ramus.height"), coronoid = mm("coronoid.height");
    return condyle + 0.47 * (coronoid - condyle) - mm("notch.depth");
}

WrittenLoft MandibleBone::neck() const {
    const double width = mm("ramus.width"), thick = mm("ramus.thickness");
    const double across = mm("condyle.width"), deep = mm("condyle.depth"), size = mm("ramus.height") / 62.5;
    const double high = dot(condyle_at_, frame_.up), depth = -dot(condyle_at_, frame_.behind);
    WrittenLoft loft{.up = {0, 1, 0}};
    const auto add = [&](double below, double in_front, double outwards, double thickness, double height) {
        const double at = high - below * size, x = ramus_x(at);
        loft.sections.push_back({.at = frame_.in_ramus(-x - outwards * (-condyle_at_.x - x), at, in_front),
                                 .width = thickness,
                                 .height = height,
                                 .turn = turn});
    };
    add(25.4, 0.265 * width, 0.0, 0.48 * thick, 0.4 * width);
    add(14.2, 0.205 * width, 0.2, 0.74 * thick, 0.39 * width);
    add(7.0, depth + 0.2, 0.56, 0.47 * across, 0.92 * deep);
    add(1.0, depth, 0.94, 0.76 * across, 0.66 * deep);
    return loft;
}

std::string MandibleBone::condyle() const {
    return "    - id: condyle\n      superellipsoid: {centre: " + vector_text(condyle_at_) +
           " mm, length: " + rounded_text(2 * condyle_half_.x) + " mm, width: " + rounded_text(2 * condyle_half_.y) +
           " mm, height: " + rounded_text(2 * condyle_half_.z) +
           " mm, along: -1 -0.18 0, up: 0 0 1}\n      blend: 2.5 mm\n      mirror: true\n";
}

Vec3 MandibleBone::condylion() const {
    const auto axes = condyle_axes();
    const double reaches = reach(axes, condyle_half_, frame_.behind);
    const double half[] = {condyle_half_.x, condyle_half_.y, condyle_half_.z};
    Vec3 at = condyle_at_;
    for (std::size_t i = 0; i < axes.size(); ++i)
        at = at + half[i] * half[i] * dot(axes[i], frame_.behind) / reaches * axes[i];
    return at;
}

WrittenLoft MandibleBone::coronoid() const {
    const double width = mm("ramus.width"), thick = mm("ramus.thickness"), rim = 1.5;
    // Its end is square to its path, so an edge reaches farther than the middle.
    const double tip = mm("coronoid.height") - 0.3 * (0.095 * width - rim);
    WrittenLoft loft{.up = {0, 1, 0}, .rim = rim};
    const auto add = [&](double part, double depth, double thickness, double height) {
        const double at = part * tip;
        loft.sections.push_back({.at = frame_.in_ramus(-ramus_x(at) + 1.0 * part, at, depth * width),
                                 .width = thickness * thick,
                                 .height = height * width,
                                 .turn = turn});
    };
    add(0.514, 0.71, 0.48, 0.40);
    add(0.716, 0.79, 0.72, 0.43);
    add(0.852, 0.80, 0.72, 0.30);
    add(1.0, 0.77, 0.64, 0.19);
    return loft;
}

std::string MandibleBone::notch() const {
    const double radius = 0.155 * mm("ramus.width");
    const Vec3 at = frame_.in_ramus(0, notch_height() + radius, 0.47 * mm("ramus.width"));
    return solid_part("notch", tube_text({-ramus_middle_ - 16, at.y, at.z}, {-ramus_middle_ + 14, at.y, at.z}, radius),
                      {.blend = 2.0, .mirror = true, .subtract = true});
}

Vec3 MandibleBone::canal_below(double from_midline) const {
    std::size_t i = 0;
    while (i + 1 < crest_.size() && crest_[i].from_midline < from_midline) ++i;
    const LoftFrame& frame = crest_[i].body;
    const double radius = 0.5 * canal_diameter, half_height = 1e3 * frame.half_height;
    const double up = mm("canal.below") + radius - half_height, part = up / half_height;
    const double half_width = 1e3 * frame.half_width * (1.0 - frame.taper * part) *
                              std::pow(1.0 - std::pow(std::abs(part), frame.exponent), 1.0 / frame.exponent);
    return 1e3 * frame.at + up * frame.up - (half_width - mm("canal.buccal") - radius) * frame.side;  // to the side
}

WrittenLoft MandibleBone::canal(double side) const {
    const double height = mm("ramus.height"), width = mm("ramus.width");
    const double molar = first_molar_from_midline(mm("first_molar.width")), last = crest_.back().from_midline;
    WrittenLoft loft{.up = {1, 0, 0}};
    const auto add = [&](Vec3 at, double diameter = canal_diameter) {
        loft.sections.push_back({.at = {-side * at.x, at.y, at.z}, .width = diameter, .height = diameter});
    };
    add(canal_below(molar - 9.0 / 11.0 * mm("first_molar.width")));  // below the second premolar
    add(canal_below(molar));
    add(canal_below(0.5 * (molar + last) + 3.0));
    const auto in_ramus = [&](double medial, double at, double depth) {
        return frame_.in_ramus(-ramus_x(at * height) + medial, at * height, depth * width);
    };
    add(in_ramus(2.6, 0.09, 0.64), 2.8);
    add(in_ramus(0.5, 0.233, 0.53), 2.5);  // the ramus is thin
    add(in_ramus(0.0, 0.38, 0.5), 2.5);
    return loft;
}

Vec3 MandibleBone::mental(double side, double part) const {
    const Vec3 from = canal(side).sections.front().at;
    const double size = part * (mm("canal.buccal") + 4.5) / 10.0;
    return from + size * Vec3{side * 8.2, -4.1, 1.5};
}

std::string MandibleBone::parts() const {
    return loft_part(
               "body", body(),
               {.source = "Lengths, heights and thicknesses: the dimensions above. The arch between them is that of "
                          "no published jaw."}) +
           loft_part("ramus", ramus(), {.blend = 5.0, .mirror = true}) + angle() +
           loft_part("neck", neck(), {.blend = 1.2, .mirror = true}) + condyle() +
           loft_part("coronoid", coronoid(), {.blend = 1.2, .mirror = true}) + notch();
}

std::string MandibleBone::canal_parts() const {
    return loft_part("canal", canal(-1),
                     {.mirror = true, .subtract = true, .source = "3 mm wide, less in the ramus."}) +
           solid_part("canal_mental", tube_text(mental(-1, 0), mental(-1, 1), 1.5),
                      {.blend = 0.8, .mirror = true, .subtract = true});
}

double MandibleBone::bend_of_others() const {
    return std::max(
        {crossing(laid(ramus())), crossing(laid(neck())), crossing(laid(coronoid())), crossing(laid(canal(-1)))});
}

}  // namespace kerf::documents
