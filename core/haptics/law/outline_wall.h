// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/field/cut/body_query.h"
#include "core/field/cut/tool_solid.h"
#include "core/haptics/law/channel.h"
#include "kerf/force.hpp"

/// A wall of the host that keeps a cutting outline out of an obstacle, whatever law the tool has.
namespace kerf {

/// Penetration of an outline point into an obstacle.
struct Penetration {
    double depth = 0.0;  ///< [m]
    Vec3 into{};         ///< unit, into the obstacle; zero: no obstacle there
};

/// Sets one contact channel at the point of a cutting outline that is deepest in an obstacle. Returns false and leaves
/// `channel` unchanged if no point is deeper than `minimum`.   [haptic, nonblocking]
/// @param view        view of the body, placed at the tool
/// @param apart       [m] maximum distance between two rings of points on the outline
/// @param minimum     [m] a negative value includes points at that distance outside the obstacle
/// @param concerns    (ring) -> bool, false if no point of the ring can be in the obstacle: then it is not sampled
/// @param entered     (point, kerf_surface_point) -> Penetration of the point, tool frame
/// @param is_seating  true: contact with a face across the axis puts the channel on the axis
template <typename Concerns, typename Enters>
[[nodiscard]] bool outline_wall(OwnContact id, const ToolSolid& cutting, const BodyQuery& view, double apart,
                                double minimum, const Concerns& concerns, const Enters& entered, kerf_channel& channel,
                                bool is_seating = false) noexcept {
    constexpr double stiffness = 1e6;  // [N/m] of the obstacle, bone or metal [assumed]
    Penetration deepest{minimum, {}};
    Vec3 at{};
    cutting.for_each_ring(apart, [&](const std::array<Vec3, 8>& ring) {
        if (!concerns(ring)) return;
        std::array<kerf_surface_point, 8> nearest;
        view.nearest(ring.data(), static_cast<std::uint32_t>(ring.size()), nearest.data());
        for (std::size_t n = 0; n < ring.size(); ++n) {
            const Penetration here = entered(ring[n], nearest[n]);
            if (here.into == Vec3{} || here.depth <= deepest.depth) continue;
            deepest = here;
            at = ring[n];
        }
    });
    if (deepest.into == Vec3{}) return false;
    constexpr double across = 0.95;  // [–] cosine between normal and axis
    if (is_seating && std::abs(deepest.into.z) > across) at.x = at.y = 0.0;
    channel = contact_channel(id, rate_at(at, deepest.into), stiffness, deepest.depth);
    return true;
}

}  // namespace kerf
