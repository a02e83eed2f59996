// SPDX-License-Identifier: Apache-2.0
#include "conformance/sweep.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "conformance/parameter_sets.h"

namespace kerf::conformance {

namespace {

/// How often one size is the other, if both are worth it: more than `slight` [N].
double ratio_of(double a, double b, double slight) {
    return std::max({a, b, slight}) / std::max(std::min(a, b), slight);
}

/// Two points of a path and their sizes.
struct Interval {
    double low, high;
    Sizes of_low, of_high;

    [[nodiscard]] double ratio(std::size_t which, double slight) const {
        return ratio_of(of_low[which], of_high[which], slight);
    }
};

/// Narrows an interval down on a jump of the force. Returns its text, empty without one.
std::string jump_in(const Sweep& sweep, std::size_t which, Interval in, double slight) {
    constexpr double jump = 2.5;  // [–] in the narrowest interval: more than a motor that stalls makes
    for (int i = 0; i < 9 && in.ratio(which, slight) > jump; ++i) {
        Sizes between{};
        const double middle =
            in.low > 0.0 && in.high > 20.0 * in.low ? std::sqrt(in.low * in.high) : 0.5 * (in.low + in.high);
        if (!sizes_at(sweep, middle, between) || between[which] < 0.0) return {};
        const bool is_below =
            ratio_of(in.of_low[which], between[which], slight) > ratio_of(between[which], in.of_high[which], slight);
        (is_below ? in.high : in.low) = middle;
        (is_below ? in.of_high : in.of_low) = between;
    }
    if (in.ratio(which, slight) <= jump || std::min(in.of_low[which], in.of_high[which]) < 0.0) return {};
    return "With " + sweep.named(in.low) + " it makes " + number(in.of_low[which]) + " N, and with " +
           sweep.named(in.high) + " " + number(in.of_high[which]) + " N, " + name_of_size[which] +
           ", expected no jump.";
}

}  // namespace

bool sizes_at(const Sweep& sweep, double value, Sizes& sizes) {
    const kerf_component& tool = *sweep.subject.tool;
    WalkSettings settings = sweep.settings(value);
    LawProbe running(sweep.subject, settings);
    if (!running.refusal().empty()) return false;
    const auto size = [&](const Vec6& rate) {
        const Response r = running.move(at_depth(0), rate, 2);  // a motor stalls later
        return tool.tool->drive_count > 0 && r.cut_ticks < r.ticks ? -1.0 : length(r.force());
    };
    sizes[0] = size(running.feed(probe_speed));
    sizes[1] = size({probe_speed, 0, 0, 0, 0, 0});
    settings.bone.shape = PlaneBone::Shape::plate;
    settings.drives = drives_at_rest(tool);
    LawProbe resting(sweep.subject, settings);
    sizes[2] = resting.evaluate(at_depth(0.1e-3)) ? length(linear(resting.law().force_at({}))) : 0.0;
    return true;
}

std::string jump_along(const Sweep& sweep, const std::vector<double>& points) {
    constexpr double suspicious = 3.0;  // [–] between neighbours
    std::vector<Sizes> sizes(points.size());
    std::vector<bool> is_made;
    for (std::size_t i = 0; i < points.size(); ++i) is_made.push_back(sizes_at(sweep, points[i], sizes[i]));
    for (std::size_t which = 0; which < 3; ++which) {
        double largest = 0.0;
        for (const Sizes& one : sizes) largest = std::max(largest, one[which]);
        const double slight = std::max(0.1 * largest, 1e-9);
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            const Interval in{points[i], points[i + 1], sizes[i], sizes[i + 1]};
            if (!is_made[i] || !is_made[i + 1] || std::min(in.of_low[which], in.of_high[which]) < 0.0) continue;
            if (in.ratio(which, slight) < suspicious) continue;
            if (std::string text = jump_in(sweep, which, in, slight); !text.empty()) return text;
        }
    }
    return {};
}

}  // namespace kerf::conformance
