// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/field/cut/tool_solid.h"
#include "core/field/grid/body.h"
#include "kerf/units.hpp"

/// Small bones and tools whose answers can be worked out by hand.
namespace kerf::test {

/// Exact signed distance to an axis-aligned box.
inline double box_distance(Vec3 p, Vec3 low, Vec3 high) {
    const Vec3 c = 0.5 * (low + high), half = 0.5 * (high - low);
    const Vec3 q{std::abs(p.x - c.x) - half.x, std::abs(p.y - c.y) - half.y, std::abs(p.z - c.z) - half.z};
    const Vec3 out{std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)};
    return length(out) + std::min(std::max({q.x, q.y, q.z}), 0.0);
}

/// One material, filling the box `low` … `high`, on a grid shifted by `offset` of a voxel.
inline Body block(Vec3 low, Vec3 high, double spacing, Vec3 offset = {0, 0, 0}) {
    const double margin = 6.0 * spacing;
    Grid grid = Grid::covering(low - Vec3{margin, margin, margin}, high + Vec3{margin, margin, margin}, spacing);
    grid.origin = grid.origin + spacing * offset;
    Body body;
    body.id = "block";
    body.surface = LevelSet::build(grid, [=](Vec3 p) { return box_distance(p, low, high); });
    body.materials.push_back({"cortical", 1850.0, {}});
    return body;
}

/// A drill's outline: cone of half point angle `p`, then a cylinder up to `length` behind the tip.
inline ToolSolid drill_outline(double radius, double half_angle, double length) {
    const double tip = radius / std::tan(half_angle);
    return ToolSolid({{0.0, 0.0}, {-tip, radius}, {-length, radius}});
}

/// A blade's cutting region: a front of `radius` about an axis behind it, `half_width` to either side, `depth` deep.
inline ToolSolid blade_outline(double radius, double half_width, double depth, double kerf) {
    std::vector<kerf_profile_point> outline;
    constexpr int pieces = 8;
    for (int i = 0; i <= pieces; ++i) {
        const double x = half_width * i / pieces;
        outline.push_back({std::sqrt(radius * radius - x * x) - radius, x});
    }
    outline.push_back({outline.back().z - depth, half_width});
    return ToolSolid::prism(outline, kerf);
}

/// A tool pose at `tip`, its +z (out of the tip) along `direction`.
inline Pose pointing(Vec3 tip, Vec3 direction) { return {tip, quat_between({0, 0, 1}, normalized(direction))}; }

}  // namespace kerf::test
