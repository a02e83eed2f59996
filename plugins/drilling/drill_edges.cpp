// SPDX-License-Identifier: Apache-2.0
#include "drill_edges.h"

#include <algorithm>
#include <cmath>

namespace kerf::drilling {

namespace {
constexpr double fitted_helix = 28.0 * pi / 180.0;  // [rad] of the drill that the coefficients belong to [assumed]
}

double resistance(const kerf_bone_sample& s, std::uint32_t tissues, double reference) noexcept {
    if (s.engagement <= 0.0) return 0.0;
    double m = 0.0;
    for (std::uint32_t i = 0; i < tissues; ++i)
        if (s.weight[i] > 0.0) m += s.weight[i] * resistance_of_density(s.density[i], reference);
    return s.engagement * m;
}

void Edges::ask(const TwistDrill& of, const Tick& tick, const BoneQuery& bone, double angle) noexcept {
    drill = of;
    lip = make_lip(drill, tick.force[force_element_pitch]);
    const SinCos a = sin_cos_exact(angle);
    lag = drill.lag_of_second_lip();
    for (int k = 0; k < lip_count; ++k) {
        const double side = k == 0 ? 1.0 : -1.0;
        for (std::size_t i = 0; i < lip.count; ++i)
            point[lip_points++] = place_of(lip.element[i], drill.half_web(), side * a.cos, side * a.sin);
    }
    count = lip_points;
    rake_factor.fill(1.0);
    if (drill.helix_angle != fitted_helix) {
        const SinCos helix = sin_cos_exact(drill.helix_angle), fitted = sin_cos_exact(fitted_helix);
        for (std::size_t i = 0; i < lip.count; ++i) {
            const double more = (drill.rake_at(lip.element[i].radius, helix) - drill.rake_at(lip.element[i].radius, fitted)) * 180.0 / pi;  // [deg]
            rake_factor[i] = std::max(0.2, 1.0 - tick.force[force_rake_effect] * more);
        }
    }
    const SinCos p = drill.half_point;
    const double pieces = std::ceil(drill.chisel_radius() / tick.force[force_element_pitch]);
    chisel_points = static_cast<std::size_t>(std::clamp(pieces, 2.0, static_cast<double>(most_chisel_points)));
    for (std::size_t i = 0; i < chisel_points; ++i) {
        const double r = (static_cast<double>(i) + 0.5) * chisel_width();
        for (const double side : {1.0, -1.0})
            point[count++] = {-side * r * a.sin, side * r * a.cos, -r * p.cos / p.sin};
    }
    const Vec3 runs_off{drill.runout * a.cos, drill.runout * a.sin, 0.0};
    for (std::size_t i = 0; i < count; ++i) point[i] = point[i] + runs_off;
    bone.sample({point.data(), count}, {0, 0, 1}, {sample.data(), count});
    for (std::size_t i = 0; i < count; ++i) resistance[i] = drilling::resistance(sample[i], bone.tissue_count(), tick.force[force_reference_density]);
}

LipShare share_of_lips(double lag, double feed) noexcept {
    if (lag <= 0.0) return {};
    LipShare share;
    share.chip[1] = feed > 0.0 ? std::max(0.0, 1.0 - 2.0 * lag / feed) : 0.0;
    share.chip[0] = 2.0 - share.chip[1];
    share.edge[1] = std::min(1.0, 10.0 * share.chip[1]);
    return share;
}

Side side_forces(const Edges& e, const Tick& tick, double n, double feed_rate, double least) noexcept {
    const Coefficients k = coefficients(tick.force);
    const double per_lip = std::max(feed_rate, 1e-6) / (lip_count * n);  // feed per lip [m]
    const LipShare share = share_of_lips(e.lag, feed_rate / n);
    const double on_chisel = force_per_width(per_lip, k.chisel);
    const bool are_alike = share.chip[0] == share.chip[1];
    std::array<double, largest_element_count> of_first_lip;  // built up there, by element; of the second the same where lips are alike
    of_first_lip.fill(-1.0);
    double thrust = 0.0, torque = 0.0, x = 0.0, y = 0.0, about_x = 0.0, about_y = 0.0, about_z = 0.0;
    for (std::size_t i = 0; i < e.count; ++i) {
        const double m = e.resistance[i];
        if (m <= 0.0 || e.gap(i) > least + left_behind) continue;
        if (i >= e.lip_points) {
            thrust += m * e.chisel_width() * on_chisel;
            continue;
        }
        const std::size_t nth = e.place_on_lip(i);
        const LipElement& el = e.lip.element[nth];
        const double t = share.chip[e.lip_of(i)] * per_lip * el.normal_axial;
        const double width = share.edge[e.lip_of(i)] * e.rake_factor[nth] * m * el.width;
        double& known = of_first_lip[nth];
        const double built_up = are_alike && known >= 0.0 ? known : built_up_at(t, k.thrust.edge_depth);  // all have one edge depth
        known = built_up;
        const double chip = std::max(t, 0.0);
        const double normal = width * force_per_width(chip, k.thrust, built_up);
        const double cutting = width * force_per_width(chip, k.cutting, built_up);
        // −cutting t̂ − normal n_r r̂, with r̂ outwards and t̂ = ẑ × r̂ the way it runs
        const Vec3 at = e.point[i];
        const double from_axis = std::sqrt(at.x * at.x + at.y * at.y), per_metre = from_axis > 0.0 ? 1.0 / from_axis : 0.0;
        const double radial = normal * el.normal_radial, axial = normal * el.normal_axial;
        const double fx = per_metre * (cutting * at.y - radial * at.x), fy = -per_metre * (cutting * at.x + radial * at.y);
        thrust += axial;
        torque += cutting * el.radius;
        x += fx;
        y += fy;
        about_x -= at.y * axial + at.z * fy;
        about_y += at.z * fx + at.x * axial;
        about_z += at.x * fy - at.y * fx;
    }
    return {thrust, torque, {x, y, 0.0}, {about_x, about_y, about_z}};
}

}  // namespace kerf::drilling
