// SPDX-License-Identifier: Apache-2.0
// kerf-limit --name NAME --cpu SECONDS [--idle SECONDS] -- COMMAND …
//
// Runs a test. Ends it with all that it started, and names it, when together they have used SECONDS of processor time,
// or none for a minute: a busy machine then fails no test, and a test that hangs still ends. Appends its name,
// processor time and wall time to the file that KERF_TEST_TIMES names. Ends as the command ends, or with 124.
#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <system_error>
#include <vector>

namespace {

using Clock = std::chrono::steady_clock;

constexpr int ended_here = 124;
constexpr double unseen = 0.05;  ///< [s] of processor time that a process which waits may still use

struct Options {
    std::string name;
    double cpu = 60.0, idle = 60.0;  ///< [s]
    char** command = nullptr;
};

/// What /proc says of one process.
struct Process {
    pid_t parent = 0;
    double cpu = 0.0;  ///< [s] its own and that of children which it has waited for
};

double seconds_of(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// All processes of the machine.
std::map<pid_t, Process> processes() {
    static const double tick = 1.0 / static_cast<double>(sysconf(_SC_CLK_TCK));
    std::map<pid_t, Process> all;
    std::error_code error;
    for (auto entry = std::filesystem::directory_iterator("/proc", error); !error && entry != end(entry);
         entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (name.find_first_not_of("0123456789") != std::string::npos) continue;
        std::string line;
        std::getline(std::ifstream(entry->path() / "stat"), line);
        const std::size_t end_of_name = line.rfind(')');  // a name may hold spaces and brackets
        if (end_of_name == std::string::npos) continue;
        char state = 0;
        int parent = 0;
        unsigned long user = 0, system = 0;
        long of_children_user = 0, of_children_system = 0;
        if (std::sscanf(line.c_str() + end_of_name + 1, " %c %d %*d %*d %*d %*d %*u %*u %*u %*u %*u %lu %lu %ld %ld",
                        &state, &parent, &user, &system, &of_children_user, &of_children_system) != 6)
            continue;
        const double ticks = static_cast<double>(user + system) + static_cast<double>(of_children_user) +
                             static_cast<double>(of_children_system);
        all[static_cast<pid_t>(std::atoi(name.c_str()))] = {parent, ticks * tick};
    }
    return all;
}

/// The processes below this one.
std::vector<pid_t> descendants(const std::map<pid_t, Process>& all) {
    std::vector<pid_t> found;
    for (const auto& [pid, process] : all) {
        pid_t ancestor = process.parent;
        for (int depth = 0; depth < 64 && ancestor != getpid() && ancestor > 1; ++depth) {
            const auto next = all.find(ancestor);
            ancestor = next != all.end() ? next->second.parent : 0;
        }
        if (ancestor == getpid()) found.push_back(pid);
    }
    return found;
}

/// Processor time of all that the command started, alive or waited for [s].
double cpu_used() {
    const auto all = processes();
    double sum = 0.0;
    for (const pid_t pid : descendants(all)) sum += all.at(pid).cpu;
    rusage ended{};
    getrusage(RUSAGE_CHILDREN, &ended);
    return sum + seconds_of(ended.ru_utime) + seconds_of(ended.ru_stime);
}

/// Ends all that the command started; again, as long as one starts another.
void end_all() {
    for (int round = 0; round < 20; ++round) {
        const auto pids = descendants(processes());
        if (pids.empty()) return;
        for (const pid_t pid : pids) kill(pid, SIGKILL);
        while (waitpid(-1, nullptr, WNOHANG) > 0) {
        }
        constexpr timespec pause{0, 50'000'000};
        nanosleep(&pause, nullptr);
    }
}

/// Waits until the command has ended; returns its status, or −1 if it was ended here.
int wait_for(pid_t command, const Options& options) {
    auto last_look = Clock::now(), last_use = last_look;
    double used_before = 0.0;
    int pause_us = 200;  // short at first: most tests end within milliseconds
    for (;;) {
        int status = 0;
        const pid_t ended = waitpid(-1, &status, WNOHANG);
        if (ended == command) return status;
        if (ended > 0) continue;
        const timespec pause{0, pause_us * 1000L};
        nanosleep(&pause, nullptr);
        pause_us = pause_us < 20'000 ? pause_us * 2 : 20'000;

        const auto now = Clock::now();
        if (now - last_look < std::chrono::seconds(1)) continue;
        last_look = now;
        const double used = cpu_used();
        if (used > used_before + unseen) {
            used_before = used;
            last_use = now;
        }
        const double idle = std::chrono::duration<double>(now - last_use).count();
        if (used <= options.cpu && idle <= options.idle) continue;
        end_all();
        std::fflush(stdout);
        if (used > options.cpu)
            std::fprintf(stderr, "%s: ENDED: it used %.0f s of processor time, and may use %.0f s\n",
                         options.name.c_str(), used, options.cpu);
        else
            std::fprintf(stderr, "%s: ENDED: it hangs: it used no processor time for %.0f s\n", options.name.c_str(),
                         idle);
        return -1;
    }
}

void append_times(const Options& options, double wall) {
    const char* file = std::getenv("KERF_TEST_TIMES");
    if (file == nullptr) return;
    rusage ended{};
    getrusage(RUSAGE_CHILDREN, &ended);
    char line[512];
    const int length = std::snprintf(line, sizeof line, "%s\t%.3f\t%.3f\n", options.name.c_str(),
                                     seconds_of(ended.ru_utime) + seconds_of(ended.ru_stime), wall);
    const int to = open(file, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
    if (to < 0) return;
    if (length > 0 && length < static_cast<int>(sizeof line))
        static_cast<void>(!write(to, line, static_cast<std::size_t>(length)));  // one call: lines of two never mix
    close(to);
}

bool read_options(int argc, char** argv, Options& options) {
    int i = 1;
    for (; i + 1 < argc && std::string(argv[i]) != "--"; i += 2) {
        const std::string option = argv[i];
        if (option == "--name")
            options.name = argv[i + 1];
        else if (option == "--cpu")
            options.cpu = std::atof(argv[i + 1]);
        else if (option == "--idle")
            options.idle = std::atof(argv[i + 1]);
        else
            return false;
    }
    options.command = argv + i + 1;
    return i + 1 < argc && options.cpu > 0.0 && options.idle > 0.0;
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    if (!read_options(argc, argv, options)) {
        std::fprintf(stderr, "kerf-limit --name NAME --cpu SECONDS [--idle SECONDS] -- COMMAND …\n");
        return 2;
    }
    prctl(PR_SET_CHILD_SUBREAPER, 1);  // what the command leaves behind is ended and counted too
    const auto start = Clock::now();
    const pid_t command = fork();
    if (command == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);  // Ctrl-C at ctest ends the test too
        setenv("KERF_BADGES", "off", 0);   // no test depends on what this machine has checked, or adds to it
        execvp(options.command[0], options.command);
        std::fprintf(stderr, "kerf-limit: %s: %s\n", options.command[0], std::strerror(errno));
        _exit(127);
    }
    if (command < 0) {
        std::perror("kerf-limit: fork");
        return 3;
    }
    const int status = wait_for(command, options);
    if (status >= 0) end_all();
    while (waitpid(-1, nullptr, WNOHANG) > 0) {
    }
    append_times(options, std::chrono::duration<double>(Clock::now() - start).count());
    if (status < 0) return ended_here;
    if (WIFSIGNALED(status)) {
        std::fprintf(stderr, "%s: ended by signal %d (%s)\n", options.name.c_str(), WTERMSIG(status),
                     strsignal(WTERMSIG(status)));
        return 128 + WTERMSIG(status);
    }
    return WEXITSTATUS(status);
}
