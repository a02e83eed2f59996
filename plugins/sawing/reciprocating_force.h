// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "blade_torque.h"
#include "reciprocating_tool.h"
#include "saw_tick.h"

/// Forces on a reciprocating saw: teeth cut, sides bind and rub, a motor moves it, a torque twists it.
namespace kerf::sawing {

struct ReciprocatingState : SawState {
    TwistWatch twist;
};
struct ReciprocatingSignals : SawSignals {
    double blade_torque = 0.0, torque_exceedance = 0.0;

    static constexpr auto about() {
        return group(
            SawSignals::about(),
            signal(&ReciprocatingSignals::blade_torque,
                   {.id = "blade_torque",
                    .help = "Torque of the bone on the blade about its long axis, half way between its edges.",
                    .unit = unit::N_m}),
            signal(&ReciprocatingSignals::torque_exceedance,
                   {.id = "torque_exceedance",
                    .help = "Fraction of the time in bone in which the torque was above its threshold, since the saw "
                            "was taken up."}));
    }
};
enum class ReciprocatingEvent { off, speeding_up, running, bogging, stalled, running_down, twisted };

[[nodiscard]] constexpr auto reciprocating_events() noexcept {
    using E = ReciprocatingEvent;
    return group(motor_events<E>(),
                 event(E::twisted, {.id = "sawing.twisted",
                                    .help = "The blade is twisted about its long axis with more than the torque "
                                            "threshold: blade or bone may break."}));
}

/// Parameters common to all laws of a reciprocating saw.
struct ReciprocatingParameters : SawParameters {
    double torque_threshold;

    static constexpr auto about() {
        using namespace literals;
        return group(SawParameters::about(),
                     param(&ReciprocatingParameters::torque_threshold,
                           {.id = "torque_threshold",
                            .help = "Torque about the blade's long axis from which the saw warns.",
                            .unit = unit::N_m,
                            .min = 1.0_Nmm,
                            .max = 5000.0_Nmm,
                            .def = 50.0_Nmm,
                            .source = "assumed: [mandibular-angle] has a threshold and does not print it"}));
    }
};

/// Computes the torque of a tick, and fires the warning when it crosses the threshold.   [haptic, nonblocking]
void watch_torque(const Advance& advance, const StraightBlade& blade, double threshold, double dt,
                  ReciprocatingState& state, ReciprocatingSignals& signals, Actions& actions) noexcept;

/// The force law of a reciprocating saw. Source: docs/models/reciprocating-saw.md.
struct ReciprocatingCutting : ReciprocatingParameters {
    struct State : ReciprocatingState {
        PreparedSaw<StraightBlade> prepared;
    };
    using Signals = ReciprocatingSignals;
    using Happened = ReciprocatingEvent;

    static constexpr auto about() {
        return describe(
            "reciprocating_cutting",
            "Edge and chip forces on each tooth of a straight blade, averaged over the oscillation, binding in the "
            "blade's own slot, contact and friction, and a warning when the blade is twisted.",
            ReciprocatingParameters::about(), budget_us(200), work({.channels = 16, .points = 800, .queries = 8}),
            ReciprocatingSignals::about(), reciprocating_events());
    }

    void begin(const Held<ReciprocatingBlade>& saw, const BoneQuery& bone, State& state) const noexcept;
    [[nodiscard]] SawNotes resist(const Held<ReciprocatingBlade>& saw, const BoneQuery& bone, const State& state,
                                  Channels& channels) const noexcept;
    void commit(const Held<ReciprocatingBlade>& saw, const BoneQuery& bone, const Noted<SawNotes>& advance,
                State& state, Signals& signals, Actions& actions) const noexcept;
};

}  // namespace kerf::sawing
