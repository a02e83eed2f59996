// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/exact_math.hpp"
#include "kerf/force.hpp"
#include "kerf/spindle.hpp"

/// A motor with a cutter: run-up, bogging, stall, and the decay of its cutting forces as it stops.
namespace kerf {

/// Fraction of the cutting forces that acts.
struct CuttingState {
    double fraction = 0.0;  ///< [–] of the cutting forces: 1 while bone is removed, then decaying

    [[nodiscard]] bool resists() const noexcept { return fraction > 0.0; }
    [[nodiscard]] bool removes_bone() const noexcept { return fraction >= 1.0; }
    /// Updates the fraction: 1 if the cutter cuts, else it decays. A cutter that has become too slow to cut sinks onto
    /// the bone behind its edges. Its cutting forces decay while contact forces build up, so that the hand feels no
    /// step.
    /// @param fading_time  time constant [s]; longer for a cutter that sinks far, for example where its walls are known
    ///                     less exactly than its point
    void step(bool cuts, double dt, double fading_time = 2e-3) noexcept {
        fraction = cuts ? 1.0 : fraction > 1e-6 ? fraction * exp_exact(-dt / fading_time) : 0.0;
    }
};

/// Maps each phase of a motor to an event of the law.
template <class E>
struct PhaseEvents {
    E off, speeding_up, running, reversing, bogging, stalled, running_down;

    [[nodiscard]] constexpr E of(Spindle::Phase phase) const noexcept {
        switch (phase) {
            case Spindle::Phase::off:
                return off;
            case Spindle::Phase::spinning_up:
                return speeding_up;
            case Spindle::Phase::running:
                return running;
            case Spindle::Phase::reversing:
                return reversing;
            case Spindle::Phase::bogging:
                return bogging;
            case Spindle::Phase::stalled:
                return stalled;
            case Spindle::Phase::running_down:
                return running_down;
        }
        return off;
    }
};

/// A motor with a cutter, as part of a law's State.
struct PoweredCutter {
    Spindle motor;
    CuttingState cutting;

    [[nodiscard]] double speed() const noexcept { return motor.speed; }  ///< [1/s], negative in reverse
    /// Advances motor and cutting by `dt` [s]. Reports the event of the phase if it changed.   [haptic, nonblocking]
    /// @param load          [N·m] as in `Spindle::step`
    /// @param slowest_cut   [1/s] speed from which on bone is removed; none is removed in reverse
    template <class E>
    void step(const Motor& with, double commanded, double load, double dt, double slowest_cut,
              const PhaseEvents<E>& events, Actions& actions) noexcept {
        if (motor.step(with, commanded, load, dt)) actions.event(events.of(motor.phase));
        cutting.step(motor.speed >= slowest_cut, dt);
    }
    /// Does the same for a law whose events are the phases of `Spindle`, in their order.
    /// @param fading_time  [s] as in `CuttingState::step`
    void step(const Motor& with, double commanded, double load, double dt, double slowest_cut, Actions& actions,
              double fading_time = 2e-3) noexcept {
        if (motor.step(with, commanded, load, dt)) actions.event(motor.phase);
        cutting.step(motor.speed >= slowest_cut, dt, fading_time);
    }
};

}  // namespace kerf
