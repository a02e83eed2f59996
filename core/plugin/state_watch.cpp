// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/state_watch.h"

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

}  // namespace

void begin_watching_state(StateChangeHandler on_change) {
    const std::lock_guard lock(watch().mutex);
    watch().right = shared_state();
    watch().on_change = on_change;
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
