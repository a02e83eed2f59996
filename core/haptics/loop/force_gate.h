// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace kerf {

/// Fades the force out after a fault and in again. The force falls to zero in 5 ms, even if the fault ends earlier.
/// Then its limit rises over 50 ms, and over more if the force would otherwise grow faster than 0.4 N per millisecond.
/// The loop releases the coupling's stretch in between, so force never ramps back into a stretched spring.
class ForceGate {
public:
    enum class State { open, closing, shut, opening };

    /// Advances the gate by one tick. `is_sound` is false while the fault lasts.   [haptic, nonblocking]
    void step(bool is_sound, double dt) noexcept {
        if (!is_sound && state_ != State::shut) state_ = State::closing;
        if (is_sound && state_ == State::shut) {
            state_ = State::opening;
            usable_fraction_ = 0.0;
        }
        switch (state_) {
            case State::open:
            case State::shut:
                break;
            case State::closing:
                gain_ -= dt / closing_time;
                if (gain_ < 1e-9) {
                    gain_ = 0.0;
                    state_ = State::shut;
                }
                break;
            case State::opening:
                gain_ += dt / opening_time;
                if (gain_ > 1.0 - 1e-9) gain_ = 1.0;
                break;
        }
    }
    /// Returns the usable fraction of the force limit `limit` [N] in the next tick of `dt` [s]. `force` [N] is the
    /// magnitude of this tick's command. The gate stays in `opening` while its rate limit bounds the force.
    /// [haptic, nonblocking] once a tick
    [[nodiscard]] double usable_fraction(double limit, double force, double dt) noexcept {
        if (state_ != State::opening) return gain_;
        const bool is_held = force >= (1.0 - 1e-9) * usable_fraction_ * limit;
        usable_fraction_ = std::min(gain_, (force + fastest_rise * dt) / limit);
        if (gain_ < 1.0 || (is_held && usable_fraction_ < 1.0)) return usable_fraction_;
        state_ = State::open;
        return 1.0;
    }
    [[nodiscard]] double gain() const noexcept { return gain_; }  ///< [–] 0 (shut) … 1 (open)
    [[nodiscard]] State state() const noexcept { return state_; }
    /// Returns whether the gate is closing or shut. Then the hand does not move the tool, and the last force before the
    /// fault fades to zero.
    [[nodiscard]] bool is_closed_or_closing() const noexcept {
        return state_ == State::closing || state_ == State::shut;
    }

private:
    static constexpr double closing_time = 5e-3, opening_time = 50e-3;  // [s]
    static constexpr double fastest_rise = 400.0;  // [N/s]; the limit of S-21 is 0.5 N per millisecond
    double gain_ = 1.0;
    double usable_fraction_ = 1.0;  ///< fraction returned last while opening
    State state_ = State::open;
};

}  // namespace kerf
