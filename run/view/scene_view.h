// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "run/scene.h"
#include "run/view/viewed_run.h"

namespace kerf::run {

/// Returns what viewers draw of a scene and does not change: names, colours, shapes, steps in words. Of an examination
/// it has no zone, no limit and no plan.   [main]
/// @param mode  "practice"
/// @param hand  who leads the tool, for people
[[nodiscard]] ViewedScene viewed_scene(const Scene& scene, std::string mode, std::string hand);

/// Returns an id for people: "spinal_canal" as "spinal canal".   [any] pure
[[nodiscard]] std::string spaced(std::string id);

/// Returns a goal as a viewer shows it: "depth at least 35 mm".   [any] pure
[[nodiscard]] ViewedLimit viewed_goal(const documents::Goal& goal, const documents::Procedure& procedure);

/// Returns a limit as a viewer shows it: "thrust at most 60 N".   [any] pure
[[nodiscard]] ViewedLimit viewed_limit(const documents::Limit& limit, const documents::Procedure& procedure);

}  // namespace kerf::run
