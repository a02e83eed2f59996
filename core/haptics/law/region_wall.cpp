// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/law/region_wall.h"

#include <algorithm>
#include <array>

#include "core/haptics/law/outline_wall.h"

namespace kerf {

bool region_wall(const Body& body, const BodyQuery& view, const ToolSolid& cutting, const Pose& body_from_tool,
                 kerf_channel& channel) noexcept {
    const Region& region = body.region;
    if (!region.is_bounded()) return false;
    const double size = cutting.tip_z() - cutting.end_z() + cutting.largest_radius();
    const Vec3 tip = body_from_tool * Vec3{0, 0, cutting.tip_z()}, around{size, size, size};
    if (region.contains(tip - around) && region.contains(tip + around)) return false;

    const auto beyond = [&](Vec3 point) { return region.distance_outside(body_from_tool * point); };
    const auto leaves = [&](const std::array<Vec3, 8>& ring) {
        return std::any_of(ring.begin(), ring.end(), [&](Vec3 p) { return beyond(p) > 0.0; });
    };
    // The wall pushes along the shorter of two paths out of that bone: back into the region, or to the bone's own
    // surface outside the region.
    const auto entered = [&](Vec3 point, const kerf_surface_point& bone) -> Penetration {
        const double over = beyond(point), below = -bone.distance;
        if (over <= 0.0 || below <= 0.0) return {};
        if (below < over && bone.normal != Vec3{}) return {below, -bone.normal};
        const Vec3 p = body_from_tool * point;
        return {over, rotate(conjugate(body_from_tool.rotation), normalized(p - region.nearest(p)))};
    };
    return outline_wall(OwnContact::region, cutting, view, 2.0 * body.grid().spacing, 0.0, leaves, entered, channel);
}

}  // namespace kerf
