// SPDX-License-Identifier: Apache-2.0
// The `kerf` program. Exit codes: 0 pass, 1 fail, incomplete or invalid, 2 bad input, 3 fault.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands.h"

namespace {

/// Plugins lie in ../lib/kerf of the program, and in KERF_PLUGIN_PATH (folders separated by `:`).
std::vector<std::string> plugin_folders() {
    std::vector<std::string> folders;
    if (const char* path = std::getenv("KERF_PLUGIN_PATH")) {
        std::string_view rest = path;
        while (!rest.empty()) {
            const auto end = rest.find(':');
            if (end != 0) folders.emplace_back(rest.substr(0, end));
            rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
        }
    }
    std::error_code error;
    const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
    if (!error) folders.push_back((self.parent_path().parent_path() / "lib" / "kerf").string());
    return folders;
}

}  // namespace

int main(int argc, char** argv) {
    const kerf::CommandLine line = kerf::read_command_line(argc, argv);
    if (!line.answer.empty()) {
        std::fputs(line.answer.c_str(), line.exit_code == kerf::exit_pass ? stdout : stderr);
        return line.exit_code;
    }
    kerf::PluginRegistry plugins;
    plugins.scan(plugin_folders());
    for (const auto& refusal : plugins.refusals()) std::fprintf(stderr, "%s\n", refusal.c_str());
    return kerf::carry_out(line, plugins);
}
