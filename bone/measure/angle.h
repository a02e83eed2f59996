// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "bone/measure/line.h"

/// Angles [rad] between lines and planes.   [any] pure.
namespace kerf::bone {

/// Returns the angle between the directions of two lines, 0 … π. Both directions point away from the corner.
[[nodiscard]] double angle_between(const Line& one, const Line& other) noexcept;
/// Returns the angle between a line and a plane, 0 … π/2.
[[nodiscard]] double angle_between(const Line& line, const Plane& plane) noexcept;
/// Returns the smaller angle between two planes, 0 … π/2.
[[nodiscard]] double angle_between(const Plane& one, const Plane& other) noexcept;

/// Returns a line's projection onto a plane, such as the sagittal one. Nothing for a line along the plane's normal.
[[nodiscard]] std::optional<Line> projected_onto(const Plane& view, const Line& line) noexcept;
/// Returns the line in which a plane meets the view. Nothing for parallel planes.
[[nodiscard]] std::optional<Line> projected_onto(const Plane& view, const Plane& plane) noexcept;

}  // namespace kerf::bone
