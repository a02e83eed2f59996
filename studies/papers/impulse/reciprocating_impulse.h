// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "impulse.h"
#include "plugins/sawing/reciprocating_force.h"

/// The reciprocating saw of [mandibular-angle], with its equations corrected: teeth that strike bone.
namespace kerf::papers {

/// [1/s] Below it no bone is removed. With fewer strikes the same push would feed the saw ever faster, and a still saw
/// would meet nothing; [mandibular-angle] measured from 8000 per minute on. Between the two the feed at a push fades,
/// so that contact takes over without a step. Assumed.
inline constexpr double slowest_strike = 100.0, full_strike = 8000.0 / 60.0;

/// Returns how often one tooth strikes [1/s].
///
///     ν = 2u max(1, S/p)
///
/// A tooth strikes new bone when the tooth before it has passed, every p/V on average, V = 2 S u; and at least once in
/// each of the two strokes of an oscillation. It is one over the time that the chip of `chip_per_feed` grows, at the
/// mean speed.   [any] pure.
[[nodiscard]] double strikes_per_second(const sawing::Stroke& stroke) noexcept;

/// The law of a reciprocating saw by impulses, docs/models/reciprocating-saw.md.
struct ReciprocatingImpulse : sawing::ReciprocatingParameters {
    double mass, gyration, restitution;

    struct State : sawing::ReciprocatingState {
        sawing::PreparedSaw<sawing::StraightBlade> prepared;
    };
    struct Signals : sawing::ReciprocatingSignals {
        double strike_rate = 0.0;
    };
    using Happened = sawing::ReciprocatingEvent;
    struct Notes {
        sawing::SawNotes teeth;
        double along_per_thrust = 0.0;  ///< [–]
    };

    static constexpr auto about() {
        using namespace literals;
        return describe(
            "reciprocating_impulse",
            "The feed of a reciprocating saw by impulses of its teeth on rigid bone, solved together; sides, contact "
            "and "
            "warning as in reciprocating_cutting.",
            sawing::ReciprocatingParameters::about(),
            param(&ReciprocatingImpulse::mass, {.id = "mass",
                                                .help = "Mass of the saw that strikes.",
                                                .unit = unit::kg,
                                                .min = 0.01_kg,
                                                .max = 10.0_kg,
                                                .def = 1.0_kg,
                                                .source = "assumed: [mandibular-angle] does not print it"}),
            param(&ReciprocatingImpulse::gyration, {.id = "gyration",
                                                    .help = "Radius of gyration of the saw about the blade's middle.",
                                                    .unit = unit::mm,
                                                    .min = 5.0_mm,
                                                    .max = 500.0_mm,
                                                    .def = 50.0_mm,
                                                    .source = "assumed: [mandibular-angle] does not print it"}),
            param(&ReciprocatingImpulse::restitution, {.id = "restitution",
                                                       .help = "Coefficient of restitution of steel on bone.",
                                                       .min = 0.0,
                                                       .max = 1.0,
                                                       .def = 0.6,
                                                       .source = "[mandibular-angle]"}),
            budget_us(200), work({.channels = 16, .points = 800, .queries = 8}), sawing::ReciprocatingSignals::about(),
            signal(&Signals::strike_rate,
                   {.id = "strike_rate", .help = "Strikes of one tooth.", .unit = unit::per_min}),
            sawing::reciprocating_events());
    }

    void begin(const Held<sawing::ReciprocatingBlade>& saw, const BoneQuery& bone, State& state) const noexcept;
    [[nodiscard]] Notes resist(const Held<sawing::ReciprocatingBlade>& saw, const BoneQuery& bone, const State& state,
                               Channels& channels) const noexcept;
    void commit(const Held<sawing::ReciprocatingBlade>& saw, const BoneQuery& bone, const Noted<Notes>& advance,
                State& state, Signals& signals, Actions& actions) const noexcept;
};

}  // namespace kerf::papers
