// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bone/remesh/remesh_request.h"

namespace kerf {

/// Returns the reason why a result is not what the cuts of its request leave, or an empty text. Three laws hold for any
/// method, each to `allowed` [m]:
///
///     no face of the result lies in what the tools sweep
///     each new face lies on the border of what they sweep, or on the mesh as it was
///     what is missing of the mesh as it was lies in what they sweep
///
/// They are checked at corners and centres of faces, with the exact distance to the swept solid. So they find a
/// strategy that leaves bone in the path of the tool, takes some beside it or returns a mesh of another scale. [worker]
/// pure.
[[nodiscard]] std::string flaw_of_removal(const RemeshRequest& request, const TaggedMesh& result, double allowed);

/// The same for a strategy that returns the mesh as it was.
[[nodiscard]] std::string flaw_of_unchanged(const RemeshRequest& request, double allowed);

/// How far a surface that a strategy makes to `tolerance` [m] may be off: that, the path of a stretch, which is
/// straight to twice its own tolerance, and the nudges.
[[nodiscard]] double allowed_for(const RemeshRequest& request, double tolerance);

}  // namespace kerf
