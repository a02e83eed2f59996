// SPDX-License-Identifier: Apache-2.0
#include "saw_force.h"

namespace kerf::sawing {

void SawCutting::begin(const Held<OscillatingBlade>& saw, const BoneQuery& bone, State& state) const noexcept {
    prepare_saw(saw.blade(), *this, bone, state.prepared);
}

SawNotes SawCutting::resist(const Held<OscillatingBlade>& saw, const BoneQuery& bone, const State& state,
                            Channels& channels) const noexcept {
    return resist_saw(state.prepared, *this, saw.stroke_rate, bone, state, channels);
}

void SawCutting::commit(const Held<OscillatingBlade>& saw, const BoneQuery& bone, const Noted<SawNotes>& advance,
                        State& state, Signals& signals, Actions& actions) const noexcept {
    const SawBlade& blade = state.prepared.blade;
    const Oscillation motion = oscillation_of(blade, saw.stroke_rate, state);
    const double load =
        commit_saw(blade, *this, motion, bone, advance, {advance.notes, {}}, saw.tick.dt, state, signals, actions);
    state.cutter.step(saw.motor(), saw.stroke_rate, load, saw.tick.dt, slowest_cut, phase_events<Happened>, actions);
}

}  // namespace kerf::sawing
