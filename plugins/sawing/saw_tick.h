// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "kerf/plugin.hpp"
#include "kerf/powered_cutter.hpp"
#include "own_slot.h"
#include "saw_contact.h"
#include "saw_parameters.h"

/// One tick of a saw's law, for any blade.
namespace kerf::sawing {

struct SawState {
    double phase = 0.0;      ///< [rad] of the oscillation
    double feed_rate = 0.0;  ///< [m/s] of the last tick
    double binding = 0.0;    ///< [N] on the sides in the last tick
    PoweredCutter cutter;    ///< its speed is the stroke rate
    OwnSlot slot;
};
/// Geometry that depends on parameters and grid only.
template <class Blade>
struct PreparedSaw {
    Blade blade{};
    TouchingPoints touching_in_cut, touching;  ///< while it removes bone; otherwise
};
struct SawNotes {
    double engaged = 0.0;    ///< teeth in bone
    double resisting = 0.0;  ///< their resistance, in teeth of the reference tissue
};
struct SawSignals {
    double chip_thickness = 0.0, engaged_teeth = 0.0, tooth_force = 0.0, vibration = 0.0, binding = 0.0;
    double drive_power = 0.0, stroke_rate = 0.0;

    static constexpr auto about() {
        return group(
            signal(&SawSignals::chip_thickness,
                   {.id = "chip_thickness",
                    .help = "Uncut chip thickness at the teeth, averaged over the oscillation.",
                    .unit = unit::um}),
            signal(&SawSignals::engaged_teeth, {.id = "engaged_teeth", .help = "Teeth in bone."}),
            signal(&SawSignals::tooth_force,
                   {.id = "tooth_force", .help = "Thrust of one tooth in bone.", .unit = unit::N}),
            signal(
                &SawSignals::vibration,
                {.id = "vibration",
                 .help = "Size of the force that swings with the teeth and is left out of the force on the hand: for "
                         "sound and rumble.",
                 .unit = unit::N}),
            signal(&SawSignals::binding, {.id = "binding", .help = "Force on the blade's sides.", .unit = unit::N}),
            signal(&SawSignals::drive_power,
                   {.id = "drive_power", .help = "Power of the motor into cutting and rubbing.", .unit = unit::W}),
            signal(&SawSignals::stroke_rate,
                   {.id = "stroke_rate", .help = "Actual oscillations.", .unit = unit::per_min}));
    }
};

/// The events of a saw's motor. `E` has `off`, `speeding_up`, `running`, `bogging`, `stalled` and `running_down`.
template <class E>
[[nodiscard]] constexpr auto motor_events() noexcept {
    return group(
        event(E::off, {.id = "sawing.off", .help = "The blade is still and its motor is off."}),
        event(E::speeding_up,
              {.id = "sawing.speeding_up", .help = "The motor brings the blade up to the commanded rate."}),
        event(E::running, {.id = "sawing.running", .help = "The blade swings at the commanded rate."}),
        event(E::bogging, {.id = "sawing.bogging",
                           .help = "The blade is slower than 0.7 of the commanded rate: the bone takes more "
                                   "torque than the motor has."}),
        event(E::stalled, {.id = "sawing.stalled",
                           .help = "The blade was held fast; it starts again once it has been commanded off."}),
        event(E::running_down, {.id = "sawing.running_down", .help = "The blade runs down with its motor off."}));
}
template <class E>
inline constexpr PhaseEvents<E> phase_events{.off = E::off,
                                             .speeding_up = E::speeding_up,
                                             .running = E::running,
                                             .reversing = E::running,  // an oscillation has no other sense
                                             .bogging = E::bogging,
                                             .stalled = E::stalled,
                                             .running_down = E::running_down};

/// Returns the oscillation of a saw with the command `commanded` [1/s].
template <class Blade>
[[nodiscard]] Oscillation oscillation_of(const Blade& blade, double commanded, const SawState& state) noexcept;

template <class Blade>
void prepare_saw(const Blade& blade, const SawParameters& law, const BoneQuery& bone,
                 PreparedSaw<Blade>& prepared) noexcept {
    prepared.blade = blade;
    prepared.touching_in_cut = touching_points(blade, law, bone, true);
    prepared.touching = touching_points(blade, law, bone, false);
}

/// Adds the channels of a tick.   [haptic, nonblocking] pure.
template <class Blade>
[[nodiscard]] SawNotes resist_saw(const PreparedSaw<Blade>& saw, const SawParameters& law, double commanded,
                                  const BoneQuery& bone, const SawState& state, Channels& channels) noexcept;

/// Results of `resist` about the teeth, for the commit.
struct CutInTick {
    SawNotes teeth;
    std::optional<double> along_per_thrust;  ///< [–] force along the teeth; none: from the law of a tooth
};

/// Takes over the motion of a tick, except in the motor.   [haptic, nonblocking]
/// @return [N·m] load torque on the motor
template <class Blade>
[[nodiscard]] double commit_saw(const Blade& blade, const SawParameters& law, const Oscillation& motion,
                                const BoneQuery& bone, const Advance& advance, const CutInTick& cut, double dt,
                                SawState& state, SawSignals& signals, Actions& actions) noexcept;

}  // namespace kerf::sawing
