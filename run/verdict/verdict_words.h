// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "run/verdict/step_monitor.h"

/// Texts for broken limits and missed goals, with their values. Verdict and deductions use the same.
namespace kerf::run {

/// Returns the reason of a broken limit and the worst value: "The drill went too deep. Depth: 39.4 mm."   [any] pure
[[nodiscard]] std::string broken_limit(const LimitState& limit, const std::vector<documents::Measure>& measures);

/// Returns what a goal lacks: "depth 12.5 mm, must be at least 30.0 mm".   [any] pure
[[nodiscard]] std::string missed_goal(const documents::Goal& goal, const StepState& state,
                                      const std::vector<documents::Measure>& measures);

/// Returns why a measure of a step has no value.   [any] pure
[[nodiscard]] std::string why_unmeasured(const std::string& measure, const StepState& state,
                                         const std::vector<documents::Measure>& measures);

/// Returns a sentence for each goal and limit on a measure whose uncertainty reaches beyond a bound. The value alone
/// decides the verdict.   [any] pure
[[nodiscard]] std::vector<std::string> undecided(const StepState& state,
                                                 const std::vector<documents::Measure>& measures);

}  // namespace kerf::run
