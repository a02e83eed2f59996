// SPDX-License-Identifier: Apache-2.0
#include "app/watch.h"

#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>
#include <utility>

#include "app/interruption.h"
#include "app/standard_streams.h"
#include "app/watched_files.h"

extern "C" char** environ;

namespace kerf::app {

namespace {

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
        const FileStates before = watched_files(options, plugins);
        if (run_once(program, arguments) < 0) return exit_fault;
        if (interruption.has_come()) return exit_pass;
        print_error("kerf: waiting for a change of a plugin, the procedure, its anatomy or their data; Ctrl-C ends\n");
        std::string what;
        for (FileStates last = before; !interruption.has_come(); std::this_thread::sleep_for(interval)) {
            FileStates now = watched_files(options, plugins);
            what = first_change(before, now);
            if (!what.empty() && first_change(last, now).empty())
                break;  // unchanged since the last poll: the writer has finished
            last = std::move(now);
        }
        if (interruption.has_come()) return exit_pass;
        print_error("kerf: " + what + " has changed\n");
    }
}

}  // namespace kerf::app
