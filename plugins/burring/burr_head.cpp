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
    // Few chords make removal fast. Each chord encloses the same area as its piece of the arc. So its ends lie outside
    // the arc, and its middle inside: by 5 µm and 2 µm on a ball of 4 mm. A groove has its true size.
    constexpr double per_radian = 16.0 / (150.0 / 180.0 * pi);
    const double pieces = std::max(2.0, std::ceil(per_radian * arc_angle)), chord = arc_angle / pieces;
    const double wider = std::sqrt(chord / sin_cos_exact(chord).sin);
    Outline outline = revolution();
    for (double i = 0.0; i <= pieces; i += 1.0) {
        const SinCos a = sin_cos_exact(chord * i);
        outline.to(arc_radius * (wider * a.cos - 1.0), end_radius + wider * arc_radius * a.sin);
    }
    const MeridianPoint end = at(meridian());
    if (side_length > 0.0 && end.z < outline.last().z) outline.to(end.z, end.radius);
    outline.cuts();
    const kerf_profile_point last = outline.last();
    if (last.radius > neck_radius) outline.to(last.z - (last.radius - neck_radius), neck_radius);
    return outline.to(-length, neck_radius);
}

}  // namespace kerf::burring
