// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "conformance/chart/scene.h"

/// For training and research; not for diagnosis, planning or deciding treatment.
namespace kerf::chart {

/// What opens a pedicle by hand: a cone on a straight shaft, pushed and not turned.
struct Awl {
    double diameter = 4e-3;      ///< [m] of the shaft [assumed]
    double point_angle = 0.5236; ///< [rad] full: 30° [assumed]
    double friction = 0.3;       ///< [–] steel on wet bone [assumed]
};

/// What pushes it along a scene's way, its tip at `depth` [m]: bone is crushed along the cone's normals and rubs on it,
///
///     F = ∫ S(ρ) (1 + μ cot p) dA_z,    S = 68 MPa (ρ / 1 g/cm³)²        [N]
///
/// by the midpoint rule over the cone in the exact bone. The shaft behind it is left out.   [any] pure.
///
/// Source: S from [carter-hayes-1977]; the law of the drilling plugin's still tip, docs/models/drilling.md.
[[nodiscard]] double push_of(const Awl& awl, const Scene& scene, double depth);

}  // namespace kerf::chart
