// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

namespace kerf::bench {

/// Where and how long a program runs.
struct ChildPlan {
    std::string folder;                        ///< its working folder; stdout and stderr go to files there
    std::map<std::string, std::string> added;  ///< variables that are added to its environment
    double limit = 60.0;                       ///< [s] of real time, then it is killed
};

/// How a program ended.
struct ChildEnd {
    int code = 0;  ///< its exit code, or 128 and the number of the signal that killed it
    bool timed_out = false;
    double seconds = 0.0;
    int left = 0;  ///< processes that it left behind; they are killed
    std::string out, err;
};

/// Runs a program in a session of its own, whose leader only waits for it. So a program that stops or kills its parent
/// reaches no process of the caller. Then it kills whatever is left of that session.   [main]
[[nodiscard]] ChildEnd run_child(const std::vector<std::string>& command, const ChildPlan& plan);

/// Returns the bytes of a file, or nothing if it cannot be read.
[[nodiscard]] std::string text_of(const std::string& file);

/// Returns whether `result` exists and is at least as new as each file of `causes`.
[[nodiscard]] bool is_newer(const std::string& result, const std::vector<std::string>& causes);

}  // namespace kerf::bench
