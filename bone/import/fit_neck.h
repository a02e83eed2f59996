// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "bone/import/surface_rays.h"

namespace kerf::bone {

/// A neck below a known head.
struct NeckGuess {
    Vec3 head{};               ///< [m] LPS: centre
    double head_radius = 0.0;  ///< [m]
    Vec3 to_base{};            ///< approximate direction from the head into the neck
};

struct FittedNeck {
    Vec3 to_base{};         ///< unit vector from the head's centre along the axis
    Vec3 narrowest{};       ///< [m] LPS: centroid of the narrowest section
    double area = 0.0;      ///< [m²] of the narrowest section
    double residual = 0.0;  ///< [m] root mean square distance of the used centroids from the axis
    int used = 0;           ///< number of used sections
};

/// Returns the axis of a neck: the line through the head's centre that passes nearest to the centroids of the sections
/// around the narrowest.
///
/// Sections are perpendicular to the axis, from 0.5 to 2 radii of the head below its centre, a fortieth of a radius
/// apart. A section with area A has the weight 1.1 − A / A_min, and none from 110 % of the smallest area on. Sections
/// wider than the head do not count. Sections and axis are iterated until the axis converges. Returns nothing if no
/// section is narrower than those on both sides of it.   [main]
[[nodiscard]] std::optional<FittedNeck> fit_neck(const BoneShape& bone, const NeckGuess& guess);

}  // namespace kerf::bone
