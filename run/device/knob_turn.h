// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "kerf/device.h"

namespace kerf::run {

/// The turn of a knob in ticks of the loop. A knob has a clock of its own: between two of its reports the turn is
/// interpolated over the ticks that the last two lay apart, at most 20. A lost knob keeps its turn, and continues from
/// there when it is back.   [haptic, nonblocking]
class KnobTurn {
public:
    /// Takes the newest report of a tick. Returns the turn [rad] since the start.
    double take(const kerf_device_state& state) noexcept {
        if ((state.flags & KERF_DEVICE_VALID) == 0 || !std::isfinite(state.turn)) {
            is_joined_ = false;
            return turn_;
        }
        if (!is_joined_) {
            join(state);
            return turn_;
        }
        ++ticks_;
        if (state.reports != reports_) {
            target_ = state.turn + offset_;
            ticks_left_ = std::min(ticks_, max_ticks);
            ticks_ = 0;
            reports_ = state.reports;
        }
        if (ticks_left_ > 0) turn_ += (target_ - turn_) / ticks_left_--;
        return turn_;
    }

private:
    static constexpr int max_ticks = 20;

    void join(const kerf_device_state& state) noexcept {
        offset_ = turn_ - state.turn;
        target_ = turn_;
        reports_ = state.reports;
        ticks_ = ticks_left_ = 0;
        is_joined_ = true;
    }

    double turn_ = 0.0, target_ = 0.0, offset_ = 0.0;  ///< [rad]
    std::uint64_t reports_ = 0;
    int ticks_ = 0, ticks_left_ = 0;  ///< since the last report; until the target
    bool is_joined_ = false;
};

}  // namespace kerf::run
