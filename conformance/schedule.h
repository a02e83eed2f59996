// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "conformance/result.h"

namespace kerf::conformance {

/// Which tests.
struct Selection {
    int level = 3;     ///< up to this one
    std::string only;  ///< regular expression on a test's id; empty: all
    struct Exclusion {
        std::string pattern, reason;
    };
    std::vector<Exclusion> excluded{};
};

/// Runs the tests of a plugin's file, each in a child process, a few at a time. The results come in the order of the
/// tests. Pre: one thread; the patterns are sound.   [main]
/// @param on_plugin   gets the plugin's id and version, and what its laws leave out, once its tables were read
void run_tests(const std::string& path, const Selection& selection,
               const std::function<void(const std::string& plugin, const std::string& does_not)>& on_plugin,
               const std::function<void(const TestResult&)>& on_result);

}  // namespace kerf::conformance
