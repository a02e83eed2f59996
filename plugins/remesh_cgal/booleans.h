// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "swept_parts.h"

/// CGAL behind a plain header: only booleans.cpp includes it.
namespace kerf::remesh_cgal {

/// Triangles with tags, as they cross the boundary.
struct Triangles {
    std::vector<double> vertices;          ///< x, y, z of each [m]
    std::vector<std::uint32_t> triangles;  ///< three corners of each, anticlockwise seen from outside
    std::vector<std::uint8_t> tags;        ///< of each triangle: KERF_FACE_…
};

enum class Outcome { cut, unchanged, refused, cancelled };

/// Removes the union of convex parts from a closed mesh, in exact arithmetic; only the result is rounded to doubles.
/// Refused: the mesh is not closed or not 2-manifold, or the result would not be; `why` is for people. Restores the
/// rounding mode whatever happens.   [worker] may take long
/// @param cancelled   asked between two steps
[[nodiscard]] Outcome cut_whole(Triangles& mesh, const std::vector<ConvexPart>& parts,
                                const std::function<bool()>& cancelled, std::string& why);

/// The library, its version and the flags that results depend on.
[[nodiscard]] const char* kernel() noexcept;

}  // namespace kerf::remesh_cgal
