// SPDX-License-Identifier: Apache-2.0
#include "reciprocating_force.h"

namespace kerf::sawing {

void watch_torque(const Advance& advance, const StraightBlade& blade, double threshold, double dt,
                  ReciprocatingState& state, ReciprocatingSignals& signals, Actions& actions) noexcept {
    signals.blade_torque = blade_torque(advance, blade);
    const bool is_in_bone = signals.engaged_teeth > 0.0 || state.binding > 0.0;
    if (state.twist.step(signals.blade_torque, threshold, is_in_bone, dt)) actions.event(ReciprocatingEvent::twisted);
    signals.torque_exceedance = state.twist.exceedance();
}

void ReciprocatingCutting::begin(const Held<ReciprocatingBlade>& saw, const BoneQuery& bone,
                                 State& state) const noexcept {
    prepare_saw(saw.blade(), *this, bone, state.prepared);
}

SawNotes ReciprocatingCutting::resist(const Held<ReciprocatingBlade>& saw, const BoneQuery& bone, const State& state,
                                      Channels& channels) const noexcept {
    return resist_saw(state.prepared, *this, saw.stroke_rate, bone, state, channels);
}

void ReciprocatingCutting::commit(const Held<ReciprocatingBlade>& saw, const BoneQuery& bone,
                                  const Noted<SawNotes>& advance, State& state, Signals& signals,
                                  Actions& actions) const noexcept {
    const StraightBlade& blade = state.prepared.blade;
    const Oscillation motion = oscillation_of(blade, saw.stroke_rate, state);
    const double load =
        commit_saw(blade, *this, motion, bone, advance, {advance.notes, {}}, saw.tick.dt, state, signals, actions);
    state.cutter.step(saw.motor(), saw.stroke_rate, load, saw.tick.dt, slowest_cut, phase_events<Happened>, actions);
    watch_torque(advance, blade, torque_threshold, saw.tick.dt, state, signals, actions);
}

}  // namespace kerf::sawing
