// SPDX-License-Identifier: Apache-2.0
#include "burr_force.h"

#include <algorithm>
#include <cmath>

namespace kerf::burring {

namespace {

using Happened = BurrCutting::Happened;

// A stopping head sinks by the sampling error of its groove's wall; the fade spreads this over some ticks [judgement].
constexpr double fading_time = 8e-3;  // [s]

// The force against the turn uses an averaged motion. With the motion of the last tick alone, a burr on a soft hand
// would whirl [judgement].
constexpr double steadying_time = 50e-3;  // [s]

constexpr PhaseEvents<Happened> phase_events{.off = Happened::off,
                                             .speeding_up = Happened::speeding_up,
                                             .running = Happened::running,
                                             .reversing = Happened::reversing,
                                             .bogging = Happened::bogging,
                                             .stalled = Happened::stalled,
                                             .running_down = Happened::running_down};

Turning turning_of(const BurrCutting::State& state, double commanded) noexcept {
    const double speed = state.cutter.speed(), sense = speed != 0.0 ? speed : commanded;
    return {.blade_rate = state.prepared.head.blades * std::max(std::abs(speed), slowest_cut),
            .sense = sense < 0.0 ? -1.0 : 1.0,
            .cutting = state.cutter.cutting,
            .rate = state.rate};
}

/// Returns the mean chip of the cutting blades [m], weighted by their force.
double mean_chip(const Advance& advance, const Turning& turning) noexcept {
    double sum = 0.0, total = 0.0;
    for (std::size_t c = 0; c < advance.channel.size(); ++c) {
        const kerf_channel& channel = advance.channel[c];
        if (channel.kind != KERF_CUT || advance.lambda[c] <= 0.0) continue;
        Vec6 d{};
        std::copy_n(channel.d, 6, d.begin());
        sum += advance.lambda[c] * std::max(0.0, dot(d, advance.rate));
        total += advance.lambda[c];
    }
    return total > 0.0 ? sum / total / turning.blade_rate : 0.0;
}

}  // namespace

void BurrCutting::begin(const AnyBurr& burr, const BoneQuery& bone, State& state) const noexcept {
    Prepared& p = state.prepared;
    p.head = burr.visit([](const auto& held) { return held.head(); });
    const double length = burr.as<Burr>().length;
    p.edges = {p.head, *this, bone};
    p.touching_in_cut = touching_points(p.head, length, *this, bone, true);
    p.touching = touching_points(p.head, length, *this, bone, false);
}

BurrCutting::Notes BurrCutting::resist(const AnyBurr& burr, const BoneQuery& bone, const State& state,
                                       Channels& channels) const noexcept {
    const auto& [head, edges, touching_in_cut, touching] = state.prepared;
    const Turning turning = turning_of(state, burr.as<Burr>().spindle_speed);
    Notes notes;
    if (turning.cutting.resists()) {
        EdgesInBone in_bone;
        in_bone.sample(edges, *this, bone);
        notes.engaged = in_bone.engaged;
        add_cutting(edges, in_bone, *this, turning, channels);
    }
    add_contact(head, turning.cutting.removes_bone() ? touching_in_cut : touching, *this, bone, turning,
                std::abs(state.cutter.speed()), state.carried, channels);
    channels.push({}, {0, 0, -state.reaction});
    return notes;
}

void BurrCutting::commit(const AnyBurr& burr, const BoneQuery&, const Noted<Notes>& advance, State& state,
                         Signals& signals, Actions& actions) const noexcept {
    const Burr& tool = burr.as<Burr>();
    const double dt = burr.tick.dt;
    const Turning turning = turning_of(state, tool.spindle_speed);
    const BurrHead& head = state.prepared.head;
    const double weight = 1.0 - exp_exact(-dt / steadying_time);
    for (std::size_t i = 0; i < state.rate.size(); ++i) state.rate[i] += weight * (advance.rate[i] - state.rate[i]);
    state.carried = Carried(advance);

    // Load on the motor: the blades, and friction of the neck. A head that does not cut must break loose.
    const bool removes_bone = turning.cutting.removes_bone();
    const double cut = cutting_torque(advance, turning.sense);
    const double load = cut + friction * (state.carried.by_neck * head.neck_radius +
                                          state.carried.by_head * 2.0 / 3.0 * head.widest_radius());
    signals.cutting_force = advance.force_of_kind(KERF_CUT);
    signals.side_pull = length(linear(advance.following));
    signals.chip_thickness = mean_chip(advance, turning);
    signals.engagement = advance.notes.engaged / state.prepared.edges.width();
    signals.drive_power = 2.0 * pi * std::abs(state.cutter.speed()) * load;
    signals.spindle_speed = state.cutter.speed();

    if (removes_bone) actions.cut();
    PoweredCutter& cutter = state.cutter;
    if (cutter.motor.step(tool.motor(), tool.spindle_speed, load, dt))
        actions.event(phase_events.of(cutter.motor.phase));
    cutter.cutting.step(std::abs(cutter.speed()) >= slowest_cut, dt, fading_time);  // blades cut in both directions
    // While the burr cuts, `follow` contains the bone's torque, so the reaction is only the motor's excess.
    const double sense = cutter.speed() != 0.0 ? cutter.speed() : tool.spindle_speed;
    state.reaction = std::copysign(1.0, sense) *
                     (cutter.cutting.removes_bone() ? cutter.motor.excess_torque(load) : cutter.motor.torque);
}

}  // namespace kerf::burring
