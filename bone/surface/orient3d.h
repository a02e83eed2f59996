// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/math.hpp"

namespace kerf::bone {

/// Returns the side of the plane through a, b, c on which d lies: +1 if a, b, c run clockwise seen from d (below), −1
/// if anticlockwise (above), 0 exactly on the plane.
///
///     sign of det [a − d, b − d, c − d]
///
/// The sign is exact. If rounding could change it, the determinant is computed again without rounding, as a sum of
/// doubles that do not overlap. Products that underflow are not covered.   [any] pure.
///
/// Source: the filter's bound and the exact arithmetic are those of Shewchuk's predicates [shewchuk-1997].
[[nodiscard]] int orient3d(Vec3 a, Vec3 b, Vec3 c, Vec3 d) noexcept;

/// Returns the orientation in the plane: +1 if a, b, c run anticlockwise.
[[nodiscard]] int orient2d(double ax, double ay, double bx, double by, double cx, double cy) noexcept;

}  // namespace kerf::bone
