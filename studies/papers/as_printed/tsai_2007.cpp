// SPDX-License-Identifier: Apache-2.0
#include "tsai_2007.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace kerf::as_printed {

namespace {

/// Δ, times what the tissue's coefficients are of the first one's. The paper: determined by the types of bones (5.1).
double engaged(const kerf_bone_sample& at, std::uint32_t tissues, double share_of_softer) noexcept {
    if (at.engagement < 0.5) return 0.0;
    double most = 0.0;
    for (std::uint32_t m = 0; m < tissues; ++m) most = std::max(most, at.density[m]);
    double share = 0.0;
    for (std::uint32_t m = 0; m < tissues; ++m) share += at.weight[m] * (at.density[m] < most ? share_of_softer : 1.0);
    return share;
}

DrillingSums sums_of(const Tsai2007& law, const PaperBit& tool, const BoneQuery& bone,
                     const LastInterval& last) noexcept {
    const PaperDrill drill = tool.drill();
    const LinearInRadius k_h{law.k_h, law.k_h_slope}, k_t{law.k_t, law.k_t_slope}, k_v{law.k_v, law.k_v_slope};
    const double pps = tool.spindle_speed, tilt = length(angular(last.rate));

    const LipPoints lips = lip_points(drill, law.element_interval, last.angle);
    std::array<Vec3, max_lip_points> place;
    std::array<kerf_bone_sample, max_lip_points> sample;
    for (std::size_t i = 0; i < lips.count; ++i) place[i] = lips.point[i].place;
    bone.sample({place.data(), lips.count}, {0, 0, 1}, {sample.data(), lips.count});
    DrillingSums sum;
    for (std::size_t i = 0; i < lips.count; ++i) {
        const LipPoint& e = lips.point[i];
        const double delta = engaged(sample[i], bone.tissue_count(), law.softer);
        if (delta <= 0.0) continue;
        // 5.1, first display: F^H = Δ K_H dw f/n, and so T and V.
        const double area = delta * e.width * feed_per_revolution(last.rate[2], e.r, tilt, pps) / lip_count;
        const double f_h = k_h.at(e.r) * area;
        const ThrustAndRadius to = lip_transform(e.r, drill.half_web, drill.p, k_t.at(e.r) * area, k_v.at(e.r) * area);
        const double l = law.shank - e.place.z;  // from the element to where the handle is held
        sum.tang += f_h;
        sum.thrust += to.thrust;
        sum.radius += to.radius;
        sum.torque_tang += e.r * f_h;
        sum.torque_radius += l * to.radius;
        sum.torque_thrust += e.r * to.thrust;
    }

    // 5.1, third display: F^C = Δ K_C dw f.
    const double half = drill.chisel_radius();
    const int count = std::clamp(static_cast<int>(std::ceil(half / law.element_interval - 1e-9)), 1, 64);
    const SinCos a = sin_cos_exact(last.angle);
    std::size_t n = 0;
    for (int i = 0; i < count; ++i)
        for (const double side : {1.0, -1.0}) {
            const double r = (i + 0.5) * half / count;
            place[n++] = {-side * r * a.sin, side * r * a.cos, -r * drill.p.cos / drill.p.sin};
        }
    bone.sample({place.data(), n}, {0, 0, 1}, {sample.data(), n});
    const double feed = last.rate[2] / pps;
    for (std::size_t i = 0; i < n; ++i)
        sum.thrust += engaged(sample[i], bone.tissue_count(), law.softer) * law.k_c * half / count * feed;
    return sum;
}

/// 5.3: points of the side that move into bone resist in proportion to n·v_s.
Vec3 sideways_force(const Tsai2007& law, const PaperBit& tool, const BoneQuery& bone,
                    const LastInterval& last) noexcept {
    const Vec3 sideways{last.rate[0], last.rate[1], 0.0};
    Vec3 force{0, 0, 0};
    for_each_surface_point(tool.drill(), law.voxel_width, law.shank, bone, [&](Vec3, Vec3 normal, bool is_in_bone) {
        const double into = dot(normal, sideways);
        if (is_in_bone && into > 0.0) force = force - (law.sideways * into) * normal;
    });
    return force;
}

}  // namespace

double feed_per_revolution(double feed_rate, double r, double tilt_rate, double revolutions) noexcept {
    return (feed_rate - r * tilt_rate) / revolutions;
}

ThrustAndRadius lip_transform(double r, double b, SinCos theta, double f_t, double f_v) noexcept {
    const double root = std::sqrt(r * r - b * b) / r;
    return {theta.cos * f_t + root * theta.sin * f_v, root * theta.sin * f_t - theta.cos * f_v};
}

Lateral lateral_force(double f_radius, double f_tang, SinCos alpha) noexcept {
    return {alpha.cos * f_radius - alpha.sin * f_tang, alpha.sin * f_radius + alpha.cos * f_tang};
}

double rendered_thrust(const DrillingSums& sum, double arm) noexcept {
    return sum.thrust + (arm > 0.0 ? sum.torque_thrust / arm : 0.0);
}

void Tsai2007::resist(const Held<PaperBit>& tool, const BoneQuery& bone, const State& state,
                      Channels& channels) const noexcept {
    const DrillingSums sum = sums_of(*this, tool, bone, state);
    const Lateral to = lateral_force(sum.radius, sum.tang, sin_cos_exact(state.angle));
    // Thrust pushes the drill out; T_tang and T_radius are not represented (5.2, last paragraph).
    channels.push(Vec3{to.x, to.y, -rendered_thrust(sum, torque_arm)} + sideways_force(*this, tool, bone, state),
                  {0, 0, 0});
}

void Tsai2007::commit(const Held<PaperBit>& tool, const BoneQuery& bone, const Advance& advance, State& state,
                      Signals& signals, Actions& actions) const noexcept {
    const DrillingSums sum = sums_of(*this, tool, bone, state);
    signals.f_tang = sum.tang;
    signals.f_radius = sum.radius;
    signals.t_tang = sum.torque_tang;
    signals.t_radius = sum.torque_radius;
    signals.t_thrust = sum.torque_thrust;
    actions.cut();
    state.advance(tool, advance);
}

}  // namespace kerf::as_printed
