// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/field/surface/mesh.h"

namespace kerf {

/// The mesh as a binary STL file in millimetres, LPS. Triangles that repeat a vertex number, or name one that does
/// not exist, are left out.   [any]
[[nodiscard]] std::vector<unsigned char> stl_bytes(const Mesh& mesh);

}  // namespace kerf
