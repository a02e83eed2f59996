// SPDX-License-Identifier: Apache-2.0
#include "app/program.h"

#include <unistd.h>

#include <cerrno>
#include <clocale>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "app/badges/loaded_files.h"
#include "app/file_limit.h"
#include "app/last_resort.h"
#include "app/plugin_folders.h"
#include "app/plugin_guard.h"
#include "app/standard_streams.h"
#include "app/worker.h"
#include "core/plugin/reserved_names.h"

namespace kerf::app {

namespace {

/// Returns the ids in KERF_PLUGIN_ALLOW, which `:` separates as in KERF_PLUGIN_PATH.
std::vector<std::string> allowed_plugins() {
    const char* const given = std::getenv("KERF_PLUGIN_ALLOW");
    std::istringstream words(given != nullptr ? given : "");
    std::vector<std::string> ids;
    for (std::string id; std::getline(words, id, ':');)
        if (!id.empty()) ids.push_back(id);
    return ids;
}

/// Loads the plugins of all folders, and prints what it refused.
void load(PluginRegistry& plugins, const Installation& here) {
    const std::vector<std::string> allowed = allowed_plugins();
    reserve_names(here.plugins(), allowed);
    const std::vector<std::string> folders = plugin_folders_of(here);
    note_files_to_load(folders);
    plugins.scan(folders);
    for (const auto& refusal : plugins.refusals()) print_error(refusal + "\n");
    for (const auto& note : plugins.notes()) print_error(note + "\n");
    for (const auto& id : allowed)
        if (!is_foreign_name(id))
            print_error("kerf: KERF_PLUGIN_ALLOW names `" + id +
                        "`, which has no effect: no plugin of this id, which must begin with `kerf.`, is in another "
                        "folder than "
                        "Kerf's own.\n");
}

}  // namespace

int run_program(int argc, char** argv, const std::function<ExitCode(const CommandLine&, const Invocation&)>& run) {
    std::setlocale(LC_NUMERIC, "C");  // a library may have set another; text/plain_numbers.h
    occupy_closed_streams();
    std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow fails to be written, and the program continues
    install_terminate_handler();
    if (!is_stack_large_enough()) return exit_fault;
    return close_stdout(run_guarded([&] {
        if (const text::Diagnostics refusal = check_file_limit(); !refusal.empty()) {
            print_error(to_text(refusal));
            return exit_fault;
        }
        CommandLine line = read_command_line(argc, argv);
        if (line.command == nullptr) {
            line.exit_code == exit_pass ? print(line.answer) : print_error(line.answer);
            return line.exit_code;
        }
        const Installation here = this_installation();
        resolve_shipped_files(line, here.procedures());
        return run(line, {here, argc, argv});
    }));
}

ExitCode complain_about_other_command(const Command& command) {
    return complain("this program does not run `" + command.name + "`. Write `kerf " + command.name + "`.",
                    exit_bad_input);
}

std::vector<std::string> plugin_folders_of(const Installation& here) {
    const char* path = std::getenv("KERF_PLUGIN_PATH");
    PluginFolders folders = plugin_folders(path != nullptr ? path : "", here.plugins());
    for (const auto& complaint : folders.complaints) print_error("kerf: " + complaint + "\n");
    return std::move(folders.folders);
}

ExitCode with_plugins(const Installation& here, const std::function<ExitCode(const PluginRegistry&)>& run) {
    return run_in_worker([&] {
        begin_guarding_state();
        // Never unloaded: what a plugin does then has no say in a result that is written.
        static PluginRegistry& plugins = *new PluginRegistry;
        load(plugins, here);
        const PluginGuard guard;  // after loading, which needs a process of one thread
        try {
            const ExitCode code = run(plugins);
            guard.check();
            return code;
        } catch (...) {
            guard.check();  // a limit that a plugin has lowered may be the reason
            throw;
        }
    });
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

ExitCode become_window(const Installation& here, char** argv) {
    const std::string file = here.helper("kerf-window");
    execv(file.c_str(), argv);
    const std::string why = std::strerror(errno);
    return complain("the window is a program of its own, " + file + ", which cannot be started: " + why +
                        ". Install the package `kerf-window`; in a copy of the source, `./dev run … --window` builds "
                        "it.",
                    exit_fault);
}

}  // namespace kerf::app
