// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "run/exact/exact_strategies.h"
#include "run/scene.h"

/// `kerf plan`: the least that each step of a procedure needs.
namespace kerf {

struct PlanOutcome {
    bool is_planned = false;  ///< all steps; not where the planned path or the bone will not do
    bool is_kept = false;     ///< every step keeps the accuracy and the budget
    std::string error;        ///< of a plan: it could not be written
};

/// Plans every step of `scene`; with `folder` not empty, writes plan.txt and plan.csv there as well.   [main]
/// @param host   calls the strategies for exact surfaces
/// @param show        takes the plan, for people, step by step
[[nodiscard]] PlanOutcome plan_procedure(const Scene& scene, const PluginRegistry& plugins, const std::string& folder,
                                         const StrategyHost& host,
                                         const std::function<void(const std::string& text)>& show);

}  // namespace kerf
