// SPDX-License-Identifier: Apache-2.0
#include "documents/made/femur/distal_measures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "documents/made/lines.h"
#include "documents/names.h"
#include "kerf/units.hpp"

namespace kerf::documents {
namespace {

using namespace literals;

constexpr double outside = 100.0_mm;

class DistalFemurMeter {
public:
    DistalFemurMeter(const Anatomy& anatomy, Vec3 medial, Vec3 lateral)
        : lines_(anatomy.phantom), medial_(medial), lateral_(lateral) {}

    std::vector<MeasuredDimension> measure() {
        measure_condyles();
        measure_notch();
        const double canal = lines_.across({0, 0, 90.0_mm}, {1, 0, 0}).size();
        const double side = lines_.to_border({outside, 0, 90.0_mm}, {-1, 0, 0}),
                     other = lines_.to_border({-outside, 0, 90.0_mm}, {1, 0, 0});
        add("shaft.width", 2.0 * outside - side - other);
        add("shaft.canal", canal);
        return std::move(found_);
    }

private:
    void add(const char* name, double value) {
        if (std::isfinite(value)) found_.push_back({name, value});
    }

    /// Returns the largest distance of bone from a plane through the origin, over a grid of lines from outside.
    template <class Line>
    double farthest(double low, double high, double front, double behind, const Line& line) const {
        double max = -HUGE_VAL;
        for (double a = low; a <= high; a += 1.0_mm)
            for (double b = front; b <= behind; b += 1.0_mm)
                if (const double far = line(a, b); std::isfinite(far)) max = std::max(max, outside - far);
        return max;
    }

    void measure_condyles() {
        const double z = medial_.z, y = medial_.y;
        const auto beside = [&](double sign) {
            return farthest(y - 8.0_mm, y + 8.0_mm, z - 8.0_mm, z + 8.0_mm, [&](double at_y, double at_z) {
                return lines_.to_border({sign * outside, at_y, at_z}, {-sign, 0, 0});
            });
        };
        add("condyles.width", beside(1.0) + beside(-1.0));
        // From front to back, over the condyle.
        const auto depth = [&](double low, double high) {
            const auto reach = [&](double sign) {
                return farthest(low, high, z - 16.0_mm, z + 8.0_mm, [&](double at_x, double at_z) {
                    return lines_.to_border({at_x, sign * outside, at_z}, {0, -sign, 0});
                });
            };
            return reach(1.0) + reach(-1.0);
        };
        add("medial_condyle.depth", depth(0.45 * medial_.x, 0.7 * medial_.x));
        add("lateral_condyle.depth", depth(0.7 * lateral_.x, 0.45 * lateral_.x));
    }

    void measure_notch() {
        // In the middle of the notch, from a plane that touches both condyles from below.
        const double y = 3.0 * medial_.y,
                     lowest = farthest(-0.7 * medial_.x, 0.7 * medial_.x, 0.0, y,
                                       [&](double at_x, double at_y) {
                                           return lines_.to_border({at_x, at_y, -outside - 20.0_mm}, {0, 0, 1});
                                       }) +
                              20.0_mm;
        const double roof = outside - lines_.to_border({0, y, -outside}, {0, 0, 1});
        add("notch.depth", lowest - roof);
        add("notch.width", lines_.across({0, y, -lowest + 0.5 * (lowest - roof)}, {1, 0, 0}).size());
    }

    Lines lines_;
    Vec3 medial_, lateral_;
    std::vector<MeasuredDimension> found_;
};

}  // namespace

std::vector<MeasuredDimension> measured_distal_femur(const Anatomy& anatomy) {
    const LandmarkPoint *medial = find_id(anatomy.points, "medial_epicondyle"),
                        *lateral = find_id(anatomy.points, "lateral_epicondyle");
    if (medial == nullptr || lateral == nullptr || anatomy.phantom.parts.empty()) return {};
    return DistalFemurMeter(anatomy, medial->at, lateral->at).measure();
}

}  // namespace kerf::documents
