// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "bone/import/surface_rays.h"

namespace kerf {

/// The neck below a head that is known.
struct NeckGuess {
    Vec3 head{};               ///< [m] LPS: centre
    double head_radius = 0.0;  ///< [m]
    Vec3 to_base{};            ///< about the direction from the head into the neck
};

struct FittedNeck {
    Vec3 to_base{};         ///< unit vector from the head's centre along the axis
    Vec3 narrowest{};       ///< [m] LPS: centroid of the narrowest section
    double area = 0.0;      ///< [m²] of that
    double residual = 0.0;  ///< [m] root mean square of the distances of the centroids used from the axis
    int used = 0;           ///< sections
};

/// Finds the axis of a neck: the line through the head's centre that passes nearest to the centroids of the sections
/// around the narrowest.
///
/// Sections lie across the axis itself, from 0.5 to 2 radii of the head below its centre, a fortieth of a radius apart.
/// A section with area A has the weight 1.1 − A / A_min, and none from 110 % of the smallest area on. Sections that are
/// wider than the head somewhere do not count. Sections and axis follow one another until the axis rests. Empty: the
/// bone has no section there that is narrower than those on both sides of it.   [main]
[[nodiscard]] std::optional<FittedNeck> fit_neck(const BoneShape& bone, const NeckGuess& guess);

}  // namespace kerf
