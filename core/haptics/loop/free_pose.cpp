// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/loop/free_pose.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace kerf {

namespace {

constexpr double farthest = 0.3;  // [m] maximum retraction

bool is_in_bone(const Body& body, Vec3 point) { return uncut_distance(body, locate(body.grid(), point)) < 0.0; }

/// Returns a point of the tool's surface that lies in bone [m], tool frame; nothing: the tool is free.
std::optional<Vec3> point_in_bone(const Body& body, const ToolSolid& whole, const Pose& at) {
    const double h = body.grid().spacing;
    const auto& outline = whole.outline();
    for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
        const double dz = outline[i + 1].z - outline[i].z, dr = outline[i + 1].radius - outline[i].radius;
        const int steps = static_cast<int>(std::ceil(std::hypot(dz, dr) / h)) + 1;
        for (int step = 0; step <= steps; ++step) {
            const double t = static_cast<double>(step) / steps, r = outline[i].radius + t * dr;
            for (const Vec3 in_tool : whole.around(r, outline[i].z + t * dz))
                if (is_in_bone(body, at * in_tool)) return in_tool;
        }
    }
    return std::nullopt;
}

}  // namespace

std::optional<double> retreat_distance(const Body& body, const ToolSolid& whole, const Pose& body_from_tool) {
    const double step = 0.5 * body.grid().spacing;
    std::optional<Vec3> found;  // a point that was in bone is most often still in it half a voxel further back
    for (int i = 0; i * step <= farthest; ++i) {
        const Pose at = body_from_tool * Pose{{0, 0, -i * step}, {1, 0, 0, 0}};
        if (found && is_in_bone(body, at * *found)) continue;
        found = point_in_bone(body, whole, at);
        if (!found) return i * step;
    }
    return std::nullopt;
}

}  // namespace kerf
