// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/state_watch.h"

#include <atomic>
#include <csignal>
#include <mutex>

#include "core/plugin/own_files.h"

namespace kerf {

namespace {

struct Watch {
    std::mutex mutex;
    SharedState right;
    StateChangeHandler on_change = nullptr;  ///< null: nothing is compared
};
Watch& watch() {
    static Watch& one = *new Watch;  // plugins end programs at any time: it is never destroyed
    return one;
}

std::atomic<int> timer_signal{0};  // 0: none came

StateChange change_by_timer_signal() noexcept {
    StateChange change;
    const int signal = timer_signal.load();
    if (signal == 0) return change;
    change.what << (signal == SIGXCPU     ? "the limit RLIMIT_CPU"
                    : signal == SIGALRM   ? "a timer of SIGALRM"
                    : signal == SIGVTALRM ? "a timer of SIGVTALRM"
                                          : "a timer of SIGPROF");
    change.before << (signal == SIGXCPU ? "a greater one" : "off");
    change.after << (signal == SIGXCPU ? "one that is used up" : "on");
    return change;
}

}  // namespace

void note_timer_signal(int signal) noexcept { timer_signal.store(signal); }

bool has_timer_signal() noexcept { return timer_signal.load() != 0; }

void begin_watching_state(StateChangeHandler on_change) {
    const std::lock_guard lock(watch().mutex);
    watch().right = shared_state();
    watch().on_change = on_change;
    timer_signal.store(0);
}

void end_watching_state() noexcept {
    const std::lock_guard lock(watch().mutex);
    watch().on_change = nullptr;
}

HostChangesHandlers::HostChangesHandlers() { watch().mutex.lock(); }

HostChangesHandlers::~HostChangesHandlers() {
    watch().right.handlers = shared_state().handlers;
    watch().mutex.unlock();
}

StateChange change_of_state() noexcept {
    {
        const std::lock_guard lock(watch().mutex);
        if (watch().on_change == nullptr) return {};
        if (StateChange change = change_by_timer_signal(); change.has_happened()) return change;
        if (StateChange change = change_between(watch().right, shared_state()); change.has_happened()) return change;
    }
    return change_of_own_files();
}

void check_state() {
    StateChangeHandler on_change = nullptr;
    {
        const std::lock_guard lock(watch().mutex);
        on_change = watch().on_change;
    }
    if (on_change == nullptr) return;
    if (const StateChange change = change_of_state(); change.has_happened()) on_change(change);
}

}  // namespace kerf
