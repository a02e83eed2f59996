// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/field/cut/bone_view.h"
#include "core/field/cut/tool_solid.h"

namespace kerf {

/// Bone beyond a body's region cannot be cut: it stands like a wall. One contact channel of the host's own, at the
/// point of the cutting outline that lies deepest in it. Returns false, and leaves the channel as it was, where there
/// is none. [haptic, nonblocking]
[[nodiscard]] bool region_wall(const Body& body, const BoneView& view, const ToolSolid& cutting,
                               const Pose& body_from_tool, kerf_channel& channel) noexcept;

}  // namespace kerf
