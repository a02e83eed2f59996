// SPDX-License-Identifier: Apache-2.0
#include "app/plugin_guard.h"

#include <pthread.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "app/parent_watch.h"
#include "core/plugin/fixed_text.h"
#include "core/plugin/guarded_memory.h"
#include "core/plugin/own_streams.h"
#include "core/plugin/plugin_call.h"
#include "core/plugin/state_watch.h"
#include "session/recorder.h"

namespace kerf::app {

namespace {

// These functions may run in a signal handler, on a thread whose plugin has just overwritten any memory. They therefore
// take no lock, no memory and no stdio. They do not write the record: SQLite is not safe in a handler. The recorder's
// own thread writes it; the handler sets a flag and waits for that thread, at most 2 s, because a broken heap may stop
// it too. Rows that were committed before are safe in any case.

constexpr int exit_fault = 3;
constexpr auto poll_interval = std::chrono::milliseconds(100);
constexpr int polls_between_states = 10;
constexpr int polls_until_hung = 50;  // 5 s, counted in polls: a program that was stopped and continued has not hung
// A law has a fraction of a millisecond. One that takes over 10 ms a call for 10 s makes a run without an end.
constexpr int polls_of_window = 100, min_calls_of_window = 1000, max_polls_outside = 5;
constexpr int polls_until_abandoned = 50;  // of a parent that is stopped: Ctrl-Z stops the worker, too
constexpr std::size_t stack_size = 256 << 10;

[[noreturn]] void leave(int status) noexcept {
    for (;;) syscall(SYS_exit_group, status);
}

const char* name_of_signal(int signal) noexcept {
    switch (signal) {
        case SIGABRT:
            return "aborted";
        case SIGSEGV:
            return "crashed (SIGSEGV: it touched memory that is not its own, or used up its stack)";
        case SIGBUS:
            return "crashed (SIGBUS)";
        case SIGFPE:
            return "crashed (SIGFPE: it divided a whole number by zero)";
        default:
            return "crashed (SIGILL)";
    }
}

constexpr const char* perhaps_from_outside = ". Another process may have done this, or the system for lack of memory";
constexpr unsigned max_seconds_of_end = 10;
std::atomic<std::int64_t> end_of_end{0};  // [s] of the monotonic clock: until then the program ends; 0: it does not

std::int64_t seconds_now() noexcept {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec;
}

/// From now on the program ends within 10 s, even if a call of its end hangs: see on_timer.
void limit_the_end() noexcept {
    end_of_end.store(seconds_now() + max_seconds_of_end);
    alarm(max_seconds_of_end);  // replaces a timer that a plugin may have set
}

/// Returns only once, and only to one thread.
void begin_to_end() noexcept {
    static std::atomic<bool> is_ending{false};
    while (is_ending.exchange(true)) pause();  // another thread ends the program
    limit_the_end();
}

/// Ends the program because of a call, after begin_to_end(). `words` and `values` may be empty; `values` is not
/// recorded.
[[noreturn]] void end_now(const CallInProgress& now, const char* what, const char* words, const char* values) noexcept {
    const ComponentName name = name_of(now.component);
    static FixedText<240> detail;  // into the record: no path
    detail << (name.is_known() ? name.plugin : "a plugin") << ": `" << to_text(now.call) << "` of `" << name.component
           << "` " << what;
    if (*words != '\0') detail << ": " << words;
    const session::SavedRecord saved =
        session::Recorder::save_what_is_open(session::plugin_failed_event, detail.c_str());

    static FixedText<6000> text;
    if (name.is_known())
        text << "kerf: plugin " << name.plugin << " (" << name.path << "): ";
    else
        text << "kerf: a plugin whose tables were overwritten: ";
    text << "`" << to_text(now.call) << "` of `" << (name.is_known() ? name.component : "?") << "` " << what << values;
    if (*words != '\0') text << ": " << words;
    text << ". Mend it, or take it out of its folder.";
    text.end_line();
    if (saved.path != nullptr) {
        text << "      What was recorded " << (saved.is_closed ? "is kept in " : "up to a moment ago is kept in ")
             << saved.path << ". Write `kerf report " << saved.path << "` to read it.";
        text.end_line();
    }
    text.print(own_error_file());
    // Without its stderr, which a plugin has closed, the parent names the plugin.
    if (open_file(own_error_file()) != OpenFile{}) say_last_word(exit_fault);
    leave(exit_fault);
}

[[noreturn]] void end_by(const CallInProgress& now, const char* what, const char* words) noexcept {
    begin_to_end();
    end_now(now, what, words, "");
}

/// Closes the record of a program that crashed in Kerf's own code, which a plugin may have damaged. The parent names
/// it.
void save_after_crash(int signal) noexcept {
    static std::atomic<bool> is_saving{false};
    if (is_saving.exchange(true)) return;  // it has crashed again
    limit_the_end();
    const CallInProgress last = last_call();
    const ComponentName name = name_of(last.component);
    static FixedText<240> detail;
    detail << "It " << name_of_signal(signal) << " outside of its plugins";
    if (last.call != PluginCall::none)
        detail << "; the last call was `" << to_text(last.call) << "` of `" << name.component << "`, plugin "
               << (name.is_known() ? name.plugin : "unknown");
    static_cast<void>(session::Recorder::save_what_is_open(session::crashed_event, detail.c_str()));
}

/// Names a plugin that faults on this thread. Other faults end the program as without a guard, with a record.
void on_signal(int signal, siginfo_t* info, void*) {
    if (is_calling_plugin()) {
        const bool is_of_memory = signal == SIGSEGV || signal == SIGBUS;
        const char* const misuse = is_of_memory ? misuse_of(info->si_addr) : nullptr;
        end_by(call_in_progress(), misuse != nullptr ? misuse : name_of_signal(signal), "");
    }
    save_after_crash(signal);
    std::signal(signal, SIG_DFL);
    raise(signal);  // delivered when this handler returns
}

/// Ends the program because a state of the process was changed. In a call, it was this call; else the last one is
/// named.
void on_change(const StateChange& change) {
    while (end_of_end.load() != 0) pause();  // the timer is Kerf's own: another thread ends the program
    begin_to_end();
    static FixedText<200> what;
    static FixedText<1300> values;
    const bool is_this_call = is_calling_plugin();
    const CallInProgress call = is_this_call ? call_in_progress() : last_call();
    if (call.call == PluginCall::none) {
        values << "kerf: " << change.what.c_str() << " was changed from " << change.before.c_str() << " to "
               << change.after.c_str() << " while plugins were loaded. Take plugins out of their folders one by one.";
        values.end_line();
        values.print(own_error_file());
        say_last_word(exit_fault);
        leave(exit_fault);
    }
    what << (is_this_call ? "changed " : "was the last call before Kerf found a change of ") << change.what.c_str();
    values << " from " << change.before.c_str() << " to " << change.after.c_str() << ", which belongs to Kerf";
    end_now(call, what.c_str(), "", values.c_str());
}

rlim_t processor_limit = RLIM_INFINITY;  // before plugins were loaded

/// Handles the signal of a timer, or of the limit of the processor. Kerf sets a timer only when it ends.
void on_timer(int signal, siginfo_t* info, void*) {
    if (end_of_end.load() != 0 && signal != SIGXCPU) {
        if (seconds_now() >= end_of_end.load()) leave(exit_fault);
        alarm(1);  // a plugin's timer, which may still be set in each of its calls
        return;
    }
    rlimit now{};
    const bool is_limit_of_user =
        signal == SIGXCPU && getrlimit(RLIMIT_CPU, &now) == 0 && now.rlim_cur >= processor_limit;
    if (is_limit_of_user || (info->si_code != SI_KERNEL && info->si_code != SI_TIMER)) {
        std::signal(signal, SIG_DFL);
        raise(signal);  // delivered when this handler returns
        return;
    }
    const itimerval off{};
    if (signal == SIGALRM) setitimer(ITIMER_REAL, &off, nullptr);
    if (signal == SIGVTALRM) setitimer(ITIMER_VIRTUAL, &off, nullptr);
    if (signal == SIGPROF) setitimer(ITIMER_PROF, &off, nullptr);
    note_timer_signal(signal);
}

constexpr std::array timer_signals{SIGALRM, SIGVTALRM, SIGPROF, SIGXCPU};

/// Handles the signals of timers that have their default effect: a profiler may have taken one.
void set_timer_handlers() {
    for (const int signal : timer_signals) {
        struct sigaction action {};
        if (sigaction(signal, nullptr, &action) != 0 || action.sa_handler != SIG_DFL) continue;
        action = {};
        action.sa_sigaction = &on_timer;
        action.sa_flags = SA_ONSTACK | SA_SIGINFO | SA_RESTART;
        sigaction(signal, &action, nullptr);
    }
}

void unset_timer_handler(int signal) {
    struct sigaction action {};
    if (sigaction(signal, nullptr, &action) == 0 && action.sa_sigaction == &on_timer) std::signal(signal, SIG_DFL);
}

/// Ends the program because its parent was killed or stopped.
void on_lost_parent(const char* what) noexcept {
    begin_to_end();
    const CallInProgress last = last_call();
    if (last.call != PluginCall::none) end_now(last, what, "", perhaps_from_outside);
    leave(exit_fault);
}

/// The parent prints what this process cannot, and ends it. A plugin that kills or stops the parent ends the run.
class ParentWatch {
public:
    void check() noexcept {
        const ParentState state = parent_state();
        if (state == ParentState::ended) on_lost_parent("was the last call before Kerf's parent process was killed");
        polls_ = state == ParentState::stopped ? polls_ + 1 : 0;
        if (polls_ < polls_until_abandoned) return;
        continue_parent();
        on_lost_parent("was the last call before Kerf's parent process was stopped");
    }
    /// Waits while the parent is stopped, at the end of the work. Ends the program if it does not continue.
    void check_end() noexcept {
        for (check(); parent_state() == ParentState::stopped; check()) std::this_thread::sleep_for(poll_interval);
    }

private:
    int polls_ = 0;
};

void on_exit() {
    if (is_calling_plugin()) end_by(call_in_progress(), "ended the program (`exit`)", "");
}

/// A copy of the program would write the same record.
void on_fork() {
    if (is_calling_plugin()) end_by(call_in_progress(), "made a copy of the program (`fork`)", "");
}

void on_throw(const char* words) { end_by(call_in_progress(), "threw an exception", words); }

std::terminate_handler previous_terminate = nullptr;

void on_terminate() {
    if (is_calling_plugin()) {
        try {
            if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
        } catch (const std::exception& e) {
            on_throw(e.what());
        } catch (...) {
            on_throw("");
        }
        end_by(call_in_progress(), "called std::terminate", "");
    }
    if (previous_terminate != nullptr) previous_terminate();
    std::abort();
}

}  // namespace

void begin_guarding_state() {
    rlimit limit{};
    if (getrlimit(RLIMIT_CPU, &limit) == 0) processor_limit = limit.rlim_cur;
    begin_watching_state(&on_change);
}

PluginGuard::PluginGuard() : stack_(std::make_unique<std::byte[]>(stack_size)) {
    static const bool is_registered = std::atexit(&on_exit) == 0 && std::at_quick_exit(&on_exit) == 0 &&
                                      pthread_atfork(&on_fork, nullptr, nullptr) == 0;
    static_cast<void>(is_registered);
    stack_t stack{};
    stack.ss_sp = stack_.get();
    stack.ss_size = stack_size;
    sigaltstack(&stack, nullptr);
    struct sigaction action {};
    action.sa_sigaction = &on_signal;
    action.sa_flags = SA_ONSTACK | SA_SIGINFO;
    for (const int signal : signals) sigaddset(&action.sa_mask, signal);
    {
        const HostChangesHandlers changes;
        for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &action, &before_[i]);
        set_timer_handlers();
    }
    set_throw_handler(&on_throw);
    previous_terminate = terminate_before_ = std::set_terminate(&on_terminate);
    if (parent_state() != ParentState::unknown) prctl(PR_SET_PDEATHSIG, 0);  // the watchdog ends it with a name
    watchdog_ = std::thread([this] { watch(); });
}

PluginGuard::~PluginGuard() {
    {
        const std::lock_guard lock(mutex_);
        is_stopping_ = true;
    }
    stop_.notify_all();
    watchdog_.join();
    ParentWatch().check_end();
    if (parent_state() != ParentState::unknown) prctl(PR_SET_PDEATHSIG, SIGKILL);
    end_watching_state();
    std::set_terminate(terminate_before_);
    set_throw_handler(nullptr);
    for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &before_[i], nullptr);
    for (const int signal : timer_signals) unset_timer_handler(signal);
    stack_t none{};
    none.ss_flags = SS_DISABLE;
    sigaltstack(&none, nullptr);
}

namespace {

/// The calls of one thread, in polls.
class CallWatch {
public:
    /// A call that is the same in `polls_until_hung` polls has hung. Only calls into plugins have a number, so loading,
    /// import and Kerf's own work have no time limit. `open` may wait for a person, who can interrupt it.
    void check(const CallInProgress& now) {
        const bool is_law =
            now.call == PluginCall::begin || now.call == PluginCall::resist || now.call == PluginCall::commit;
        const bool is_limited = now.call != PluginCall::none && now.call != PluginCall::open;
        polls_ = is_limited && now.count == count_ ? polls_ + 1 : 0;
        count_ = now.count;
        if (polls_ >= polls_until_hung) end_by(now, "did not come back within 5 s", "");

        if (is_law) last_of_law_ = now;
        window_outside_ += !is_law;
        if (++window_polls_ < polls_of_window) return;
        if (window_outside_ <= max_polls_outside && now.count - window_begin_ < min_calls_of_window)
            end_by(last_of_law_, "took over 10 ms a call for 10 s", "");
        window_polls_ = window_outside_ = 0;
        window_begin_ = now.count;
    }

private:
    std::uint64_t count_ = 0, window_begin_ = 0;
    int polls_ = 0, window_polls_ = 0, window_outside_ = 0;
    CallInProgress last_of_law_;
};

}  // namespace

void PluginGuard::watch() {
    std::array<CallWatch, max_calling_threads> threads{};
    ParentWatch parent;
    std::unique_lock lock(mutex_);
    for (int polls = 1; !stop_.wait_for(lock, poll_interval, [&] { return is_stopping_; }); ++polls) {
        for (std::size_t thread = 0; thread < threads.size(); ++thread)
            threads[thread].check(call_in_progress_of(thread));
        parent.check();
        if (polls % polls_between_states == 0 || has_timer_signal()) check_state();
    }
}

void PluginGuard::check() const { check_state(); }

void end_if_raised_by_plugin(int signal, const siginfo_t& info) noexcept {
    const bool is_own = (info.si_code == SI_USER || info.si_code == SI_TKILL) && info.si_pid == getpid();
    if (!is_own || !is_calling_plugin()) return;
    const char* const what = signal == SIGINT    ? "raised SIGINT, which is the user's"
                             : signal == SIGTERM ? "raised SIGTERM, which is the user's"
                             : signal == SIGHUP  ? "raised SIGHUP, which is the user's"
                                                 : "raised a signal that is the user's";
    end_by(call_in_progress(), what, "");
}

}  // namespace kerf::app

// A plugin that calls one of these reaches Kerf's version; the system's would end a run as if it had passed.
extern "C" void _exit(int status) {
    if (kerf::is_calling_plugin()) kerf::app::end_by(kerf::call_in_progress(), "ended the program (`_exit`)", "");
    kerf::app::leave(status);
}
extern "C" void _Exit(int status) noexcept { _exit(status); }
