// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "bit_bending.h"
#include "crushing.h"
#include "drill_contact.h"
#include "drill_cutting.h"
#include "hole_line.h"
#include "kerf/force.hpp"

/// What a twist drill feels: lips and chisel edge that cut, a shank that touches and rubs, a motor that turns it.
namespace kerf::drilling {

/// The law of a twist drill, docs/models/drilling.md.
struct DrillCutting {
    /// What follows from parameters and grid alone.
    struct Prepared {
        TwistDrill drill{};
        EdgePlaces edges;
        SideEdges sides;
        ContactPoints touching_in_cut, touching;  ///< while its tip goes into bone, else
        CrushingTip tip;
        double bending_share = 0.0;  ///< [–] of a tick in the mean of the bit's stress
    };
    struct State {
        double angle = 0.0;  ///< [rad] of the first lip about the shaft
        Travel travel;
        OwnHoles holes;               ///< of its lands
        HoleLine hole;                ///< of its shank
        Carried carried;              ///< by contact in the last tick
        double cut_share = 0.0;       ///< [–] 1 while it cuts, then fading
        bool crushes = false;         ///< its tip, which does not cut, the bone it stands on
        double crushing_from = 0.0;   ///< [N] that it stood with when that began
        WallAhead wall;               ///< before a tip that stands or crushes
        BrokenWall broken;            ///< what of it has broken
        double bending_stress = 0.0;  ///< [Pa] of the bit, in the mean over a few milliseconds
        bool is_overbent = false;     ///< the bit, since it was last nearly straight
        double reaction = 0.0;  ///< [N·m] of the motor, beyond what the bone's torque answers; negative in reverse
        Spindle spindle;
        Prepared prepared;
    };
    static constexpr std::size_t tool_parameter_count = drilling::tool_parameter_count;
    static constexpr std::size_t force_parameter_count = drilling::force_parameter_count;
    static constexpr std::size_t drive_count = drilling::drive_count;
    static constexpr std::size_t signal_count = drilling::signal_count;

    static void begin(const Tick& tick, const BoneQuery& bone, State& state) noexcept;
    static void resist(const Tick& tick, const BoneQuery& bone, const State& state, Channels& channels) noexcept;
    static void commit(const Tick& tick, const BoneQuery& bone, const Advance& advance, State& state,
                       std::span<double> signals, Actions& actions) noexcept;
};
static_assert(ForceLaw<DrillCutting>);

}  // namespace kerf::drilling
