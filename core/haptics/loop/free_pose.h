// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/field/cut/tool_solid.h"
#include "core/field/grid/body.h"

namespace kerf {

/// Returns the distance by which the tool must retract along its own axis until its outline is outside the uncut bone
/// [m]. Returns 0 if it is outside already, and no value if 0.3 m is not enough.   [main]
[[nodiscard]] std::optional<double> retreat_distance(const Body& body, const ToolSolid& whole,
                                                     const Pose& body_from_tool);

}  // namespace kerf
