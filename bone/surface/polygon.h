// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bone/surface/surface_mesh.h"

namespace kerf {

inline constexpr std::size_t most_corners = 256;  ///< of one polygon

/// Adds a polygon as triangles, cut off ear by ear so that a corner that points inwards stays one. A polygon that
/// crosses itself comes out as some triangles.   Pre: 3 … most_corners corners, all existing.
void add_polygon(SurfaceMesh& mesh, const std::vector<std::uint32_t>& corners);

}  // namespace kerf
