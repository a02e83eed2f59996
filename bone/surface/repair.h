// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bone/surface/read_surface.h"
#include "documents/anatomy.h"

/// Repairs flaws that need no invented bone, and reports each repair. Refuses all other flaws with advice.
///
///     E0649  holes wider than the allowed width
///     E0650  an edge of three or more faces that bound no inside
///     E0651  faces that cannot all be oriented outwards (as on a Möbius strip)
///     E0653  a piece inside another that could be a cavity or an artefact
namespace kerf::bone {

struct RepairRules {
    double holes_up_to = 0.0;   ///< [m] diameter; wider holes are refused
    double pieces_under = 0.0;  ///< [m³] smaller pieces are left out
    documents::InnerPieces inner = documents::InnerPieces::unsaid;
};

/// Merges vertices at exactly the same position; the first one stays. Returns the number of removed vertices.
std::size_t weld(SurfaceMesh& mesh);

/// Closes the surface and orients all its faces outwards. It drops collapsed and duplicate faces, joins borders within
/// a micrometre, orients faces like their neighbours, closes holes and orients pieces. Each step that changes the mesh
/// adds a note.
/// Error: as above, and E0647 if no face remains; then `mesh` is unusable. Pre: metres, LPS.   [any] pure.
[[nodiscard]] std::optional<SurfaceError> repair(SurfaceMesh& mesh, const RepairRules& rules,
                                                 std::vector<std::string>& notes);

/// Removes all pieces inside others from a repaired surface and returns them, turned inside out: the cavities without
/// bone.
[[nodiscard]] SurfaceMesh taken_cavities(SurfaceMesh& mesh);

}  // namespace kerf::bone
