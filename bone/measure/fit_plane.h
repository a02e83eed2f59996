// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "bone/measure/line.h"

/// Lines and planes of least squares.
namespace kerf::bone {

struct FittedLine {
    Line line{};            ///< through the mean of the points, directed from the first towards the last
    double residual = 0.0;  ///< [m] standard deviation of the points from the line; 0 for two points
};
/// Returns the line of least squares through points. Nothing for fewer than two points, or for points at one spot.
/// [any] pure.
/// @param points  #N points [m]
[[nodiscard]] std::optional<FittedLine> line_through(std::span<const Vec3> points) noexcept;

struct FittedPlane {
    Plane plane{};
    double residual = 0.0;          ///< [m] standard deviation of the points from the plane; 0 for three points
    double tilt_uncertainty = 0.0;  ///< [rad] standard uncertainty of the normal, in its least certain direction
};
/// Returns the plane of least squares through points.
///
///     s² = Σ d_i² / (N − 3),   u(tilt) = s / √(Σ b_i²)
///
/// with d_i the distance of point i from the plane [m], and b_i its distance from the centre along the second principal
/// axis [m]. The normal has the direction of (p2 − p1) × (p3 − p1) of the first three points. Nothing for fewer than
/// three points, or for points on one line.   [any] pure.
/// @param points  #N points [m]
[[nodiscard]] std::optional<FittedPlane> plane_through(std::span<const Vec3> points) noexcept;

/// Returns the plane of symmetry of pairs, such as the landmarks of both sides of a skull. It passes through the mean
/// of the pairs' middles. Its normal is the mean of the differences, from the right point to the left one.
///
///     n = Σ (l_i − r_i) / |Σ (l_i − r_i)|
///
/// `residual` is the standard deviation of the middles from the plane, with N − 1 degrees of freedom.
/// `tilt_uncertainty` is the root mean square of the differences' parts across n, divided by their mean length and √N.
/// Nothing without pairs, or if the differences cancel.   [any] pure.
/// @param left, right  #N points each [m]; pair i is left[i] and right[i]
[[nodiscard]] std::optional<FittedPlane> mirror_plane(std::span<const Vec3> left, std::span<const Vec3> right) noexcept;

}  // namespace kerf::bone
