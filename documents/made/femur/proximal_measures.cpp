// SPDX-License-Identifier: Apache-2.0
#include "documents/made/femur/proximal_measures.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "documents/made/lines.h"
#include "documents/names.h"
#include "kerf/units.hpp"

namespace kerf::documents {
namespace {

using namespace literals;

constexpr Vec3 lateral{1, 0, 0}, back{0, 1, 0}, up{0, 0, 1};

class ProximalFemurMeter {
public:
    ProximalFemurMeter(const Anatomy& anatomy, Vec3 head, const LandmarkAxis& neck, const LandmarkAxis& shaft)
        : lines_(anatomy.phantom), head_(head), neck_(neck), shaft_(shaft) {}

    std::vector<MeasuredDimension> measure() {
        measure_head();
        measure_shaft();
        measure_neck();
        measure_trochanters();
        return std::move(found_);
    }

private:
    void add(const char* name, double value) {
        if (std::isfinite(value)) found_.push_back({name, value});
    }

    void measure_head() {
        // From front to back nothing is attached to it. Its top and its inner side give its centre.
        const double diameter = lines_.across(head_, back).size(), radius = 0.5 * diameter;
        const Vec3 inwards = normalized(Vec3{-1, -1, 1});
        const double above = lines_.to_border(head_, up) - radius;
        const double sideways = lines_.to_border(head_, inwards) - radius;
        const double front = lines_.across(head_, back).middle();
        // sideways = inwards · offset, to first order.
        head_ = head_ + Vec3{(sideways - inwards.y * front - inwards.z * above) / inwards.x, front, above};
        add("head.diameter", diameter);
    }

    void measure_shaft() {
        // Close to the end of the bone, where the shaft is straight.
        const Vec3 low = shaft_.to - 9.0_mm * up, high = shaft_.to + 3.0_mm * up;
        const double width = lines_.across(low, lateral).size();
        const auto middle = [&](Vec3 at) { return at + lines_.across(at, lateral).middle() * lateral; };
        low_ = middle(low), high_ = middle(high);
        add("shaft.width", width);
    }

    void measure_neck() {
        const Vec3 along = normalized(neck_.to - neck_.from), across = normalized(cross(back, along));
        const double stretch = length(neck_.to - neck_.from);
        double height = HUGE_VAL, depth = HUGE_VAL;
        Vec3 waist{};
        for (int i = 0; i <= 60; ++i) {
            const Vec3 at = neck_.from + (0.35 + 0.4 * i / 60.0) * stretch * along;
            const Lines::Chord chord = lines_.across(at, across);
            depth = std::min(depth, lines_.across(at, back).size());
            if (chord.size() >= height) continue;
            height = chord.size(), waist = at + chord.middle() * across;
        }
        const Vec3 neck = normalized(head_ - waist), down = normalized(low_ - high_);
        add("neck.height", height);
        add("neck.depth", depth);
        add("neck.angle", std::acos(std::clamp(dot(neck, down), -1.0, 1.0)));
        const Vec3 from_axis = head_ - low_;
        add("neck.offset", std::abs(from_axis.x - dot(from_axis, down) * down.x));
    }

    void measure_trochanters() {
        // The highest bone above the shaft.
        Vec3 greater{0, 0, -HUGE_VAL};
        for (double x = 3.0_mm; x <= 22.0_mm; x += 0.5_mm)
            for (double y = 0.0; y <= 26.0_mm; y += 0.5_mm) {
                const double far = lines_.to_border({x, y, 70.0_mm}, -1.0 * up);
                if (std::isfinite(far) && 70.0_mm - far > greater.z) greater = {x, y, 70.0_mm - far};
            }
        // The bone that lies farthest to the middle and to the back, below the neck.
        const Vec3 outwards = normalized(Vec3{-0.75, 0.62, 0}), sideways = cross(up, outwards);
        Vec3 lesser{};
        double farthest = 0.0;
        for (double s = -14.0_mm; s <= 14.0_mm; s += 0.5_mm)
            for (double z = -65.0_mm; z <= -12.0_mm; z += 0.5_mm) {
                const Vec3 from = 60.0_mm * outwards + s * sideways + z * up;
                const double far = lines_.to_border(from, -1.0 * outwards);
                if (!std::isfinite(far) || 60.0_mm - far <= farthest) continue;
                farthest = 60.0_mm - far, lesser = from - far * outwards;
            }
        add("greater_trochanter.rise", greater.z - head_.z);
        add("trochanters.distance", length(greater - lesser));
    }

    Lines lines_;
    Vec3 head_;  ///< its centre: the landmark, then the one that is measured
    LandmarkAxis neck_, shaft_;
    Vec3 low_{}, high_{};  ///< middles of the shaft
    std::vector<MeasuredDimension> found_;
};

}  // namespace

std::vector<MeasuredDimension> measured_proximal_femur(const Anatomy& anatomy) {
    const LandmarkPoint* head = find_id(anatomy.points, "head");
    const LandmarkAxis *neck = find_id(anatomy.axes, "neck"), *shaft = find_id(anatomy.axes, "shaft");
    if (head == nullptr || neck == nullptr || shaft == nullptr) return {};
    return ProximalFemurMeter(anatomy, head->at, *neck, *shaft).measure();
}

}  // namespace kerf::documents
