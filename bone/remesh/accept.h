// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bone/remesh/remesh_request.h"

namespace kerf::bone {

/// Returns the reason to refuse a result for a request, or an empty text. The checks are:
///
/// * Every edge has two faces that run along it in opposite directions. The border of the request's mesh is excepted;
///   it must be in the result.
/// * No two faces cross, decided exactly. No face is duplicated.
/// * Parts do not touch in a single vertex.
/// * Locked vertices are in the result, bit for bit.
/// * Vertices lie within the box of a request's whole mesh.
///
/// [any] pure.
[[nodiscard]] std::string flaw_of_result(const RemeshRequest& request, const TaggedMesh& result);

/// Returns the reason to refuse a patch of an accepted surface. `ring` has the faces around the patch. Only new faces
/// are compared with the others.   [any] pure.
[[nodiscard]] std::string flaw_of_patch(const RemeshRequest& request, const TaggedMesh& result, const TaggedMesh& ring);

}  // namespace kerf::bone
