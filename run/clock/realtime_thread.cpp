// SPDX-License-Identifier: Apache-2.0
#include "run/clock/realtime_thread.h"

#include <malloc.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <thread>

namespace kerf::run {

namespace {

constexpr std::size_t touched_stack = 256 * 1024;  // [bytes]

/// Writes each page of a block, so that no tick takes a page fault there. A page that is locked and never written still
/// costs its first writer time, on a virtual machine.
void touch(volatile char* block, std::size_t size) noexcept {
    for (std::size_t i = 0; i < size; i += 4096) block[i] = 0;
}

void touch_stack() noexcept {
    char pages[touched_stack];
    touch(pages, touched_stack);
}

/// Writes 32 MB of the calling thread's heap and keeps it for the rest of the process, so that its allocations take no
/// page fault.
void touch_heap() noexcept {
    constexpr std::size_t block_size = 1 << 20;
    mallopt(M_MMAP_MAX, 0);         // large blocks come from the heap
    mallopt(M_TRIM_THRESHOLD, -1);  // and return to it
    std::array<void*, 32> blocks{};
    for (void*& block : blocks) {
        block = std::malloc(block_size);
        if (block != nullptr) touch(static_cast<char*>(block), block_size);
    }
    for (void* block : blocks) std::free(block);
}

void take_priority(RealtimeState& state) {
    if (const int error = take_fifo_priority(haptic_priority); error != 0)
        state.refusals.push_back(std::string("The system refused the real-time class to the haptic thread (") +
                                 std::strerror(error) +
                                 "): other programs delay ticks. Allow `rtprio 49` in /etc/security/limits.d.");
    else
        state.priority = haptic_priority;
}

/// Gives the calling thread the real-time class while it exists, but not the threads and processes that it starts.
class LowestPriority {
public:
    LowestPriority() noexcept {
        sched_param parameters{};
        parameters.sched_priority = run_priority;
        is_taken_ = sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &parameters) == 0;
    }
    ~LowestPriority() {
        const sched_param normal{};
        if (is_taken_) sched_setscheduler(0, SCHED_OTHER, &normal);
    }
    LowestPriority(const LowestPriority&) = delete;
    LowestPriority& operator=(const LowestPriority&) = delete;

private:
    bool is_taken_;
};

/// Locks the memory that is there. Later allocations are locked too only if the limit is unlimited: below it, the
/// kernel lets them fail.
void lock_memory(RealtimeState& state) {
    rlimit limit{};
    const bool is_unlimited = getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY;
    state.is_locked = mlockall(is_unlimited ? MCL_CURRENT | MCL_FUTURE : MCL_CURRENT) == 0;
    if (!state.is_locked)
        state.refusals.push_back(std::string("The system refused to lock the memory (") + std::strerror(errno) +
                                 "): ticks may wait for pages. Allow `memlock unlimited` in /etc/security/limits.d.");
    else if (!is_unlimited)
        state.refusals.emplace_back(
            "Memory that is allocated during the run is not locked: ticks may wait for pages. Allow "
            "`memlock unlimited` in /etc/security/limits.d.");
}

}  // namespace

int take_fifo_priority(int priority) noexcept {
    sched_param parameters{};
    parameters.sched_priority = priority;
    return pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
}

RealtimeState run_in_real_time(const std::function<void()>& work, const std::function<void()>& meanwhile) {
    RealtimeState state;
    std::exception_ptr failure, failure_meanwhile;
    std::atomic<bool> is_done{false};
    std::thread thread([&] {
        try {
            take_priority(state);
            touch_heap();
            lock_memory(state);
            touch_stack();
            work();
        } catch (...) {
            failure = std::current_exception();
        }
        is_done = true;
    });
    {
        const LowestPriority priority;
        while (!is_done && !failure_meanwhile) {
            try {
                meanwhile();
            } catch (...) {
                failure_meanwhile = std::current_exception();
            }
        }
    }
    thread.join();
    if (state.is_locked) munlockall();
    if (failure) std::rethrow_exception(failure);
    if (failure_meanwhile) std::rethrow_exception(failure_meanwhile);
    return state;
}

}  // namespace kerf::run
