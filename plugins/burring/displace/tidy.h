// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "kerf/remesh_mesh.hpp"

namespace kerf::burring::displacement {

using remeshing::Triangles;

/// Limits of `tidy`.
struct TidyLimits {
    double flat = 1e-9;  ///< [m] largest distance of a face of the old surface from its plane
    double rim = 0.0;    ///< [m] largest shift of the rim in the old surface
    double wall = 0.0;   ///< [m] largest shift of a wall
};

/// Removes slivers next to a new wall. It flips edges and merges vertices where that increases the smallest angles and
/// moves the surface within the limits. Vertices on the border of the mesh and those flagged in `stays` stay. Vertices
/// keep their numbers and positions.   [any] pure.
/// @param is_new  #vertices; slivers without such a vertex stay
void tidy(Triangles& mesh, const std::vector<std::uint8_t>& stays, const std::vector<std::uint8_t>& is_new,
          const TidyLimits& limits);

}  // namespace kerf::burring::displacement
