// SPDX-License-Identifier: Apache-2.0
#include "run/clock/realtime_thread.h"

#include <pthread.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <exception>
#include <thread>

namespace kerf::run {

namespace {

constexpr std::size_t touched_stack = 256 * 1024;  // [bytes]

/// Writes each page of the stack that a tick may use, so that no tick takes a page fault there.
void touch_stack() noexcept {
    char pages[touched_stack];
    volatile char* const written = pages;  // so that the compiler keeps the writes
    for (std::size_t i = 0; i < touched_stack; i += 4096) written[i] = 0;
}

void take_priority(RealtimeState& state) {
    if (const int error = take_fifo_priority(haptic_priority); error != 0)
        state.refusals.push_back(std::string("The system refused the real-time class to the haptic thread (") +
                                 std::strerror(error) +
                                 "): other programs delay ticks. Allow `rtprio 49` in /etc/security/limits.d.");
    else
        state.priority = haptic_priority;
}

/// Locks the memory that is there. Later allocations are locked too only if the limit is unlimited: below it, the
/// kernel lets them fail.
void lock_memory(RealtimeState& state) {
    rlimit limit{};
    const bool is_unlimited = getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY;
    state.is_locked = mlockall(is_unlimited ? MCL_CURRENT | MCL_FUTURE : MCL_CURRENT) == 0;
    if (!state.is_locked)
        state.refusals.push_back(std::string("The system refused to lock the memory (") + std::strerror(errno) +
                                 "): ticks may wait for pages. Allow `memlock unlimited` in /etc/security/limits.d.");
}

}  // namespace

int take_fifo_priority(int priority) noexcept {
    sched_param parameters{};
    parameters.sched_priority = priority;
    return pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
}

RealtimeState run_in_real_time(const std::function<void()>& work) {
    RealtimeState state;
    std::exception_ptr failure;
    std::thread thread([&] {
        take_priority(state);
        lock_memory(state);
        touch_stack();
        try {
            work();
        } catch (...) {
            failure = std::current_exception();
        }
    });
    thread.join();
    if (state.is_locked) munlockall();
    if (failure) std::rethrow_exception(failure);
    return state;
}

}  // namespace kerf::run
