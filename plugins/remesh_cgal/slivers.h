// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "kerf/remesh_mesh.hpp"

namespace kerf::remesh_cgal {

using remeshing::Triangles;

/// Removes edges shorter than `width` [m], and vertices that lie nearer than that to the opposite side of their face.
/// Two surfaces that cross at a small angle leave such faces, and rounding makes them cross. The surface moves by less
/// than `width`; it stays closed and 2-manifold where it was. Vertices on the border of the mesh stay.   [any] pure.
void remove_slivers(Triangles& mesh, double width);

}  // namespace kerf::remesh_cgal
