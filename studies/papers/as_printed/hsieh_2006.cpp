// SPDX-License-Identifier: Apache-2.0
#include "hsieh_2006.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace kerf::as_printed {

namespace {

struct Sum {
    int teeth = 0;
    Vec3 force{0, 0, 0};  ///< [N] against feed, oscillation and set: on the saw, tool frame
};

/// Of the sum of two angles.
SinCos turned(SinCos a, SinCos b) noexcept { return {a.sin * b.cos + a.cos * b.sin, a.cos * b.cos - a.sin * b.sin}; }

/// 2.4: a tooth cuts if its tip is in a bone voxel.
Sum teeth_in_bone_of(const Hsieh2006& law, const PaperSaw& tool, const BoneQuery& bone,
                     const Hsieh2006::State& last) noexcept {
    const std::size_t count = std::min(static_cast<std::size_t>(tool.tooth_count), max_saw_teeth);
    const double u = tool.oscillation, alpha = 0.5 * tool.swing * sin_cos_exact(last.phase).sin;
    const double l = tool.length, chip = chip_as_printed(law.tooth_width, tool.tooth_pitch, last.rate[2], u);
    std::array<Vec3, max_saw_teeth> tip{};
    std::array<SinCos, max_saw_teeth> theta;
    std::array<kerf_bone_sample, max_saw_teeth> sample;
    for (std::size_t i = 0; i < count; ++i) {
        const double offset = (static_cast<double>(i) - 0.5 * static_cast<double>(count - 1)) * tool.tooth_pitch;
        const double along = l - tool.bend * offset * offset, r = std::sqrt(offset * offset + along * along);
        theta[i] = turned({offset / r, along / r}, sin_cos_exact(alpha));  // β as the text means it, and α
        tip[i] = {r * theta[i].sin, 0.0, r * theta[i].cos - l};
    }
    bone.sample({tip.data(), count}, {0, 0, 1}, {sample.data(), count});
    Sum sum;
    for (std::size_t i = 0; i < count; ++i) {
        if (sample[i].engagement < 0.5) continue;  // Δ
        const SawForce to = saw_force(theta[i], law.k_normal * chip, law.k_lateral * chip);
        ++sum.teeth;
        sum.force = sum.force - Vec3{to.x, law.k_radial * chip, to.z};
    }
    return sum;
}

/// 2.3: in proportion to the sample points in bone, against the way the saw moves.
Vec3 touch_of(const Hsieh2006& law, const PaperSaw& tool, const BoneQuery& bone,
              const Hsieh2006::State& last) noexcept {
    const double step = law.point_interval, half = 0.5 * tool.tooth_count * tool.tooth_pitch;
    const int across = static_cast<int>(2.0 * half / step) + 1, deep = static_cast<int>(0.5 * tool.length / step) + 1;
    std::array<Vec3, 128> point{};
    std::array<kerf_bone_sample, 128> sample;
    int immersed = 0;
    std::size_t held = 0;
    const auto ask = [&] {
        bone.sample({point.data(), held}, {0, 0, 1}, {sample.data(), held});
        for (std::size_t n = 0; n < held; ++n) immersed += sample[n].engagement >= 0.5 ? 1 : 0;
        held = 0;
    };
    for (int j = 0; j < deep; ++j)
        for (int i = 0; i < across; ++i)
            for (const double side : {1.0, -1.0}) {
                point[held++] = {-half + i * step, side * 0.5 * tool.kerf, -j * step};
                if (held == point.size()) ask();
            }
    ask();
    return (-law.per_point * immersed) * normalized(linear(last.rate));
}

}  // namespace

double tooth_angle_as_printed(double length, double offset, double bend) noexcept {
    return std::atan(length / (offset - bend * offset * offset));
}
double chip_as_printed(double width, double pitch, double feed_rate, double oscillation) noexcept {
    return width * pitch * feed_rate / oscillation;
}
SawForce saw_force(SinCos theta, double normal, double lateral) noexcept {
    return {theta.sin * lateral + theta.cos * normal, theta.cos * normal - theta.sin * lateral};
}

void Hsieh2006::resist(const Held<PaperSaw>& tool, const BoneQuery& bone, const State& state,
                       Channels& channels) const noexcept {
    if (tool.oscillation > 0.0)
        channels.push(teeth_in_bone_of(*this, tool, bone, state).force, {0, 0, 0});
    else
        channels.push(touch_of(*this, tool, bone, state), {0, 0, 0});
}

void Hsieh2006::commit(const Held<PaperSaw>& tool, const BoneQuery& bone, const Advance& advance, State& state,
                       Signals& signals, Actions&) const noexcept {
    const bool goes = tool.oscillation > 0.0;
    const Sum sum = goes ? teeth_in_bone_of(*this, tool, bone, state) : Sum{};
    signals.teeth_in_bone = sum.teeth;
    signals.f_x = -sum.force.x;
    signals.f_y = -sum.force.y;
    signals.f_z = -sum.force.z;
    state.rate = advance.rate;
    state.phase += 2.0 * pi * tool.oscillation * tool.tick.dt;
    while (state.phase >= 2.0 * pi) state.phase -= 2.0 * pi;
}

}  // namespace kerf::as_printed
