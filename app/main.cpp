// SPDX-License-Identifier: Apache-2.0
// The `kerf` program. Exit codes: 0 pass, 1 fail, incomplete or invalid, 2 bad input, 3 fault.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include "app/commands.h"
#include "app/plugin_folders.h"
#include "app/shipped.h"

int main(int argc, char** argv) {
    std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error with a name, not an end
    kerf::CommandLine line = kerf::read_command_line(argc, argv);
    if (!line.answer.empty()) {
        std::fputs(line.answer.c_str(), line.exit_code == kerf::exit_pass ? stdout : stderr);
        return line.exit_code;
    }
    // Plugins lie in ../lib/kerf of the program, and wherever the user says; shipped procedures in
    // ../share/kerf/procedures.
    std::error_code error;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
    const char* plugin_path = std::getenv("KERF_PLUGIN_PATH");
    const auto prefix = program.parent_path().parent_path(), lib = prefix / "lib";
    line.shipped = (prefix / "share" / "kerf" / "procedures").string();
    if (line.command != "privacy")  // of that, any file is meant as it is named
        for (std::string& file : line.files) file = kerf::shipped_or_own(file, line.shipped);
    line.anatomy = kerf::shipped_or_own(line.anatomy, line.shipped);
    const kerf::PluginFolders folders =
        kerf::plugin_folders(plugin_path != nullptr ? plugin_path : "", (lib / "kerf").string());
    for (const auto& complaint : folders.complaints) std::fprintf(stderr, "kerf: %s\n", complaint.c_str());
    kerf::PluginRegistry plugins;
    plugins.scan(folders.folders);
    for (const auto& refusal : plugins.refusals()) std::fprintf(stderr, "%s\n", refusal.c_str());
    return kerf::carry_out(line, plugins, (lib / "kerf-bench").string());
}
