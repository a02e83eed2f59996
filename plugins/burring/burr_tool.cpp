// SPDX-License-Identifier: Apache-2.0
#include "burr_tool.h"

#include <algorithm>
#include <cmath>

#include "kerf/exact_math.hpp"
#include "kerf/figure.hpp"

namespace kerf::burring {

using namespace literals;

Outline Burr::outline_of(const BurrHead& head) const noexcept {
    constexpr double widest_neck = 0.95;  // [–] of the head's diameter
    if (std::floor(blades) != blades) return refuse("`blades` is ", Figure(blades), "; it needs a whole number.");
    if (!(neck_diameter <= widest_neck * diameter))
        return refuse("`neck_diameter` is ", in_mm(neck_diameter), "; with this `diameter`, ", in_mm(diameter),
                      ", it needs ", in_mm(widest_neck * diameter), " or less.");
    const double needed = -head.end_z() + std::max(0.0, head.at(head.meridian()).radius - head.neck_radius);
    if (!(needed < length))
        return refuse("`length` is ", in_mm(length), "; it needs more than the head and its shoulder, ", in_mm(needed),
                      ".");
    // The hand grips the handpiece like a pen. The tool has no mass: with the force against the turn, a mass across the
    // shaft would keep a burr on a soft hand circling in its own pit.
    return head.outline(length).gripped_at(-length - 15.0_mm);
}

/// The ball ends where its circle is as wide as the neck.
BurrHead RoundBurr::head() const noexcept {
    const double neck = std::min(0.5 * neck_diameter, radius());
    // Bisection replaces the arc sine, whose bits differ between machines.
    double low = 0.5 * pi, high = pi;
    for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (low + high);
        (radius() * sin_cos_exact(middle).sin > neck ? low : high) = middle;
    }
    return {.arc_radius = radius(), .arc_angle = low, .neck_radius = neck, .blades = blades};
}
Outline RoundBurr::outline() const noexcept { return outline_of(head()); }

BurrHead CylindricalBurr::head() const noexcept {
    const double corner = std::min(corner_radius, radius());
    return {.end_radius = radius() - corner,
            .arc_radius = corner,
            .arc_angle = 0.5 * pi,
            .side_length = std::max(0.0, head_length - corner),
            .neck_radius = 0.5 * neck_diameter,
            .blades = blades};
}
Outline CylindricalBurr::outline() const noexcept {
    if (!(corner_radius <= radius()))
        return refuse("`corner_radius` is ", in_mm(corner_radius), "; it needs half of `diameter` or less, ",
                      in_mm(radius()), ".");
    if (!(head_length > corner_radius))
        return refuse("`head_length` is ", in_mm(head_length), "; it needs more than `corner_radius`, ",
                      in_mm(corner_radius), ".");
    return outline_of(head());
}

/// The cone continues the ball's circle tangentially. It ends with the head, or where it is as thin as the neck.
BurrHead PearBurr::head() const noexcept {
    const SinCos t = sin_cos_exact(taper);
    const double neck = 0.5 * neck_diameter, begins = radius() * (1.0 + t.sin), wide = radius() * t.cos;
    const double to_end = (head_length - begins) / t.cos, to_neck = (wide - neck) / t.sin;
    return {.arc_radius = radius(),
            .arc_angle = 0.5 * pi + taper,
            .side_length = std::max(0.0, std::min(to_end, to_neck)),
            .neck_radius = neck,
            .blades = blades};
}
Outline PearBurr::outline() const noexcept {
    const SinCos t = sin_cos_exact(taper);
    const double ball = radius() * (1.0 + t.sin);
    if (!(head_length > ball))
        return refuse("`head_length` is ", in_mm(head_length), "; it needs more than the ball in front of the cone, ",
                      in_mm(ball), ".");
    if (!(neck_diameter < diameter * t.cos))
        return refuse("`neck_diameter` is ", in_mm(neck_diameter), "; it needs less than the cone where it begins, ",
                      in_mm(diameter * t.cos), ".");
    return outline_of(head());
}

}  // namespace kerf::burring
