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
    std::string refusal;    ///< without the plugin's name; empty: it may be loaded here
    std::string plugin_id;  ///< id of its entry; empty if it could not be read
};

/// Messages of a trial to its parent.
class TrialReport {
public:
    explicit TrialReport(int pipe) noexcept : pipe_(pipe) {}
    /// Reports the present activity, such as "while it was loaded", for the case that it never ends.
    void does(const std::string& what) const noexcept { send('d', what); }
    void is_named(const std::string& plugin_id) const noexcept { send('n', plugin_id); }

private:
    friend class TrialChild;
    void send(char what, const std::string& text) const noexcept;
    int pipe_;
};

/// Loads one plugin and unloads it. Returns the reason of its refusal; empty if it is not refused.
using TryOne = std::function<std::string(const std::string& path, const TrialReport& report)>;

/// Returns whether a child can be started: only while this process has one thread. A child of a process with more
/// threads would inherit their locks but not the threads that release them, so it could wait for ever.   [main]
[[nodiscard]] bool can_try() noexcept;

/// Returns one trial for each path, all in one child process if none fails. After a child that ended early or hung,
/// each plugin is tried in a child of its own, so that none is blamed for another.   [main] Pre: can_try().
[[nodiscard]] std::vector<Trial> try_in_child(const std::vector<std::string>& paths, const TryOne& try_one,
                                              std::chrono::milliseconds limit = std::chrono::seconds(5));

}  // namespace kerf
