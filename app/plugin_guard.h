// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <condition_variable>
#include <csignal>
#include <cstddef>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>

namespace kerf::app {

/// Takes the state of the process as the right one: descriptors, limits, timers, handlers of signals, working folder,
/// decimal point and mask of new files (core/plugin/state_watch.h).   [main, before plugins are loaded]
void begin_guarding_state();

/// While this lives, a plugin that crashes, throws, aborts, exits or does not return from a call within 5 s ends the
/// program in order: the guard closes the record of the run, names plugin, path and call on stderr, and exits with 3.
/// The same happens each second if the state of the process is not the right one. Faults of Kerf's own code end the
/// program as without a guard, after the record is closed.   [main] one at a time
class PluginGuard {
public:
    PluginGuard();
    ~PluginGuard();
    PluginGuard(const PluginGuard&) = delete;
    PluginGuard& operator=(const PluginGuard&) = delete;

    /// Ends the program now if the state of the process is not the right one.   [main]
    void check() const;

private:
    void watch();

    static constexpr std::array signals{SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL};
    std::array<struct sigaction, signals.size()> before_{};
    std::terminate_handler terminate_before_;
    std::unique_ptr<std::byte[]> stack_;  ///< for the handlers: a plugin may have used up its own stack
    std::mutex mutex_;
    std::condition_variable stop_;
    bool is_stopping_ = false;
    std::thread watchdog_;
};

/// Ends the program in order, as for a crash, if the signal of `info` was raised by a plugin in a call. Else returns.
/// [any] async-signal-safe
void end_if_raised_by_plugin(int signal, const siginfo_t& info) noexcept;

}  // namespace kerf::app
