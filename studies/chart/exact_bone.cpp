// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/chart/exact_bone.h"

#include <cstddef>
#include <utility>

namespace kerf::chart {

int ExactBone::tissue_at(Vec3 point) const {
    if (!(surface(point) < 0.0)) return -1;
    for (std::size_t i = 0; i + 1 < tissues.size(); ++i)
        if (tissues[i].border(point) < 0.0) return static_cast<int>(i);
    return static_cast<int>(tissues.size()) - 1;
}

Body body_of(const ExactBone& bone, double spacing, Vec3 offset) {
    const double margin = 2.0 * spacing;
    Grid grid =
        Grid::covering(bone.low - Vec3{margin, margin, margin}, bone.high + Vec3{margin, margin, margin}, spacing);
    grid.origin = grid.origin + spacing * offset;
    Body body;
    body.id = "bone";
    body.surface = LevelSet::build(grid, bone.surface);
    for (std::size_t i = 0; i < bone.tissues.size(); ++i) {
        Material material{bone.tissues[i].id, bone.tissues[i].density, {}};
        if (i + 1 < bone.tissues.size()) material.border = LevelSet::build(grid, bone.tissues[i].border);
        body.materials.push_back(std::move(material));
    }
    return body;
}

}  // namespace kerf::chart
