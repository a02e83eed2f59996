// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>

#include "core/field/surface/mesh.h"
#include "kerf/math.hpp"

namespace kerf {

/// A function known at the samples of a grid. Negative inside bone; zero, like NaN, counts as outside.
struct SampleGrid {
    std::array<int, 3> size{};  ///< samples along x, y, z
    double spacing = 0.0;       ///< [m]
    Vec3 origin{};              ///< [m] of sample (0, 0, 0)
    /// At sample (i, j, k), inside the grid only. Asked about each sample once.
    std::function<float(int, int, int)> value;
};

/// The surface where `grid` is zero, as one welded mesh without holes.
///
/// Marching cubes. Where a face of a cell is ambiguous, inside corners are kept apart: what touches only across a
/// diagonal stays two pieces, as 6-connectivity of the samples has it. Each edge of the mesh belongs to two triangles
/// that run along it in opposite directions, always. What lies outside the grid counts as +1, so a solid that reaches
/// the grid's border is closed there. Vertices stand where the field, linear along the grid's edge, is zero; where a
/// sample is exactly zero, several stand on one spot and triangles may have no area. Numbering follows from the field
/// alone. Normals come from central differences of the field; on the closing faces they are the face's own. Leaves
/// `Mesh::tissue` empty: that is the caller's.   [worker] pure if `value` is.
///
/// The plain way, for any function; bone is meshed faster by `BrickMesher`. Source: [lorensen-1987].
[[nodiscard]] Mesh isosurface(const SampleGrid& grid);

}  // namespace kerf
