// SPDX-License-Identifier: Apache-2.0
#include "bit_stiffness.h"

#include <algorithm>
#include <cstddef>

#include "kerf/beam.hpp"

namespace kerf::drilling {

namespace {

/// Calls `each(x1, x2, EI)` for each piece of constant diameter, from the tip backwards.
template <class Each>
void for_each_piece(const TwistDrill& drill, const Each& each) {
    const auto stiffness_of = [&](double radius) {
        const double d = 2.0 * std::min(radius, drill.shank_radius());
        return stainless_steel * 0.5 * pi * d * d * d * d / 64.0;
    };
    double x = 0.0;
    const auto add = [&](double end, double radius) {
        if (end <= x) return;
        each(x, end, stiffness_of(radius));
        x = end;
    };
    add(std::min(drill.point_depth(), drill.length), drill.radius());
    for (std::size_t i = 0; i < drill.corner_count; ++i)
        add(std::min(drill.corners[i].depth, drill.length), drill.corners[i].radius);
    add(drill.length, drill.shank_radius());
}

}  // namespace

Outline::Bending tip_bending(const TwistDrill& drill) noexcept {
    Outline::Bending tip{};
    for_each_piece(drill, [&](double x1, double x2, double ei) {
        tip.deflection += (x2 * x2 * x2 - x1 * x1 * x1) / (3.0 * ei);
        tip.slope += (x2 * x2 - x1 * x1) / (2.0 * ei);
    });
    return tip;
}

double shank_stiffness(const TwistDrill& drill, Outline::Bending tip, double z, double contact) noexcept {
    const double a = -z;
    double gives = 0.0;
    for_each_piece(drill, [&](double x1, double x2, double ei) {
        if (x2 <= a) return;
        const double from = std::max(0.0, x1 - a), to = x2 - a;
        gives += (to * to * to - from * from * from) / (3.0 * ei);
    });
    const double shaped = tip.deflection - a * tip.slope;
    const double rest = gives - shaped * shaped / tip.deflection;
    return rest > 0.0 ? in_series(1.0 / rest, contact) : contact;
}

}  // namespace kerf::drilling
