// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "app/exit_code.h"

/// Everything the program prints goes through here, so that what a document, a file name or a plugin holds cannot
/// command a terminal, and what does not arrive is an error.
namespace kerf {

/// Prints to stdout, with hidden characters escaped (text/printable.h).   [main]
void print(std::string_view text);

/// Prints to stderr, likewise.   [main]
void print_error(std::string_view text);

/// Prints what went wrong to stderr and returns `code`.   [main]
ExitCode complain(const std::string& error, ExitCode code);

/// `printf` into a string.   [any]
#if defined(__GNUC__)
[[gnu::format(printf, 1, 2)]]
#endif
[[nodiscard]] std::string
formatted(const char* format, ...);

/// Occupies the numbers of standard streams that are closed, so that no file of ours gets one: a later message would be
/// written into it. What is written to such a stream fails.   [main, before any file is opened]
void occupy_closed_streams();

/// Writes what is still buffered for stdout and closes it. Returns `code`; exit_fault, with a line on stderr, if
/// anything that was printed did not arrive.   [main, last]
[[nodiscard]] ExitCode close_stdout(ExitCode code);

}  // namespace kerf
