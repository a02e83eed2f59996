// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "run/exact/exact_strategies.h"
#include "run/scene.h"

/// `kerf plan`: the least that each step of a procedure needs.
namespace kerf {

struct PlanOutcome {
    std::string text;      ///< for people; empty where the planned path or the bone will not do
    bool is_kept = false;  ///< every step keeps the accuracy and the budget
    std::string error;     ///< with text: it could not be written
};

/// Plans every step of `scene`; with `folder` not empty, writes plan.txt and plan.csv there as well.   [main]
/// @param remeshing   where strategies for exact surfaces are
[[nodiscard]] PlanOutcome plan_procedure(const Scene& scene, const PluginRegistry& plugins, const std::string& folder,
                                         const RemeshFolders& remeshing);

}  // namespace kerf
