// SPDX-License-Identifier: Apache-2.0
#include "drill_edges.h"

#include <algorithm>
#include <cmath>

namespace kerf::drilling {

/// Share of the reference tissue's resistance at a sample, zero in air.
double resistance(const kerf_bone_sample& s, std::uint32_t tissues, double reference) noexcept {
    if (s.engagement <= 0.0) return 0.0;
    double m = 0.0;
    for (std::uint32_t i = 0; i < tissues; ++i) m += s.weight[i] * resistance_of_density(s.density[i], reference);
    return s.engagement * m;
}

void Edges::ask(const Tick& tick, const BoneQuery& bone, double angle) noexcept {
    drill = drill_of(tick.tool);
    lip = make_lip(drill, tick.force[force_element_pitch]);
    const SinCos a = sin_cos_exact(angle);
    cos_angle = a.cos;
    sin_angle = a.sin;
    for (int k = 0; k < lip_count; ++k) {
        const double side = k == 0 ? 1.0 : -1.0;
        for (std::size_t i = 0; i < lip.count; ++i)
            point[lip_points++] = place_of(lip.element[i], drill.half_web(), side * a.cos, side * a.sin);
    }
    count = lip_points;
    const PointAngle p = half_point_angle(drill);
    const double pieces = std::ceil(drill.chisel_radius() / tick.force[force_element_pitch]);
    chisel_points = static_cast<std::size_t>(std::clamp(pieces, 2.0, static_cast<double>(most_chisel_points)));
    for (std::size_t i = 0; i < chisel_points; ++i) {
        const double r = (static_cast<double>(i) + 0.5) * chisel_width();
        for (const double side : {1.0, -1.0})
            point[count++] = {-side * r * a.sin, side * r * a.cos, -r * p.cos / p.sin};
    }
    bone.sample({point.data(), count}, {0, 0, 1}, {sample.data(), count});
}

Side side_forces(const Edges& e, const Tick& tick, std::uint32_t tissues, double n, double feed_rate, double least) noexcept {
    const Coefficients k = coefficients(tick.force);
    const double reference = tick.force[force_reference_density];
    const double per_lip = std::max(feed_rate, 1e-6) / (lip_count * n);  // feed per lip [m]
    Side sum;
    for (std::size_t i = 0; i < e.count; ++i) {
        const double m = resistance(e.sample[i], tissues, reference);
        if (m <= 0.0 || e.sample[i].gap > least + left_behind) continue;
        if (i >= e.lip_points) {
            sum.thrust += m * e.chisel_width() * force_per_width(per_lip, k.chisel);
            continue;
        }
        const LipElement& el = e.element(i);
        const double t = per_lip * el.normal_axial;
        const double normal = m * el.width * force_per_width(t, k.thrust);
        const double cutting = m * el.width * force_per_width(t, k.cutting);
        const Vec3 outwards = normalized(Vec3{e.point[i].x, e.point[i].y, 0.0});
        const Vec3 running = cross(Vec3{0, 0, 1}, outwards);
        const Vec3 lateral = -cutting * running - normal * el.normal_radial * outwards;
        sum.thrust += normal * el.normal_axial;
        sum.torque += cutting * el.radius;
        sum.lateral = sum.lateral + lateral;
        sum.moment = sum.moment + cross(e.point[i], lateral - normal * el.normal_axial * Vec3{0, 0, 1});
    }
    return sum;
}

}  // namespace kerf::drilling
