// SPDX-License-Identifier: Apache-2.0
#include "app/program.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/last_resort.h"
#include "app/plugin_folders.h"
#include "app/plugin_guard.h"
#include "app/standard_streams.h"
#include "run/shipped.h"

namespace kerf {

int run_program(int argc, char** argv, const std::function<ExitCode(CommandLine&, const Installation&)>& command) {
    occupy_closed_streams();
    std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error with a name, not an end
    say_why_not_on_terminate();
    if (!is_stack_large_enough()) return exit_fault;
    return close_stdout(do_or_say_why_not([&] {
        CommandLine line = read_command_line(argc, argv);
        if (!line.answer.empty()) {
            line.exit_code == exit_pass ? print(line.answer) : print_error(line.answer);
            return static_cast<ExitCode>(line.exit_code);
        }
        const Installation here = this_installation();
        line.shipped = here.procedures();
        return command(line, here);
    }));
}

void resolve_shipped_files(CommandLine& line, const Installation& here) {
    if (line.command == "privacy") return;  // it opens exactly the file that is named
    for (std::string& file : line.files) file = shipped_or_own(file, here.procedures());
    line.anatomy = shipped_or_own(line.anatomy, here.procedures());
}

std::vector<std::string> plugin_folders_of(const Installation& here) {
    const char* path = std::getenv("KERF_PLUGIN_PATH");
    PluginFolders folders = plugin_folders(path != nullptr ? path : "", here.plugins());
    for (const auto& complaint : folders.complaints) print_error("kerf: " + complaint + "\n");
    return std::move(folders.folders);
}

ExitCode with_plugins(CommandLine& line, const Installation& here,
                      const std::function<ExitCode(const PluginRegistry&)>& command) {
    resolve_shipped_files(line, here);
    PluginRegistry plugins;
    plugins.scan(plugin_folders_of(here));
    for (const auto& refusal : plugins.refusals()) print_error(refusal + "\n");
    for (const auto& note : plugins.notes()) print_error(note + "\n");
    const PluginGuard guard;  // after loading, which needs a process of one thread
    return command(plugins);
}

bool is_own_program(const std::string& command) {
    constexpr std::array<std::string_view, 4> programs{"chart", "check", "plan", "stability"};
    return std::find(programs.begin(), programs.end(), command) != programs.end();
}

ExitCode become_program_of(const std::string& command, const Installation& here, char** argv) {
    const std::string file = here.helper("kerf-" + command);
    execv(file.c_str(), argv);
    const std::string why = std::strerror(errno);
    return complain("`kerf " + command + "` is a program of its own, " + file + ", which cannot be started: " + why +
                        ". In a copy of the source, write `./dev kerf " + command +
                        "`, which builds it; else install Kerf again.",
                    exit_fault);
}

}  // namespace kerf
