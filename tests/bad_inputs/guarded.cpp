// SPDX-License-Identifier: Apache-2.0
#include "tests/bad_inputs/guarded.h"

#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <fstream>
#include <stdexcept>

namespace kerf::test {
namespace {

constexpr int max_ms = 20'000;                     // then it is stopped
constexpr rlim_t max_address_space = 16ull << 30;  // [bytes] so that a fault cannot take the machine along

/// [kB] of a line of /proc/self/status.
std::int64_t status_of(const std::string& key) {
    std::ifstream in("/proc/self/status");
    std::string word;
    std::int64_t value = 0;
    while (in >> word)
        if (word == key && in >> value) return value;
    throw std::runtime_error("no " + key + " in /proc/self/status");
}

struct Sent {
    std::int64_t kilobytes = 0;
    char is_thrown = 0;
};

[[noreturn]] void work_and_send(int pipe, const std::function<std::string()>& work) {
    const rlimit space{max_address_space, max_address_space};
    setrlimit(RLIMIT_AS, &space);
    const std::int64_t before = status_of("VmRSS:");
    Sent sent;
    std::string result;
    try {
        result = work();
    } catch (const std::exception& error) {
        sent.is_thrown = 1;
        result = error.what();
    }
    rusage children{};
    getrusage(RUSAGE_CHILDREN, &children);
    sent.kilobytes = std::max<std::int64_t>(status_of("VmHWM:"), children.ru_maxrss) - before;
    std::string bytes(reinterpret_cast<const char*>(&sent), sizeof sent);
    bytes += result;
    for (std::size_t at = 0; at < bytes.size();) {
        const ssize_t count = write(pipe, bytes.data() + at, bytes.size() - at);
        if (count <= 0) _exit(1);
        at += static_cast<std::size_t>(count);
    }
    _exit(0);
}

}  // namespace

Guarded guarded(const std::function<std::string()>& work) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const auto elapsed = [&] { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); };
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe");
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("no process");
    if (child == 0) {
        close(ends[0]);
        work_and_send(ends[1], work);
    }
    close(ends[1]);

    Guarded outcome;
    std::string bytes;
    for (;;) {
        pollfd wait{ends[0], POLLIN, 0};
        if (poll(&wait, 1, std::max(0, max_ms - static_cast<int>(elapsed()))) == 0) {
            outcome.fault = "took longer than 20 s";
            kill(child, SIGKILL);
            break;
        }
        char some[4096];
        const ssize_t count = read(ends[0], some, sizeof some);
        if (count <= 0) break;
        bytes.append(some, static_cast<std::size_t>(count));
    }
    close(ends[0]);
    int status = 0;
    waitpid(child, &status, 0);
    outcome.ms = elapsed();
    if (!outcome.fault.empty()) return outcome;
    if (WIFSIGNALED(status))
        outcome.fault = "signal " + std::to_string(WTERMSIG(status));
    else if (bytes.size() < sizeof(Sent))
        outcome.fault = "ended with " + std::to_string(WEXITSTATUS(status));
    if (!outcome.fault.empty()) return outcome;
    Sent sent;
    std::copy_n(bytes.data(), sizeof sent, reinterpret_cast<char*>(&sent));
    outcome.mb = static_cast<double>(sent.kilobytes) / 1024.0;
    outcome.result = bytes.substr(sizeof sent);
    if (sent.is_thrown != 0) outcome.fault = "threw: " + outcome.result;
    return outcome;
}

}  // namespace kerf::test
