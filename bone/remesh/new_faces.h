// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "bone/surface/surface_mesh.h"

namespace kerf {

/// Returns for each face of a mesh whether it is none of another mesh: 1, or 0. Faces are the same if their corners
/// are, bit for bit.   [any] pure.
[[nodiscard]] std::vector<std::uint8_t> new_faces_of(const SurfaceMesh& mesh, const SurfaceMesh& before);

}  // namespace kerf
