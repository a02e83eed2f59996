// SPDX-License-Identifier: Apache-2.0
#include "burr_head.h"

#include <algorithm>
#include <cmath>

namespace kerf::burring {

MeridianPoint BurrHead::at(double along) const noexcept {
    if (along < end_radius) return {along, 0.0, 0.0, 1.0, 0.0};
    const double angle = std::min((along - end_radius) / arc_radius, arc_angle);
    const SinCos a = sin_cos_exact(angle);
    const double side = std::max(0.0, along - end_radius - arc_radius * arc_angle);
    return {end_radius + arc_radius * a.sin + side * a.cos, arc_radius * (a.cos - 1.0) - side * a.sin, a.sin, a.cos,
            side > 0.0 ? 0.0 : arc_radius};
}

double BurrHead::widest_radius() const noexcept {
    return end_radius + arc_radius * sin_cos_exact(std::min(arc_angle, 0.5 * pi)).sin;
}

Outline BurrHead::outline(double length) const noexcept {
    // Chords of an arc take less than the arc: with 24 of them on a ball a groove is 0.3 % too small.
    constexpr double per_radian = 24.0 / (150.0 / 180.0 * pi);
    const auto pieces = static_cast<std::size_t>(std::ceil(per_radian * arc_angle));
    Outline outline = revolution();
    for (std::size_t i = 0; i <= pieces; ++i) {
        const MeridianPoint p =
            at(end_radius + arc_radius * arc_angle * static_cast<double>(i) / static_cast<double>(pieces));
        outline.to(p.z, p.radius);
    }
    const MeridianPoint end = at(meridian());
    if (side_length > 0.0) outline.to(end.z, end.radius);
    outline.cuts();
    if (end.radius > neck_radius) outline.to(end.z - (end.radius - neck_radius), neck_radius);
    return outline.to(-length, neck_radius);
}

}  // namespace kerf::burring
