// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "kerf/exact_math.hpp"

namespace kerf {

/// What drives a turning tool.
struct Motor {
    double inertia = 0.0;  ///< [kg·m²] of all that turns; 0: the speed follows at once
    double torque = 0.0;   ///< [N·m] the most it turns or brakes with
};

/// A spindle as part of a law's State: it holds the commanded speed for as long as the motor's torque lasts.
///
///     J (ω⁺ − ω)/T = τ − τ_load (1 − e^(−ω⁺/ω_e)),      −τ_max ≤ τ ≤ τ_max just as holds ω⁺ = commanded
///
/// One implicit scalar step a tick: the load never turns the tool backwards, and no step overshoots. Speeds are in
/// revolutions per second.
///
/// Source: docs/models/drilling.md, "The spindle".
struct Spindle {
    enum class Phase : std::uint32_t { off, spinning_up, running, bogging, running_down };

    double speed = 0.0;  ///< [1/s]
    Phase phase = Phase::off;

    /// `load` [N·m] is what resists at speed. Returns whether the phase changed.   [haptic, nonblocking]
    bool step(const Motor& motor, double commanded, double load, double dt) noexcept {
        speed = next_speed(motor, commanded, load, dt);
        const Phase before = phase;
        if (commanded <= 0.0)
            phase = speed > 0.0 ? Phase::running_down : Phase::off;
        else if (speed >= back_to_speed * commanded)
            phase = Phase::running;
        else if (phase == Phase::running && speed < bogged_down * commanded)
            phase = Phase::bogging;
        else if (phase == Phase::off || phase == Phase::running_down)
            phase = Phase::spinning_up;
        return phase != before;
    }

private:
    static constexpr double bogged_down = 0.7, back_to_speed = 0.95;
    static constexpr double onset = 5.0 / 60.0;  ///< ω_e [1/s]: below it the load fades [assumed]

    [[nodiscard]] double next_speed(const Motor& motor, double commanded, double load, double dt) const noexcept {
        const double inertia = 2.0 * pi * motor.inertia / dt;  // [N·m·s] per revolution
        // What is left over of a torque at a speed: falls with the speed.
        const auto left_over = [&](double torque, double at) {
            return torque - load * (1.0 - exp_exact(-at / onset)) - inertia * (at - speed);
        };
        const double least = -motor.torque, most = motor.torque;
        const bool holds = left_over(most, commanded) >= 0.0 && left_over(least, commanded) <= 0.0;
        if (holds) return std::max(0.0, commanded);
        // Too weak to get there, or still too fast: it gives all it has. Halve between where it is and where it would be.
        const double torque = left_over(most, commanded) < 0.0 ? most : least;
        double low = 0.0, high = std::max(speed, commanded);
        if (left_over(torque, low) <= 0.0) return 0.0;
        for (int i = 0; i < 40; ++i) {
            const double middle = 0.5 * (low + high);
            (left_over(torque, middle) > 0.0 ? low : high) = middle;
        }
        return 0.5 * (low + high);
    }
};

}  // namespace kerf
