// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/field/surface/mesh.h"
#include "documents/anatomy.h"

namespace kerf::documents {

/// Returns the surfaces of solids, each closed, with outward normals. Round ones are prisms and rings of 32 sides
/// inside the solid, at most 0.5 % of its radius off. Solids that overlap are not merged. No tissue.   [any] pure.
[[nodiscard]] Mesh mesh_of(const std::vector<Solid>& solids);

}  // namespace kerf::documents
