// SPDX-License-Identifier: Apache-2.0
// The `kerf` program. Exit codes: 0 pass, 1 fail, incomplete or invalid, 2 bad input, 3 fault.
#include <string>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/program.h"
#include "app/watch.h"

int main(int argc, char** argv) {
    using namespace kerf;
    return run_program(argc, argv, [&](CommandLine& line, const Installation& here) {
        if (is_own_program(line.command)) return become_program_of(line.command, here, argv);
        if (!line.is_watched)
            return with_plugins(line, here,
                                [&](const PluginRegistry& plugins) { return run_command(line, plugins, here); });
        resolve_shipped_files(line, here);
        std::vector<std::string> arguments;
        for (int i = 1; i < argc; ++i)
            if (std::string(argv[i]) != "--watch") arguments.emplace_back(argv[i]);
        return run_and_watch(line, here.program(), std::move(arguments), plugin_folders_of(here));
    });
}
