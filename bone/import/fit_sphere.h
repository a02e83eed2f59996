// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "bone/import/surface_rays.h"

namespace kerf::bone {

/// Initial position of a sphere. Lengths in m, LPS.
struct SphereGuess {
    Vec3 centre{};
    double radius = 0.0;
    double within = 0.0;  ///< of the centre; the search reaches twice as far, so that a near miss can be reported
};

/// A sphere fitted to part of a bone's surface, such as the articular part of a femoral head.
struct FittedSphere {
    Vec3 centre{};          ///< [m] LPS
    double radius = 0.0;    ///< [m]
    double residual = 0.0;  ///< [m] root mean square distance of the used points
    double fraction = 0.0;  ///< [–] of 1000 rays from the centre, the fraction that ends on used points
};

/// [–] largest difference of the radius from the guess. Also for tubes.
constexpr double max_size_deviation = 0.3;
/// [–] smallest fraction of the rays. A sphere in a tube touches a quarter of it; the head of a femur shows two thirds.
constexpr double min_sphere_fraction = 0.4;

/// Returns the sphere near a guess.
///
/// Rays from the guess find points on the surface. A fixed sequence draws 2000 spheres through four points each. The
/// one with most points within 4 % of its radius is the start. Then rays from the sphere's own centre give new points,
/// and least squares of the distances a new sphere, until it converges. Points farther off than 2.5 times the residual,
/// or than 4 % of the radius, do not count: so the neck has no weight. The guess affects only the choice of the sphere.
/// Returns nothing if no sphere has enough points to start from.   [main]
[[nodiscard]] std::optional<FittedSphere> fit_sphere(const BoneShape& bone, const SphereGuess& guess);

}  // namespace kerf::bone
