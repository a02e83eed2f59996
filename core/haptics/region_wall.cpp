// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/region_wall.h"

#include <algorithm>

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
    const auto& outline = cutting.outline();
    for (const auto& [z, radius] : outline)
        for (const Vec3 in_tool : cutting.around(radius, z)) {
            const Vec3 p = body_from_tool * in_tool;
            const double beyond = region.distance_outside(p);
            if (beyond <= farthest || view.present_distance(p) >= 0.0) continue;
            farthest = beyond;
            at = in_tool;
            outwards = rotate(conjugate(body_from_tool.rotation), normalized(p - region.nearest(p)));
        }
    if (farthest <= 0.0) return false;
    channel = kerf_channel{};
    channel.kind = KERF_CONTACT;
    channel.id = 0xffffffffu;
    const Vec6 d = rate_at(at, outwards);
    std::copy(d.begin(), d.end(), channel.d);
    channel.w = 1e-6;
    channel.k = stiffness;
    channel.delta = farthest;
    return true;
}

}  // namespace kerf
