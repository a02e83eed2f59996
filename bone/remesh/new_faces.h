// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "bone/surface/surface_mesh.h"

namespace kerf::bone {

/// Returns a flag for each face of a mesh: 1 if it is not in the mesh `before`, else 0. Faces are equal if their
/// corners are, bit for bit.   [any] pure.
[[nodiscard]] std::vector<std::uint8_t> new_faces_of(const SurfaceMesh& mesh, const SurfaceMesh& before);

}  // namespace kerf::bone
