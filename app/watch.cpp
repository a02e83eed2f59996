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

namespace kerf::app {

namespace {

namespace fs = std::filesystem;

/// Identifies the state of a file by its time and size [bytes].
using Files = std::map<std::string, std::pair<fs::file_time_type, std::uintmax_t>>;

void add(const fs::path& path, Files& files) {
    std::error_code error;
    const auto written = fs::last_write_time(path, error);
    if (error) return;
    const auto size = fs::file_size(path, error);
    if (!error) files[path.string()] = {written, size};
}

/// Adds the files of a folder with this ending, and those of its subfolders down to `levels`.
void add_all(const fs::path& folder, const std::string& extension, int levels, Files& files) {
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        if (entry->path().extension() == extension) add(entry->path(), files);
        if (levels > 0 && entry->is_directory(error)) add_all(entry->path(), extension, levels - 1, files);
    }
}

Files watched(const RunOptions& options, const std::vector<std::string>& plugins) {
    Files files;
    for (const std::string& folder : plugins) add_all(folder, ".so", 0, files);
    std::vector<std::string> documents = options.patches;
    documents.insert(documents.end(), {options.procedure, options.anatomy});
    for (const std::string& document : documents) {
        if (document.empty()) continue;
        const fs::path folder = fs::path(document).parent_path();
        add_all(folder.empty() ? fs::path(".") : folder, ".yaml", 1, files);
    }
    return files;
}

/// Returns the first file that is new, removed or different; empty if none is.
std::string changed(const Files& before, const Files& now) {
    for (const auto& [path, known] : now)
        if (const auto found = before.find(path); found == before.end() || found->second != known) return path;
    for (const auto& [path, known] : before)
        if (!now.contains(path)) return path;
    return {};
}

/// Returns the exit code; −1 if the program could not be started.
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

ExitCode run_and_watch(const RunOptions& options, const std::string& program, std::vector<std::string> arguments,
                       const std::vector<std::string>& plugins) {
    constexpr auto interval = std::chrono::milliseconds(200);
    const Interruption interruption;
    for (;;) {
        Files before = watched(options, plugins);
        if (run_once(program, arguments) < 0) return exit_fault;
        if (interruption.has_come()) return exit_pass;
        print_error("kerf: waiting for a change of a plugin, the procedure or its anatomy; Ctrl-C ends\n");
        std::string what;
        for (Files last = before; !interruption.has_come(); std::this_thread::sleep_for(interval)) {
            const Files now = watched(options, plugins);
            what = changed(before, now);
            if (!what.empty() && changed(last, now).empty())
                break;  // unchanged since the last poll: the writer has finished
            last = now;
        }
        if (interruption.has_come()) return exit_pass;
        print_error("kerf: " + what + " has changed\n");
    }
}

}  // namespace kerf::app
