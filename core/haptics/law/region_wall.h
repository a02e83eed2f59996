// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/field/cut/body_query.h"
#include "core/field/cut/tool_solid.h"

namespace kerf {

/// Sets one contact channel of the host that keeps a tool out of the bone outside the body's region, which cannot be
/// cut. The channel is at the point of the cutting outline that is deepest in that bone. Returns false and leaves
/// `channel` unchanged if the outline does not enter that bone.   [haptic, nonblocking]
[[nodiscard]] bool region_wall(const Body& body, const BodyQuery& view, const ToolSolid& cutting,
                               const Pose& body_from_tool, kerf_channel& channel) noexcept;

}  // namespace kerf
