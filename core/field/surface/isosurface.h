// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>

#include "core/field/surface/mesh.h"
#include "kerf/math.hpp"

namespace kerf {

/// A function at the samples of a grid. Negative inside bone; zero and NaN count as outside.
struct SampleGrid {
    std::array<int, 3> size{};  ///< samples along x, y, z
    double spacing = 0.0;       ///< [m]
    Vec3 origin{};              ///< [m] of sample (0, 0, 0)
    /// Returns the value at sample (i, j, k) of the grid. Called at most once for each sample.
    std::function<float(int, int, int)> value;
};

/// Returns the surface where `grid` is zero, as one welded mesh without holes.
///
/// Marching cubes. Where a face of a cell is ambiguous, inside corners are kept apart: parts that touch only across a
/// diagonal are two pieces, as with 6-connectivity of the samples. Each edge of the mesh always belongs to two
/// triangles that run along it in opposite directions. Samples outside the grid count as +1, so a solid that reaches
/// the grid's border is closed there. Vertices lie on edges of the grid where the linearly interpolated field is zero.
/// Where a sample is exactly zero, several vertices coincide and triangles may have no area. The numbering depends on
/// the field alone. Normals are unit gradients by central differences of the field; on closing faces they are the
/// normals of the faces. Leaves `Mesh::tissue` empty for the caller to fill.   [worker] pure if `value` is.
///
/// A simple implementation for any function; `BrickMesher` meshes bone faster. Source: [lorensen-1987].
[[nodiscard]] Mesh isosurface(const SampleGrid& grid);

}  // namespace kerf
