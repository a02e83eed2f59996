// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "kerf/remesh_mesh.hpp"

namespace kerf::burring::displacement {

using remeshing::Triangles;

/// What `tidy` may do.
struct TidyLimits {
    double flat = 1e-9;  ///< [m] that a face of the old surface may leave its plane
    double rim = 0.0;    ///< [m] that the rim may move in the old surface
    double wall = 0.0;   ///< [m] that a wall may move
};

/// Removes slivers beside a new wall: turns edges and joins vertices where that makes least angles larger and leaves
/// the surface where it is, within the limits. Vertices on the border of the mesh and those with a flag in `stays`
/// stay, vertices keep their numbers, and none moves.   [any] pure.
/// @param is_new   of each vertex: slivers without such a vertex stay
void tidy(Triangles& mesh, const std::vector<std::uint8_t>& stays, const std::vector<std::uint8_t>& is_new,
          const TidyLimits& limits);

}  // namespace kerf::burring::displacement
