// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "app/exit_code.h"

/// Ends the program with a message and exit code 3 if memory, threads or stack run out.
namespace kerf::app {

/// Runs `work` and returns its result. An exception becomes a line on stderr and exit_fault.   [main]
[[nodiscard]] ExitCode run_guarded(const std::function<ExitCode()>& work);

/// Installs a handler that ends the program in the same way if an exception cannot reach `run_guarded`: in a thread, or
/// in a noexcept function. Exceptions other than those of memory and of the system still abort.   [main, once]
void install_terminate_handler();

/// Returns whether the stack is large enough. Raises its limit if possible; else prints a line to stderr.   [main]
[[nodiscard]] bool is_stack_large_enough();

}  // namespace kerf::app
