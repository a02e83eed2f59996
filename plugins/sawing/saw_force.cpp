// SPDX-License-Identifier: Apache-2.0
#include "saw_force.h"

#include <algorithm>
#include <cstdint>

namespace kerf::sawing {

namespace {

using namespace literals;

// Below `slowest_cut` its teeth only drag, less and less, while it sinks onto the bone that they leave standing; so
// contact takes over without a blow.
constexpr double dragging_time = 2.0_ms;
// From here on forces are averaged over the oscillation: in ticks of a millisecond a faster one would alias.
constexpr double averaged_from = 100.0;  // [1/s]

enum Note : std::size_t { note_engaged, note_resisting };  // teeth in bone; what they resist, in teeth

/// On its way up or down a saw passes all rates: only one that is meant to go slowly shakes with every stroke.
Going going_of(const SawBlade& blade, const Tick& tick, const SawCutting::State& state) noexcept {
    const double commanded = tick.drive[drive_stroke_rate];
    return {{blade.stroke(), blade.pitch, std::max(state.motor.speed, slowest_cut)},
            state.cut_share,
            state.phase,
            !(commanded > 0.0 && commanded <= averaged_from)};
}

Event event_of(Spindle::Phase phase) noexcept {
    switch (phase) {
        case Spindle::Phase::off:
            return event_off;
        case Spindle::Phase::spinning_up:
            return event_speeding_up;
        case Spindle::Phase::running:
            return event_running;
        case Spindle::Phase::reversing:
            return event_running;  // an oscillation has no other sense
        case Spindle::Phase::stalled:
            return event_stalled;
        case Spindle::Phase::bogging:
            return event_bogging;
        case Spindle::Phase::running_down:
            return event_running_down;
    }
    return event_off;
}

/// What the teeth carried against the feed, of all sectors [N].
double thrust_of(const Advance& advance) noexcept {
    double sum = 0.0;
    for (std::size_t c = 0; c < advance.channel.size(); ++c) {
        const std::uint32_t id = advance.channel[c].id;
        if (id >= id_feed && id < id_feed + sector_count * part_count) sum += advance.lambda[c];
    }
    return sum;
}

/// What pushes the saw back along its shaft, of all channels [N].
double pushed_along(const Advance& advance) noexcept {
    double sum = 0.0;
    for (std::size_t c = 0; c < advance.channel.size(); ++c)
        if (advance.channel[c].kind != KERF_FRICTION) sum += advance.channel[c].d[2] * advance.lambda[c];
    return std::max(0.0, sum);
}

/// Along the teeth's motion [N], of a saw that is pushed with `push` [N] on bone it takes none of: to go, its teeth
/// have to break loose what they stand in, with the force that goes with such a push in cutting.
double force_of_standing(const Tick& tick, double push) noexcept {
    const Coefficients k = coefficients(tick.force);
    const double thrust = force_per_width(k.thrust.edge_depth, k.thrust),
                 cutting = force_per_width(k.thrust.edge_depth, k.cutting);
    return thrust > 0.0 ? push * cutting / thrust : 0.0;
}

}  // namespace

void SawCutting::begin(const Tick& tick, const BoneQuery& bone, State& state) noexcept {
    Prepared& p = state.prepared;
    p.blade = blade_of(tick.tool);
    p.touching_in_cut = touching_points(p.blade, tick, bone, true);
    p.touching = touching_points(p.blade, tick, bone, false);
}

void SawCutting::resist(const Tick& tick, const BoneQuery& bone, const State& state, Channels& channels) noexcept {
    const auto& [blade, touching_in_cut, touching] = state.prepared;
    const Going going = going_of(blade, tick, state);
    if (going.drags()) {
        TeethInBone in_bone;
        in_bone.ask(tick, bone, blade, going);
        channels.note(note_engaged, in_bone.engaged);
        channels.note(note_resisting, in_bone.resisting());
        add_feed_cutting(in_bone, blade, tick, going, state.feed_rate, channels);
        if (going.removes()) add_side_cutting(in_bone, blade, tick, bone, going, channels);
    }
    add_contact(blade, going.removes() ? touching_in_cut : touching, tick, bone, going, state.slot, state.binding,
                channels);
}

void SawCutting::commit(const Tick& tick, const BoneQuery& bone, const Advance& advance, State& state,
                        std::span<double> signals, Actions& actions) noexcept {
    const SawBlade& blade = state.prepared.blade;
    const Going going = going_of(blade, tick, state);
    double engaged = advance.note.empty() ? 0.0 : advance.note[note_engaged];
    double resisting = advance.note.empty() ? 0.0 : advance.note[note_resisting];
    if (!going.drags()) {  // a still saw asks for its motor, which has to break its teeth loose
        TeethInBone in_bone;
        in_bone.ask(tick, bone, blade, going);
        engaged = in_bone.engaged;
        resisting = in_bone.resisting();
    }
    const double thrust = thrust_of(advance);
    const bool is_cutting = going.removes() && thrust > 0.0;
    state.feed_rate = std::max(0.0, advance.rate[2]);
    state.binding = binding_of(advance);

    // What the teeth meet along their motion, and what the motor needs for it: a mean force over two strokes each turn.
    const double per_tooth = mean_cutting_force(blade, tick, going.stroke, state.feed_rate);
    const double along = is_cutting        ? resisting * per_tooth
                         : going.removes() ? 0.0
                                           : force_of_standing(tick, pushed_along(advance));
    const double rubbing = tick.force[force_friction] * state.binding;
    const double load = (along + rubbing) * blade.stroke() / pi;
    signals[signal_chip_thickness] = is_cutting ? mean_chip_per_feed(going.stroke) * state.feed_rate : 0.0;
    signals[signal_engaged_teeth] = engaged;
    signals[signal_tooth_force] = is_cutting && engaged > 0.0 ? thrust / engaged : 0.0;
    signals[signal_vibration] = going.is_averaged && is_cutting ? along + rubbing : 0.0;
    signals[signal_binding] = state.binding;
    signals[signal_drive_power] = 2.0 * pi * state.motor.speed * load;
    signals[signal_stroke_rate] = state.motor.speed;

    // The slot: cut while the teeth go forward in bone, left when none is in it any more.
    if (engaged <= 0.0 && !is_cutting && state.feed_rate > 0.0) state.slot.depth = 0.0;
    state.slot.move(advance.rate, tick.dt, is_cutting ? state.feed_rate * tick.dt : 0.0, 0.5 * bone.reach());

    if (going.removes()) actions.cut();
    state.phase += 2.0 * pi * state.motor.speed * tick.dt;
    while (state.phase >= 2.0 * pi) state.phase -= 2.0 * pi;
    if (state.motor.step(motor_of(tick.tool), tick.drive[drive_stroke_rate], load, tick.dt))
        actions.event(event_of(state.motor.phase));
    state.cut_share = state.motor.speed >= slowest_cut ? 1.0
                      : state.cut_share > 1e-6         ? state.cut_share * exp_exact(-tick.dt / dragging_time)
                                                       : 0.0;
}

}  // namespace kerf::sawing
