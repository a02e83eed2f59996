// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "bone/measure/measured.h"
#include "bone/measure/surface.h"

namespace kerf {

/// Returns the stretch of bone that a line passes: the one that contains the line's point, or else the first one behind
/// it, along the direction. Nothing where there is none.   [worker]
[[nodiscard]] std::optional<Stretch> stretch_at(const MeasuredSurface& surface, const Line& line);

/// Returns the thickness of the bone on a line [m]: the length of that stretch.
///
///     u² = (w / cos α)² + (w / cos β)²
///
/// with w the uncertainty of a wall [m], and α, β the angles between the line and the walls' normals: in closed form,
/// by [gum-2008], 5.1.2. A cosine counts as 0.1 at least. Nothing where there is no bone, or where it goes on beyond
/// what was read.   [worker]
[[nodiscard]] std::optional<Measured> thickness_at(const MeasuredSurface& surface, const Line& line);

/// Returns the signed distance of a point to the surface, negative inside, with the uncertainty of a wall [m].
/// Nothing without a surface.   [worker]
[[nodiscard]] std::optional<Measured> surface_distance(const MeasuredSurface& surface, Vec3 point);

/// The least cosine between a line and a wall's normal that counts [–]: a line along a wall is uncertain without end.
inline constexpr double least_wall_cosine = 0.1;

}  // namespace kerf
