// SPDX-License-Identifier: Apache-2.0
#include "dental_implant.h"

#include <cstdint>

namespace kerf::as_printed {

namespace {

struct Asked {
    LipPoints lips;
    std::array<kerf_bone_sample, max_lip_points> sample;
};

void ask(const DentalImplant& law, const PaperBit& tool, const BoneQuery& bone, double angle, Asked& asked) noexcept {
    asked.lips = lip_points(tool.drill(), law.element_interval, angle);
    std::array<Vec3, max_lip_points> place;
    for (std::size_t i = 0; i < asked.lips.count; ++i) place[i] = asked.lips.point[i].place;
    bone.sample({place.data(), asked.lips.count}, {0, 0, 1}, {asked.sample.data(), asked.lips.count});
}

}  // namespace

Vec3 element_force(double f_n, double f_t, SinCos theta, SinCos alpha) noexcept {
    const double f_r = f_n * theta.sin;  // 7
    return {-f_r * alpha.cos - f_t * alpha.sin, -f_r * alpha.sin + f_t * alpha.cos, f_n * theta.cos};
}

double density_as_printed(const std::array<double, 8>& d, double x, double y, double z) noexcept {
    return d[0] * (1 - x) * (1 - y) * (1 - z) + d[1] * x * (1 - y) * (1 - z) + d[2] * x * (1 - y) * z +
           d[3] * (1 - x) * (1 - y) * z + d[4] * (1 - x) * y * (1 - z) + d[5] * x * y * (1 - z) + d[6] * x * y * z +
           d[7] * (1 - x) * y * z;
}

void DentalImplant::resist(const Held<PaperBit>& tool, const BoneQuery& bone, const State& state,
                           Channels& channels) const noexcept {
    Asked asked;
    ask(*this, tool, bone, state.angle, asked);
    const PaperDrill drill = tool.drill();
    const SinCos alpha = sin_cos_exact(state.angle);
    const SinCos theta{drill.p.cos, drill.p.sin};  // between the cone's normal and the axis: 90° less the half angle
    Vec3 sum{0, 0, 0};
    for (std::size_t i = 0; i < asked.lips.count; ++i) {
        const kerf_bone_sample& at = asked.sample[i];
        if (at.engagement <= 0.0) continue;
        double density = 0.0;
        for (std::uint32_t m = 0; m < bone.tissue_count(); ++m) density += at.weight[m] * at.density[m];
        sum = sum + element_force(k_n * density, k_t * density, theta, alpha);
    }
    channels.push({sum.x, sum.y, -sum.z}, {0, 0, 0});  // the axial force pushes the drill out
}

void DentalImplant::commit(const Held<PaperBit>& tool, const BoneQuery& bone, const Advance& advance, State& state,
                           Signals& signals, Actions& actions) const noexcept {
    Asked asked;
    ask(*this, tool, bone, state.angle, asked);
    signals.elements = static_cast<double>(asked.lips.count);
    actions.cut();
    state.advance(tool, advance);
}

}  // namespace kerf::as_printed
