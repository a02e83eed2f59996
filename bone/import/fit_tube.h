// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "bone/import/surface_rays.h"

namespace kerf::bone {

/// Initial position of a tube: two points on its axis. Lengths in m, LPS.
struct TubeGuess {
    Vec3 from{}, to{};
    double radius = 0.0;
    double within = 0.0;  ///< of both ends to the axis; the search reaches twice as far
};

/// The axis of a tube fitted to part of a bone's surface, such as the shaft of a long bone.
struct FittedTube {
    Vec3 from{}, to{};      ///< [m] LPS: the ends of the guess, projected onto the axis
    double radius = 0.0;    ///< [m] mean of its sections
    double residual = 0.0;  ///< [m] root mean square distance of the used points from the wall
    double fraction = 0.0;  ///< [–] of the rays of all sections, the fraction that ends on used points
};

constexpr double min_tube_fraction = 0.5;  ///< [–] of the rays

/// Returns the axis of the tube near a guess.
///
/// 64 rays sample each of 41 sections across the axis. The tube is round, and each section has its own radius, because
/// a shaft widens towards its ends. Least squares of the distances from the wall move the axis, until it converges.
/// Points farther off than 2.5 times the residual, or than 10 % of the radius, do not count: so a ridge such as the
/// linea aspera has no weight. Sections with too few hits, or with a radius unlike the guess, do not count. Returns
/// nothing if too few sections remain to start from.   [main]
[[nodiscard]] std::optional<FittedTube> fit_tube(const BoneShape& bone, const TubeGuess& guess);

}  // namespace kerf::bone
