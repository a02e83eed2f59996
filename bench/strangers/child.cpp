// SPDX-License-Identifier: Apache-2.0
#include "bench/strangers/child.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <thread>

namespace kerf::bench {

namespace {

using Clock = std::chrono::steady_clock;

int code_of(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status); }

[[noreturn]] void become(const std::vector<std::string>& command, const ChildPlan& plan) {
    std::vector<char*> words;
    for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    for (const auto& [name, value] : plan.added) setenv(name.c_str(), value.c_str(), 1);
    if (chdir(plan.folder.c_str()) != 0) _exit(127);
    const int none = open("/dev/null", O_RDONLY);
    const int out = open("stdout", O_WRONLY | O_CREAT | O_TRUNC, 0644);
    const int err = open("stderr", O_WRONLY | O_CREAT | O_TRUNC, 0644);
    dup2(none, STDIN_FILENO);
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    for (int file = 3; file < 100; ++file) close(file);
    execvp(words[0], words.data());
    _exit(127);
}

/// The leader of the session: its only work is to be the parent of the program.
[[noreturn]] void lead(const std::vector<std::string>& command, const ChildPlan& plan) {
    setsid();
    const pid_t program = fork();
    if (program == 0) become(command, plan);
    int status = 0;
    while (waitpid(program, &status, 0) < 0) continue;
    _exit(code_of(status));
}

/// Returns the session of a process, or -1.
pid_t session_of(const std::string& folder) {
    std::string line = text_of(folder + "/stat");
    const std::size_t name_end = line.rfind(')');
    if (name_end == std::string::npos) return -1;
    std::istringstream rest(line.substr(name_end + 1));
    std::string state;
    pid_t parent = -1, group = -1, session = -1;
    rest >> state >> parent >> group >> session;
    return state == "Z" ? -1 : session;
}

/// Returns the processes of a session.
std::vector<pid_t> processes_of(pid_t leader) {
    std::vector<pid_t> found;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
        const std::string name = entry.path().filename().string();
        if (name.find_first_not_of("0123456789") != std::string::npos) continue;
        const auto process = static_cast<pid_t>(std::stol(name));
        if (session_of(entry.path().string()) == leader) found.push_back(process);
    }
    return found;
}

/// Gives the processes of a session a second to end, then kills them. Returns how many it killed without the leader.
int end_session(pid_t leader) {
    constexpr int polls = 20;
    for (int i = 0; i < polls && !processes_of(leader).empty(); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    int count = 0;
    for (const pid_t process : processes_of(leader)) {
        count += process != leader ? 1 : 0;
        kill(process, SIGKILL);
    }
    return count;
}

}  // namespace

ChildEnd run_child(const std::vector<std::string>& command, const ChildPlan& plan) {
    const auto begun = Clock::now();
    const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - begun).count(); };
    ChildEnd end;
    const pid_t leader = fork();
    if (leader == 0) lead(command, plan);
    if (leader < 0) return end.code = 127, end;
    int status = 0;
    pid_t ended = 0;
    while ((ended = waitpid(leader, &status, WNOHANG)) == 0 && seconds() < plan.limit)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    end.timed_out = ended == 0;
    end.left = end_session(leader);
    if (end.timed_out) waitpid(leader, &status, 0);
    end.seconds = seconds();
    end.code = end.timed_out ? 124 : code_of(status);
    end.out = text_of(plan.folder + "/stdout");
    end.err = text_of(plan.folder + "/stderr");
    return end;
}

std::string text_of(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

bool is_newer(const std::string& result, const std::vector<std::string>& causes) {
    std::error_code none;
    const auto time = std::filesystem::last_write_time(result, none);
    if (none) return false;
    return std::none_of(causes.begin(), causes.end(), [&](const std::string& cause) {
        const auto changed = std::filesystem::last_write_time(cause, none);
        return none || changed > time;
    });
}

}  // namespace kerf::bench
