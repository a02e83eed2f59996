// SPDX-License-Identifier: Apache-2.0
#include "conformance/sandbox.h"

#include <execinfo.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <iterator>
#include <memory>

#include "core/plugin/guarded_memory.h"
#include "core/plugin/plain_text.h"
#include "core/plugin/plugin_call.h"

namespace kerf::conformance {

namespace {

double now() noexcept {
    timespec t{};
    clock_gettime(CLOCK_MONOTONIC, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// ---- the child's last words: a letter, the length, the text, and a checksum of the text ---------------------------

constexpr std::size_t head_size = 1 + sizeof(std::uint32_t) + sizeof(std::uint64_t);
int report_pipe = -1;  // of the child

std::uint64_t checksum(const char* text, std::size_t size) noexcept {
    std::uint64_t hash = 14695981039346656037ull;
    for (std::size_t i = 0; i < size; ++i) hash = (hash ^ static_cast<unsigned char>(text[i])) * 1099511628211ull;
    return hash;
}

/// Async-signal-safe.
void write_all(const void* bytes, std::size_t size) noexcept {
    const auto* at = static_cast<const char*>(bytes);
    while (size > 0) {
        const auto written = ::write(report_pipe, at, size);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return;
        at += written;
        size -= static_cast<std::size_t>(written);
    }
}
void say(char kind, const char* text, std::size_t size) noexcept {
    char head[head_size];
    const auto length = static_cast<std::uint32_t>(size);
    const std::uint64_t sum = checksum(text, size);
    head[0] = kind;
    std::memcpy(head + 1, &length, sizeof length);
    std::memcpy(head + 1 + sizeof length, &sum, sizeof sum);
    write_all(head, sizeof head);
    write_all(text, size);
}

[[noreturn]] void leave(int status) noexcept {
    for (;;) syscall(SYS_exit_group, status);
}

// ---- what a signal handler can say --------------------------------------------------------------------------------

/// A text in a fixed place; what does not fit is left out.   async-signal-safe
class FixedText {
public:
    FixedText& operator<<(const char* more) noexcept {
        while (*more != '\0' && count_ < sizeof text_) text_[count_++] = *more++;
        return *this;
    }
    FixedText& operator<<(std::uint64_t number) noexcept {
        char digits[24];
        char* at = std::end(digits);
        *--at = '\0';
        do *--at = static_cast<char>('0' + number % 10);
        while ((number /= 10) > 0);
        return *this << at;
    }
    void send(char kind) const noexcept { say(kind, text_, count_); }

private:
    char text_[2000]{};
    std::size_t count_ = 0;
};

/// "in `resist` of `burring`", or where else.
FixedText& add_call(FixedText& text) noexcept {
    const CallInProgress call = call_in_progress();
    if (call.call == PluginCall::none) return text << "outside its functions";
    return text << "in `" << to_text(call.call) << "` of `"
                << (call.component != nullptr ? name_of(call.component).component : "") << "`";
}

/// Into the captured output: the names need memory, and the heap may be broken.
void print_callers() noexcept {
    void* frames[24];
    const int count = backtrace(frames, static_cast<int>(std::size(frames)));
    backtrace_symbols_fd(frames, count, STDERR_FILENO);
}

const char* name_of_signal(int signal) noexcept {
    switch (signal) {
        case SIGABRT:
            return "aborted (SIGABRT)";
        case SIGSEGV:
            return "crashed (SIGSEGV)";
        case SIGBUS:
            return "crashed (SIGBUS)";
        case SIGFPE:
            return "crashed (SIGFPE)";
        case SIGILL:
            return "crashed (SIGILL)";
        default:
            return "was ended by a signal";
    }
}

void on_crash(int signal, siginfo_t* info, void*) {
    FixedText text;
    text << "It " << name_of_signal(signal) << " ";
    add_call(text);
    if (signal == SIGSEGV || signal == SIGBUS) {
        const auto* at = static_cast<const char*>(info->si_addr);
        if (const char* misuse = misuse_of(at); misuse != nullptr)
            text << ": " << misuse;
        else if (reinterpret_cast<std::uintptr_t>(at) < 65536)
            text << ": it used a null pointer";
    }
    text << ".";
    print_callers();
    text.send('C');
    leave(1);
}

void on_cpu_limit(int, siginfo_t*, void*) {
    FixedText text;
    text << "It did not return from its work ";
    add_call(text) << ".";
    text.send('T');
    leave(1);
}

void on_throw(const char* words) {
    FixedText text;
    text << "It threw an exception ";
    add_call(text);
    if (*words != '\0') text << ": " << words;
    text << ". No exception may leave a plugin.";
    text.send('C');
    leave(1);
}

void on_exit() {
    FixedText text;
    text << "It ended the process (`exit`) ";
    add_call(text) << ".";
    text.send('L');
    leave(1);
}

void set_handlers(const Limits& limits) {
    static std::array<char, 128 << 10> stack;  // a plugin may have used up its own
    stack_t alternative{};
    alternative.ss_sp = stack.data();
    alternative.ss_size = stack.size();
    sigaltstack(&alternative, nullptr);
    void* frames[1];
    backtrace(frames, 1);  // it loads its library now, not in a handler
    struct sigaction action {};
    action.sa_flags = SA_SIGINFO | SA_ONSTACK;
    action.sa_sigaction = &on_crash;
    for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL}) sigaction(signal, &action, nullptr);
    action.sa_sigaction = &on_cpu_limit;
    sigaction(SIGXCPU, &action, nullptr);
    set_throw_handler(&on_throw);
    std::atexit(&on_exit);
    std::at_quick_exit(&on_exit);

    const auto limit = [](auto what, rlim_t most) {
        const rlimit value{most, most};
        setrlimit(what, &value);
    };
    limit(RLIMIT_CORE, 0);
    const rlimit written{64u << 20, 1u << 30};  // memory shared with a process counts as a file: its test raises it
    setrlimit(RLIMIT_FSIZE, &written);
    const auto cpu = static_cast<rlim_t>(limits.cpu_seconds);
    const rlimit processor{cpu, cpu + 2};
    setrlimit(RLIMIT_CPU, &processor);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // their shadow is larger than any limit
    limit(RLIMIT_AS, limits.memory);
#endif
}

[[noreturn]] void be_child(const std::function<std::string()>& work, const Limits& limits, int pipe, int output) {
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    report_pipe = pipe;
    const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
    dup2(nothing, STDIN_FILENO);
    dup2(output, STDOUT_FILENO);
    dup2(output, STDERR_FILENO);
    close(nothing);
    close(output);
    set_handlers(limits);
    const std::string text = work();
    say('R', text.data(), text.size());
    leave(0);
}

std::string tail_of(int file) {
    constexpr off_t most = 2000;
    const off_t size = lseek(file, 0, SEEK_END);
    if (size <= 0) return {};
    const off_t from = size > most ? size - most : 0;
    std::string text(static_cast<std::size_t>(size - from), '\0');
    const auto got = pread(file, text.data(), text.size(), from);
    text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    std::string lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string line = plain(text.substr(at, end - at));
        if (line.find("kerf-check-child(") == std::string::npos) lines += line + "\n";  // the plugin's callers are ours
        at = end + 1;
    }
    return (from > 0 ? "…" : "") + lines;
}

}  // namespace

Sandbox::Sandbox(const std::function<std::string()>& work, const Limits& limits) : limits_(limits), started_(now()) {
    int pipe[2];
    if (pipe2(pipe, O_CLOEXEC | O_NONBLOCK) != 0) return;
    output_ = memfd_create("output", MFD_CLOEXEC);
    std::fflush(nullptr);  // or the child prints it again
    child_ = output_ < 0 ? -1 : fork();
    if (child_ == 0) {
        close(pipe[0]);
        fcntl(pipe[1], F_SETFL, 0);  // the writer may wait
        be_child(work, limits, pipe[1], output_);
    }
    close(pipe[1]);
    if (child_ < 0) {
        close(pipe[0]);
        return;
    }
    setpgid(child_, child_);  // whoever of the two comes first
    pipe_ = pipe[0];
}

Sandbox::~Sandbox() {
    if (child_ > 0) static_cast<void>(ended());
    if (pipe_ >= 0) close(pipe_);
    if (output_ >= 0) close(output_);
}

double Sandbox::seconds_left() const noexcept { return started_ + limits_.wall_seconds - now(); }

bool Sandbox::poll() {
    if (pipe_ < 0) return true;
    char buffer[4096];
    for (;;) {
        const auto got = read(pipe_, buffer, sizeof buffer);
        if (got > 0) {
            bytes_.append(buffer, static_cast<std::size_t>(got));
            continue;
        }
        if (got < 0 && errno == EINTR) continue;
        is_closed_ = is_closed_ || got == 0;
        break;
    }
    // A child that a plugin forked would keep the pipe open: what was said to its end is enough.
    if (bytes_.size() >= head_size) {
        std::uint32_t length = 0;
        std::memcpy(&length, bytes_.data() + 1, sizeof length);
        if (bytes_.size() >= head_size + length) return true;
    }
    return is_closed_ || seconds_left() <= 0.0;
}

Ended Sandbox::ended() {
    Ended result;
    result.seconds = now() - started_;
    if (child_ <= 0) {
        result.text = std::string("no child process could be made: ") + std::strerror(errno) + ".";
        return result;
    }
    const bool is_late = !is_closed_ && bytes_.empty();
    kill(-child_, SIGKILL);
    int status = 0;
    while (waitpid(child_, &status, 0) < 0 && errno == EINTR) {
    }
    child_ = -1;
    result.output = tail_of(output_);
    std::uint32_t length = 0;
    std::uint64_t sum = 0;
    if (bytes_.size() >= head_size) {
        std::memcpy(&length, bytes_.data() + 1, sizeof length);
        std::memcpy(&sum, bytes_.data() + 1 + sizeof length, sizeof sum);
    }
    const bool is_whole =
        bytes_.size() >= head_size + length && length + sum > 0 && checksum(bytes_.data() + head_size, length) == sum;
    if (is_whole) {
        result.text = bytes_.substr(head_size, length);
        const char kind = bytes_.front();
        result.how = kind == 'R'   ? Ended::How::returned
                     : kind == 'T' ? Ended::How::timed_out
                     : kind == 'L' ? Ended::How::left
                                   : Ended::How::crashed;
        if (kind == 'T') result.text += " It used " + std::to_string(limits_.cpu_seconds) + " s of processor time.";
        return result;
    }
    if (is_late) {
        result.how = Ended::How::timed_out;
        result.text = "It did not return within " + std::to_string(limits_.wall_seconds) + " s.";
    } else if (WIFEXITED(status)) {
        result.how = Ended::How::left;
        result.text =
            "It ended the process (`_exit`, or a system call) with status " + std::to_string(WEXITSTATUS(status)) + ".";
    } else {
        result.how = Ended::How::crashed;
        result.text = std::string("It ended with the signal ") + strsignal(WTERMSIG(status)) + ".";
    }
    return result;
}

Ended run_in_child(const std::function<std::string()>& work, const Limits& limits) {
    Sandbox child(work, limits);
    while (!child.poll()) {
        pollfd waits{child.descriptor(), POLLIN, 0};
        ::poll(&waits, 1, std::max(1, static_cast<int>(1e3 * child.seconds_left())));
    }
    return child.ended();
}

}  // namespace kerf::conformance
