// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "kerf/force.hpp"
#include "own_slot.h"
#include "saw_contact.h"
#include "saw_parameters.h"

/// What an oscillating saw feels: teeth that cut, sides that bind and rub, a motor that swings it.
namespace kerf::sawing {

/// The law of an oscillating saw, docs/models/oscillating-saw.md.
struct SawCutting {
    /// What follows from parameters and grid alone.
    struct Prepared {
        SawBlade blade{};
        TouchingPoints touching_in_cut, touching;  ///< while it takes bone, else
    };
    struct State {
        double phase = 0.0;      ///< [rad] of the oscillation
        double feed_rate = 0.0;  ///< [m/s] of the last tick
        double binding = 0.0;    ///< [N] what the sides carried in the last tick
        double cut_share = 0.0;  ///< [–] 1 while it cuts, then fading
        OwnSlot slot;
        Spindle motor;  ///< its speed is the stroke rate
        Prepared prepared;
    };
    static constexpr std::size_t tool_parameter_count = sawing::tool_parameter_count;
    static constexpr std::size_t force_parameter_count = sawing::force_parameter_count;
    static constexpr std::size_t drive_count = sawing::drive_count;
    static constexpr std::size_t signal_count = sawing::signal_count;

    static void begin(const Tick& tick, const BoneQuery& bone, State& state) noexcept;
    static void resist(const Tick& tick, const BoneQuery& bone, const State& state, Channels& channels) noexcept;
    static void commit(const Tick& tick, const BoneQuery& bone, const Advance& advance, State& state,
                       std::span<double> signals, Actions& actions) noexcept;
};
static_assert(ForceLaw<SawCutting>);

}  // namespace kerf::sawing
