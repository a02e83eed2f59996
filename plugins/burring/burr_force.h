// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "burr_contact.h"
#include "burr_tool.h"
#include "kerf/plugin.hpp"

/// Forces on a burr: blades on its head cut, its neck rubs, a motor turns it.
namespace kerf::burring {

using AnyBurr = Held<RoundBurr, CylindricalBurr, PearBurr>;

/// The force law of a burr. Source: docs/models/burr.md.
struct BurrCutting : BurrParameters {
    struct Prepared {
        BurrHead head{};
        EdgePoints edges;
        ContactPoints touching_in_cut, touching;  ///< while it removes bone; otherwise
    };
    struct State {
        Vec6 rate{};            ///< [m/s, rad/s] of the tool, averaged over the last ticks
        double reaction = 0.0;  ///< [N·m] motor torque beyond the torque from bone; negative in reverse
        Carried carried;
        PoweredCutter cutter;
        Prepared prepared;
    };
    struct Notes {
        double engaged = 0.0;  ///< [m] of blade in bone
    };
    struct Signals {
        double cutting_force = 0.0, side_pull = 0.0, chip_thickness = 0.0, engagement = 0.0, drive_power = 0.0,
               spindle_speed = 0.0;
    };
    enum class Happened { off, speeding_up, running, reversing, bogging, stalled, running_down };

    static constexpr auto about() {
        return describe(
            "burr_cutting",
            "Edge and chip forces of blades all over the head, averaged over the turn, contact and friction of the "
            "neck and of a head that does not cut.",
            BurrParameters::about(), budget_us(100), work({.channels = 16, .points = 1100, .queries = 8}),
            signal(&Signals::cutting_force, {.id = "cutting_force",
                                             .help = "Force of the bone on the blades, normal to the head.",
                                             .unit = unit::N}),
            signal(&Signals::side_pull, {.id = "side_pull",
                                         .help = "Force with which the turn of the blades pulls the burr aside.",
                                         .unit = unit::N}),
            signal(&Signals::chip_thickness,
                   {.id = "chip_thickness", .help = "Mean chip thickness of the blades that cut.", .unit = unit::um}),
            signal(&Signals::engagement, {.id = "engagement", .help = "Share of the blades that is in bone."}),
            signal(&Signals::drive_power,
                   {.id = "drive_power", .help = "Power of the motor into cutting and rubbing.", .unit = unit::W}),
            signal(&Signals::spindle_speed, {.id = "spindle_speed", .help = "Actual speed.", .unit = unit::rpm}),
            event(Happened::off, {.id = "burring.off", .help = "The burr is still and its motor is off."}),
            event(Happened::speeding_up,
                  {.id = "burring.speeding_up", .help = "The motor brings the burr up to the commanded speed."}),
            event(Happened::running, {.id = "burring.running", .help = "The burr turns at the commanded speed."}),
            event(Happened::reversing, {.id = "burring.reversing", .help = "The burr turns in reverse."}),
            event(Happened::bogging, {.id = "burring.bogging",
                                      .help = "The burr is slower than 0.7 of its command: the bone takes more torque "
                                              "than the motor has."}),
            event(Happened::stalled,
                  {.id = "burring.stalled",
                   .help = "The burr was held fast; it starts again once it has been commanded off."}),
            event(Happened::running_down,
                  {.id = "burring.running_down", .help = "The burr runs down with its motor off."}));
    }

    void begin(const AnyBurr& burr, const BoneQuery& bone, State& state) const noexcept;
    [[nodiscard]] Notes resist(const AnyBurr& burr, const BoneQuery& bone, const State& state,
                               Channels& channels) const noexcept;
    void commit(const AnyBurr& burr, const BoneQuery& bone, const Noted<Notes>& advance, State& state, Signals& signals,
                Actions& actions) const noexcept;
};

}  // namespace kerf::burring
