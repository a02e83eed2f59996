// SPDX-License-Identifier: Apache-2.0
#include "app/plugin_guard.h"

#include <pthread.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "core/plugin/guarded_memory.h"
#include "core/plugin/plugin_call.h"
#include "session/recorder.h"

namespace kerf::app {

namespace {

// These functions may run in a signal handler, on a thread whose plugin has just overwritten any memory. They therefore
// take no lock, no memory and no stdio. They do not write the record: SQLite is not safe in a handler. The recorder's
// own thread writes it; the handler sets a flag and waits for that thread, at most 2 s, because a broken heap may stop
// it too. Rows that were committed before are safe in any case.

constexpr int exit_fault = 3;
constexpr auto poll_interval = std::chrono::milliseconds(100);
constexpr int polls_until_hung = 50;  // 5 s, counted in polls: a program that was stopped and continued has not hung
// A law has a fraction of a millisecond. One that takes over 10 ms a call for 10 s makes a run without an end.
constexpr int polls_of_window = 100, min_calls_of_window = 1000, max_polls_outside = 5;
constexpr std::size_t stack_size = 256 << 10;

[[noreturn]] void leave(int status) noexcept {
    for (;;) syscall(SYS_exit_group, status);
}

/// Text in a fixed buffer; characters that do not fit are left out.
template <std::size_t size>
class FixedText {
public:
    FixedText& operator<<(const char* more) noexcept {
        while (*more != '\0' && count_ + 1 < size) {
            const auto c = static_cast<unsigned char>(*more++);
            text_[count_++] = c < 0x20 || c == 0x7f ? ' ' : static_cast<char>(c);
        }
        text_[count_] = '\0';
        return *this;
    }
    void end_line() noexcept {
        if (count_ + 1 < size) text_[count_++] = '\n';
        text_[count_] = '\0';
    }
    [[nodiscard]] const char* c_str() const noexcept { return text_; }
    void print() const noexcept {
        for (std::size_t at = 0; at < count_;) {
            const ssize_t written = write(STDERR_FILENO, text_ + at, count_ - at);
            if (written <= 0) return;
            at += static_cast<std::size_t>(written);
        }
    }

private:
    char text_[size]{};
    std::size_t count_ = 0;
};

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

/// Ends the program because of a call. `words` may be empty.
[[noreturn]] void end_by(const CallInProgress& now, const char* what, const char* words) noexcept {
    static std::atomic<bool> is_ending{false};
    while (is_ending.exchange(true)) pause();  // another thread ends the program
    alarm(10);                                 // the program ends even if a call below hangs

    const ComponentName name = name_of(now.component);
    static FixedText<240> detail;  // into the record: no path
    detail << (name.is_known() ? name.plugin : "a plugin") << ": `" << to_text(now.call) << "` of `" << name.component
           << "` " << what;
    if (*words != '\0') detail << ": " << words;
    const session::SavedRecord saved =
        session::Recorder::save_what_is_open(session::plugin_failed_event, detail.c_str());

    static FixedText<6000> text;
    text << "kerf: plugin " << name.plugin << " (" << (name.is_known() ? name.path : "of unknown path") << "): `"
         << to_text(now.call) << "` of `" << name.component << "` " << what;
    if (*words != '\0') text << ": " << words;
    text << ". Mend it, or take it out of its folder.";
    text.end_line();
    if (saved.path != nullptr) {
        text << "      What was recorded " << (saved.is_closed ? "is kept in " : "up to a moment ago is kept in ")
             << saved.path << ". Write `kerf report " << saved.path << "` to read it.";
        text.end_line();
    }
    text.print();
    say_last_word(exit_fault);
    leave(exit_fault);
}

/// Closes the record of a program that crashed in Kerf's own code, which a plugin may have damaged. The parent names
/// it.
void save_after_crash(int signal) noexcept {
    static std::atomic<bool> is_saving{false};
    if (is_saving.exchange(true)) return;  // it has crashed again
    alarm(10);
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
    for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &action, &before_[i]);
    set_throw_handler(&on_throw);
    previous_terminate = terminate_before_ = std::set_terminate(&on_terminate);
    watchdog_ = std::thread([this] { watch(); });
}

PluginGuard::~PluginGuard() {
    {
        const std::lock_guard lock(mutex_);
        is_stopping_ = true;
    }
    stop_.notify_all();
    watchdog_.join();
    std::set_terminate(terminate_before_);
    set_throw_handler(nullptr);
    for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &before_[i], nullptr);
    stack_t none{};
    none.ss_flags = SS_DISABLE;
    sigaltstack(&none, nullptr);
}

namespace {

/// The calls of one thread, in polls.
class CallWatch {
public:
    /// A call that is the same in `polls_until_hung` polls has hung. Only calls into plugins have a number, so loading,
    /// import and Kerf's own work have no time limit.
    void check(const CallInProgress& now) {
        const bool is_law =
            now.call == PluginCall::begin || now.call == PluginCall::resist || now.call == PluginCall::commit;
        polls_ = now.call != PluginCall::none && now.count == count_ ? polls_ + 1 : 0;
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
    std::unique_lock lock(mutex_);
    while (!stop_.wait_for(lock, poll_interval, [&] { return is_stopping_; }))
        for (std::size_t thread = 0; thread < threads.size(); ++thread)
            threads[thread].check(call_in_progress_of(thread));
}

}  // namespace kerf::app

// A plugin that calls one of these reaches Kerf's version; the system's would end a run as if it had passed.
extern "C" void _exit(int status) {
    if (kerf::is_calling_plugin()) kerf::app::end_by(kerf::call_in_progress(), "ended the program (`_exit`)", "");
    kerf::app::leave(status);
}
extern "C" void _Exit(int status) noexcept { _exit(status); }
