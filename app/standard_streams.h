// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "app/exit_code.h"

/// Prints all output of the program. Text from documents, file names and plugins cannot control the terminal, and
/// output that is not written is an error.
namespace kerf::app {

/// Prints to stdout, with hidden characters escaped (text/printable.h).   [main]
void print(std::string_view text);

/// Prints to stderr, with hidden characters escaped.   [main]
void print_error(std::string_view text);

/// Copies what is printed to stderr while it lives, for a user without a terminal.   [main] one at a time
class ErrorCopy {
public:
    ErrorCopy();
    ~ErrorCopy();
    ErrorCopy(const ErrorCopy&) = delete;
    ErrorCopy& operator=(const ErrorCopy&) = delete;
    [[nodiscard]] std::string text() const;
};

/// Prints an error to stderr and returns `code`.   [main]
ExitCode complain(const std::string& error, ExitCode code);

/// `printf` into a string.   [any]
#if defined(__GNUC__)
[[gnu::format(printf, 1, 2)]]
#endif
[[nodiscard]] std::string
formatted(const char* format, ...);

/// Occupies the descriptors of closed standard streams, so that no later file gets one and receives messages. Writing
/// to such a stream fails.   [main, before any file is opened]
void occupy_closed_streams();

/// Flushes and closes stdout. Returns `code`; or prints a line to stderr and returns exit_fault if any output was lost.
/// [main, last]
[[nodiscard]] ExitCode close_stdout(ExitCode code);

}  // namespace kerf::app
