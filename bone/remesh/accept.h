// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bone/remesh/remesh_request.h"

namespace kerf {

/// Returns the reason to refuse a result for a request, or an empty text. It checks: every edge has two faces
/// that run along it in opposite directions, except on the border of the request's mesh, which must come back; no two
/// faces cross, decided exactly; parts do not touch in a vertex only; no face lies twice; locked vertices came back bit
/// for bit; vertices lie within the box of a request's whole mesh.   [any] pure.
[[nodiscard]] std::string flaw_of_result(const RemeshRequest& request, const TaggedMesh& result);

/// The same for a patch of an accepted surface, with the ring of faces around it: only its new faces are compared with
/// the others.   [any] pure.
[[nodiscard]] std::string flaw_of_patch(const RemeshRequest& request, const TaggedMesh& result, const TaggedMesh& ring);

}  // namespace kerf
