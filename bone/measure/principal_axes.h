// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "kerf/math.hpp"

namespace kerf::bone {

/// The principal directions of a set of points.
struct PrincipalAxes {
    Vec3 centre{};                  ///< [m] mean of the points
    std::array<Vec3, 3> axes{};     ///< unit, right-handed; the widest spread first
    std::array<double, 3> squares;  ///< [m²] sum of squared distances from the centre along each axis
};

/// Returns the principal axes of points, by Jacobi rotations of their scatter matrix. The largest component of an axis
/// is positive. The same points give the same bits.   [any] pure.
/// @param points  #N ≥ 1 points [m]
[[nodiscard]] PrincipalAxes principal_axes(std::span<const Vec3> points) noexcept;

}  // namespace kerf::bone
