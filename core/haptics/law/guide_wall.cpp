// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/law/guide_wall.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/haptics/law/channel.h"
#include "kerf/force.hpp"

namespace kerf {

namespace {

constexpr double stiffness = 1e6;        // [N/m] of metal [assumed], same as for an implant
constexpr double near_contact = 0.3e-3;  // [m] no channel beyond this distance

/// Returns the radius of an outline at `z` [m]; beyond an end, the radius at that end.
double radius_at(const ToolSolid& tool, double z) noexcept {
    const auto& outline = tool.outline();
    if (z >= outline.front().z) return outline.front().radius;
    for (std::size_t i = 1; i < outline.size(); ++i)
        if (z >= outline[i].z) {
            const double t = (outline[i - 1].z - z) / (outline[i - 1].z - outline[i].z);
            return outline[i - 1].radius + t * (outline[i].radius - outline[i - 1].radius);
        }
    return outline.back().radius;
}

/// Returns the foremost z at which the outline has its largest radius [m].
double first_full_width(const ToolSolid& tool) noexcept {
    const auto& outline = tool.outline();
    const double widest = tool.largest_radius();
    const auto full = std::find_if(outline.begin(), outline.end(),
                                   [&](const kerf_profile_point& p) { return p.radius >= widest * (1.0 - 1e-9); });
    return full->z;
}

}  // namespace

std::size_t guide_wall(const Guide& guide, const ToolSolid& tool, const Pose& tool_from_body,
                       kerf_channel* channels) noexcept {
    const Vec3 mouth = tool_from_body * guide.mouth, along = rotate(tool_from_body.rotation, guide.along);
    if (along.z < 0.5) return 0;  // excludes a tool at more than 60° to the bore
    // To first order, a point of the tool's axis is nearest to the point of the bore's axis with the same z.
    const auto point_behind_mouth = [&](double behind_mouth) { return mouth - behind_mouth * along; };
    const double front = std::min(mouth.z, first_full_width(tool)), rear = point_behind_mouth(guide.length).z;
    if (front <= rear) return 0;
    const auto bore_at = [&](double z) { return mouth + (z - mouth.z) / along.z * along; };
    const Vec3 at_front = bore_at(front);
    if (std::hypot(at_front.x, at_front.y) > guide.bore_radius) return 0;  // the tool is outside the bore

    std::size_t count = 0;
    constexpr std::array ids{OwnContact::guide_front, OwnContact::guide_rear};
    const std::array ends{front, rear};
    for (std::size_t i = 0; i < ends.size(); ++i) {
        if (ends[i] < tool.end_z()) continue;  // behind the rear end of the tool
        const Vec3 bore = bore_at(ends[i]);
        const double apart = std::hypot(bore.x, bore.y);
        const double depth = apart + radius_at(tool, ends[i]) - guide.bore_radius;
        if (depth < -near_contact || apart < 1e-9) continue;
        const Vec3 into{-bore.x / apart, -bore.y / apart, 0.0};  // from the bore's axis to the tool's
        channels[count++] = contact_channel(ids[i], rate_at({0, 0, ends[i]}, into), stiffness, depth);
    }
    return count;
}

}  // namespace kerf
