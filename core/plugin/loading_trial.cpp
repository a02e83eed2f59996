// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/loading_trial.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <system_error>
#include <utility>

#include "core/plugin/own_streams.h"
#include "core/plugin/plain_text.h"
#include "core/plugin/process_state.h"

namespace kerf {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t max_message = 3000;  // [bytes] of text; with its head, a pipe takes it in one write
constexpr int lost_pipe = 113;             // exit code of a child whose pipe was closed or replaced
constexpr rlim_t max_written = 1u << 20;   // [bytes] maximum size of a file that the child writes, stderr included

#if defined(__SANITIZE_THREAD__)
constexpr int own_threads = 2;  // one of them is the sanitizer's
#else
constexpr int own_threads = 1;
#endif

struct Head {
    /// 'b' a plugin begins, 'd' its activity, 'n' its id, 'r' its refusal, 't' it threw, 'c' it changed the process, so
    /// the child ends, 'e' all plugins are done
    char what = 0;
    std::uint32_t size = 0;
};

/// Owns a file descriptor and closes it.
class Descriptor {
public:
    explicit Descriptor(int fd = -1) noexcept : fd_(fd) {}
    ~Descriptor() {
        if (fd_ >= 0) close(fd_);
    }
    Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(fd_, other.fd_);
        return *this;
    }
    [[nodiscard]] int get() const noexcept { return fd_; }

private:
    int fd_;
};

// ---- in the child --------------------------------------------------------------------------------------------------

int terminate_pipe = -1;  // global, because a terminate handler has no arguments

std::string exception_text() {
    try {
        if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
    } catch (const std::exception& e) {
        return e.what();
    } catch (...) {
        return "an exception that is no std::exception";
    }
    return "";
}

std::string text_of(const StateChange& change) {
    return "changed " + plain(change.text()) +
           " while it was loaded, which belongs to Kerf. Its own code did so in a trial: mend it, or take it out of "
           "its "
           "folder.";
}

/// Confines the child: its own process group, so that its children end with it; no core file; no terminal.
void confine(int stderr_fd) {
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const rlimit no_core{0, 0}, short_files{max_written, max_written};
    setrlimit(RLIMIT_CORE, &no_core);
    setrlimit(RLIMIT_FSIZE, &short_files);
    if (const int nothing = open("/dev/null", O_RDWR); nothing >= 0) {
        dup2(nothing, STDIN_FILENO);
        dup2(nothing, STDOUT_FILENO);
        dup2(stderr_fd >= 0 ? stderr_fd : nothing, STDERR_FILENO);
    }
    unite_streams();
}

}  // namespace

void TrialReport::send(char what, const std::string& text) const noexcept {
    std::array<char, sizeof(Head) + max_message> message{};
    const Head head{what, static_cast<std::uint32_t>(std::min(text.size(), max_message))};
    std::memcpy(message.data(), &head, sizeof head);
    std::memcpy(message.data() + sizeof head, text.data(), head.size);
    while (write(pipe_, message.data(), sizeof head + head.size) < 0 && errno == EINTR) {
    }
}

/// Tries some plugins in a child process; `run` is the parent's part.
class TrialChild {
public:
    TrialChild(const std::vector<std::string>& paths, const TryOne& try_one, std::chrono::milliseconds limit)
        : paths_(paths), try_one_(try_one), limit_(limit) {}

    /// Returns one trial for each path that the child began. If it did not finish all, the last trial ended it.
    [[nodiscard]] std::vector<Trial> run();
    [[nodiscard]] bool has_finished() const noexcept { return has_finished_; }

private:
    struct Ended {
        int status = 0;
        bool has_hung = false;
    };
    [[noreturn]] void work(int pipe, int stderr_fd) const;
    [[nodiscard]] bool take_message(int pipe);
    [[nodiscard]] Ended follow(pid_t child, int pipe);
    [[nodiscard]] std::string ending(const Ended& ended, int stderr_fd) const;

    const std::vector<std::string>& paths_;
    const TryOne& try_one_;
    std::chrono::milliseconds limit_;
    std::vector<Trial> trials_;
    std::string activity_, thrown_;
    bool has_thrown_ = false, has_changed_ = false, has_finished_ = false;
};

void TrialChild::work(int pipe, int stderr_fd) const {
    confine(stderr_fd);
    for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTERM, SIGINT, SIGHUP})
        std::signal(signal, SIG_DFL);
    terminate_pipe = pipe;
    std::set_terminate([] {
        TrialReport(terminate_pipe).send('t', exception_text());
        std::abort();
    });
    const TrialReport report(pipe);
    const OpenFile own_pipe = open_file(pipe);
    for (const std::string& path : paths_) {
        report.send('b', "");
        const SharedState before = shared_state();
        std::string refusal;
        try {
            refusal = try_one_(path, report);
        } catch (...) {
            report.send('t', exception_text());
            _exit(1);
        }
        if (open_file(pipe) != own_pipe) _exit(lost_pipe);
        const StateChange change = change_between(before, shared_state());
        if (change.has_happened() && refusal.empty()) refusal = text_of(change);
        report.send('r', refusal);
        if (!change.has_happened()) continue;
        report.send('c', "");  // the others are tried in a process that it has not changed
        _exit(0);
    }
    report.send('e', "");
    _exit(0);  // the child must not flush or destroy objects of the parent
}

// ---- in the parent -------------------------------------------------------------------------------------------------

bool TrialChild::take_message(int pipe) {
    Head head;
    std::string text(max_message, '\0');
    // Messages are written in one piece, so one read returns a whole head and another its whole text.
    if (read(pipe, &head, sizeof head) != static_cast<ssize_t>(sizeof head) || head.size > max_message) return false;
    if (head.size > 0 && read(pipe, text.data(), head.size) != static_cast<ssize_t>(head.size)) return false;
    text.resize(head.size);
    if (head.what == 'b' && trials_.size() < paths_.size()) {
        trials_.emplace_back();
        activity_.clear();
    }
    if (head.what == 'e') has_finished_ = true;
    if (trials_.empty()) return true;
    if (head.what == 'd') activity_ = text;
    if (head.what == 'n') trials_.back().plugin_id = text;
    if (head.what == 'r') trials_.back().refusal = text;
    if (head.what == 'c') has_changed_ = true;
    if (head.what == 't') {
        has_thrown_ = true;
        thrown_ = text;
    }
    return true;
}

std::string TrialChild::ending(const Ended& ended, int stderr_fd) const {
    const int status = ended.status;
    std::string what;
    if (ended.has_hung)
        what = "did not come back within " + std::to_string(limit_.count() / 1000) + " s";
    else if (WIFEXITED(status) && WEXITSTATUS(status) == lost_pipe)
        what = "closed descriptors that are not its own";
    else if (has_thrown_)
        what = "threw an exception" + (thrown_.empty() ? "" : " (" + quoted_plain(thrown_) + ")");
    else if (WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT)
        what = "aborted";
    else if (WIFSIGNALED(status))
        what = std::string("crashed (") + strsignal(WTERMSIG(status)) + ")";
    else
        what = "ended the program with exit code " + std::to_string(WEXITSTATUS(status));
    what += " " + (activity_.empty() ? "while it was loaded" : activity_) + ".";
    std::array<char, 500> written{};
    if (const ssize_t size = pread(stderr_fd, written.data(), written.size(), 0); size > 0 && !has_thrown_) {
        std::string first(written.data(), static_cast<std::size_t>(size));
        first.resize(std::min(first.find('\n'), first.size()));
        what += " It wrote " + quoted_plain(first) + ".";
    }
    return what + " Its own code did so in a trial: mend it, or take it out of its folder.";
}

std::vector<Trial> TrialChild::run() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) return {};
    const Descriptor out(ends[0]);
    Descriptor in(ends[1]);
    const Descriptor stderr_fd(memfd_create("kerf-trial", MFD_CLOEXEC));
    std::fflush(nullptr);  // else an `exit` in the child would write the buffers a second time
    const pid_t child = fork();
    if (child < 0) return {};
    if (child == 0) work(in.get(), stderr_fd.get());
    in = Descriptor();

    const Ended ended = follow(child, out.get());
    kill(-child, SIGKILL);  // ends the child's own children
    if (!has_finished_ && !has_changed_ && !trials_.empty()) trials_.back().refusal = ending(ended, stderr_fd.get());
    return std::move(trials_);
}

/// Reads messages until the child has ended. The end of the pipe does not show this: children of the child may keep it
/// open, and the child may close it.
TrialChild::Ended TrialChild::follow(pid_t child, int pipe) {
    constexpr int slice = 20;  // [ms] interval between checks whether the child has ended with its pipe open
    Ended ended;
    bool is_open = true, has_ended = false;
    auto deadline = Clock::now() + limit_;
    while (!has_ended) {
        pollfd ready{is_open ? pipe : -1, POLLIN, 0};
        const int count = poll(&ready, 1, has_finished_ ? 1 : slice);
        if (count > 0) {
            is_open = take_message(pipe);
            deadline = Clock::now() + limit_;
            continue;
        }
        if (!ended.has_hung && Clock::now() >= deadline) {
            ended.has_hung = true;
            kill(child, SIGKILL);
        }
        const pid_t waited_pid = waitpid(child, &ended.status, WNOHANG);
        has_ended = waited_pid == child || (waited_pid < 0 && errno != EINTR);
    }
    return ended;
}

bool can_try() noexcept {
    std::error_code error;
    int threads = 0;
    for (std::filesystem::directory_iterator task("/proc/self/task", error), end; !error && task != end;
         task.increment(error))
        ++threads;
    return !error && threads <= own_threads;
}

std::vector<Trial> try_in_child(const std::vector<std::string>& paths, const TryOne& try_one,
                                std::chrono::milliseconds limit) {
    TrialChild all(paths, try_one, limit);
    std::vector<Trial> trials = all.run();
    if (all.has_finished() || trials.empty()) {
        trials.resize(paths.size());  // without a child: no refusals here, and faults appear when the caller loads
        return trials;
    }
    // If the child ended at the first plugin, no other plugin had run before: that trial counts.
    trials.resize(trials.size() == 1 ? 1 : 0);
    while (trials.size() < paths.size()) {
        const std::vector<std::string> alone{paths[trials.size()]};
        const std::vector<Trial> one = TrialChild(alone, try_one, limit).run();
        trials.push_back(one.empty() ? Trial{} : one.front());
    }
    return trials;
}

}  // namespace kerf
