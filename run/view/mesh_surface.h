// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "core/field/surface/mesh.h"
#include "run/view/viewed_run.h"

/// Surfaces of bone that viewers draw, made of a mesh without its field.
namespace kerf::run {

inline constexpr std::size_t max_mesh_triangles = 150'000;  ///< of a viewed mesh

/// Returns a mesh with at most `max_triangles`. Vertices that lie in one cell of a lattice, and have the same tissue
/// and the same main direction of the normal, become one. Triangles without area, and with an invalid vertex, are left
/// out. [main] Pre: normals and tissues, one per vertex; finite positions.
[[nodiscard]] Mesh thinned(const Mesh& mesh, std::size_t max_triangles);

/// Returns the surface of a mesh in the frame of the mesh, without shade. Its bricks have about as many triangles as
/// those of a field. Returns nothing for a mesh without triangles, and for one with too many at one position.
/// [main] Pre: as for `thinned`, and valid vertices.
[[nodiscard]] std::optional<ViewedBodySurface> viewed_surface(const Mesh& mesh);

}  // namespace kerf::run
