// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/haptics/law/live_body.h"
#include "core/haptics/law/tool.h"

namespace kerf {

/// Sets one contact channel of the host that keeps a tool out of a body that cannot be cut. The channel is at the
/// deepest point of the cutting outline, or of an implant's part that stays in bone. Returns false and leaves `channel`
/// unchanged if that point is 0.3 mm or more away from the body. Pre: the body's view is placed at the tool.
/// [haptic, nonblocking]
[[nodiscard]] bool metal_wall(const LiveBody& body, const ToolOutline& tool, kerf_channel& channel) noexcept;

}  // namespace kerf
