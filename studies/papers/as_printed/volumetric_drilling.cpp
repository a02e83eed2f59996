// SPDX-License-Identifier: Apache-2.0
#include "volumetric_drilling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace kerf::as_printed {

namespace {

SinCos of_sine(double sine) noexcept { return {sine, std::sqrt(std::max(0.0, 1.0 - sine * sine))}; }

/// Asks about points in chunks; what the bone says is of no interest, only that it was asked.
class Toucher {
public:
    explicit Toucher(const BoneQuery& bone) : bone_(bone) {}
    ~Toucher() { ask(); }
    Toucher(const Toucher&) = delete;
    Toucher& operator=(const Toucher&) = delete;
    void touch(Vec3 point) noexcept {
        point_[held_] = point;
        if (++held_ == chunk) ask();
    }

private:
    void ask() noexcept {
        bone_.sample({point_.data(), held_}, {0, 0, 1}, {sample_.data(), held_});
        held_ = 0;
    }
    const BoneQuery& bone_;
    std::array<Vec3, chunk> point_{};
    std::array<kerf_bone_sample, chunk> sample_;
    std::size_t held_ = 0;
};

/// Section III.A: interior points, shell points, and the shell's ways, all one voxel apart, as far back as the tip and
/// a land behind it reach: what is behind has gone already.
void touch_all(const PaperDrill& drill, double interval, Vec3 moved, const BoneQuery& bone) noexcept {
    Toucher toucher(bone);
    const double back = drill.point_depth() + 0.5 * drill.radius;
    const int along_way = static_cast<int>(length(moved) / interval);
    for (int k = 0; k <= static_cast<int>(back / interval); ++k) {
        const double z = k * interval;
        const double outer = std::min(drill.radius, z * drill.p.sin / drill.p.cos);
        for (double r = outer;; r -= interval) {  // the outermost circle is the shell
            if (r < 0.0) break;
            const int around = static_cast<int>(2.0 * pi * r / interval) + 1;
            const SinCos step = sin_cos_exact(2.0 * pi / around);
            double c = 1.0, s = 0.0;
            for (int i = 0; i < around; ++i) {
                const Vec3 at{r * c, r * s, -z};
                toucher.touch(at);
                if (r == outer)
                    for (int w = 1; w <= along_way; ++w)
                        toucher.touch(at + (static_cast<double>(w) / along_way) * moved);
                const double turned = c * step.cos - s * step.sin;
                s = s * step.cos + c * step.sin;
                c = turned;
            }
        }
    }
}

}  // namespace

ObliqueForce oblique_force(double n, double f, SinCos rake, SinCos inclination, SinCos flow) noexcept {
    return {
        -n * rake.sin + f * rake.cos * flow.cos,
        n * rake.cos * inclination.cos + f * flow.sin * inclination.sin + f * rake.sin * flow.cos * inclination.cos,
        n * rake.cos * inclination.cos - f * flow.sin * inclination.sin + f * rake.sin * flow.cos * inclination.cos};
}

ObliqueForce oblique_force_corrected(double n, double f, SinCos rake, SinCos inclination, SinCos flow) noexcept {
    ObliqueForce force = oblique_force(n, f, rake, inclination, flow);
    force.e =
        n * rake.cos * inclination.sin - f * flow.sin * inclination.cos + f * rake.sin * flow.cos * inclination.sin;
    return force;
}

double chip_thickness(double feed_rate, double revolutions) noexcept {
    return feed_rate / (2.0 * 2.0 * pi * revolutions);
}

void VolumetricDrilling::resist(const Held<PaperBit>& tool, const BoneQuery& bone, const State& state,
                                Channels& channels) const noexcept {
    const PaperDrill drill = tool.drill();
    const LipPoints lips = lip_points(drill, element_interval, state.angle);
    std::array<Vec3, max_lip_points> place;
    std::array<kerf_bone_sample, max_lip_points> sample;
    for (std::size_t i = 0; i < lips.count; ++i) place[i] = lips.point[i].place;
    bone.sample({place.data(), lips.count}, {0, 0, 1}, {sample.data(), lips.count});
    const double t = chip_thickness(state.rate[2], tool.spindle_speed);
    const SinCos a = sin_cos_exact(state.angle), rake_angle = sin_cos_exact(rake);
    Vec3 force{0, 0, 0};
    for (std::size_t i = 0; i < lips.count; ++i) {
        const LipPoint& e = lips.point[i];
        if (sample[i].engagement <= 0.0) continue;
        // Equation 1: K_1 t_1 + K_2 t_2, the chip's two parts as the shares of the tissues (E01-5).
        double most = 0.0, share = 0.0;
        for (std::uint32_t m = 0; m < bone.tissue_count(); ++m) most = std::max(most, sample[i].density[m]);
        for (std::uint32_t m = 0; m < bone.tissue_count(); ++m)
            share += sample[i].weight[m] * (sample[i].density[m] < most ? softer : 1.0);
        const double sin_beta = drill.half_web / e.r, cos_beta = std::sqrt(1.0 - sin_beta * sin_beta);
        const SinCos tau = of_sine(sin_beta * drill.p.sin);
        const double area = sample[i].engagement * share * t * e.width * tau.cos;             // dw = dy cos τ
        const ObliqueForce to = oblique_force(k_n * area, k_f * area, rake_angle, tau, tau);  // ψ = τ
        // c against the edge's motion, r out of the bone, e along the edge outwards: the paper does not say.
        const Vec3 outwards = (1.0 / e.r) * Vec3{e.place.x, e.place.y, 0.0};
        const Vec3 running = cross(Vec3{0, 0, 1}, outwards);
        const Vec3 normal = (1.0 / tau.cos) * (drill.p.cos * outwards + drill.p.sin * cos_beta * Vec3{0, 0, 1});
        const Vec3 edge = drill.p.sin * e.side * Vec3{a.cos, a.sin, 0.0} - drill.p.cos * Vec3{0, 0, 1};
        force = force - to.c * running - to.r * normal + to.e * edge;
    }
    channels.push(force, {0, 0, 0});
}

void VolumetricDrilling::commit(const Held<PaperBit>& tool, const BoneQuery& bone, const Advance& advance, State& state,
                                Signals& signals, Actions& actions) const noexcept {
    touch_all(tool.drill(), voxel_width, tool.tick.dt * linear(advance.rate), bone);
    signals.thrust = 0.0;
    actions.cut();
    state.advance(tool, advance);
}

}  // namespace kerf::as_printed
