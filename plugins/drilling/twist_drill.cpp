// SPDX-License-Identifier: Apache-2.0
#include "twist_drill.h"

#include <algorithm>
#include <cmath>

#include "kerf/exact_math.hpp"

namespace kerf::drilling {

PointAngle half_point_angle(const TwistDrill& drill) noexcept {
    const SinCos p = sin_cos_exact(0.5 * drill.point_angle);
    return {p.sin, p.cos};
}

double TwistDrill::point_depth() const noexcept {
    const PointAngle p = half_point_angle(*this);
    return radius() * p.cos / p.sin;
}

double TwistDrill::lag_of_second_lip() const noexcept {
    const PointAngle p = half_point_angle(*this);
    return 2.0 * runout * p.cos / p.sin;
}

double TwistDrill::rake_at(double at) const noexcept {
    const SinCos h = sin_cos_exact(helix_angle);
    const double slope = at / radius() * h.sin / h.cos;
    return slope / (1.0 + 0.28 * slope * slope);
}

Lip make_lip(const TwistDrill& drill, double pitch) noexcept {
    Lip lip;
    const PointAngle p = half_point_angle(drill);
    const double b = drill.half_web(), r_c = drill.chisel_radius(), r_o = drill.radius();
    const double first = std::sqrt(r_c * r_c - b * b), last = std::sqrt(r_o * r_o - b * b);
    const double pieces = std::ceil((last - first) / pitch - 1e-9);
    lip.count = static_cast<std::size_t>(std::clamp(pieces, 1.0, static_cast<double>(largest_element_count)));
    const double ds = (last - first) / static_cast<double>(lip.count);

    for (std::size_t i = 0; i < lip.count; ++i) {
        LipElement& e = lip.element[i];
        e.along = first + (static_cast<double>(i) + 0.5) * ds;
        e.radius = std::sqrt(e.along * e.along + b * b);
        e.z = -e.radius * p.cos / p.sin;
        const double cos_beta = e.along / e.radius;
        const double cos_i = std::sqrt(p.cos * p.cos + p.sin * p.sin * cos_beta * cos_beta);
        e.normal_axial = p.sin * cos_beta / cos_i;
        e.normal_radial = p.cos / cos_i;
        e.width = ds / p.sin * cos_i;
    }
    return lip;
}

Vec3 place_of(const LipElement& e, double half_web, double cos_angle, double sin_angle) noexcept {
    return {e.along * cos_angle - half_web * sin_angle, e.along * sin_angle + half_web * cos_angle, e.z};
}

}  // namespace kerf::drilling
