// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "app/exit_code.h"

/// What is done where memory, threads or stack run out: a sentence and exit code 3, never a crash.
namespace kerf {

/// Does `work`. An exception of it becomes a line on stderr and exit_fault.   [main]
[[nodiscard]] ExitCode run_guarded(const std::function<ExitCode()>& work);

/// Ends the program in the same way where an exception cannot get to `run_guarded`: in a thread, or through a
/// function that does not throw. What is no exception of memory or of the system still aborts.   [main, once]
void install_terminate_handler();

/// Whether the stack is large enough; a line on stderr if not.   [main]
[[nodiscard]] bool is_stack_large_enough();

}  // namespace kerf
