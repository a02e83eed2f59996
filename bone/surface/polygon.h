// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bone/surface/surface_mesh.h"

namespace kerf::bone {

inline constexpr std::size_t max_corners = 256;  ///< of one polygon

/// Adds a polygon as triangles, by cutting off ears, so that concave corners are kept. A polygon that crosses itself
/// becomes arbitrary triangles. Pre: 3 … max_corners corners, all existing.
void add_polygon(SurfaceMesh& mesh, const std::vector<std::uint32_t>& corners);

}  // namespace kerf::bone
