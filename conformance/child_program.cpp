// SPDX-License-Identifier: Apache-2.0
#include "conformance/child_program.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

extern "C" char** environ;

namespace kerf::conformance {

namespace {

/// As the system wants them.
std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> all;
    for (std::string& text : texts) all.push_back(text.data());
    all.push_back(nullptr);
    return all;
}

std::vector<std::string> environment_with(const std::vector<std::string>& further) {
    std::vector<std::string> all = further;
    const auto is_replaced = [&](const std::string& variable) {
        const std::string name = variable.substr(0, variable.find('=') + 1);
        for (const std::string& other : further)
            if (other.starts_with(name)) return true;
        return false;
    };
    for (char** variable = environ; *variable != nullptr; ++variable)
        if (!is_replaced(*variable)) all.emplace_back(*variable);
    return all;
}

}  // namespace

ChildProgram::ChildProgram(const Settings& settings) {
    int pipe[2];
    if (pipe2(pipe, O_CLOEXEC) != 0) {
        error_ = std::strerror(errno);
        return;
    }
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, pipe[1], STDOUT_FILENO);
    if (settings.with_errors) posix_spawn_file_actions_adddup2(&actions, pipe[1], STDERR_FILENO);
    std::vector<std::string> arguments = settings.arguments, environment = environment_with(settings.environment);
    const int failed = posix_spawn(&process_, arguments.front().c_str(), &actions, nullptr, pointers(arguments).data(),
                                   pointers(environment).data());
    posix_spawn_file_actions_destroy(&actions);
    close(pipe[1]);
    if (failed != 0) {
        error_ = std::strerror(failed);
        process_ = -1;
        close(pipe[0]);
        return;
    }
    output_ = pipe[0];
}

ChildProgram::~ChildProgram() {
    if (process_ > 0) {
        kill(process_, SIGTERM);
        static_cast<void>(wait());
    }
    if (output_ >= 0) close(output_);
}

bool ChildProgram::read_line(std::string& line, const std::function<bool()>& is_interrupted) {
    for (;;) {
        if (const std::size_t end = bytes_.find('\n'); end != std::string::npos) {
            line = bytes_.substr(0, end);
            bytes_.erase(0, end + 1);
            return true;
        }
        pollfd waits{output_, POLLIN, 0};
        ::poll(&waits, 1, 100);
        if (is_interrupted && is_interrupted()) return false;
        // What the program forked may hold its output open: it has said all when it has ended.
        if (waits.revents == 0 && has_ended()) return false;
        if (waits.revents == 0) continue;
        char buffer[4096];
        const auto got = read(output_, buffer, sizeof buffer);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        bytes_.append(buffer, static_cast<std::size_t>(got));
    }
}

bool ChildProgram::has_ended() {
    if (process_ > 0 && waitpid(process_, &status_, WNOHANG) == process_) process_ = -1;
    return process_ < 0;
}

int ChildProgram::wait() {
    while (process_ > 0 && waitpid(process_, &status_, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1;
}

}  // namespace kerf::conformance
