// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace kerf {

/// Takes the force away after a fault and gives it back: to nothing in 5 ms, then, once all is well, up in 50 ms and by
/// 0.4 N a millisecond at most, whatever the hand runs into. What was stored in the coupling is let go in between:
/// force is never ramped back into a stretch (resolutions A10).
class ForceGate {
public:
    enum class State { open, closing, shut, opening };

    /// One tick: `is_sound` is false while the fault lasts.   [haptic, nonblocking]
    void step(bool is_sound, double dt) noexcept {
        if (!is_sound && state_ != State::shut) state_ = State::closing;
        if (is_sound && state_ == State::shut) {
            state_ = State::opening;
            share_ = 0.0;
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
    /// Of a force limit [N], the share that may be used in the next step of `dt`, after one that made `force` [N]. As
    /// long as the bound on the rise is what holds the force, the gate goes on opening.   [haptic, nonblocking] once a
    /// tick
    [[nodiscard]] double share(double limit, double force, double dt) noexcept {
        if (state_ != State::opening) return gain_;
        const bool is_held = force >= (1.0 - 1e-9) * share_ * limit;
        share_ = std::min(gain_, (force + fastest_rise * dt) / limit);
        if (gain_ < 1.0 || (is_held && share_ < 1.0)) return share_;
        state_ = State::open;
        return 1.0;
    }
    [[nodiscard]] double gain() const noexcept { return gain_; }  ///< [–] 0 … 1
    [[nodiscard]] State state() const noexcept { return state_; }
    /// The tool is not led by the hand: the force of before the fault is fading, or gone.
    [[nodiscard]] bool is_barred() const noexcept { return state_ == State::closing || state_ == State::shut; }

private:
    static constexpr double closing_time = 5e-3, opening_time = 50e-3;  // [s]
    static constexpr double fastest_rise = 400.0;  // [N/s]; 0.5 N a millisecond is not to be passed (S-21)
    double gain_ = 1.0;
    double share_ = 1.0;  ///< allowed last, while it opens
    State state_ = State::open;
};

}  // namespace kerf
