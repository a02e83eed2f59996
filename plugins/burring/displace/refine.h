// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "kerf/remesh_mesh.hpp"

namespace kerf::burring::displacement {

using remeshing::Triangles;

using Edge = std::pair<std::uint32_t, std::uint32_t>;  ///< its vertices, the smaller number first

/// Returns the edges with one face, sorted.   [any] pure.
[[nodiscard]] std::vector<Edge> border_of(const Triangles& mesh);

/// Whether a face has to be split. Called once for each face, and once for each face that a split makes. `longest` is
/// the length of its longest side that can be split [m]; 0 if all are on the border.
using WantsSplit = std::function<bool(const Triangles& mesh, std::uint32_t face, double longest)>;
/// The new vertex of an edge.
using Middle = std::function<Vec3(Vec3 a, Vec3 b)>;

/// Splits faces in four, as the pattern of Loop's subdivision does, until no face wants it. Neighbours differ by one
/// level at most; a face beside one that is split more is halved at the end (green closure), so the mesh stays
/// conforming. Edges with one face stay: their faces are split in three or in two. Vertices keep their numbers and
/// positions; there is no smoothing mask. Returns false beyond `most_faces`.   [any] pure.
///
/// Source: [loop-1987] for the pattern; [bank-1983] for the closure.
[[nodiscard]] bool refine(Triangles& mesh, const WantsSplit& wants_split, const Middle& middle, std::size_t most_faces);

}  // namespace kerf::burring::displacement
