// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/field/cut/tool_solid.h"
#include "core/field/grid/body.h"

namespace kerf {

/// How far the tool must be drawn back along its own axis, at most 0.3 m, until no point of its outline lies in the
/// bone as it was before any cut [m]; 0 where it is free already, nothing where it never is.   [main]
[[nodiscard]] std::optional<double> way_out_of_bone(const Body& body, const ToolSolid& whole,
                                                    const Pose& body_from_tool);

}  // namespace kerf
