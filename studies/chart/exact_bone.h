// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/field/grid/body.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// Bone as implicit solids, without a grid: what references integrate over, and what every method's grid is made from.
struct ExactBone {
    using Distance = std::function<double(Vec3)>;  ///< body frame [m] → [m], negative inside, 1-Lipschitz

    struct Tissue {
        std::string id;
        double density = 1850.0;  ///< [kg/m³]
        Distance border{};        ///< negative inside this tissue; unused for the last
    };
    Distance surface;
    std::vector<Tissue> tissues;  ///< front to back; the last fills what the others leave
    Vec3 low, high;               ///< [m] the box that grids cover: all that a path can reach, and some room

    /// Index of the tissue at a point; −1 in air.   [any] pure.
    [[nodiscard]] int tissue_at(Vec3 point) const;
};

/// On a grid of `spacing` [m], shifted by `offset` of a voxel: Kerf's own fields.   [main]
[[nodiscard]] Body body_of(const ExactBone& bone, double spacing, Vec3 offset);

}  // namespace kerf::chart
