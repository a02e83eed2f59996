// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "bone/measure/measured.h"
#include "bone/measure/surface.h"

namespace kerf::bone {

/// Returns the stretch of bone on a line that contains the line's point, or else the first one behind it in the line's
/// direction. Nothing without bone.   [worker]
[[nodiscard]] std::optional<Stretch> stretch_at(const MeasuredSurface& surface, const Line& line);

/// Returns the thickness of the bone on a line [m]: the length of the stretch at its point.
///
///     u² = (w / cos α)² + (w / cos β)²
///
/// with w the uncertainty of a wall [m], and α, β the angles between the line and the walls' normals: in closed form,
/// by [gum-2008], 5.1.2. A cosine counts as 0.1 at least. Nothing without bone, or if it continues beyond the data.
/// [worker]
[[nodiscard]] std::optional<Measured> thickness_at(const MeasuredSurface& surface, const Line& line);

/// Returns the signed distance of a point to the surface, negative inside, with the uncertainty of a wall [m].
/// Nothing without a surface.   [worker]
[[nodiscard]] std::optional<Measured> surface_distance(const MeasuredSurface& surface, Vec3 point);

/// Smallest cosine between a line and a wall's normal that counts [–]. Along a wall the uncertainty is unlimited.
inline constexpr double min_wall_cosine = 0.1;

}  // namespace kerf::bone
