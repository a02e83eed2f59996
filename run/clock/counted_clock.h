// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

namespace kerf::run {

/// Counts the periods that a foreign clock missed, such as the servo thread of a device: its callback runs the ticks,
/// and nothing may sleep there.
class CountedClock {
public:
    /// @param period  [s] of the foreign clock
    explicit CountedClock(double period) noexcept : period_(period) {}

    /// Returns the number of periods that passed without a tick before this one. A clock that jitters by less than half
    /// a period misses none. One that is stopped or goes back misses none, too.   [haptic, nonblocking]
    /// @param now  [s] by the foreign clock
    [[nodiscard]] std::uint32_t missed_before(double now) noexcept {
        const double passed = last_due_ ? std::round((now - *last_due_) / period_) : 0.0;
        if (!(passed >= 1.0)) {
            last_due_ = now;
            return 0;
        }
        // The due time follows the clock slowly: so jitter does not add up, and a fast or slow clock misses nothing.
        constexpr double following = 0.1, maximum = 1e9;
        const double due = *last_due_ + passed * period_;
        last_due_ = due + following * (now - due);
        return static_cast<std::uint32_t>(std::fmin(passed - 1.0, maximum));
    }

private:
    double period_;
    std::optional<double> last_due_;  ///< [s] of the last tick
};

}  // namespace kerf::run
