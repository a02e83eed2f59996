// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "app/command_line.h"
#include "app/installation.h"
#include "core/plugin/loader.h"

/// Code shared by `kerf` and the programs that it starts: from `main` to the exit code.
namespace kerf::app {

/// Reads the command line and calls `run`; prints help or mistakes instead where they are the answer. Occupies closed
/// streams first, resolves the names of shipped documents, and turns a lack of memory, threads or stack into a message
/// and exit_fault. Returns the exit code of the program.   [main, once]
[[nodiscard]] int run_program(int argc, char** argv,
                              const std::function<ExitCode(const CommandLine&, const Invocation&)>& run);

/// Prints that a program of libexec/kerf does not run `command`; returns exit_bad_input.   [main]
[[nodiscard]] ExitCode complain_about_other_command(const Command& command);

/// As run_program(), for libexec/kerf/kerf-NAME, which runs the one command with the options `T`.   [main, once]
template <class T>
[[nodiscard]] int run_own_program(int argc, char** argv,
                                  const std::function<ExitCode(const T&, const Installation&)>& run) {
    return run_program(argc, argv, [&](const CommandLine& line, const Invocation& call) {
        const T* options = std::get_if<T>(&line.options);
        return options != nullptr ? run(*options, call.here) : complain_about_other_command(*line.command);
    });
}

/// Loads the plugins and calls `run` in a worker (app/worker.h), while a PluginGuard lives. Prints each plugin that it
/// refused.   [main]
[[nodiscard]] ExitCode with_plugins(const Installation& here,
                                    const std::function<ExitCode(const PluginRegistry&)>& run);

/// Returns the folders of plugins, and prints the mistakes in KERF_PLUGIN_PATH.   [main]
[[nodiscard]] std::vector<std::string> plugin_folders_of(const Installation& here);

/// Replaces this process by libexec/kerf/kerf-COMMAND, with the same arguments. Returns only if the program cannot be
/// started, and prints how to get it.   [main]
[[nodiscard]] ExitCode become_program_of(const std::string& command, const Installation& here, char** argv);

/// Replaces this process by libexec/kerf/kerf-window, with the same arguments. Returns as above.   [main]
[[nodiscard]] ExitCode become_window(const Installation& here, char** argv);

}  // namespace kerf::app
