// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "bone/import/surface_rays.h"

namespace kerf {

/// Where a sphere should be. Lengths in m, LPS.
struct SphereGuess {
    Vec3 centre{};
    double radius = 0.0;
    double within = 0.0;  ///< of the centre; the search reaches twice as far, so that a near miss can be reported
};

/// A sphere that part of a bone's surface lies on, such as the articular part of a femoral head.
struct FittedSphere {
    Vec3 centre{};          ///< [m] LPS
    double radius = 0.0;    ///< [m]
    double residual = 0.0;  ///< [m] root mean square of the distances of the points used
    double share = 0.0;     ///< [–] of 1000 rays from the centre that end on points used
};

/// The radius may differ from the guess by 30 %. Also of tubes.
constexpr double most_off_size = 0.3;
/// Of the rays [–]. A sphere in a tube touches a quarter of it, and the head of a femur shows two thirds.
constexpr double least_share_of_sphere = 0.4;

/// Finds the sphere near a guess.
///
/// Rays from the guess find points on the surface. Of 2000 spheres through four points each, drawn by a fixed sequence,
/// the one with most points within 4 % of its radius is the start. Then rays from the sphere's own centre give new
/// points, and least squares of the distances a new sphere, until it rests. Points farther off than 2.5 times the
/// residual do not count, nor those beyond 4 % of the radius: so the neck has no weight. The result depends on the
/// guess only by which sphere it finds. Empty: no sphere has points enough to start from. [main]
[[nodiscard]] std::optional<FittedSphere> fit_sphere(const BoneShape& bone, const SphereGuess& guess);

}  // namespace kerf
