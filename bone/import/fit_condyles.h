// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "bone/import/surface_rays.h"

namespace kerf {

/// Where the backs of two condyles should be. Lengths in m, LPS.
struct CondylesGuess {
    Vec3 from{}, to{};              ///< a point near the back of each
    Vec3 shaft_from{}, shaft_to{};  ///< the axis along which the bone is seen
    double within = 0.0;            ///< search around both points
};

struct FittedCondyles {
    Vec3 from{}, to{};      ///< [m] LPS: the points where a plane touches the two backs
    double residual = 0.0;  ///< [m] root mean square of the distances from the larger of the two patches
};

/// Finds the posterior condylar line: a plane parallel to the shaft touches the bone from behind near both points.
///
/// Behind is the side on which the points lie, seen from the shaft. Rays along the plane's normal find the backmost
/// point near each, and least squares put a paraboloid through the points within 6 mm of it: its apex is where the
/// plane touches. Plane and apexes follow one another until the plane rests. Empty, with the number of the point in
/// `failed`: the bone has no backmost point there.   [main]
[[nodiscard]] std::optional<FittedCondyles> fit_condyles(const BoneShape& bone, const CondylesGuess& guess,
                                                         std::size_t& failed);

}  // namespace kerf
