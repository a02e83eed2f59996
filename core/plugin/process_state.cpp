// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/process_state.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <clocale>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <thread>

#include "core/plugin/floating_point.h"

extern "C" char** environ;

namespace kerf {

namespace fs = std::filesystem;

namespace {

struct NamedNumber {
    int number;
    const char* name;
};

// Others, such as those of priorities, change nothing that Kerf does; a window system may change them.
constexpr std::array limits{
    NamedNumber{RLIMIT_AS, "RLIMIT_AS"},       NamedNumber{RLIMIT_DATA, "RLIMIT_DATA"},
    NamedNumber{RLIMIT_FSIZE, "RLIMIT_FSIZE"}, NamedNumber{RLIMIT_NOFILE, "RLIMIT_NOFILE"},
    NamedNumber{RLIMIT_CPU, "RLIMIT_CPU"},     NamedNumber{RLIMIT_STACK, "RLIMIT_STACK"},
    NamedNumber{RLIMIT_NPROC, "RLIMIT_NPROC"}, NamedNumber{RLIMIT_MEMLOCK, "RLIMIT_MEMLOCK"},
};
constexpr std::array timers{NamedNumber{ITIMER_REAL, "SIGALRM"}, NamedNumber{ITIMER_VIRTUAL, "SIGVTALRM"},
                            NamedNumber{ITIMER_PROF, "SIGPROF"}};
constexpr std::array streams{NamedNumber{STDIN_FILENO, "stdin"}, NamedNumber{STDOUT_FILENO, "stdout"},
                             NamedNumber{STDERR_FILENO, "stderr"}};
/// Signals that Kerf handles, or whose default it needs.
constexpr std::array signals{SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGINT, SIGTERM, SIGHUP, SIGCHLD, SIGXFSZ};

bool is_armed(const itimerval& timer) noexcept { return timer.it_value.tv_sec != 0 || timer.it_value.tv_usec != 0; }

/// Reads the mask of new files without setting it, as `umask` would.
int file_mask() noexcept {
    const int status = open("/proc/self/status", O_RDONLY | O_CLOEXEC);
    if (status < 0) return -1;
    char text[256]{};  // it is in the second line
    const ssize_t size = read(status, text, sizeof text - 1);
    close(status);
    const char* const line = size > 0 ? std::strstr(text, "Umask:") : nullptr;
    return line != nullptr ? static_cast<int>(std::strtol(line + 6, nullptr, 8)) : -1;
}

using ValueText = FixedText<600>;

void put_limit(rlim_t limit, ValueText& text) noexcept {
    limit == RLIM_INFINITY ? text << "unlimited" : text << static_cast<unsigned long long>(limit);
}

void put_handler(std::uintptr_t handler, ValueText& text) noexcept {
    text << (handler == reinterpret_cast<std::uintptr_t>(SIG_DFL)   ? "the default"
             : handler == reinterpret_cast<std::uintptr_t>(SIG_IGN) ? "none: ignored"
                                                                    : "a function");
}

void put_octal(int mask, ValueText& text) noexcept {
    const char digits[] = {static_cast<char>('0' + (mask >> 6 & 7)), static_cast<char>('0' + (mask >> 3 & 7)),
                           static_cast<char>('0' + (mask & 7)), '\0'};
    text << digits;
}

/// Compares the values of a limit that were in force.
bool compare_limits(const SharedState& before, const SharedState& after, StateChange& change) noexcept {
    for (const auto& [number, name] : limits) {
        const auto i = static_cast<std::size_t>(number);
        if (after.limits[i].rlim_cur >= before.limits[i].rlim_cur) continue;
        change.what << "the limit " << name;
        put_limit(before.limits[i].rlim_cur, change.before);
        put_limit(after.limits[i].rlim_cur, change.after);
        return true;
    }
    return false;
}

bool compare_timers(const SharedState& before, const SharedState& after, StateChange& change) noexcept {
    for (const auto& [number, name] : timers) {
        const auto i = static_cast<std::size_t>(number);
        if (!is_armed(after.timers[i]) || is_armed(before.timers[i])) continue;
        change.what << "a timer of " << name;
        change.before << "off";
        change.after << "on";
        return true;
    }
    return false;
}

bool compare_handlers(const SharedState& before, const SharedState& after, StateChange& change) noexcept {
    for (const int signal : signals) {
        const auto i = static_cast<std::size_t>(signal);
        if (before.handlers[i] == after.handlers[i]) continue;
        const char* const name = sigabbrev_np(signal);
        change.what << "the handler of SIG" << (name != nullptr ? name : "?");
        put_handler(before.handlers[i], change.before);
        put_handler(after.handlers[i], change.after);
        return true;
    }
    return false;
}

bool compare_streams(const SharedState& before, const SharedState& after, StateChange& change) noexcept {
    for (const auto& [number, name] : streams) {
        const auto i = static_cast<std::size_t>(number);
        if (before.streams[i] == after.streams[i]) continue;
        change.what << "the descriptor of " << name;
        change.before << (before.streams[i] == OpenFile{} ? "closed" : "open");
        change.after << (after.streams[i] == OpenFile{} ? "closed" : "another file");
        return true;
    }
    return false;
}

bool compare_surroundings(const SharedState& before, const SharedState& after, StateChange& change) noexcept {
    if (std::strcmp(before.folder.data(), after.folder.data()) != 0) {
        change.what << "the working folder";
        change.before << before.folder.data();
        change.after << (after.folder[0] != '\0' ? after.folder.data() : "one without a path");
    } else if (std::strcmp(before.decimal_point.data(), after.decimal_point.data()) != 0) {
        change.what << "the decimal point of the locale";
        change.before << "`" << before.decimal_point.data() << "`";
        change.after << "`" << after.decimal_point.data() << "`";
    } else if (before.mask != after.mask && before.mask >= 0 && after.mask >= 0) {
        change.what << "the mask of new files (umask)";
        put_octal(before.mask, change.before);
        put_octal(after.mask, change.after);
    }
    return change.has_happened();
}

}  // namespace

OpenFile open_file(int descriptor) noexcept {
    struct stat found {};
    if (fstat(descriptor, &found) != 0) return {};
    return {static_cast<std::uint64_t>(found.st_dev), static_cast<std::uint64_t>(found.st_ino)};
}

SharedState shared_state() noexcept {
    SharedState state;
    for (std::size_t i = 0; i < state.limits.size(); ++i)
        getrlimit(static_cast<__rlimit_resource>(i), &state.limits[i]);
    for (const auto& [number, name] : timers)
        getitimer(static_cast<__itimer_which>(number), &state.timers[static_cast<std::size_t>(number)]);
    for (std::size_t signal = 1; signal < state.handlers.size(); ++signal) {
        struct sigaction action {};
        sigaction(static_cast<int>(signal), nullptr, &action);
        state.handlers[signal] = reinterpret_cast<std::uintptr_t>(action.sa_handler);
    }
    for (std::size_t i = 0; i < state.streams.size(); ++i) state.streams[i] = open_file(static_cast<int>(i));
    if (getcwd(state.folder.data(), state.folder.size()) == nullptr) state.folder[0] = '\0';
    std::strncpy(state.decimal_point.data(), std::localeconv()->decimal_point, state.decimal_point.size() - 1);
    state.mask = file_mask();
    return state;
}

StateChange change_between(const SharedState& before, const SharedState& after) noexcept {
    StateChange change;
    static_cast<void>(compare_streams(before, after, change) || compare_limits(before, after, change) ||
                      compare_timers(before, after, change) || compare_handlers(before, after, change) ||
                      compare_surroundings(before, after, change));
    return change;
}

std::string StateChange::text() const {
    return std::string(what.c_str()) + " from " + before.c_str() + " to " + after.c_str();
}

std::vector<std::string> further(const std::vector<std::string>& before, const std::vector<std::string>& after) {
    std::vector<std::string> more;
    for (const std::string& one : after)
        if (std::find(before.begin(), before.end(), one) == before.end()) more.push_back(one);
    return more;
}

int count_threads() {
    const auto count = [] {
        std::error_code error;
        int threads = 0;
        for (fs::directory_iterator task("/proc/self/task", error), end; !error && task != end; task.increment(error))
            ++threads;
        return threads;
    };
    int threads = count();
    for (int i = 0; i < 20 && threads > 1; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        threads = count();
    }
    return threads;
}

ProcessState process_state() {
    ProcessState state;
    state.shared = shared_state();
    const FloatingPoint now = floating_point();
    state.rounding = now.sse | static_cast<std::uint32_t>(now.x87) << 16;
    std::error_code error;
    for (int file = 0; file < 256; ++file) {
        const fs::path target = fs::read_symlink("/proc/self/fd/" + std::to_string(file), error);
        if (!error) state.files.push_back(std::to_string(file) + " " + target.string());
        error.clear();
    }
    state.locale = std::setlocale(LC_ALL, nullptr);
    for (char** variable = environ; variable != nullptr && *variable != nullptr; ++variable)
        state.environment.emplace_back(*variable);
    std::sort(state.environment.begin(), state.environment.end());
    state.threads = count_threads();
    return state;
}

}  // namespace kerf
