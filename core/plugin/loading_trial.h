// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

/// Loads plugins in a child process first: a crash, exit, exception or hang there ends only the child.
namespace kerf {

/// The result of a trial.
struct Trial {
    std::string refusal;    ///< reason, without the plugin's name; empty: this process may load the plugin
    std::string plugin_id;  ///< id of its entry; empty if it could not be read
};

/// Sends messages of a trial, which runs in the child, to the parent process.
class TrialReport {
public:
    explicit TrialReport(int pipe) noexcept : pipe_(pipe) {}
    /// Reports the activity that begins, such as "while it was loaded". If the child ends or hangs, the refusal names
    /// it.
    void does(const std::string& what) const noexcept { send('d', what); }
    void is_named(const std::string& plugin_id) const noexcept { send('n', plugin_id); }

private:
    friend class TrialChild;
    void send(char what, const std::string& text) const noexcept;
    int pipe_;
};

/// A function that loads one plugin and unloads it, in the child. It returns the reason to refuse it, or an empty text.
using TryOne = std::function<std::string(const std::string& path, const TrialReport& report)>;

/// Returns whether a child can be started: only while this process has one thread. A child of a process with more
/// threads would inherit their locks but not the threads that release them, so it could wait for ever.   [main]
[[nodiscard]] bool can_try() noexcept;

/// Returns one trial for each path. First tries all plugins in one child process. If that child ends early or hangs,
/// tries each plugin in a child of its own, so that none is refused for another's fault.   [main] Pre: can_try().
/// @param limit  maximum time between two messages of the child; then it has hung
[[nodiscard]] std::vector<Trial> try_in_child(const std::vector<std::string>& paths, const TryOne& try_one,
                                              std::chrono::milliseconds limit = std::chrono::seconds(5));

}  // namespace kerf
