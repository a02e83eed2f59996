// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bone/surface/read_surface.h"
#include "documents/anatomy.h"

/// What can be mended without inventing bone is mended, and said; the rest is refused with what to do.
///
///     E0649  holes that are wider than was allowed to close
///     E0650  an edge of three or more faces that bound no inside
///     E0651  faces that cannot all look outwards (as on a Möbius strip)
///     E0653  a piece inside another that could be a cavity or nothing
namespace kerf {

struct RepairRules {
    double holes_up_to = 0.0;   ///< [m] across: wider ones are refused
    double pieces_under = 0.0;  ///< [m³] smaller ones are left out
    InnerPieces inner = InnerPieces::unsaid;
};

/// Makes vertices one that lie at exactly the same place; the first one stays. Returns how many went.
std::size_t weld(SurfaceMesh& mesh);

/// Makes the surface closed, with all its faces looking outwards: leaves out faces that collapsed or are there twice,
/// joins borders that lie within a micrometre of each other, turns faces like their neighbours, closes holes, turns
/// pieces. Each step that did something adds a note.
/// Error: as above, and E0647 when no face is left; `mesh` is of no use then.   Pre: metres, LPS.   [any] pure.
[[nodiscard]] std::optional<SurfaceError> repair(SurfaceMesh& mesh, const RepairRules& rules,
                                                 std::vector<std::string>& notes);

/// Takes out of a mended surface all pieces that lie inside others, turned inside out: the rooms in it that hold no
/// bone.
[[nodiscard]] SurfaceMesh taken_cavities(SurfaceMesh& mesh);

}  // namespace kerf
