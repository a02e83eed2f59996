// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/plugin.hpp"
#include "kerf/powered_cutter.hpp"
#include "own_slot.h"
#include "saw_contact.h"
#include "saw_parameters.h"
#include "saw_tool.h"

/// What an oscillating saw feels: teeth that cut, sides that bind and rub, a motor that swings it.
namespace kerf::sawing {

/// The law of an oscillating saw, docs/models/oscillating-saw.md.
struct SawCutting : SawParameters {
    /// What follows from parameters and grid alone.
    struct Prepared {
        SawBlade blade{};
        TouchingPoints touching_in_cut, touching;  ///< while it removes bone; otherwise
    };
    struct State {
        double phase = 0.0;      ///< [rad] of the oscillation
        double feed_rate = 0.0;  ///< [m/s] of the last tick
        double binding = 0.0;    ///< [N] on the sides in the last tick
        PoweredCutter cutter;    ///< its speed is the stroke rate
        OwnSlot slot;
        Prepared prepared;
    };
    struct Notes {
        double engaged = 0.0;    ///< teeth in bone
        double resisting = 0.0;  ///< their resistance, in teeth of the reference tissue
    };
    struct Signals {
        double chip_thickness = 0.0, engaged_teeth = 0.0, tooth_force = 0.0, vibration = 0.0, binding = 0.0;
        double drive_power = 0.0, stroke_rate = 0.0;
    };
    enum class Happened { off, speeding_up, running, bogging, stalled, running_down };

    static constexpr auto about() {
        using namespace literals;
        return describe(
            "saw_cutting",
            "Edge and chip forces on each tooth, averaged over the oscillation, binding in the blade's own slot, "
            "contact and friction.",
            SawParameters::about(), budget_us(150), work({.channels = 16, .points = 400, .queries = 8}),
            signal(&Signals::chip_thickness,
                   {.id = "chip_thickness",
                    .help = "Uncut chip thickness at the teeth, averaged over the oscillation.",
                    .unit = unit::um}),
            signal(&Signals::engaged_teeth, {.id = "engaged_teeth", .help = "Teeth in bone."}),
            signal(&Signals::tooth_force,
                   {.id = "tooth_force", .help = "Thrust of one tooth in bone.", .unit = unit::N}),
            signal(
                &Signals::vibration,
                {.id = "vibration",
                 .help = "Size of the force that swings with the teeth and is left out of the force on the hand: for "
                         "sound and rumble.",
                 .unit = unit::N}),
            signal(&Signals::binding, {.id = "binding", .help = "Force on the blade's sides.", .unit = unit::N}),
            signal(&Signals::drive_power,
                   {.id = "drive_power", .help = "Power of the motor into cutting and rubbing.", .unit = unit::W}),
            signal(&Signals::stroke_rate, {.id = "stroke_rate", .help = "Actual oscillations.", .unit = unit::per_min}),
            event(Happened::off, {.id = "sawing.off", .help = "The blade is still and its motor is off."}),
            event(Happened::speeding_up,
                  {.id = "sawing.speeding_up", .help = "The motor brings the blade up to the commanded rate."}),
            event(Happened::running, {.id = "sawing.running", .help = "The blade swings at the commanded rate."}),
            event(Happened::bogging, {.id = "sawing.bogging",
                                      .help = "The blade is slower than 0.7 of the commanded rate: the bone takes more "
                                              "torque than the motor has."}),
            event(Happened::stalled,
                  {.id = "sawing.stalled",
                   .help = "The blade was held fast; it starts again once it has been commanded off."}),
            event(Happened::running_down,
                  {.id = "sawing.running_down", .help = "The blade runs down with its motor off."}));
    }

    void begin(const Held<OscillatingBlade>& saw, const BoneQuery& bone, State& state) const noexcept;
    [[nodiscard]] Notes resist(const Held<OscillatingBlade>& saw, const BoneQuery& bone, const State& state,
                               Channels& channels) const noexcept;
    void commit(const Held<OscillatingBlade>& saw, const BoneQuery& bone, const Noted<Notes>& advance, State& state,
                Signals& signals, Actions& actions) const noexcept;
};

}  // namespace kerf::sawing
