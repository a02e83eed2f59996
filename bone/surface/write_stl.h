// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/field/surface/mesh.h"

namespace kerf::bone {

/// Returns the mesh as a binary STL file in millimetres, LPS. Leaves out triangles that repeat a vertex number, or
/// refer to one that does not exist.   [any]
[[nodiscard]] std::vector<unsigned char> stl_bytes(const Mesh& mesh);

}  // namespace kerf::bone
