// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "bone/import/surface_rays.h"

namespace kerf::bone {

/// Initial positions of the backs of two condyles. Lengths in m, LPS.
struct CondylesGuess {
    Vec3 from{}, to{};              ///< a point near the back of each
    Vec3 shaft_from{}, shaft_to{};  ///< axis of view
    double within = 0.0;            ///< radius of the search around both points
};

struct FittedCondyles {
    Vec3 from{}, to{};      ///< [m] LPS: contacts of a plane with the two backs
    double residual = 0.0;  ///< [m] root mean square distance from the paraboloid, of the larger of the two patches
};

/// Returns the posterior condylar line: the contacts of a plane parallel to the shaft that touches the bone from behind
/// near both points.
///
/// The points lie behind the shaft, which defines "behind". Rays along the plane's normal find the backmost point near
/// each. Least squares fit a paraboloid to the surface within 6 mm of it; its apex is the contact. Plane and apexes are
/// iterated until the plane converges. Returns nothing, with the number of the point in `failed`, if the bone has no
/// backmost point there.   [main]
[[nodiscard]] std::optional<FittedCondyles> fit_condyles(const BoneShape& bone, const CondylesGuess& guess,
                                                         std::size_t& failed);

}  // namespace kerf::bone
