// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/haptics/law/tool.h"
#include "run/view/facets.h"
#include "run/view/viewed_run.h"

/// Shapes of tools, drawn as what they are: drill, burr, screw, saw blade. docs/guide/plugins.md lists the rules.
namespace kerf::run {

/// Returns the shape of a tool in its frame, with at most `max_tool_triangles`. Grooves and gullets lie inside the
/// tool's outline, and a thread inside its crest. So the drawn tool touches no bone that the tool does not reach.
/// [main]
[[nodiscard]] ViewedMesh tool_shape(const Tool& tool);

/// Returns the part of an implant that stays in bone, with its head; empty for other tools.   [main]
[[nodiscard]] ViewedMesh staying_shape(const Tool& tool);

}  // namespace kerf::run
