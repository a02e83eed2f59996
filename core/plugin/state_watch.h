// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/plugin/process_state.h"

/// Compares the state of the process with the one that it had before plugins were loaded. A host that changes its own
/// state, as by a handler of a signal, accepts it. Without begin_watching_state() nothing is compared.
namespace kerf {

/// Takes the state as the right one. `on_change` is called for a change; it must not return.   [main]
using StateChangeHandler = void (*)(const StateChange& change);
void begin_watching_state(StateChangeHandler on_change);
void end_watching_state() noexcept;  // [main]

/// While it lives, the host changes its handlers of signals, and nothing is compared. Afterwards those are the right
/// ones.   [main]
class HostChangesHandlers {
public:
    HostChangesHandlers();
    ~HostChangesHandlers();
    HostChangesHandlers(const HostChangesHandlers&) = delete;
    HostChangesHandlers& operator=(const HostChangesHandlers&) = delete;
};

/// Notes that a timer, or the limit of the processor, sent its signal although the host has set none. The timer may be
/// off again: this is a change.
/// @param signal   SIGALRM, SIGVTALRM, SIGPROF or SIGXCPU   [any] async-signal-safe
void note_timer_signal(int signal) noexcept;
[[nodiscard]] bool has_timer_signal() noexcept;  // [any]

/// Returns the first change so far.   [any] async-signal-safe but for a lock
[[nodiscard]] StateChange change_of_state() noexcept;
/// Calls the handler if there is a change. Call it before a result is written, and after plugins were called that may
/// wait.   [any, may block]
void check_state();

}  // namespace kerf
