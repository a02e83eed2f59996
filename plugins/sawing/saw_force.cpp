// SPDX-License-Identifier: Apache-2.0
#include "saw_force.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace kerf::sawing {

namespace {

constexpr double averaged_from =
    100.0;  // [1/s] forces are averaged from here on: in ticks of 1 ms a faster one aliases
using Happened = SawCutting::Happened;
constexpr PhaseEvents<Happened> phase_events{.off = Happened::off,
                                             .speeding_up = Happened::speeding_up,
                                             .running = Happened::running,
                                             .reversing = Happened::running,  // an oscillation has no other sense
                                             .bogging = Happened::bogging,
                                             .stalled = Happened::stalled,
                                             .running_down = Happened::running_down};

/// A saw passes all rates as it speeds up and runs down: it shakes with every stroke only if it is commanded to.
Oscillation oscillation_of(const OscillatingBlade& saw, const SawBlade& blade,
                           const SawCutting::State& state) noexcept {
    return {.stroke = {blade.stroke(), blade.pitch, std::max(state.cutter.speed(), slowest_cut)},
            .cutting = state.cutter.cutting,
            .phase = state.phase,
            .is_averaged = !(saw.stroke_rate > 0.0 && saw.stroke_rate <= averaged_from)};
}

/// Returns the thrust on the teeth of all sectors [N].
double thrust_of(const Advance& advance) noexcept {
    double sum = 0.0;
    for (std::size_t c = 0; c < advance.channel.size(); ++c) {
        const std::uint32_t id = advance.channel[c].id;
        if (id >= id_feed && id < id_feed + sector_count * part_count) sum += advance.lambda[c];
    }
    return sum;
}

/// Returns the force along the teeth's motion [N] of a saw that is pushed with `push` [N] and removes no bone: to move,
/// its teeth must break loose, with the force that goes with such a push in cutting.
double breakaway_force(const SawParameters& law, double push) noexcept {
    const double thrust = force_per_width(law.edge_depth, law.thrust()),
                 cutting = force_per_width(law.edge_depth, law.cutting());
    return thrust > 0.0 ? push * cutting / thrust : 0.0;
}

}  // namespace

void SawCutting::begin(const Held<OscillatingBlade>& saw, const BoneQuery& bone, State& state) const noexcept {
    Prepared& p = state.prepared;
    p.blade = saw.blade();
    p.touching_in_cut = touching_points(p.blade, *this, bone, true);
    p.touching = touching_points(p.blade, *this, bone, false);
}

SawCutting::Notes SawCutting::resist(const Held<OscillatingBlade>& saw, const BoneQuery& bone, const State& state,
                                     Channels& channels) const noexcept {
    const auto& [blade, touching_in_cut, touching] = state.prepared;
    const Oscillation motion = oscillation_of(saw, blade, state);
    Notes notes;
    if (motion.cutting.resists()) {
        TeethInBone in_bone;
        in_bone.sample(*this, bone, blade, motion);
        notes = {.engaged = in_bone.engaged, .resisting = in_bone.resisting()};
        add_feed_cutting(in_bone, blade, *this, motion, state.feed_rate, channels);
        if (motion.cutting.removes_bone()) add_side_cutting(in_bone, blade, *this, bone, motion, channels);
    }
    add_contact(blade, motion.cutting.removes_bone() ? touching_in_cut : touching, *this, bone, motion, state.slot,
                state.binding, channels);
    return notes;
}

void SawCutting::commit(const Held<OscillatingBlade>& saw, const BoneQuery& bone, const Noted<Notes>& advance,
                        State& state, Signals& signals, Actions& actions) const noexcept {
    const double dt = saw.tick.dt;
    const SawBlade& blade = state.prepared.blade;
    const Oscillation motion = oscillation_of(saw, blade, state);
    auto [engaged, resisting] = advance.notes;
    if (!motion.cutting.resists()) {  // a still saw samples its teeth for its motor, which must break them loose
        TeethInBone in_bone;
        in_bone.sample(*this, bone, blade, motion);
        engaged = in_bone.engaged;
        resisting = in_bone.resisting();
    }
    const bool removes_bone = motion.cutting.removes_bone();
    const double thrust = thrust_of(advance);
    const bool is_cutting = removes_bone && thrust > 0.0;
    state.feed_rate = std::max(0.0, advance.rate[2]);
    state.binding = binding_of(advance);

    // The force along the teeth's motion, and the motor's torque for it: a mean force over two strokes each turn.
    const double per_tooth = mean_cutting_force(blade, *this, motion.stroke, state.feed_rate);
    const double along = is_cutting     ? resisting * per_tooth
                         : removes_bone ? 0.0
                                        : breakaway_force(*this, advance.pushed_along());
    const double rubbing = friction * state.binding;
    const double load = (along + rubbing) * blade.stroke() / pi;
    signals.chip_thickness = is_cutting ? mean_chip_per_feed(motion.stroke) * state.feed_rate : 0.0;
    signals.engaged_teeth = engaged;
    signals.tooth_force = is_cutting && engaged > 0.0 ? thrust / engaged : 0.0;
    signals.vibration = motion.is_averaged && is_cutting ? along + rubbing : 0.0;
    signals.binding = state.binding;
    signals.drive_power = 2.0 * pi * state.cutter.speed() * load;
    signals.stroke_rate = state.cutter.speed();

    // The slot is cut while the teeth advance in bone, and forgotten when none is in it any more.
    if (engaged <= 0.0 && !is_cutting && state.feed_rate > 0.0) state.slot.depth = 0.0;
    state.slot.move(advance.rate, dt, is_cutting ? state.feed_rate * dt : 0.0, 0.5 * bone.reach());

    if (removes_bone) actions.cut();
    state.phase += 2.0 * pi * state.cutter.speed() * dt;
    while (state.phase >= 2.0 * pi) state.phase -= 2.0 * pi;
    state.cutter.step(saw.motor(), saw.stroke_rate, load, dt, slowest_cut, phase_events, actions);
}

}  // namespace kerf::sawing
