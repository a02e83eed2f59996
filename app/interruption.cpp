// SPDX-License-Identifier: Apache-2.0
#include "app/interruption.h"

#include <cstddef>

#include "app/plugin_guard.h"
#include "app/worker.h"
#include "core/plugin/state_watch.h"

namespace kerf::app {

namespace {

volatile std::sig_atomic_t is_noted = 0;  // a signal handler can only reach globals

// Of each signal of Interruption: how many came from the terminal or another process, and how many the parent passed
// on. A terminal sends each one to parent and child, so the greater number counts.
volatile std::sig_atomic_t came_directly[NSIG], was_passed_on[NSIG];

void note(int signal, siginfo_t* info, void*) {
    end_if_raised_by_plugin(signal, *info);
    volatile std::sig_atomic_t& count = is_passed_on(*info) ? was_passed_on[signal] : came_directly[signal];
    count = count + 1;
    is_noted = 1;
    if (count < 2) return;
    std::signal(signal, SIG_DFL);
    raise(signal);
}

}  // namespace

Interruption::Interruption() {
    is_noted = 0;
    const HostChangesHandlers changes;
    struct sigaction action {};
    action.sa_sigaction = &note;
    action.sa_flags = SA_SIGINFO | SA_RESTART;
    for (std::size_t i = 0; i < signals.size(); ++i) {
        came_directly[signals[i]] = 0;
        was_passed_on[signals[i]] = 0;
        is_taken_[i] = sigaction(signals[i], nullptr, &before_[i]) == 0 && before_[i].sa_handler != SIG_IGN;
        if (is_taken_[i]) sigaction(signals[i], &action, nullptr);
    }
}

Interruption::~Interruption() {
    const HostChangesHandlers changes;
    for (std::size_t i = 0; i < signals.size(); ++i)
        if (is_taken_[i]) sigaction(signals[i], &before_[i], nullptr);
}

void Interruption::come() const noexcept { is_noted = 1; }

bool Interruption::has_come() const noexcept { return is_noted != 0; }

}  // namespace kerf::app
