// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "run/clock/tick_trace.h"

namespace kerf::run {

/// Why a tick began or ended late.
enum class LateCause : std::uint8_t {
    compute,          ///< the ticks themselves computed too long
    core_taken,       ///< the thread was ready, and another one had its core
    machine_stopped,  ///< neither computed nor waited for a core: the machine, or its timer, stood still
    blocked,          ///< the thread slept inside a tick: a lock, a page from disk, a system call
    unknown,
};
inline constexpr std::size_t late_cause_count = 5;

/// Returns a few words for people.   [any]
[[nodiscard]] const char* to_text(LateCause cause) noexcept;

/// Counters of a thread at one time, as the scheduler reports them.
struct ThreadSample {
    std::int64_t begun = 0, at = 0;  ///< CLOCK_MONOTONIC before and after the counters were read [ns]
    std::int64_t waited = 0;         ///< [ns] ready without a core, since the thread began
    bool is_blocked = false;         ///< it slept, and not in its clock
    std::uint64_t faults = 0;        ///< page faults
};

/// The cause of a slow tick.
struct ExplainedTick {
    TickTrace trace;
    LateCause cause = LateCause::unknown;
    std::uint64_t faults = 0;  ///< page faults in it and shortly before or after
};

/// Returns the cause of a slow tick from samples of its thread's counters, in order of time. The time from the due time
/// to the end is split into processor time, waiting for a core, and the rest; the largest is the cause. Unknown if no
/// samples are around the tick, or if they are so far apart that the waiting may belong to other ticks. Half of the
/// time computed needs no samples.   [any] pure.
/// @param before  the trace of the tick before it if that ended after this one was due, else null. A tick that begins
///                late because the one before it ended late has the cause of that one, and its longest part
[[nodiscard]] ExplainedTick explain(const TickTrace& tick, const TickTrace* before,
                                    std::span<const ThreadSample> samples, std::int64_t period) noexcept;

}  // namespace kerf::run
