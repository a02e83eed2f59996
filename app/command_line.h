// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/command_table.h"
#include "app/exit_code.h"
#include "app/options.h"

namespace kerf::app {

/// A command line of `kerf` that was read.
struct CommandLine {
    const Command* command = nullptr;  ///< null: print `answer` and end
    Options options;                   ///< of `command`
    std::string answer;                ///< help, version, or what is wrong
    ExitCode exit_code = exit_pass;    ///< with `answer`; exit_bad_input belongs on stderr
};

/// Reads the arguments by the table of commands. Never throws, prints or exits.   [main]
[[nodiscard]] CommandLine read_command_line(int argc, const char* const* argv);

/// Replaces the names of shipped documents by their files, where the working folder has no file of that name.   [main]
/// @param shipped   the folder of the shipped procedures
void resolve_shipped_files(CommandLine& line, const std::string& shipped);

}  // namespace kerf::app
