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

using Edge = std::pair<std::uint32_t, std::uint32_t>;  ///< vertex numbers, the smaller first

/// Returns the edges with one face, sorted.   [any] pure.
[[nodiscard]] std::vector<Edge> border_of(const Triangles& mesh);

/// Returns whether a face has to be split. It is called once for each face, including the faces that splits make.
/// `longest` is the length of its longest side that can be split [m]; 0 if all are on the border.
using WantsSplit = std::function<bool(const Triangles& mesh, std::uint32_t face, double longest)>;
/// Returns the new vertex of an edge.
using Middle = std::function<Vec3(Vec3 a, Vec3 b)>;

/// Splits faces in four, in the pattern of Loop's subdivision, until `wants_split` is false for all. Neighbours differ
/// by one level at most. A face next to a more split one is halved at the end (green closure), so the mesh stays
/// conforming. Border edges stay: their faces are split in three or in two. Vertices keep their numbers and positions;
/// there is no smoothing mask. Returns false beyond `max_faces`.   [any] pure.
///
/// Source: [loop-1987] for the pattern; [bank-1983] for the closure.
[[nodiscard]] bool refine(Triangles& mesh, const WantsSplit& wants_split, const Middle& middle, std::size_t max_faces);

}  // namespace kerf::burring::displacement
