// SPDX-License-Identifier: Apache-2.0
#include "app/watch.h"

#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <system_error>
#include <thread>

#include "app/interruption.h"
#include "app/standard_streams.h"

extern "C" char** environ;

namespace kerf {

namespace {

namespace fs = std::filesystem;

/// What a file is known by: when it was written, and how long it is.
using Files = std::map<std::string, std::pair<fs::file_time_type, std::uintmax_t>>;

void add(const fs::path& path, Files& files) {
    std::error_code error;
    const auto written = fs::last_write_time(path, error);
    if (error) return;
    const auto size = fs::file_size(path, error);
    if (!error) files[path.string()] = {written, size};
}

/// Those of a folder and of its own folders, of this kind.
void add_all(const fs::path& folder, const std::string& extension, int levels, Files& files) {
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        if (entry->path().extension() == extension) add(entry->path(), files);
        if (levels > 0 && entry->is_directory(error)) add_all(entry->path(), extension, levels - 1, files);
    }
}

Files watched(const CommandLine& line, const std::vector<std::string>& plugins) {
    Files files;
    for (const std::string& folder : plugins) add_all(folder, ".so", 0, files);
    for (const std::string& document : {line.files.front(), line.anatomy}) {
        if (document.empty()) continue;
        const fs::path folder = fs::path(document).parent_path();
        add_all(folder.empty() ? fs::path(".") : folder, ".yaml", 1, files);
    }
    return files;
}

/// The first that is new, gone or different.
std::string changed(const Files& before, const Files& now) {
    for (const auto& [path, known] : now)
        if (const auto found = before.find(path); found == before.end() || found->second != known) return path;
    for (const auto& [path, known] : before)
        if (!now.contains(path)) return path;
    return {};
}

/// The exit code; −1 if it could not be started.
int run_once(const std::string& program, std::vector<std::string>& arguments) {
    std::vector<char*> pointers{const_cast<char*>(program.c_str())};
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    pid_t child = -1;
    if (const int failed = posix_spawn(&child, program.c_str(), nullptr, nullptr, pointers.data(), environ);
        failed != 0) {
        print_error("kerf: " + program + " cannot be started: " + std::strerror(failed) + "\n");
        return -1;
    }
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : exit_fault;
}

}  // namespace

ExitCode run_and_watch(const CommandLine& line, const std::string& program, std::vector<std::string> arguments,
                       const std::vector<std::string>& plugins) {
    constexpr auto interval = std::chrono::milliseconds(200);
    const Interruption interruption;
    for (;;) {
        Files before = watched(line, plugins);
        if (run_once(program, arguments) < 0) return exit_fault;
        if (interruption.has_come()) return exit_pass;
        print_error("kerf: waiting for a change of a plugin, the procedure or its anatomy; Ctrl-C ends\n");
        std::string what;
        for (Files last = before; !interruption.has_come(); std::this_thread::sleep_for(interval)) {
            const Files now = watched(line, plugins);
            what = changed(before, now);
            if (!what.empty() && changed(last, now).empty()) break;  // whoever writes it has finished
            last = now;
        }
        if (interruption.has_come()) return exit_pass;
        print_error("kerf: " + what + " has changed\n");
    }
}

}  // namespace kerf
