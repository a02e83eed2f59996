// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bone/remesh/tagged_mesh.h"
#include "core/field/grid/body.h"

/// The surface that exact cuts begin with.
namespace kerf {

/// The surface of an uncut body as its field has it: vertices within a micrometre are one, and faces that this leaves
/// without area are removed.   [any]
[[nodiscard]] SurfaceMesh field_surface(const Body& body);

/// Joins vertices that lie in one cell of a lattice `step` [m] apart and removes the faces that collapse. Vertices move
/// onto the lattice, by less than `step`.   [any] pure.
void snap(SurfaceMesh& mesh, double step);

/// Removes faces without area, whose corners lie exactly on one line, and leaves the surface where it is: an edge
/// without length becomes one vertex, and a face with three corners in a row shares the area of the neighbour at its
/// longest edge. Faces for which that cannot be done stay.   [any] pure.
void remove_flat_faces(SurfaceMesh& mesh);

/// Whether the corners of a face lie on one line, exactly.   [any] pure.
[[nodiscard]] bool has_no_area(const SurfaceMesh& mesh, const Triangle& face) noexcept;

/// Returns the first flaw of a surface that prevents an exact cut, or an empty text: open or crowded edges, pinched
/// vertices, faces that cross or have no area. For people, with a position.   [any] pure.
[[nodiscard]] std::string flaw_of_base(const SurfaceMesh& mesh);

}  // namespace kerf
