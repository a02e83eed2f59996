// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/field/surface/mesh.h"

namespace kerf::bone {

/// Returns the mesh as a binary STL file in millimetres, LPS. Leaves out triangles that repeat a vertex number, or
/// refer to one that does not exist.   [any]
[[nodiscard]] std::vector<unsigned char> stl_bytes(const Mesh& mesh);

/// What a mesh loses when it is written as STL, whose numbers have 24 bits.
struct StlLoss {
    double displacement = 0.0;  ///< [m] largest distance of a vertex from its written position
    std::size_t flattened = 0;  ///< faces whose written corners lie on a line, though the mesh's do not
};

/// Returns what `stl_bytes` loses.   [any] pure.
[[nodiscard]] StlLoss stl_loss(const Mesh& mesh);

}  // namespace kerf::bone
