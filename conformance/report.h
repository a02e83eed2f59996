// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "conformance/result.h"

/// What was found, for people, programs and CI.
namespace kerf::conformance {

struct Tally {
    std::size_t passed = 0, warned = 0, failed = 0, skipped = 0;
    [[nodiscard]] std::size_t run() const noexcept { return passed + warned + failed; }
    [[nodiscard]] std::size_t all() const noexcept { return run() + skipped; }
};
[[nodiscard]] Tally tally(const PluginReport& report) noexcept;  // [any]

/// Whether some test ran, none failed and the kit did its work.   [any]
[[nodiscard]] bool is_conforming(const PluginReport& report) noexcept;

/// One failure, warning or skipped test as it is shown at once; empty for a test that passed.   [any]
[[nodiscard]] std::string text_of(const TestResult& result, const std::string& path);

/// Coverage and verdict: "58 of 63 run, 5 skipped: …".   [any]
[[nodiscard]] std::string summary_of(const PluginReport& report);

/// All results, with every test that ran.   [any]
[[nodiscard]] std::string json_text(const std::vector<PluginReport>& reports);
[[nodiscard]] std::string junit_text(const std::vector<PluginReport>& reports);

}  // namespace kerf::conformance
