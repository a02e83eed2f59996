// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/import/surface/surface_mesh.h"

namespace kerf {

/// An exact surface: triangles in double precision, body frame [m], and where each of them comes from.
struct TaggedMesh {
    SurfaceMesh mesh;
    std::vector<std::uint8_t> tags;  ///< of each triangle: KERF_FACE_…
};

}  // namespace kerf
