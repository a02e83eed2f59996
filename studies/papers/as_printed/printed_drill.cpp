// SPDX-License-Identifier: Apache-2.0
#include "printed_drill.h"

#include <algorithm>
#include <cmath>

#include "kerf/figure.hpp"

namespace kerf::as_printed {

PaperDrill PaperBit::drill() const noexcept {
    const double radius = 0.5 * diameter;
    return {radius, web * radius, length, sin_cos_exact(0.5 * point_angle)};
}

Outline PaperBit::outline() const noexcept {
    using namespace literals;
    const PaperDrill d = drill();
    const double land = 0.5 * d.radius, end = d.point_depth() + land;
    if (!(end < length))
        return refuse("`length` is ", in_mm(length), "; it needs more than ", in_mm(end),
                      ", where the land behind the point ends.");
    return revolution({{0.0, 0.0}, {-d.point_depth(), d.radius}, {-d.point_depth() - land, d.radius}})
        .cuts()
        .to(-length, d.radius)
        .gripped_at(-length - 40.0_mm);
}

LipPoints lip_points(const PaperDrill& drill, double interval, double angle) noexcept {
    LipPoints points;
    const double b = drill.half_web, r_c = drill.chisel_radius();
    const double first = std::sqrt(r_c * r_c - b * b), last = std::sqrt(drill.radius * drill.radius - b * b);
    const double length = (last - first) / drill.p.sin;
    const int count = std::clamp(static_cast<int>(std::ceil(length / interval - 1e-9)), 1,
                                 static_cast<int>(max_lip_points / lip_count));
    const SinCos a = sin_cos_exact(angle);
    for (const double side : {1.0, -1.0})
        for (int i = 0; i < count; ++i) {
            const double s = first + (last - first) * (i + 0.5) / count, r = std::sqrt(s * s + b * b);
            const double c = side * a.cos, sn = side * a.sin;
            points.point[points.count++] = {
                {s * c - b * sn, s * sn + b * c, -r * drill.p.cos / drill.p.sin}, r, length / count, side};
        }
    return points;
}

void LastInterval::advance(const Held<PaperBit>& tool, const Advance& moved) noexcept {
    rate = moved.rate;
    angle += 2.0 * pi * tool.spindle_speed * tool.tick.dt;
    if (angle >= 2.0 * pi) angle -= 2.0 * pi;
}

}  // namespace kerf::as_printed
