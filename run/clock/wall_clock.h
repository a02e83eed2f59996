// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/haptics/law/call_times.h"
#include "run/clock/thread_watch.h"
#include "run/clock/tick_clock.h"
#include "run/clock/tick_trace.h"

namespace kerf::run {

/// Lateness and computing time of the ticks of a clock [ns]. Nothing of it enters a result, a record or a hash.
struct TickTimes {
    CallTimes lateness;             ///< from the due time until the tick begins
    CallTimes compute;              ///< processor time of the thread from the pose until all of the tick is done
    std::uint64_t ticks = 0;        ///< that ran
    std::uint64_t late = 0;         ///< ticks that began more than one period late
    std::uint64_t missed = 0;       ///< periods without a tick
    std::uint64_t pauses = 0;       ///< gaps of three missed periods or more: the force fades
    std::uint64_t over_period = 0;  ///< ticks that computed longer than one period
};

/// Paces ticks by the monotonic clock: sleeps to an absolute time, then spins for the rest.
///
/// Each wait sleeps, also when it is late: a thread of the real-time class that never sleeps is stopped by the kernel.
/// A late tick runs at once and the periods missed before it are skipped, so ticks never catch up in a burst.
class WallClock final : public TickClock {
public:
    /// @param period  [s] of a tick
    /// @param watch   gets the trace of each tick; may be null
    explicit WallClock(double period, ThreadWatch* watch = nullptr) noexcept;

    [[nodiscard]] std::uint32_t wait() noexcept override;
    void tick_done() noexcept override;

    /// Returns the times of all ticks since the first `wait`.   [any] after the last tick
    [[nodiscard]] const TickTimes& times() const noexcept { return times_; }
    /// Returns the measure of a tick's parts, for the run that ticks.
    [[nodiscard]] TickParts& parts() noexcept { return parts_; }

private:
    std::int64_t period_;         ///< [ns]
    ThreadWatch* watch_;          ///< or null
    std::int64_t due_ = 0;        ///< [ns] of the next tick; 0: no tick has run
    std::int64_t begun_cpu_ = 0;  ///< [ns] processor time of the thread at the start of the tick
    TickTrace trace_;             ///< of the tick that runs
    TickParts parts_;
    TickTimes times_;
};

}  // namespace kerf::run
