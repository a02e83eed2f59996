// SPDX-License-Identifier: Apache-2.0
// The `kerf` program. Exit codes: 0 pass, 1 fail, incomplete or invalid, 2 bad input, 3 fault.
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/check_plugins.h"
#include "app/commands.h"
#include "app/last_resort.h"
#include "app/plugin_folders.h"
#include "app/plugin_guard.h"
#include "app/standard_streams.h"
#include "app/watch.h"
#include "run/shipped.h"

namespace {

using namespace kerf;

ExitCode do_as_told(int argc, char** argv) {
    CommandLine line = read_command_line(argc, argv);
    if (!line.answer.empty()) {
        line.exit_code == exit_pass ? print(line.answer) : print_error(line.answer);
        return static_cast<ExitCode>(line.exit_code);
    }
    // Plugins lie in ../lib/kerf of the program, and wherever the user says; shipped procedures in
    // ../share/kerf/procedures.
    std::error_code error;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
    const char* plugin_path = std::getenv("KERF_PLUGIN_PATH");
    const auto prefix = program.parent_path().parent_path(), lib = prefix / "lib";
    line.shipped = (prefix / "share" / "kerf" / "procedures").string();
    if (line.command == "check") return check_plugins(line, program.string());  // it loads no plugin
    if (line.command != "privacy")  // of that, any file is meant as it is named
        for (std::string& file : line.files) file = shipped_or_own(file, line.shipped);
    line.anatomy = shipped_or_own(line.anatomy, line.shipped);
    const PluginFolders folders = plugin_folders(plugin_path != nullptr ? plugin_path : "", (lib / "kerf").string());
    for (const auto& complaint : folders.complaints) print_error("kerf: " + complaint + "\n");
    if (line.is_watched) {
        std::vector<std::string> arguments;
        for (int i = 1; i < argc; ++i)
            if (std::string(argv[i]) != "--watch") arguments.emplace_back(argv[i]);
        return run_and_watch(line, program.string(), std::move(arguments), folders.folders);
    }
    PluginRegistry plugins;
    plugins.scan(folders.folders);
    for (const auto& refusal : plugins.refusals()) print_error(refusal + "\n");
    const PluginGuard guard;  // after loading, which needs a process of one thread
    return carry_out(line, plugins, (lib / "kerf-bench").string());
}

}  // namespace

int main(int argc, char** argv) {
    occupy_closed_streams();
    std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error with a name, not an end
    say_why_not_on_terminate();
    if (!is_stack_large_enough()) return exit_fault;
    return close_stdout(do_or_say_why_not([&] { return do_as_told(argc, argv); }));
}
