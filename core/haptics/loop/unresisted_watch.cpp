// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/loop/unresisted_watch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace kerf {

namespace {

// All [assumed].
constexpr std::uint64_t interval = 16;                // ticks between checks
constexpr double min_ring_gap = 1e-3;                 // [m] between the rings of points that are checked
constexpr double max_rings = 16.0;                    // number of rings on the parts that cut nothing
constexpr double channel_reach = 3e-3;                // [m] from a channel's line of action to the tool's surface
constexpr double min_slant = 0.2;                     // [–] cosine between a channel and the direction off the axis
constexpr double min_depth = 1e-3, min_voxels = 2.0;  // [m], [voxels] a point must be deeper than both

/// Returns whether a channel carries force against motion of the point away from the tool's axis. A channel has no
/// position, so its line of action must pass within the point's radius plus `channel_reach` of the point.
bool is_resisted_at(Vec3 point, const Motion& motion, const EvaluatedLaw& law) noexcept {
    const double radius = std::sqrt(point.x * point.x + point.y * point.y);
    const Vec3 outwards = radius > 0.0 ? (1.0 / radius) * Vec3{point.x, point.y, 0.0} : Vec3{};
    for (std::uint32_t c = 0; c < law.count; ++c) {
        const kerf_channel& channel = law.channel[c];
        const Vec3 along{channel.d[0], channel.d[1], channel.d[2]}, moment{channel.d[3], channel.d[4], channel.d[5]};
        const double size = length(along);
        const bool is_two_sided = channel.kind == KERF_FRICTION || channel.kind == KERF_HOLD;
        const double into = dot(along, outwards);
        if (motion.lambda[c] == 0.0 || (is_two_sided ? std::abs(into) : into) < min_slant * size) continue;
        if (length(cross(point, along) - moment) <= (radius + channel_reach) * size) return true;
    }
    return false;
}

bool cuts_at(const ToolSolid& cutting, double z) noexcept {
    return z >= cutting.end_z() && z <= cutting.tip_z() &&
           std::none_of(cutting.gaps().begin(), cutting.gaps().end(),
                        [z](const ToolSolid::Gap& gap) { return z < gap.front && z > gap.back; });
}

/// Returns the length of the parts of the tool that cut nothing [m].
double passive_length(const ToolOutline& outline) noexcept {
    const ToolSolid &whole = outline.whole, &cutting = outline.cutting;
    double passive = (cutting.end_z() - whole.end_z()) + (whole.tip_z() - cutting.tip_z());
    for (const ToolSolid::Gap& gap : cutting.gaps()) passive += gap.front - gap.back;
    return passive;
}

}  // namespace

bool UnresistedWatch::check(const Motion& motion, const EvaluatedLaw& law, const LoopBodies& bodies,
                            const ToolNow& tool, double spacing) noexcept {
    if (tool.tick % interval != 0) return false;
    const double passive = passive_length(tool.outline());
    Unresisted deepest;
    if (passive > 0.0 && bodies.is_in_reach(tool, 0.0))
        tool.outline().whole.for_each_ring(
            std::max(min_ring_gap, passive / max_rings), [&](const std::array<Vec3, 8>& ring) {
                if (cuts_at(tool.outline().cutting, ring[0].z)) return;
                std::array<kerf_surface_point, 8> bone;
                bodies.view().nearest(ring.data(), static_cast<std::uint32_t>(ring.size()), bone.data());
                for (std::size_t n = 0; n < ring.size(); ++n) {
                    const auto body = static_cast<std::size_t>(bone[n].body);
                    if (bone[n].body < 0 || body >= bodies.count() || !bodies[body].is_cuttable) continue;
                    if (-bone[n].distance <= deepest.depth || is_resisted_at(ring[n], motion, law)) continue;
                    deepest = {ring[n], -bone[n].distance};
                }
            });
    if (deepest.depth > 0.0 && !is_reported_) last_ = deepest;

    // Distances beyond the field's clamp are unknown, so the limit is below it.
    const double limit = std::min(std::max(min_depth, min_voxels * spacing), 0.9 * clamp_voxels * spacing);
    const bool is_new = deepest.depth >= limit && !std::exchange(is_reported_, true);
    if (deepest.depth < 0.5 * limit) is_reported_ = false;
    return is_new;
}

}  // namespace kerf
