// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/region_wall.h"

#include <array>

#include "core/haptics/channel.h"
#include "kerf/force.hpp"

namespace kerf {

namespace {
constexpr double stiffness = 1e6;  // [N/m], of bone that is not to be entered [assumed]
}  // namespace

bool region_wall(const Body& body, const BoneView& view, const ToolSolid& cutting, const Pose& body_from_tool,
                 kerf_channel& channel) noexcept {
    const Region& region = body.region;
    if (!region.is_bounded()) return false;
    const double size = cutting.tip_z() - cutting.end_z() + cutting.largest_radius();
    const Vec3 tip = body_from_tool * Vec3{0, 0, cutting.tip_z()}, around{size, size, size};
    if (region.contains(tip - around) && region.contains(tip + around)) return false;

    double farthest = 0.0;
    Vec3 at{}, outwards{};
    cutting.for_each_ring(2.0 * body.grid().spacing, [&](const std::array<Vec3, 8>& ring) {
        for (const Vec3 in_tool : ring) {
            const Vec3 p = body_from_tool * in_tool;
            const double beyond = region.distance_outside(p);
            if (beyond <= farthest || view.present_distance(p) >= 0.0) continue;
            farthest = beyond;
            at = in_tool;
            outwards = rotate(conjugate(body_from_tool.rotation), normalized(p - region.nearest(p)));
        }
    });
    if (farthest <= 0.0) return false;
    channel = contact_channel(OwnContact::region, rate_at(at, outwards), stiffness, farthest);
    return true;
}

}  // namespace kerf
