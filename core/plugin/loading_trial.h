// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

/// Plugins are loaded in a child process first: one that crashes, exits, throws or hangs there costs only the child.
namespace kerf {

/// How a trial went.
struct Trial {
    std::string refusal;    ///< without the plugin's name; empty: it may be loaded here
    std::string plugin_id;  ///< as far as its entry could be read
};

/// What a trial passes to its parent while it goes on.
class TrialReport {
public:
    explicit TrialReport(int pipe) noexcept : pipe_(pipe) {}
    /// "while it was loaded": what the code that may not come back is doing.
    void does(const std::string& what) const noexcept { send('d', what); }
    void is_named(const std::string& plugin_id) const noexcept { send('n', plugin_id); }

private:
    friend class TrialChild;
    void send(char what, const std::string& text) const noexcept;
    int pipe_;
};

/// Loads one plugin and unloads it. Returns why it is refused; empty when it is not.
using TryOne = std::function<std::string(const std::string& path, const TrialReport& report)>;

/// Whether a child can be made: only while this is the process's one thread. A child of a process with more would
/// inherit the locks that others held and no thread to release them, so it could wait for ever.   [main]
[[nodiscard]] bool can_try() noexcept;

/// One trial for each path, in one child process while all goes well. After a child that did not come back each is
/// tried in a child of its own, so that none answers for another.   [main] Pre: can_try().
[[nodiscard]] std::vector<Trial> try_in_child(const std::vector<std::string>& paths, const TryOne& try_one,
                                              std::chrono::milliseconds limit = std::chrono::seconds(5));

}  // namespace kerf
