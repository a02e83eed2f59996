// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/scenes/bone_block.h"

#include <algorithm>
#include <cmath>

namespace kerf {

namespace {

/// Exact signed distance to an axis-aligned box.
double box_distance(Vec3 p, Vec3 low, Vec3 high) {
    const Vec3 middle = 0.5 * (low + high), half = 0.5 * (high - low);
    const Vec3 q{std::abs(p.x - middle.x) - half.x, std::abs(p.y - middle.y) - half.y,
                 std::abs(p.z - middle.z) - half.z};
    return length(Vec3{std::max(q.x, 0.0), std::max(q.y, 0.0), std::max(q.z, 0.0)}) +
           std::min(std::max({q.x, q.y, q.z}), 0.0);
}

}  // namespace

Body make(const BoneBlock& block) {
    const double half = 0.5 * block.width;
    const Vec3 low{-half, -half, -block.thickness}, high{half, half, 0.0};
    const double margin = 6.0 * block.spacing;
    Grid grid = Grid::covering(low - Vec3{margin, margin, margin}, high + Vec3{margin, margin, margin}, block.spacing);
    grid.origin = grid.origin + block.spacing * Vec3{0.3, 0.1, 0.7};
    Body body;
    body.id = "block";
    body.surface = LevelSet::build(grid, [=](Vec3 p) { return box_distance(p, low, high); });
    if (block.shell > 0.0) {
        body.materials.push_back(
            {"outer", block.density, LevelSet::build(grid, [&](Vec3 p) { return -p.z - block.shell; })});
        body.materials.push_back({"inner", block.inner, {}});
    } else {
        body.materials.push_back({"outer", block.density, {}});
    }
    return body;
}

}  // namespace kerf
