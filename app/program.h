// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/command_line.h"
#include "app/installation.h"
#include "core/plugin/loader.h"

/// Code shared by `kerf` and the programs that it starts: from `main` to the exit code.
namespace kerf {

/// Reads the command line and calls `command`; prints help and mistakes instead where that is the answer. Occupies
/// closed streams first, and turns a lack of memory, threads or stack into a message and exit_fault.
/// Returns the exit code of the program.   [main, once]
[[nodiscard]] int run_program(int argc, char** argv,
                              const std::function<ExitCode(CommandLine&, const Installation&)>& command);

/// Resolves the names of shipped procedures, loads the plugins and calls `command` while a PluginGuard lives. Prints
/// what it refused to load.   [main]
[[nodiscard]] ExitCode with_plugins(CommandLine& line, const Installation& here,
                                    const std::function<ExitCode(const PluginRegistry&)>& command);

/// Replaces files of `line` by shipped ones of the same name where there is no other.   [main]
void resolve_shipped_files(CommandLine& line, const Installation& here);

/// Returns the folders of plugins, and prints what is wrong with KERF_PLUGIN_PATH.   [main]
[[nodiscard]] std::vector<std::string> plugin_folders_of(const Installation& here);

/// Returns whether a command is a program of its own: studies and the conformance kit, which an operation never needs.
[[nodiscard]] bool is_own_program(const std::string& command);

/// Replaces this process by the program of a command, with the same arguments. Returns only if that is missing: prints
/// how to get it.   [main]
[[nodiscard]] ExitCode become_program_of(const std::string& command, const Installation& here, char** argv);

}  // namespace kerf
