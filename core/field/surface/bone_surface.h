// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/field/cut/cut_field.h"
#include "core/field/surface/mesh.h"

namespace kerf {

/// Returns the surface of the remaining bone, cut off flat at the faces of its region (body frame [m]). It is closed
/// and welded, and has the material at each vertex. Uses every `stride`-th sample along each axis.   [worker]
[[nodiscard]] Mesh bone_surface(const Body& body, const CutField& cut, int stride = 1);

}  // namespace kerf
