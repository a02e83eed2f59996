// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/field/surface/mesh.h"
#include "run/view/viewed_run.h"

namespace kerf::run {

/// Returns a surface in single precision. Triangles without area, and points of no triangle, are left out.   [main]
[[nodiscard]] ViewedMesh viewed(const Mesh& mesh);

}  // namespace kerf::run
