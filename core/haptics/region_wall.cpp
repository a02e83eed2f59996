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

    // Out of the bone leads the shorter of two ways: back over the region's face, or to the bone's own surface beyond it.
    double deepest = 0.0;
    Vec3 at{}, into{};
    cutting.for_each_ring(2.0 * body.grid().spacing, [&](const std::array<Vec3, 8>& ring) {
        std::array<kerf_surface_point, 8> bone;
        view.nearest(ring.data(), static_cast<std::uint32_t>(ring.size()), bone.data());
        for (std::size_t n = 0; n < ring.size(); ++n) {
            const Vec3 p = body_from_tool * ring[n];
            const double beyond = region.distance_outside(p), below = -bone[n].distance;
            const bool is_to_surface = below < beyond && bone[n].normal != Vec3{};
            const double depth = is_to_surface ? below : beyond;
            if (beyond <= 0.0 || below <= 0.0 || depth <= deepest) continue;
            deepest = depth;
            at = ring[n];
            into = is_to_surface ? -bone[n].normal : rotate(conjugate(body_from_tool.rotation), normalized(p - region.nearest(p)));
        }
    });
    if (deepest <= 0.0) return false;
    channel = contact_channel(OwnContact::region, rate_at(at, into), stiffness, deepest);
    return true;
}

}  // namespace kerf
