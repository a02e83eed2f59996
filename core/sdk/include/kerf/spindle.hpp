// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "kerf/exact_math.hpp"

namespace kerf {

/// The motor of a tool that turns or oscillates.
struct Motor {
    double inertia = 0.0;  ///< [kg·m²] of all rotating parts; 0: the speed follows the command at once
    double torque = 0.0;   ///< [N·m] max driving or braking torque
    double ramp = 1e300;   ///< [1/s²] rate at which its controller changes the speed, with or without load, while the
                           ///< torque suffices

    /// Returns a motor that reaches `speed` [1/s] unloaded in `run_up` [s]; 0 makes the speed follow at once.
    [[nodiscard]] static constexpr Motor with_run_up(double run_up, double speed, double torque,
                                                     double inertia) noexcept {
        if (run_up <= 0.0) return {.inertia = 0.0, .torque = torque};
        return {.inertia = inertia, .torque = torque, .ramp = speed / run_up};
    }
};

/// A spindle as part of a law's State: it keeps the commanded speed while the motor's torque suffices.
///
///     J (ω⁺ − ω)/T = τ − τ_load (1 − e^(−ω⁺/ω_e)),      −τ_max ≤ τ ≤ τ_max, chosen so that ω⁺ = aim if possible
///
/// The aim approaches the commanded speed at the rate of the ramp. While the speed falls, the motor brakes and never
/// drives, so that a load stops it sooner.
///
/// One implicit scalar step a tick: the load never turns the tool backwards, and no step overshoots. Speeds are in
/// revolutions per second, negative in reverse; a reversal passes through standstill. A motor that stays below its
/// crawling speed for 20 ms has stalled: it pulls with its full torque until it is switched off.
///
/// Source: docs/models/drilling.md, "The spindle".
struct Spindle {
    enum class Phase : std::uint32_t { off, spinning_up, running, reversing, bogging, stalled, running_down };

    double speed = 0.0;   ///< [1/s]
    double torque = 0.0;  ///< [N·m] of the motor in the last step, along the sense of rotation; at standstill along
                          ///< the commanded sense
    double crawl_time = 0.0;  ///< [s] time spent below the crawling speed at full torque
    Phase phase = Phase::off;

    /// Advances the spindle by `dt` [s]. Returns whether the phase changed.   [haptic, nonblocking]
    /// @param commanded  [1/s] speed, negative in reverse
    /// @param load       [N·m] ≥ 0, torque that resists rotation in either sense; it fades towards standstill
    bool step(const Motor& motor, double commanded, double load, double dt) noexcept {
        const Phase before = phase;
        const double sense = speed != 0.0 ? (speed > 0.0 ? 1.0 : -1.0) : (commanded < 0.0 ? -1.0 : 1.0);
        const double wanted = std::max(0.0, sense * commanded);
        if (phase == Phase::stalled && commanded != 0.0) {
            torque = motor.torque;
            return false;
        }
        const double old = sense * speed, now = next_speed(motor, old, wanted, load, dt);
        const double inertial_torque = 2.0 * pi * motor.inertia * (now - old) / dt;
        torque = std::clamp(inertial_torque + load * fading(now), -motor.torque, motor.torque);
        speed = sense * now;

        // A stuck motor may seem to gain speed by rounding errors: hence the tolerance.
        const bool is_crawling = wanted > 0.0 && now < crawling && now <= old + 1e-4 * crawling;
        crawl_time = is_crawling ? crawl_time + dt : 0.0;
        if (crawl_time > stalling_time - 0.5 * dt) {
            phase = Phase::stalled;
            speed = crawl_time = 0.0;
        } else if (wanted <= 0.0) {
            phase = now > 0.0 ? Phase::running_down : Phase::off;
        } else if (now >= back_to_speed * wanted) {
            phase = sense > 0.0 ? Phase::running : Phase::reversing;
        } else if ((phase == Phase::running || phase == Phase::reversing) && now < bogged_down * wanted) {
            phase = Phase::bogging;
        } else if (phase == Phase::off || phase == Phase::running_down || phase == Phase::stalled) {
            phase = Phase::spinning_up;
        }
        return phase != before;
    }
    /// Returns the motor's torque minus the load [N·m], along the sense of rotation. The hand feels its reaction in
    /// addition to that of the load.
    [[nodiscard]] double excess_torque(double load) const noexcept {
        return torque - load * fading(speed < 0.0 ? -speed : speed);
    }

private:
    static constexpr double bogged_down = 0.7, back_to_speed = 0.95;
    static constexpr double onset = 5.0 / 60.0;      ///< ω_e [1/s]: below it the load fades [assumed]
    static constexpr double crawling = 10.0 / 60.0;  ///< [1/s] residual speed of a stuck motor [assumed]
    static constexpr double stalling_time = 20e-3;   ///< [s]

    [[nodiscard]] static double fading(double at) noexcept { return 1.0 - exp_exact(-at / onset); }

    [[nodiscard]] static double next_speed(const Motor& motor, double old, double wanted, double load,
                                           double dt) noexcept {
        if (wanted >= old) return reached(motor, old, std::min(wanted, old + motor.ramp * dt), motor.torque, load, dt);
        const double braked = reached(motor, old, std::max(wanted, old - motor.ramp * dt), 0.0, load, dt);
        return braked >= wanted ? braked : reached(motor, old, wanted, motor.torque, load, dt);
    }

    /// Returns the speed after a step [1/s]: `wanted`, or the nearest speed that the motor can reach. It drives with at
    /// most `max_drive_torque` and brakes with at most its full torque.
    [[nodiscard]] static double reached(const Motor& motor, double old, double wanted, double max_drive_torque,
                                        double load, double dt) noexcept {
        const double inertia = 2.0 * pi * motor.inertia / dt;  // [N·m·s] per revolution
        // The torque that remains at a speed. It falls as the speed rises.
        const auto left_over = [&](double pull, double at) { return pull - load * fading(at) - inertia * (at - old); };
        const double min_torque = -motor.torque;
        if (left_over(max_drive_torque, wanted) >= 0.0 && left_over(min_torque, wanted) <= 0.0) return wanted;
        // The motor is too weak to reach `wanted`, or cannot brake to it: it applies its limit. Bisect between
        // standstill and the faster of the two speeds.
        const double pull = left_over(max_drive_torque, wanted) < 0.0 ? max_drive_torque : min_torque;
        double low = 0.0, high = std::max(old, wanted);
        if (left_over(pull, low) <= 0.0) return 0.0;
        for (int i = 0; i < 40; ++i) {
            const double middle = 0.5 * (low + high);
            (left_over(pull, middle) > 0.0 ? low : high) = middle;
        }
        return 0.5 * (low + high);
    }
};

}  // namespace kerf
