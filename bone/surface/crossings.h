// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bone/surface/triangle_tree.h"

namespace kerf::bone {

/// Two faces of one surface that meet outside their common corners and sides.
using Crossing = std::array<std::uint32_t, 2>;  ///< the smaller number first

/// Returns all crossings, by number, decided exactly. Corners at the same position are common, whatever their numbers.
/// Faces with the same three corners, and faces without area, are not crossings; they are separate flaws.
/// `test_needles` also tests faces that are nowhere wider than a nanometre, but have an area. The last argument has a 0
/// for each face of which it is known that no two such faces cross; empty: nothing is known.
[[nodiscard]] std::vector<Crossing> crossings_of(const SurfaceMesh& mesh, const TriangleTree& tree,
                                                 bool test_needles = false,
                                                 const std::vector<std::uint8_t>& is_tested = {});

/// Returns whether a face has no area: it is nowhere wider than a nanometre. An area is exactly zero only in the unit
/// of its file, because metres are rounded.   [any] pure.
[[nodiscard]] bool is_flat(Vec3 a, Vec3 b, Vec3 c) noexcept;

}  // namespace kerf::bone
