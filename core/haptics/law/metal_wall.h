// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/haptics/law/live_body.h"
#include "core/haptics/law/tool.h"

namespace kerf {

/// A body that cannot be cut stops what would cut it, and the head of an implant. One contact channel of the host's
/// own, at the point of the cutting outline, or of what stays, that is deepest in it. Returns false, and leaves the
/// channel as it was, where there is none. Pre: its view is placed at the tool. [haptic, nonblocking]
[[nodiscard]] bool metal_wall(const LiveBody& body, const ToolOutline& tool, kerf_channel& channel) noexcept;

}  // namespace kerf
