// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kerf/math.hpp"

namespace kerf::remesh_cgal {

/// Triangles with tags, as they cross the boundary.
struct Triangles {
    std::vector<Vec3> vertices;            ///< [m]
    std::vector<std::uint32_t> triangles;  ///< three corners of each, anticlockwise seen from outside
    std::vector<std::uint8_t> tags;        ///< of each triangle: KERF_FACE_…
};

/// Removes edges shorter than `width` [m], and vertices that lie nearer than that to the opposite side of their face.
/// Two surfaces that cross at a small angle leave such faces, and rounding makes them cross. The surface moves by less
/// than `width`; it stays closed and 2-manifold where it was. Vertices on the border of the mesh stay.   [any] pure.
void remove_slivers(Triangles& mesh, double width);

}  // namespace kerf::remesh_cgal
