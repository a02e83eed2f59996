// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/field/cut/bone_view.h"
#include "core/field/cut/tool_solid.h"
#include "core/haptics/law/channel.h"
#include "kerf/force.hpp"

/// What stands in the way of a cutting outline as a wall of the host's own, whatever law the tool has.
namespace kerf {

/// What an outline may not enter: at a point of it.
struct Entered {
    double depth = 0.0;  ///< [m]
    Vec3 into{};         ///< unit; zero: nothing is there
};

/// One channel at the point of a cutting outline that is deepest in what it may not enter. Returns false, and leaves
/// the channel as it was, where none is deeper than `least`.
/// @param view     placed at the tool
/// @param apart    [m] from ring to ring of the outline
/// @param least    [m] negative: also what is so near
/// @param concerns (ring) -> bool, whether any of it may be deeper: else the bone is not asked
/// @param entered  (point, kerf_surface_point) -> Entered, tool frame
/// @param is_seat  a face across the axis carries all around: the channel is on the axis then
/// [haptic, nonblocking]
template <typename Concerns, typename Enters>
[[nodiscard]] bool outline_wall(OwnContact id, const ToolSolid& cutting, const BoneView& view, double apart,
                                double least, const Concerns& concerns, const Enters& entered, kerf_channel& channel,
                                bool is_seat = false) noexcept {
    constexpr double stiffness = 1e6;  // [N/m] of what is not to be entered, bone or metal [assumed]
    Entered deepest{least, {}};
    Vec3 at{};
    cutting.for_each_ring(apart, [&](const std::array<Vec3, 8>& ring) {
        if (!concerns(ring)) return;
        std::array<kerf_surface_point, 8> nearest;
        view.nearest(ring.data(), static_cast<std::uint32_t>(ring.size()), nearest.data());
        for (std::size_t n = 0; n < ring.size(); ++n) {
            const Entered here = entered(ring[n], nearest[n]);
            if (here.into == Vec3{} || here.depth <= deepest.depth) continue;
            deepest = here;
            at = ring[n];
        }
    });
    if (deepest.into == Vec3{}) return false;
    constexpr double across = 0.95;  // [–] of a normal along the axis
    if (is_seat && std::abs(deepest.into.z) > across) at.x = at.y = 0.0;
    channel = contact_channel(id, rate_at(at, deepest.into), stiffness, deepest.depth);
    return true;
}

}  // namespace kerf
