// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "core/field/cut/tool_solid.h"
#include "kerf/abi.h"

/// A sleeve that leads a turning tool: a smooth bore that stands still in the frame of a body.
namespace kerf {

struct Guide {
    std::size_t body = 0;      ///< it moves with
    Vec3 mouth{};              ///< [m] the middle of its end next to the bone, body frame
    Vec3 along{};              ///< unit, towards the bone
    double length = 0.0;       ///< [m] from that end backwards
    double bore_radius = 0.0;  ///< [m]
};

/// Contact channels of the host's own at the two places where a bore holds a shaft: its mouth, or as far as the tool
/// has come; and its rear end. Each pushes the tool's axis back towards the bore's once the play is used up. None for a
/// tool that is not in the bore: past its rear end, or beside it. Returns how many were written, 2 at most. The bore is
/// smooth: without friction, and nothing stops the tool along it.   [haptic, nonblocking]
/// @param tool_from_body   where the sleeve is, as the tool sees it
[[nodiscard]] std::size_t guide_wall(const Guide& guide, const ToolSolid& tool, const Pose& tool_from_body,
                                     kerf_channel* channels) noexcept;

}  // namespace kerf
