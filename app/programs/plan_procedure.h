// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "run/exact/exact_strategies.h"
#include "run/scene.h"

/// `kerf plan`: finds the coarsest settings that each step of a procedure allows.
namespace kerf::app {

struct PlanOutcome {
    bool is_planned = false;  ///< all steps; false if the planned path or the bone does not suit
    bool is_kept = false;     ///< each step keeps the accuracy and the budget
    std::string error;        ///< why there is no plan, or why it could not be written
};

/// Plans every step of `scene`; with `folder` not empty, writes plan.txt and plan.csv there as well.   [main]
/// @param host   calls the strategies for exact surfaces
/// @param show        takes the plan, for people, step by step
[[nodiscard]] PlanOutcome plan_procedure(const run::Scene& scene, const PluginRegistry& plugins,
                                         const std::string& folder, const run::StrategyHost& host,
                                         const std::function<void(const std::string& text)>& show);

}  // namespace kerf::app
