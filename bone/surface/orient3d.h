// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kerf/math.hpp"

namespace kerf {

/// On which side of the plane through a, b, c a point lies: +1 where a, b, c run clockwise seen from it (below), −1
/// where anticlockwise (above), 0 exactly on it.
///
///     sign of det [a − d, b − d, c − d]
///
/// The sign is exact: where rounding could decide, the determinant is computed again without it, as a sum of doubles
/// that do not overlap. (Numbers so small that their products underflow are left out.)   [any] pure.
///
/// Source: the filter's bound and the exact arithmetic are those of Shewchuk's predicates [shewchuk-1997].
[[nodiscard]] int orient3d(Vec3 a, Vec3 b, Vec3 c, Vec3 d) noexcept;

/// The same in the plane: +1 where a, b, c run anticlockwise.
[[nodiscard]] int orient2d(double ax, double ay, double bx, double by, double cx, double cy) noexcept;

}  // namespace kerf
