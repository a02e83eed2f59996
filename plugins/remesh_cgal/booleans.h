// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "slivers.h"
#include "swept_parts.h"

/// CGAL behind a plain header: only booleans.cpp includes it.
namespace kerf::remesh_cgal {

using remeshing::Cancelled, remeshing::Outcome;

/// Removes the union of convex parts from a closed mesh, in exact arithmetic. Only the result is rounded to doubles.
/// Refuses a mesh that is not closed or not 2-manifold, and a result that would not be; `why` is text for people.
/// Always restores the rounding mode.   [worker] may take long
/// @param cancelled  called between steps; true ends the work
[[nodiscard]] Outcome cut_whole(Triangles& mesh, const std::vector<ConvexPart>& parts, const Cancelled& cancelled,
                                std::string& why);

/// Removes convex parts one after the other from a patch, which may have a border. Each stretch of the surface between
/// lines of intersection is kept or dropped as a whole. The side on which its faces begin at these lines decides; long
/// edges count more. A wrong decision leaves an open or crossing surface, which the host refuses. No part may meet the
/// border, so the host adds a margin.   [worker]
/// @param is_exact  rounds points only at the end of each part; far slower, for patches where rounded points fail
[[nodiscard]] Outcome cut_patch(Triangles& patch, const std::vector<ConvexPart>& parts, bool is_exact,
                                const Cancelled& cancelled, std::string& why);

/// Does the work of `cut_whole` one part after the other, with rounded points. It is the baseline of `cut_patch` in
/// measurements.   [worker]
[[nodiscard]] Outcome cut_whole_rounded(Triangles& mesh, const std::vector<ConvexPart>& parts,
                                        const Cancelled& cancelled, std::string& why);

}  // namespace kerf::remesh_cgal
