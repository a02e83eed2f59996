// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "bone/measure/measured.h"
#include "bone/measure/tangent.h"

namespace kerf {

/// Returns how uneven a border is [m]: the root mean square distance of its outline from a parabola of least squares.
///
/// The outline has one point for each millimetre along the path: the outermost of the surface points that project
/// there. The parabola takes up the natural curve of a border; steps and notches are left. The uncertainty is that of
/// one wall, `wall` [m], which is also about what a perfect border measures. Nothing for fewer than six points of the
/// outline, or where `side` leads along the path.   [any] pure.
/// @param points   #N points of the surface [m]; those outside the path are ignored
[[nodiscard]] std::optional<Measured> border_roughness(std::span<const Vec3> points, const Path& path,
                                                       const BorderView& view, double wall);

}  // namespace kerf
