// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <csignal>
#include <functional>

#include "app/exit_code.h"

/// The process in which plugins run, and the parent that waits for its word.
namespace kerf::app {

/// Runs `work` in a child process and returns its exit code, which the child notes before it ends. If the child ends
/// otherwise, prints which plugin it was calling or had called last, what is recorded, and what to do; returns
/// exit_fault. A signal that ends the program is passed on to the child, and ends the parent if it ended the child. No
/// copy of the child survives it.   [main, while the process has one thread]
[[nodiscard]] ExitCode run_in_worker(const std::function<ExitCode()>& work);

/// Returns whether the parent passed this signal on: a terminal sends each one to parent and child.
/// [any] async-signal-safe
[[nodiscard]] bool is_passed_on(const siginfo_t& signal) noexcept;

}  // namespace kerf::app
