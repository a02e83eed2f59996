// SPDX-License-Identifier: Apache-2.0
#include "app/worker.h"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>
#include <thread>

#include "app/last_resort.h"
#include "app/parent_watch.h"
#include "app/plugin_output.h"
#include "app/standard_streams.h"
#include "core/plugin/process_notes.h"
#include "text/shell.h"
#include "text/system_reason.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define KERF_HAS_SANITIZER 1
#else
#define KERF_HAS_SANITIZER 0
#endif

namespace kerf::app {

namespace {

constexpr int passed_on = 0x6b657266;  // "kerf"
constexpr int signals_until_kill = 3;
constexpr auto poll_interval = std::chrono::milliseconds(100);
constexpr int polls_until_stuck = 50;  // 5 s, counted in polls: Ctrl-Z stops the parent too

// A signal handler can only reach globals.
volatile pid_t worker = 0;
volatile std::sig_atomic_t passed_signal = 0, passed_count = 0;

void pass_on(int signal) {
    passed_signal = signal;
    passed_count = passed_count + 1;
    if (worker <= 0) return;
    sigval value{};
    value.sival_int = passed_on;
    if (passed_count < signals_until_kill)
        sigqueue(worker, signal, value);
    else
        kill(worker, SIGKILL);
}

constexpr std::array signals{SIGINT, SIGTERM, SIGHUP};

/// Passes on the signals that end a program. One that was ignored, as by `nohup`, stays ignored.
void pass_signals_on() {
    for (const int signal : signals) {
        struct sigaction action {};
        if (sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
        action = {};
        action.sa_handler = &pass_on;
        sigaction(signal, &action, nullptr);
    }
}

void stop_passing_signals_on() {
    for (const int signal : signals) {
        struct sigaction action {};
        if (sigaction(signal, nullptr, &action) == 0 && action.sa_handler == &pass_on) std::signal(signal, SIG_DFL);
    }
}

/// Delays these signals while it lives.
class SignalsDelayed {
public:
    SignalsDelayed() {
        sigset_t delayed;
        sigemptyset(&delayed);
        for (const int signal : signals) sigaddset(&delayed, signal);
        sigprocmask(SIG_BLOCK, &delayed, &before_);
    }
    ~SignalsDelayed() { sigprocmask(SIG_SETMASK, &before_, nullptr); }
    SignalsDelayed(const SignalsDelayed&) = delete;
    SignalsDelayed& operator=(const SignalsDelayed&) = delete;

private:
    sigset_t before_{};
};

/// Forks. In the child, signals have their usual effect; in the parent, they are passed on.
pid_t fork_worker() {
    const SignalsDelayed delayed;
    const pid_t child = fork();
    if (child == 0)
        stop_passing_signals_on();
    else
        worker = child;
    return child;
}

[[noreturn]] void work_as_child(const std::function<ExitCode()>& work, pid_t parent, PluginOutput& printed) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // the worker ends with its parent
    if (getppid() != parent) _exit(exit_fault);
    note_parent(parent);
    allow_last_word(getpid());
    printed.separate();
    const ExitCode code = close_stdout(run_guarded(work));
    std::fflush(nullptr);  // text of plugins that is in a buffer
    say_last_word(code);
    // Exit handlers and destructors of plugins have no say in a result that is written.
    if (KERF_HAS_SANITIZER) std::exit(code);
    _exit(code);
}

/// Ends copies of this program that a plugin has made and left behind.
void end_copies() {
    std::error_code error;
    const std::filesystem::path own = std::filesystem::read_symlink("/proc/self/exe", error);
    std::ifstream children("/proc/self/task/" + std::to_string(getpid()) + "/children");
    for (pid_t child = 0; children >> child;)
        if (std::filesystem::read_symlink("/proc/" + std::to_string(child) + "/exe", error) == own) {
            kill(child, SIGKILL);
            waitpid(child, nullptr, 0);
        }
}

/// Waits for a stopped worker. Returns false if it is inside of a plugin and does not continue.
bool does_continue() {
    for (int polls = 0; polls < polls_until_stuck; ++polls) {
        std::this_thread::sleep_for(poll_interval);
        siginfo_t changed{};
        waitid(P_PID, static_cast<id_t>(worker), &changed, WEXITED | WCONTINUED | WNOHANG | WNOWAIT);
        if (changed.si_pid != 0 || call_in_progress().call == PluginCall::none) return true;
    }
    return false;
}

/// How a worker ended: "ended the program with exit code 0".
struct Ending {
    std::string text;
    bool is_from_outside = false;  ///< perhaps: another process, or the system, can send this signal
};

Ending ending_of(int status) {
    if (WIFEXITED(status)) return {"ended the program with exit code " + std::to_string(WEXITSTATUS(status))};
    const int signal = WTERMSIG(status);
    const char* name = sigabbrev_np(signal);
    const bool is_from_outside = signal == SIGKILL || signal == SIGTERM || signal == SIGINT || signal == SIGHUP;
    return {std::string("ended the program by SIG") + (name != nullptr ? name : "?"), is_from_outside};
}

std::string text_of_plugin(const ComponentName& name) {
    return name.is_known() ? std::string(name.plugin) + " (" + name.path + ")" : "of unknown path";
}

/// Prints why there is no result, and what is recorded.
void report_end(const Ending& ending) {
    const CallInProgress now = call_in_progress(), last = last_call();
    const ComponentName name = name_of(now.call != PluginCall::none ? now.component : last.component);
    const std::string from_outside = " Another process may have done this, or the system for lack of memory.";
    if (now.call != PluginCall::none)
        print_error("kerf: plugin " + text_of_plugin(name) + ": `" + to_text(now.call) + "` of `" + name.component +
                    "` " + ending.text + ", without a result." + (ending.is_from_outside ? from_outside : "") +
                    " Mend it, or take it out of its folder.\n");
    else if (ending.is_from_outside)
        print_error("kerf: a signal " + ending.text + ", without a result." + from_outside + "\n");
    else if (last.call != PluginCall::none)
        print_error("kerf: Kerf's own code " + ending.text + ", without a result. The last call was `" +
                    to_text(last.call) + "` of `" + name.component + "`, plugin " + text_of_plugin(name) +
                    ". A plugin that writes beyond its memory, or has a thread of its own, can do this. Write `kerf "
                    "check " +
                    text::shell_path(name.path) +
                    "`, which finds it; if it finds nothing, Kerf is at fault: report it.\n");
    else
        print_error("kerf: Kerf's own code " + ending.text +
                    ", without a result, and no plugin was called. Kerf is at fault: report it.\n");
    const std::string record = noted_record();
    std::error_code none;
    if (!record.empty() && std::filesystem::exists(record, none))
        print_error("      What was recorded up to a moment ago is kept in " + record + ". Write `kerf report " +
                    text::shell_path(record) + "` to read it.\n");
}

/// Ends this process by the signal that ended the worker.
void end_by(int signal) {
    std::signal(signal, SIG_DFL);
    raise(signal);
}

ExitCode judge(int status) {
    if (const std::optional<int> word = last_word()) {
        const bool is_leak = KERF_HAS_SANITIZER && WIFEXITED(status) && WEXITSTATUS(status) > exit_fault;
        return static_cast<ExitCode>(is_leak ? WEXITSTATUS(status) : *word);
    }
    if (WIFSIGNALED(status)) {
        const int signal = WTERMSIG(status);
        const bool is_closed_pipe = signal == SIGPIPE && call_in_progress().call == PluginCall::none;
        const bool is_passed = passed_count > 0 && (signal == passed_signal || signal == SIGKILL);
        if (is_closed_pipe || is_passed) end_by(is_passed ? passed_signal : signal);
    }
    report_end(ending_of(status));
    return exit_fault;
}

ExitCode wait_for_worker() {
    for (;;) {
        int status = 0;
        if (waitpid(worker, &status, WUNTRACED) < 0) {
            if (errno == EINTR) continue;
            return complain(std::string("the worker cannot be waited for: ") + std::strerror(errno) + ".", exit_fault);
        }
        if (!WIFSTOPPED(status)) return judge(status);
        if (does_continue()) continue;
        kill(worker, SIGKILL);
        waitpid(worker, nullptr, 0);
        report_end({"stopped the program for 5 s", true});
        return exit_fault;
    }
}

}  // namespace

bool is_passed_on(const siginfo_t& signal) noexcept {
    return signal.si_code == SI_QUEUE && signal.si_value.sival_int == passed_on && signal.si_pid == getppid();
}

ExitCode run_in_worker(const std::function<ExitCode()>& work) {
    if (!begin_common_notes())
        return complain(std::string("the system refused memory: ") + std::strerror(errno) + ".", exit_fault);
    std::fflush(nullptr);  // or the child prints it again
    passed_count = 0;
    PluginOutput printed;
    prctl(PR_SET_CHILD_SUBREAPER, 1);
    pass_signals_on();
    const pid_t parent = getpid();
    const pid_t child = fork_worker();
    if (child == 0) work_as_child(work, parent, printed);
    if (child < 0)
        return complain(
            std::string("the system refused a process: ") + std::strerror(errno) + ". " + text::thread_advice() + ".",
            exit_fault);
    printed.begin();
    const ExitCode code = wait_for_worker();
    stop_passing_signals_on();
    end_copies();
    printed.report();
    return code;
}

}  // namespace kerf::app
