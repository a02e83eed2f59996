// SPDX-License-Identifier: Apache-2.0
#include "saw_tick.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "saw_tool.h"

namespace kerf::sawing {

namespace {

constexpr double averaged_from =
    100.0;  // [1/s] above it forces are averaged; in ticks of 1 ms a faster force would alias

/// Returns the thrust on the teeth of all sectors [N].
double thrust_of(const Advance& advance) noexcept {
    double sum = 0.0;
    for (std::size_t c = 0; c < advance.channel.size(); ++c) {
        const std::uint32_t id = advance.channel[c].id;
        if (id >= id_feed && id < id_feed + sector_count * part_count) sum += advance.lambda[c];
    }
    return sum;
}

/// Returns the force along the teeth's motion [N] of a saw under `push` [N] that removes no bone. To move, its teeth
/// must break loose. The force is the one that cutting at this thrust would take.
double breakaway_force(const SawParameters& law, double push) noexcept {
    const double thrust = force_per_width(law.edge_depth, law.thrust()),
                 cutting = force_per_width(law.edge_depth, law.cutting());
    return thrust > 0.0 ? push * cutting / thrust : 0.0;
}

}  // namespace

/// A saw passes all rates as it speeds up and runs down. It shakes with every stroke only if its command is that slow.
template <class Blade>
Oscillation oscillation_of(const Blade& blade, double commanded, const SawState& state) noexcept {
    return {.stroke = {blade.stroke(), blade.pitch, std::max(state.cutter.speed(), slowest_cut)},
            .cutting = state.cutter.cutting,
            .phase = state.phase,
            .is_averaged = !(commanded > 0.0 && commanded <= averaged_from)};
}

template <class Blade>
SawNotes resist_saw(const PreparedSaw<Blade>& saw, const SawParameters& law, double commanded, const BoneQuery& bone,
                    const SawState& state, Channels& channels) noexcept {
    const auto& [blade, touching_in_cut, touching] = saw;
    const Oscillation motion = oscillation_of(blade, commanded, state);
    SawNotes notes;
    if (motion.cutting.resists()) {
        TeethInBone in_bone;
        in_bone.sample(law, bone, blade, motion);
        notes = {.engaged = in_bone.engaged, .resisting = in_bone.resisting()};
        add_feed_cutting(in_bone, blade.kerf(), law, motion, state.feed_rate, channels);
        if (motion.cutting.removes_bone()) add_side_cutting(in_bone, blade, law, bone, motion, channels);
    }
    add_contact(blade, motion.cutting.removes_bone() ? touching_in_cut : touching, law, bone, motion, state.slot,
                state.binding, channels);
    return notes;
}

template <class Blade>
double commit_saw(const Blade& blade, const SawParameters& law, const Oscillation& motion, const BoneQuery& bone,
                  const Advance& advance, const CutInTick& cut, double dt, SawState& state, SawSignals& signals,
                  Actions& actions) noexcept {
    auto [engaged, resisting] = cut.teeth;
    if (!motion.cutting.resists()) {  // a still saw samples its teeth, because its motor must break them loose
        TeethInBone in_bone;
        in_bone.sample(law, bone, blade, motion);
        engaged = in_bone.engaged;
        resisting = in_bone.resisting();
    }
    const bool removes_bone = motion.cutting.removes_bone();
    const double thrust = thrust_of(advance);
    const bool is_cutting = removes_bone && thrust > 0.0;
    state.feed_rate = std::max(0.0, advance.rate[2]);
    state.binding = binding_of(advance);

    // The force along the teeth's motion, and the motor's torque for it: a mean force over two strokes each turn.
    const double cutting = cut.along_per_thrust
                               ? *cut.along_per_thrust * thrust
                               : resisting * mean_cutting_force(blade.kerf(), law, motion.stroke, state.feed_rate);
    const double along = is_cutting ? cutting : removes_bone ? 0.0 : breakaway_force(law, advance.axial_thrust());
    const double rubbing = law.friction * state.binding;
    const double load = (along + rubbing) * blade.stroke() / pi;
    signals.chip_thickness = is_cutting ? mean_chip_per_feed(motion.stroke) * state.feed_rate : 0.0;
    signals.engaged_teeth = engaged;
    signals.tooth_force = is_cutting && engaged > 0.0 ? thrust / engaged : 0.0;
    signals.vibration = motion.is_averaged && is_cutting ? along + rubbing : 0.0;
    signals.binding = state.binding;
    signals.drive_power = 2.0 * pi * state.cutter.speed() * load;
    signals.stroke_rate = state.cutter.speed();

    // The slot is cut while the teeth advance in bone. Its depth is reset when no tooth is in bone.
    if (engaged <= 0.0 && !is_cutting && state.feed_rate > 0.0) state.slot.depth = 0.0;
    state.slot.move(advance.rate, dt, is_cutting ? state.feed_rate * dt : 0.0, 0.5 * bone.reach());

    if (removes_bone) actions.cut();
    state.phase += 2.0 * pi * state.cutter.speed() * dt;
    while (state.phase >= 2.0 * pi) state.phase -= 2.0 * pi;
    return load;
}

template Oscillation oscillation_of(const SawBlade&, double, const SawState&) noexcept;
template Oscillation oscillation_of(const StraightBlade&, double, const SawState&) noexcept;
template SawNotes resist_saw(const PreparedSaw<SawBlade>&, const SawParameters&, double, const BoneQuery&,
                             const SawState&, Channels&) noexcept;
template SawNotes resist_saw(const PreparedSaw<StraightBlade>&, const SawParameters&, double, const BoneQuery&,
                             const SawState&, Channels&) noexcept;
template double commit_saw(const SawBlade&, const SawParameters&, const Oscillation&, const BoneQuery&, const Advance&,
                           const CutInTick&, double, SawState&, SawSignals&, Actions&) noexcept;
template double commit_saw(const StraightBlade&, const SawParameters&, const Oscillation&, const BoneQuery&,
                           const Advance&, const CutInTick&, double, SawState&, SawSignals&, Actions&) noexcept;

}  // namespace kerf::sawing
