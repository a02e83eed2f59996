// SPDX-License-Identifier: Apache-2.0
#include "twist_drill.h"

#include <algorithm>
#include <cmath>

namespace kerf::drilling {

double TwistDrill::rake_at(double at, SinCos h) const noexcept {
    const double slope = at / radius() * h.sin / h.cos;
    return slope / (1.0 + 0.28 * slope * slope);
}

TwistDrill::Cones TwistDrill::cones() const noexcept {
    Cones all{{Cone{half_point, 0.0, radius(), 0.0}}, 1};
    OutlineCorner last{point_depth(), radius()};
    for (std::size_t i = 0; i < corner_count; ++i) {
        const double wider = corners[i].radius - last.radius, longer = corners[i].depth - last.depth;
        if (wider > 0.0) {
            const double slant = std::sqrt(wider * wider + longer * longer);
            all.cone[all.count++] = {{wider / slant, longer / slant}, last.radius, corners[i].radius, -last.depth};
        } else {
            all.cone[all.count - 1].straight += longer;
        }
        last = corners[i];
    }
    for (std::size_t i = all.count - 1; i-- > 0;)
        if (all.cone[i].straight <= 0.0) all.cone[i].wall = all.cone[i + 1].wall;
    return all;
}

double TwistDrill::bit_radius_at(double z) const noexcept {
    if (corner_count == 0 || -z <= point_depth()) return std::min(radius(), shank_radius());
    for (std::size_t i = 0; i < corner_count; ++i)
        if (-z <= corners[i].depth) return std::min(corners[i].radius, shank_radius());
    return shank_radius();
}

double TwistDrill::head() const noexcept {
    const double of_corners = corner_count > 0 ? corners[corner_count - 1].depth : 0.0;
    return std::max(of_corners, land() - cones().last().end());
}

namespace {

/// Appends the pieces of an edge at the half web `b` on a cone, from the radius `from` outwards.
void add_edge(Lip& lip, const Cone& cone, double b, double from, double pitch) noexcept {
    const SinCos p = cone.half_angle;
    const double first = std::sqrt(from * from - b * b), last = std::sqrt(cone.outer * cone.outer - b * b);
    const double capacity = static_cast<double>(largest_element_count - lip.count);
    const auto count = static_cast<std::size_t>(std::clamp(std::ceil((last - first) / pitch - 1e-9), 1.0, capacity));
    const double ds = (last - first) / static_cast<double>(count);
    for (std::size_t i = 0; i < count; ++i) {
        LipElement& e = lip.element[lip.count++];
        e.along = first + (static_cast<double>(i) + 0.5) * ds;
        e.radius = std::sqrt(e.along * e.along + b * b);
        e.z = cone.z_at(e.radius);
        e.wall = cone.wall;
        const double cos_beta = e.along / e.radius;
        const double cos_i = std::sqrt(p.cos * p.cos + p.sin * p.sin * cos_beta * cos_beta);
        e.normal_axial = p.sin * cos_beta / cos_i;
        e.normal_radial = p.cos / cos_i;
        e.width = ds / p.sin * cos_i;
    }
}

}  // namespace

Lip make_lip(const TwistDrill& drill, double pitch) noexcept {
    Lip lip;
    const double b = drill.half_web();
    const TwistDrill::Cones cones = drill.cones();
    pitch = std::max(pitch, drill.widest_radius() /
                                static_cast<double>(largest_element_count - cones.count));  // one piece more a cone
    for (const Cone& cone : cones) add_edge(lip, cone, b, std::max(cone.inner, drill.chisel_radius()), pitch);
    return lip;
}

Vec3 position_of(const LipElement& e, double half_web, double cos_angle, double sin_angle) noexcept {
    return {e.along * cos_angle - half_web * sin_angle, e.along * sin_angle + half_web * cos_angle, e.z};
}

}  // namespace kerf::drilling
