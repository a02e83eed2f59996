// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bone/remesh/tagged_mesh.h"
#include "core/field/grid/body.h"

/// The initial surface of exact cuts.
namespace kerf::bone {

/// Returns the surface of an uncut body from its field. Vertices within a micrometre are merged, and faces that this
/// leaves without area are removed.   [any]
[[nodiscard]] SurfaceMesh field_surface(const Body& body);

/// Merges vertices in one cell of a lattice with `step` [m], and removes the faces that collapse. Vertices move onto
/// the lattice, by less than `step`.   [any] pure.
void snap(SurfaceMesh& mesh, double step);

/// Removes faces whose corners lie exactly on one line, without moving the surface. An edge of zero length becomes one
/// vertex. A face with three collinear corners takes part of the area of the neighbour at its longest edge. Other such
/// faces stay.   [any] pure.
void remove_flat_faces(SurfaceMesh& mesh);

/// Returns whether the corners of a face are exactly collinear.   [any] pure.
[[nodiscard]] bool has_no_area(const SurfaceMesh& mesh, const Triangle& face) noexcept;

/// Returns the first flaw of a surface that prevents an exact cut, or an empty text: open edges, edges with more than
/// two faces, pinched vertices, faces that cross or have no area. The text is for people, with a position.
/// [any] pure.
[[nodiscard]] std::string flaw_of_base(const SurfaceMesh& mesh);

}  // namespace kerf::bone
