// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "bone/measure/measured.h"
#include "bone/measure/tangent.h"

namespace kerf::bone {

/// Returns the roughness of a border [m]: the root mean square distance of its outline from a parabola of least
/// squares.
///
/// The outline has one point for each millimetre along the path: the outermost of the surface points that project
/// there. The parabola follows the natural curve of a border; steps and notches remain. The uncertainty is that of one
/// wall, `wall` [m]. A perfect border measures about as much. Nothing for fewer than six points of the outline, or if
/// `side` is parallel to the path.   [any] pure.
/// @param points  #N points of the surface [m]; points outside the path are ignored
[[nodiscard]] std::optional<Measured> border_roughness(std::span<const Vec3> points, const Path& path,
                                                       const BorderView& view, double wall);

}  // namespace kerf::bone
