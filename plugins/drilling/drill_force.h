// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "bit_bending.h"
#include "crushing.h"
#include "drill_bit.h"
#include "drill_contact.h"
#include "drill_cutting.h"
#include "hole_line.h"
#include "kerf/plugin.hpp"
#include "kerf/powered_cutter.hpp"

/// Forces on a twist drill: lips and chisel edge cut, the shank touches and rubs, a motor turns the drill.
namespace kerf::drilling {

/// The force law of a twist drill. Source: docs/models/drilling.md.
struct DrillCutting : DrillParameters {
    /// Geometry that depends on parameters and grid only.
    struct Prepared {
        TwistDrill drill{};
        EdgeLayout edges;
        SideEdges sides;
        ContactPoints touching_in_cut, touching;  ///< while the tip removes or crushes bone; otherwise
        CrushingTip tip;
        double bending_weight = 0.0;  ///< [–] weight of one tick in the average bending stress
    };
    struct State {
        double angle = 0.0;  ///< [rad] of the first lip about the shaft
        Travel travel;
        OwnHoles holes;              ///< of its lands
        HoleLine hole;               ///< of its shank
        Carried carried;             ///< by contact in the last tick
        bool crushes = false;        ///< the still tip crushes bone
        double crushing_from = 0.0;  ///< [N] contact force when crushing began
        WallAhead wall;              ///< ahead of a tip that rests or crushes
        BrokenWall broken;           ///< the part of it that has broken
        Bending bending;             ///< of the bit, averaged over a few milliseconds
        bool is_overbent = false;    ///< set above the yield stress, cleared when the bit is nearly straight
        double reaction = 0.0;       ///< [N·m] motor torque beyond the torque from bone; negative in reverse
        PoweredCutter cutter;
        Prepared prepared;
    };
    struct Notes {
        double engagement = 0.0;                      ///< [–] fraction of the edges in bone
        std::size_t breaks_on = PressedWall::no_ray;  ///< ray to the wall that breaks before a still tip
        bool is_bent = false;                         ///< the shank does not fit into its hole
        bool is_broken = false;                       ///< a wall has broken before the tip
    };
    struct Signals {
        double chip_thickness = 0.0, feed_per_revolution = 0.0, engagement = 0.0, drive_power = 0.0,
               spindle_speed = 0.0, bending_stress = 0.0;
    };
    enum class Happened {
        spindle_off,
        spinning_up,
        running,
        bogging,
        stalled,
        running_down,
        reversing,
        bit_overbent,
        crushing,
        wall_broken
    };

    static constexpr auto about() {
        return describe(
            "drill_cutting",
            "Edge and chip forces on lips and chisel edge, mixed tissue, contact and friction of the shank.",
            DrillParameters::about(), budget_us(150), work({.channels = 16, .points = 1200, .queries = 8}),
            signal(&Signals::chip_thickness,
                   {.id = "chip_thickness", .help = "Uncut chip thickness at the lips.", .unit = unit::um}),
            signal(&Signals::feed_per_revolution,
                   {.id = "feed_per_revolution", .help = "Feed per revolution through bone.", .unit = unit::mm}),
            signal(&Signals::engagement, {.id = "engagement", .help = "Share of the cutting edges in bone."}),
            signal(&Signals::drive_power,
                   {.id = "drive_power", .help = "Power the motor puts into cutting and rubbing.", .unit = unit::W}),
            signal(&Signals::spindle_speed,
                   {.id = "spindle_speed", .help = "Speed of the spindle as it is.", .unit = unit::rpm}),
            signal(&Signals::bending_stress, {.id = "bending_stress",
                                              .help = "Largest bending stress in the bit, averaged over 20 ms.",
                                              .unit = unit::N_per_mm2}),
            event(Happened::spindle_off,
                  {.id = "drilling.spindle_off", .help = "The spindle is still and its motor is off."}),
            event(Happened::spinning_up,
                  {.id = "drilling.spinning_up", .help = "The motor brings the spindle up to the commanded speed."}),
            event(Happened::running, {.id = "drilling.running", .help = "The spindle turns as it is commanded."}),
            event(Happened::bogging,
                  {.id = "drilling.bogging",
                   .help = "The spindle is slower than 0.7 of its command: the bone takes more torque "
                           "than the motor has."}),
            event(Happened::stalled,
                  {.id = "drilling.stalled",
                   .help = "The spindle was held fast; it starts again once it has been commanded off."}),
            event(Happened::running_down,
                  {.id = "drilling.running_down", .help = "The spindle runs down with its motor off."}),
            event(Happened::reversing,
                  {.id = "drilling.reversing", .help = "The spindle turns in reverse, and the edges rub."}),
            event(Happened::bit_overbent,
                  {.id = "drilling.bit_overbent",
                   .help =
                       "The bit was bent beyond its `yield_strength`: one of steel would have stayed bent, or broken.",
                   .is_damage = true}),
            event(Happened::crushing, {.id = "drilling.crushing",
                                       .help = "The tip does not turn, and is pushed harder than the bone before it "
                                               "withstands: it crushes its way in."}),
            event(Happened::wall_broken,
                  {.id = "drilling.wall_broken",
                   .help = "A thin wall with free space behind it broke out before a tip that does not turn."}));
    }

    using AnyDrill = Held<TwistBit, StepBit, ProfileBit>;
    void begin(const AnyDrill& tool, const BoneQuery& bone, State& state) const noexcept;
    [[nodiscard]] Notes resist(const AnyDrill& tool, const BoneQuery& bone, const State& state,
                               Channels& channels) const noexcept;
    void commit(const AnyDrill& tool, const BoneQuery& bone, const Noted<Notes>& advance, State& state,
                Signals& signals, Actions& actions) const noexcept;
};

}  // namespace kerf::drilling
