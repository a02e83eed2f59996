// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

#include "core/field/spsc_ring.h"
#include "run/clock/late_cause.h"

namespace kerf::run {

/// Why ticks were late, and the slowest ones.
struct LateTicks {
    std::array<std::uint64_t, late_cause_count> causes{};  ///< late ticks by cause
    std::vector<ExplainedTick> slowest;                    ///< at most ten, the slowest first
};

/// Watches the thread of a clock from a thread of its own: samples its counters once a period and explains its slow
/// ticks. The watched thread only writes to a ring.
class ThreadWatch {
public:
    /// @param period  [ns] of a tick
    explicit ThreadWatch(std::int64_t period);
    ~ThreadWatch();
    ThreadWatch(const ThreadWatch&) = delete;
    ThreadWatch& operator=(const ThreadWatch&) = delete;

    /// Starts to watch the calling thread.   [the watched thread, before its first tick] allocates
    void watch_this_thread();
    /// Reports that the clock sleeps, or that it woke.   [haptic, nonblocking]
    void report_sleep(bool is_asleep) noexcept { is_asleep_.store(is_asleep, std::memory_order_release); }
    /// Reports a tick that ended.   [haptic, nonblocking]
    void report(const TickTrace& tick) noexcept;
    /// Ends the watch and returns what it found.   [the watched thread, after its last tick]
    [[nodiscard]] LateTicks finish();

private:
    struct Counters;

    void run(const Counters& counters);
    void take_sample(const Counters& counters);
    void explain_until(std::int64_t time, bool is_last);
    void add(const ExplainedTick& tick);

    std::int64_t period_;
    SpscRing<TickTrace> slow_{1024};
    std::atomic<bool> is_asleep_{false};
    std::atomic<std::uint64_t> dropped_{0};
    std::atomic<bool> is_ending_{false};
    std::vector<ThreadSample> samples_;  ///< of the last seconds
    TickTrace last_{};                   ///< the slow tick explained last
    LateTicks found_;
    std::unique_ptr<Counters> counters_;
    std::thread thread_;
};

}  // namespace kerf::run
