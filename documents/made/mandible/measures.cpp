// SPDX-License-Identifier: Apache-2.0
#include "documents/made/mandible/measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "documents/made/lines.h"
#include "kerf/units.hpp"

namespace kerf::documents {
namespace {

using namespace literals;

constexpr double around = 100e-3;  // [m] from where lines come

/// A line of the sagittal plane.
struct Border {
    Vec3 at{}, along{};
};

/// Returns the largest value of a function over a range: on a grid, and then between its neighbours.
template <class F>
double largest(double low, double high, int count, const F& value) {
    const double step = (high - low) / count;
    double best = low, max = -HUGE_VAL;
    for (int i = 0; i <= count; ++i)
        if (const double found = value(low + step * i); found > max) best = low + step * i, max = found;
    for (double half = 0.5 * step; half > 0.1_mm; half *= 0.5)
        for (const double at : {best - half, best + half})
            if (const double found = value(at); found > max) best = at, max = found;
    return max;
}

/// Returns the upper hull of points at a position. Pre: positions ascend; `at` lies between the first and the last.
struct Sample {
    double at = 0.0, value = 0.0;
};
double hull_at(const std::vector<Sample>& samples, double at) {
    double highest = -HUGE_VAL;
    for (const Sample& a : samples)
        for (const Sample& b : samples)
            if (a.at <= at && b.at > at)
                highest = std::max(highest, a.value + (at - a.at) / (b.at - a.at) * (b.value - a.value));
    return highest;
}

class MandibleMeter {
public:
    struct Landmarks {
        Vec3 gonion{}, condylion{}, menton{};
        Vec3 molar{}, premolar{};       ///< middles of the crowns
        double molar_half_width = 0.0;  ///< along the row
        const LoftSolid* nerve = nullptr;
    };
    MandibleMeter(const PhantomSource& bone, const Landmarks& landmarks) : lines_(bone), of_(landmarks) {}

    std::vector<MeasuredDimension> measure() {
        measure_borders();
        measure_condyle();
        measure_ramus();
        measure_chin();
        measure_at_molar();
        return std::move(found_);
    }

private:
    void add(const char* name, double value) {
        if (std::isfinite(value)) found_.push_back({name, value});
    }
    /// Returns the coordinate, along `from_outside` and inwards, at which a line through a point first meets bone.
    [[nodiscard]] double first_bone(Vec3 through, Vec3 inwards) const {
        const double far = lines_.to_border(through - around * inwards, inwards);
        return std::isfinite(far) ? far - around : HUGE_VAL;
    }
    [[nodiscard]] Vec3 at(double x, double up, double in_front) const {
        return Vec3{x, 0, 0} + corner_ + up * up_ - in_front * behind_;
    }

    void measure_borders() {
        // How far behind or below bone is, seen from the side.
        const double medial = std::max(of_.gonion.x, of_.condylion.x) + 5.0_mm,
                     lateral = std::min(of_.gonion.x, of_.condylion.x) - 6.0_mm;
        const double from = of_.gonion.z, to = of_.condylion.z;
        std::vector<Sample> posterior, lower;
        for (const double part : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 1.0, 1.03}) {
            const double z = from + part * (to - from);
            posterior.push_back({z, largest(lateral, medial, 8, [&](double x) {
                                     return -first_bone({x, 0, z}, {0, -1, 0});
                                 })});
        }
        const double back = of_.gonion.y, front = of_.menton.y;
        for (const double part : {1.02, 1.0, 0.97, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1}) {
            const double y = back + part * (front - back);
            lower.push_back({y, largest(lateral, 0.0, 14, [&](double x) {
                                 return -first_bone({x, y, 0}, {0, 0, 1});
                             })});
        }
        const auto line = [](const std::vector<Sample>& samples, double a, double b) {
            const double low = a + 0.25 * (b - a), high = a + 0.75 * (b - a);
            return std::array{Sample{low, hull_at(samples, low)}, Sample{high, hull_at(samples, high)}};
        };
        const auto of_posterior = line(posterior, from, to), of_lower = line(lower, front, back);
        const Vec3 p{0, of_posterior[0].value, of_posterior[0].at}, q{0, of_posterior[1].value, of_posterior[1].at};
        const Vec3 r{0, of_lower[1].at, -of_lower[1].value}, s{0, of_lower[0].at, -of_lower[0].value};
        up_ = normalized(q - p), ahead_ = normalized(s - r);
        behind_ = {0, up_.z, -up_.y}, above_ = {0, ahead_.z, -ahead_.y};
        corner_ = p + dot(r - p, above_) / dot(up_, above_) * up_;
        add("gonial.angle", std::acos(dot(up_, ahead_)));
        add("mandibular_plane.angle", std::atan2(-ahead_.z, -ahead_.y));

        double half = 0.0;
        for (double up = 1.0_mm; up < 20.0_mm; up += 2.0_mm)
            half = std::max(half, largest(0.0, 20.0_mm, 8, [&](double in_front) {
                                const Vec3 through = at(0, 0, 0) + up * up_ + in_front * ahead_;
                                return -first_bone(through, {1, 0, 0});
                            }));
        add("bigonial.width", 2.0 * half);
        half_bigonial_ = half;
    }

    void measure_condyle() {
        const Vec3 c = of_.condylion;
        double lateral = -HUGE_VAL, medial = -HUGE_VAL, top = -HUGE_VAL;
        for (double z = c.z - 1.5_mm; z <= c.z + 3.5_mm; z += 1.0_mm) {  // above the neck
            const auto outwards = [&](double y) { return -first_bone({0, y, z}, {1, 0, 0}); };
            // From the middle of the head, so that the other condyle is not met.
            const auto inwards = [&](double y) { return -lines_.to_border({0, y, z}, {-1, 0, 0}); };
            lateral = std::max(lateral, largest(c.y - 10.0_mm, c.y, 5, outwards));
            medial = std::max(medial, largest(c.y - 10.0_mm, c.y, 5, inwards));
        }
        add("bicondylar.width", 2.0 * lateral);
        add("condyle.width", lateral + medial);
        const double middle = -0.5 * (lateral - medial);
        for (double x = middle - 6.0_mm; x <= middle + 6.0_mm; x += 3.0_mm)
            top = std::max(
                top, largest(0.0, 10.0_mm, 5, [&](double in_front) { return -first_bone(at(x, 0, in_front), -up_); }));
        height_ = top;
        add("ramus.height", top);
        // Across its long axis, where it is shortest.
        double depth = HUGE_VAL;
        const Vec3 head{middle,
                        0.5 * (first_bone({middle, 0, c.z}, {0, 1, 0}) - first_bone({middle, 0, c.z}, {0, -1, 0})),
                        c.z + 0.5_mm};
        for (double angle = -24.0_deg; angle <= 24.0_deg; angle += 3.0_deg)
            depth = std::min(depth, lines_.across(head, {std::sin(angle), std::cos(angle), 0}).size());
        add("condyle.depth", depth);
    }

    void measure_ramus() {
        // Seen from the side, where it is narrowest.
        const double outside = of_.gonion.x - 4.0_mm, inside = of_.gonion.x + 12.0_mm;
        double width = HUGE_VAL;
        for (const double part : {0.44, 0.5, 0.56}) {
            const auto farthest = [&](Vec3 inwards) {
                return largest(outside, inside, 8,
                               [&](double x) { return -first_bone(at(x, part * height_, 0), inwards); });
            };
            width = std::min(width, farthest(-behind_) + farthest(behind_));
        }
        add("ramus.width", width);
        const auto thickness = [&](double in_front) {
            const Vec3 through = at(0, 0.45 * height_, in_front);
            return -first_bone(through, {1, 0, 0}) - lines_.to_border(through, {-1, 0, 0});
        };
        add("ramus.thickness", thickness(0.5 * width));
        const double lateral = largest(0.1 * width, 0.9 * width, 8, [&](double in_front) {
            return -first_bone(at(0, 0.5 * height_, in_front), {1, 0, 0});
        });
        add("gonial.flare", half_bigonial_ - lateral);

        // Its upper border from above: condyle, notch, coronoid process.
        const auto top = [&](double in_front) {
            return largest(outside, inside, 6, [&](double x) { return -first_bone(at(x, 0, in_front), -up_); });
        };
        double coronoid = -HUGE_VAL, tip = 0.0;
        std::vector<Sample> between;
        for (double in_front = 0.25 * width; in_front < 0.95 * width; in_front += 0.75_mm) {
            const double found = top(in_front);
            between.push_back({in_front, found});
            if (in_front > 0.6 * width && found > coronoid) coronoid = found, tip = in_front;
        }
        add("coronoid.height", coronoid);
        double depth = -HUGE_VAL;
        const double condyle = dot(corner_ - of_.condylion, behind_) + 4.5_mm;
        for (const Sample& sample : between)
            if (sample.at < tip)
                depth = std::max(
                    depth, height_ + (coronoid - height_) * (sample.at - condyle) / (tip - condyle) - sample.value);
        add("notch.depth", depth);
    }

    void measure_chin() {
        add("body.length", largest(-1.0_mm, 14.0_mm, 10,
                                   [&](double height) { return -first_bone(corner_ + height * above_, -ahead_); }));
        const double from = of_.menton.z + 3.0_mm, to = of_.menton.z + 24.0_mm;
        const double behind_chin = 30.0_mm;  // from the tongue forward
        const auto back_of = [&](double z) {
            return of_.menton.y + behind_chin - lines_.to_border({0, of_.menton.y + behind_chin, z}, {0, -1, 0});
        };
        const auto thickness = [&](double z) { return back_of(z) - first_bone({0, 0, z}, {0, 1, 0}); };
        add("symphysis.thickness", largest(from, to, 14, thickness));
        const double middle_z = 0.5 * (from + to),
                     y = 0.5 * (back_of(middle_z) + first_bone({0, 0, middle_z}, {0, 1, 0}));
        add("symphysis.height", lines_.across({0, y, middle_z}, {0, 0, 1}).size());
    }

    void measure_at_molar() {
        // Between the last premolar and the molar, where the crest has no root.
        const Vec3 row = normalized(of_.premolar - of_.molar);
        std::size_t nearest = 0;
        const std::vector<LoftFrame>& path = of_.nerve->path;
        for (std::size_t i = 0; i < path.size(); ++i)
            if (std::abs(dot(path[i].at - of_.molar, row)) < std::abs(dot(path[nearest].at - of_.molar, row)))
                nearest = i;
        const Vec3 canal = path[nearest].at;
        const auto past_wall = [&](Vec3 along) {
            const double wall = lines_.to_border(canal, along) + 0.01_mm;
            return lines_.to_border(canal + wall * along, along);
        };
        // Across the body where that is shortest, a little above the canal.
        const Vec3 lateral = normalized(cross(Vec3{0, 0, 1}, row)), outwards = lateral.x < 0.0 ? lateral : -lateral;
        const Vec3 middle = canal + 5.0_mm * above_;
        double shortest = HUGE_VAL;
        Vec3 across = outwards;
        for (double angle = -24.0_deg; angle <= 24.0_deg; angle += 2.0_deg) {
            const Vec3 along = std::cos(angle) * outwards + std::sin(angle) * Vec3{0, 0, 1};
            if (const double size = lines_.across(middle, along).size(); size < shortest)
                shortest = size, across = along;
        }
        const Vec3 along_body = normalized(cross(across, row));
        const Vec3 upwards = along_body.z > 0.0 ? along_body : -along_body;
        add("body.thickness", largest(-1.0_mm, 8.0_mm, 6, [&](double height) {
                return lines_.across(middle + height * upwards, across).size();
            }));
        add("canal.buccal", past_wall(across));
        add("canal.below", past_wall(-upwards));
        // Above the middle of the body, between both teeth, whose necks stand on the crest.
        const Vec3 inside = middle + lines_.across(middle, across).middle() * across;
        double height = HUGE_VAL;
        for (const double aside : {-0.8_mm, -0.4_mm, 0.0_mm, 0.4_mm, 0.8_mm}) {
            const Vec3 from = inside + (of_.molar_half_width + aside) * row;
            const Vec3 crest = from + lines_.to_border(from, upwards) * upwards;
            height = std::min(height, dot(crest - corner_, above_));
        }
        add("body.height", height);
    }

    Lines lines_;
    Landmarks of_;
    Vec3 up_{}, behind_{}, ahead_{}, above_{}, corner_{};  ///< of the borders, seen from the side
    double height_ = 0.0, half_bigonial_ = 0.0;
    std::vector<MeasuredDimension> found_;
};

}  // namespace

std::vector<MeasuredDimension> measured_mandible(const Anatomy& anatomy) {
    MandibleMeter::Landmarks landmarks;
    const auto point = [&](const char* id, Vec3& at) {
        for (const LandmarkPoint& p : anatomy.points)
            if (p.id == id) return at = p.at, true;
        return false;
    };
    const auto crown = [&](const char* id, Vec3& at, double* half_width) {
        for (const PhantomPart& part : anatomy.phantom.parts)
            if (const auto* solid = std::get_if<SuperellipsoidSolid>(&part.solid); solid && part.id == id) {
                if (half_width != nullptr) *half_width = 0.5 * solid->height;
                return at = solid->centre, true;
            }
        return false;
    };
    for (const Zone& zone : anatomy.zones)
        if (zone.id == "nerve_right" && !zone.solids.empty())
            landmarks.nerve = std::get_if<LoftSolid>(&zone.solids.front());
    if (!point("gonion_right", landmarks.gonion) || !point("condylion_right", landmarks.condylion) ||
        !point("menton", landmarks.menton) || !crown("molar_1_crown", landmarks.molar, &landmarks.molar_half_width) ||
        !crown("premolar_2_crown", landmarks.premolar, nullptr) || landmarks.nerve == nullptr)
        return {};
    return MandibleMeter(anatomy.phantom, landmarks).measure();
}

}  // namespace kerf::documents
