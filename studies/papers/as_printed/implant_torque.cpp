// SPDX-License-Identifier: Apache-2.0
#include "implant_torque.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "kerf/figure.hpp"

namespace kerf::as_printed {

namespace {

constexpr std::size_t max_elements = 512;
constexpr double full_turn = 2.0 * pi;  // [rad] of tightening

struct ThreadElements {
    std::array<Vec3, max_elements> place;
    std::size_t count;
    double radius;  ///< [m] r_i, the same for all: the thread is a cylinder's
};

/// Along the crest's helix, from the tip backwards.
void list(const PaperImplant& implant, double per_turn, ThreadElements& elements) noexcept {
    const double wanted = per_turn * implant.thread_length / implant.pitch;
    elements.count = std::clamp(static_cast<std::size_t>(wanted + 0.5), std::size_t{1}, max_elements);
    elements.radius = 0.5 * implant.diameter;
    const double step = implant.thread_length / static_cast<double>(elements.count);
    for (std::size_t i = 0; i < elements.count; ++i) {
        const double z = -(static_cast<double>(i) + 0.5) * step;
        const SinCos angle = sin_cos_exact(full_turn * z / implant.pitch);
        elements.place[i] = {elements.radius * angle.cos, elements.radius * angle.sin, z};
    }
}

}  // namespace

Outline PaperImplant::outline() const noexcept {
    using namespace literals;
    const double radius = 0.5 * diameter, head = 0.5 * head_diameter, seat = thread_length + neck_length;
    if (!(head > radius))
        return refuse("`head_diameter` is ", in_mm(head_diameter), "; it needs more than `diameter`, ", in_mm(diameter),
                      ".");
    constexpr double step = 1e-6;  // [m] along the shaft where the radius changes at once
    return revolution({{0.0, 0.0}, {-step, radius}, {-seat, radius}, {-seat - step, head}, {-seat - 2.0_mm, head}})
        .gripped_at(-seat - 60.0_mm);
}

double contact_stiffness(double k_ins, double s, TorqueMode mode, double theta) noexcept {
    switch (mode) {
        case TorqueMode::insertion:
            return k_ins;  // 15
        case TorqueMode::tightening:
            return k_ins * (1.0 + s * theta);  // 16
        case TorqueMode::stripping:
            break;
    }
    return k_ins * (1.0 + s * full_turn);  // 17
}

TorqueMode next_mode(TorqueMode mode, std::size_t touching, std::size_t count, double theta) noexcept {
    switch (mode) {
        case TorqueMode::insertion:
            return count > 0 && touching == count ? TorqueMode::tightening : mode;
        case TorqueMode::tightening:
            return theta >= full_turn ? TorqueMode::stripping : mode;
        case TorqueMode::stripping:
            break;
    }
    return touching == 0 ? TorqueMode::insertion : mode;
}

ImplantTorque::Notes ImplantTorque::resist(const Held<PaperImplant>& tool, const BoneQuery& bone, const State& state,
                                           Channels& channels) const noexcept {
    ThreadElements elements;
    list(tool, elements_per_turn, elements);
    std::array<kerf_bone_sample, max_elements> sample;
    bone.sample({elements.place.data(), elements.count}, {0, 0, 1}, {sample.data(), elements.count});

    Notes notes{.count = elements.count};
    const double stiffness = contact_stiffness(k_ins, s, state.mode, state.theta);
    for (std::size_t i = 0; i < elements.count; ++i) {
        if (sample[i].engagement < 0.5) continue;  // Δ
        double density = 0.0;
        for (std::uint32_t m = 0; m < bone.tissue_count(); ++m) density += sample[i].weight[m] * sample[i].density[m];
        ++notes.touching;
        notes.torque += stiffness * std::max(0.0, density - state.worn) * elements.radius;  // 14, 18
    }
    if (state.turn_rate > 0.0) channels.push({0, 0, 0}, {0, 0, -notes.torque});
    if (state.turn_rate < 0.0) channels.push({0, 0, 0}, {0, 0, notes.torque});
    return notes;
}

void ImplantTorque::commit(const Held<PaperImplant>& tool, const BoneQuery&, const Noted<Notes>& advance, State& state,
                           Signals& signals, Actions&) const noexcept {
    const Notes& notes = advance.notes;
    signals = {.torque = state.turn_rate == 0.0 ? 0.0 : notes.torque,
               .mode = static_cast<double>(state.mode),
               .tightened = state.theta,
               .elements = static_cast<double>(notes.touching)};

    state.turn_rate = advance.rate[5];
    if (state.mode == TorqueMode::tightening)
        state.theta = std::clamp(state.theta + state.turn_rate * tool.tick.dt, 0.0, full_turn);
    if (state.mode == TorqueMode::stripping) state.worn += wear;
    state.mode = next_mode(state.mode, notes.touching, notes.count, state.theta);
    if (state.mode == TorqueMode::insertion) state.theta = state.worn = 0.0;
}

}  // namespace kerf::as_printed
