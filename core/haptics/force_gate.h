// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace kerf {

/// Takes the force away after a fault and gives it back: to nothing in 5 ms, then, once all is well, up in 50 ms, and until then
/// by 0.4 N a millisecond at most, whatever the hand runs into. What was stored in the coupling is let go in between:
/// force is never ramped back into a stretch (resolutions A10).
class ForceGate {
public:
    enum class State { open, closing, shut, opening };

    /// One tick: `is_sound` is false while the fault lasts.   [haptic, nonblocking]
    void step(bool is_sound, double dt) noexcept {
        if (!is_sound && state_ != State::shut) state_ = State::closing;
        if (is_sound && state_ == State::shut) state_ = State::opening;
        switch (state_) {
            case State::open:
                break;
            case State::closing:
                gain_ -= dt / closing_time;
                if (gain_ < 1e-9) {
                    gain_ = 0.0;
                    state_ = State::shut;
                }
                break;
            case State::shut:
                break;
            case State::opening:
                gain_ += dt / opening_time;
                if (gain_ > 1.0 - 1e-9) {
                    gain_ = 1.0;
                    state_ = State::open;
                }
                break;
        }
    }
    [[nodiscard]] double gain() const noexcept { return gain_; }  ///< [–] 0 … 1
    [[nodiscard]] State state() const noexcept { return state_; }
    /// Of a force limit [N], the share that may be used in the tick after one that made `force` [N].
    [[nodiscard]] double share(double limit, double force, double dt) const noexcept {
        return state_ == State::opening ? std::min(gain_, (force + fastest_rise * dt) / limit) : gain_;
    }
    /// The tool is not led by the hand: the force of before the fault is fading, or gone.
    [[nodiscard]] bool is_barred() const noexcept { return state_ == State::closing || state_ == State::shut; }

private:
    static constexpr double closing_time = 5e-3, opening_time = 50e-3;  // [s]
    static constexpr double fastest_rise = 400.0;                        // [N/s]; 0.5 N a millisecond is not to be passed (S-21)
    double gain_ = 1.0;
    State state_ = State::open;
};

}  // namespace kerf
