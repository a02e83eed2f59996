// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bone/measure/line.h"

/// Distances [m], never negative.   [any] pure. To a surface: bone/measure/surface.h.
namespace kerf::bone {

[[nodiscard]] double distance_between(Vec3 one, Vec3 other) noexcept;
[[nodiscard]] double distance_between(Vec3 point, const Line& line) noexcept;
[[nodiscard]] double distance_between(Vec3 point, const Plane& plane) noexcept;
/// Returns the shortest distance between two infinite lines, also for parallel ones.
[[nodiscard]] double distance_between(const Line& one, const Line& other) noexcept;

}  // namespace kerf::bone
