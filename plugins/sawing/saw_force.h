// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "saw_tick.h"
#include "saw_tool.h"

/// Forces on an oscillating saw: teeth cut, sides bind and rub, a motor swings it.
namespace kerf::sawing {

/// The force law of an oscillating saw. Source: docs/models/oscillating-saw.md.
struct SawCutting : SawParameters {
    struct State : SawState {
        PreparedSaw<SawBlade> prepared;
    };
    using Signals = SawSignals;
    enum class Happened { off, speeding_up, running, bogging, stalled, running_down };

    static constexpr auto about() {
        return describe(
            "saw_cutting",
            "Edge and chip forces on each tooth, averaged over the oscillation, binding in the blade's own slot, "
            "contact and friction.",
            SawParameters::about(), budget_us(150), work({.channels = 16, .points = 400, .queries = 8}),
            SawSignals::about(), motor_events<Happened>());
    }

    void begin(const Held<OscillatingBlade>& saw, const BoneQuery& bone, State& state) const noexcept;
    [[nodiscard]] SawNotes resist(const Held<OscillatingBlade>& saw, const BoneQuery& bone, const State& state,
                                  Channels& channels) const noexcept;
    void commit(const Held<OscillatingBlade>& saw, const BoneQuery& bone, const Noted<SawNotes>& advance, State& state,
                Signals& signals, Actions& actions) const noexcept;
};

}  // namespace kerf::sawing
