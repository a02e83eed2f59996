// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "conformance/result.h"

/// `kerf check`: the side that never loads a plugin.
namespace kerf::conformance {

struct CheckRequest {
    std::string child;                                            ///< the program kerf-check-child
    int level = 3;                                                ///< 1 … 5
    std::string only{};                                           ///< regular expression on a test's id; empty: all
    std::vector<std::pair<std::string, std::string>> excluded{};  ///< pattern and reason
    std::function<bool()> is_interrupted{};                       ///< may be empty

    // Of level 5:
    std::string program{};                  ///< `kerf`
    std::vector<std::string> procedures{};  ///< files; empty: those below `shipped` that use the plugin
    std::string shipped{};                  ///< folder
    std::string twin{};                     ///< file of the same plugin, built otherwise; empty: none
};

/// Why a pattern is no regular expression, with the pattern; empty if it is one.   [any]
[[nodiscard]] std::string refusal_of_pattern(const std::string& pattern);

/// Runs the tests of a plugin's file in child processes. `on_result` gets each as it comes; it may be empty.   [main]
[[nodiscard]] PluginReport check_plugin(const std::string& path, const CheckRequest& request,
                                        const std::function<void(const TestResult&)>& on_result);

}  // namespace kerf::conformance
