// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "kerf/remesh_mesh.hpp"

namespace kerf::remesh_cgal {

using remeshing::Triangles;

/// Removes edges shorter than `width` [m], and vertices closer than `width` to the opposite side of their face. Two
/// surfaces that cross at a small angle leave such faces, and rounding makes these cross. The surface moves by less
/// than `width`. A closed 2-manifold stays one. Vertices on the border of the mesh stay.   [any] pure.
void remove_slivers(Triangles& mesh, double width);

}  // namespace kerf::remesh_cgal
