// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "slivers.h"
#include "swept_parts.h"

/// CGAL behind a plain header: only booleans.cpp includes it.
namespace kerf::remesh_cgal {

enum class Outcome { cut, unchanged, refused, cancelled };

/// Removes the union of convex parts from a closed mesh, in exact arithmetic; only the result is rounded to doubles.
/// Refused: the mesh is not closed or not 2-manifold, or the result would not be; `why` is for people. Restores the
/// rounding mode whatever happens.   [worker] may take long
/// @param cancelled   asked between two steps
[[nodiscard]] Outcome cut_whole(Triangles& mesh, const std::vector<ConvexPart>& parts,
                                const std::function<bool()>& cancelled, std::string& why);

/// Removes convex parts one after the other from a piece of a mesh, which may have a border. Each part of the surface
/// between the lines of intersection is kept or dropped as a whole, by on which side of the other surface its faces
/// begin; long edges of intersection count more. A wrong decision leaves an open or crossing surface, which the host
/// refuses. No part may meet the border: the host gives a margin.   [worker]
/// @param is_exact   points are rounded at the end of each part only: slower by far, where rounded ones fail
[[nodiscard]] Outcome cut_patch(Triangles& patch, const std::vector<ConvexPart>& parts, bool is_exact,
                                const std::function<bool()>& cancelled, std::string& why);

/// The same as `cut_whole`, one part after the other with rounded points: what `cut_patch` is measured against.
/// [worker]
[[nodiscard]] Outcome cut_whole_rounded(Triangles& mesh, const std::vector<ConvexPart>& parts,
                                        const std::function<bool()>& cancelled, std::string& why);

}  // namespace kerf::remesh_cgal
