// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace kerf::run {

inline constexpr int haptic_priority = 49;  ///< of SCHED_FIFO; below the kernel's threaded interrupts, which have 50
inline constexpr int run_priority = 1;      ///< of the run that follows the haptic thread
inline constexpr int helper_priority = 48;  ///< of threads that serve the haptic one: devices, the watch of the clock

/// Gives the calling thread a priority of SCHED_FIFO. Returns 0, or the error number if the system refuses.   [any]
[[nodiscard]] int take_fifo_priority(int priority) noexcept;

/// What the system granted to a thread that requested real time.
struct RealtimeState {
    int priority = 0;                   ///< of SCHED_FIFO; 0: the thread has the normal class
    bool is_locked = false;             ///< the memory of the process stays in RAM
    std::vector<std::string> refusals;  ///< what the system refused and what to set, for people
};

/// Runs `work` to its end on a thread of its own: class SCHED_FIFO of priority 49, with its stack and 32 MB of its
/// heap written to and the memory of the process locked. The system may refuse parts of that; the work runs all the
/// same. Returns what was granted.   [main] blocks until the work is done
/// @param meanwhile  called on the calling thread again and again while the work runs, with the lowest priority of
///                   SCHED_FIFO if the system allows it; it sleeps between its own work.
///                   If it throws, it must make the work end
RealtimeState run_in_real_time(const std::function<void()>& work, const std::function<void()>& meanwhile);

}  // namespace kerf::run
