// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>

/// Work in a child process, which may crash, exit, hang or print.
namespace kerf::conformance {

/// How the work ended.
struct Ended {
    enum class How {
        returned,   ///< `text` is what the work returned
        crashed,    ///< `text` names the signal, the plugin's call and the callers
        left,       ///< it ended its process; `text` says by what
        timed_out,  ///< `text` names the plugin's call that did not return
        unstarted   ///< there is no child; `text` says why
    };
    How how = How::unstarted;
    std::string text;
    std::string output;  ///< the last of what it wrote to stdout and stderr
    double seconds = 0.0;
};

struct Limits {
    int cpu_seconds = 3;              ///< of processor time; then it has hung
    int wall_seconds = 10;            ///< by the clock
    std::size_t memory = 4ull << 30;  ///< [B] of address space
};

/// A child that works, or has ended.
class Sandbox {
public:
    /// Starts `work` in a forked child with a process group of its own, without input, its output kept. Pre: this
    /// process has one thread.   [main]
    Sandbox(const std::function<std::string()>& work, const Limits& limits);
    ~Sandbox();
    Sandbox(const Sandbox&) = delete;
    Sandbox& operator=(const Sandbox&) = delete;

    /// Readable when the child has something to say or has ended.
    [[nodiscard]] int descriptor() const noexcept { return pipe_; }
    /// Seconds until its time is up by the clock.
    [[nodiscard]] double seconds_left() const noexcept;
    /// Reads what is there. Returns whether the child has ended, or its time is up; then `ended` may be called.
    [[nodiscard]] bool poll();
    /// Ends the child and its group, and returns how it ended. Once only.
    [[nodiscard]] Ended ended();

private:
    Limits limits_;
    int child_ = -1, pipe_ = -1, output_ = -1;
    double started_ = 0.0;
    bool is_closed_ = false;
    std::string bytes_;
};

/// `Sandbox`, waited for.   [main]
[[nodiscard]] Ended run_in_child(const std::function<std::string()>& work, const Limits& limits = {});

}  // namespace kerf::conformance
