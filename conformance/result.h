// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

/// What the conformance kit found out about a plugin.
namespace kerf::conformance {

enum class Status { passed, warned, failed, skipped };
[[nodiscard]] constexpr const char* to_text(Status status) noexcept {
    switch (status) {
        case Status::passed:
            return "passed";
        case Status::warned:
            return "warned";
        case Status::failed:
            return "failed";
        default:
            return "skipped";
    }
}

/// One test of one subject.
struct TestResult {
    std::string id;        ///< "law.finite"
    int level = 0;         ///< 1 … 5
    std::string subject;   ///< "burr", "burr with burring"; empty: the plugin as a whole
    std::string sentence;  ///< what is true of a plugin that passes
    Status status = Status::passed;
    std::string text;                    ///< the cause, or a measured figure; may be empty
    std::string output;                  ///< what the plugin printed meanwhile, fit for a terminal; may be empty
    double seconds = 0.0;                ///< differs from run to run
    std::vector<std::string> options{};  ///< of `kerf check`, that the test needs besides its level
};

/// All tests of one plugin.
struct PluginReport {
    std::string path;
    std::string plugin;  ///< "kerf.drilling 0.1.0"; empty: its tables could not be read
    std::vector<TestResult> results;
    std::vector<std::string> notes;  ///< measured figures that no test judges
    std::string error;               ///< the kit itself failed, so the plugin is not checked; empty if it did not
    std::string does_not{};          ///< what its laws leave out: "resist sideways (burring)"; empty: nothing
};

}  // namespace kerf::conformance
