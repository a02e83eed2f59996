// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "core/field/cut/tool_solid.h"
#include "kerf/abi.h"

/// A drill sleeve that guides a turning tool: a smooth bore, fixed in the frame of a body.
namespace kerf {

struct Guide {
    std::size_t body = 0;      ///< index of the body that it moves with
    Vec3 mouth{};              ///< [m] centre of the end next to the bone, body frame
    Vec3 along{};              ///< unit vector along the bore, towards the bone, body frame
    double length = 0.0;       ///< [m] of the bore, from the mouth backwards
    double bore_radius = 0.0;  ///< [m]

    [[nodiscard]] bool operator==(const Guide&) const = default;
};

/// Writes the host's contact channels between a bore and a shaft, at most 2, and returns their number. One is at the
/// rear end of the bore. The other is at the mouth, or at the foremost full width of the tool while that is inside the
/// bore. Each pushes the tool's axis back towards the bore's axis once the play is used up. Writes none for a tool
/// outside the bore, or at more than 60° to it. The bore is smooth: no friction, no axial stop.   [haptic, nonblocking]
/// @param tool_from_body  takes a point from the frame of the sleeve's body to the tool frame
[[nodiscard]] std::size_t guide_wall(const Guide& guide, const ToolSolid& tool, const Pose& tool_from_body,
                                     kerf_channel* channels) noexcept;

}  // namespace kerf
