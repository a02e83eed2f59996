// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bone/remesh/remesh_request.h"

namespace kerf::bone {

/// Returns the reason why a result differs from the cuts of its request, or an empty text. Three laws hold for any
/// method, each to `allowed` [m]:
///
///     no face of the result lies in the swept volume
///     each new face lies on the border of the swept volume, or on the mesh before the cut
///     the removed part of the mesh before the cut lies in the swept volume
///
/// They are checked at corners and centres of faces, with the exact distance to the swept solid. So they detect a
/// strategy that leaves bone in the path of the tool, removes bone outside it, or returns a mesh of another scale.
/// [worker] pure.
[[nodiscard]] std::string flaw_of_removal(const RemeshRequest& request, const TaggedMesh& result, double allowed);

/// Returns the reason why an unchanged mesh is wrong for a request, or an empty text.
[[nodiscard]] std::string flaw_of_unchanged(const RemeshRequest& request, double allowed);

/// Returns the allowed error of a strategy's surface [m]: its `tolerance`, twice the tolerance of a straight stretch,
/// and the nudges.
[[nodiscard]] double allowed_for(const RemeshRequest& request, double tolerance);

}  // namespace kerf::bone
