// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/field/cut/cut_field.h"
#include "core/field/surface/mesh.h"

namespace kerf {

/// Returns the surface of the remaining bone, cut off flat at its region: closed, welded, anticlockwise from outside,
/// with the material at each vertex (body frame [m]). Uses every `stride`-th sample.   [worker]
[[nodiscard]] Mesh bone_surface(const Body& body, const CutField& cut, int stride = 1);

}  // namespace kerf
