// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "app/command_line.h"

/// What is done where memory, threads or stack run out: a sentence and exit code 3, never a crash.
namespace kerf {

/// Does `work`. An exception of it becomes a line on stderr and exit_fault.   [main]
[[nodiscard]] ExitCode do_or_say_why_not(const std::function<ExitCode()>& work);

/// Ends the program in the same way where an exception cannot get to `do_or_say_why_not`: in a thread, or through a
/// function that does not throw. What is no exception of memory or of the system still aborts.   [main, once]
void say_why_not_on_terminate();

/// Whether the stack is large enough; a line on stderr if not.   [main]
[[nodiscard]] bool is_stack_large_enough();

}  // namespace kerf
