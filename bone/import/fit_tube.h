// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "bone/import/surface_rays.h"

namespace kerf {

/// Where a tube should be: between two points on its axis. Lengths in m, LPS.
struct TubeGuess {
    Vec3 from{}, to{};
    double radius = 0.0;
    double within = 0.0;  ///< of both ends to the axis; the search reaches twice as far
};

/// The axis of a tube that part of a bone's surface lies on, such as the shaft of a long bone.
struct FittedTube {
    Vec3 from{}, to{};      ///< [m] LPS: the ends of the guess, moved square onto the axis
    double radius = 0.0;    ///< [m] mean of its sections
    double residual = 0.0;  ///< [m] root mean square of the distances of the points used from the wall
    double share = 0.0;     ///< [–] of the rays of all sections that end on points used
};

constexpr double least_share_of_tube = 0.5;  ///< [–] of the rays

/// Finds the axis of the tube near a guess.
///
/// 41 sections across the axis are met by 64 rays each. The tube is round, and each section has a radius of its own: a
/// shaft widens towards its ends. Least squares of the distances from the wall move the axis, until it rests. Points
/// farther off than 2.5 times the residual do not count, nor those beyond 10 % of the radius: so a ridge such as the
/// linea aspera has no weight. Sections that are not met all around do not count, nor those whose radius is not that of
/// the guess. Empty: too few sections to start from.   [main]
[[nodiscard]] std::optional<FittedTube> fit_tube(const BoneShape& bone, const TubeGuess& guess);

}  // namespace kerf
