// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bone/surface/triangle_tree.h"

namespace kerf {

/// Two faces of one surface that meet elsewhere than at corners and sides they share.
using Crossing = std::array<std::uint32_t, 2>;  ///< the smaller number first

/// All of them, by number; decided exactly. Corners at the same place count as shared, whatever their number. Faces
/// that have the same three corners, and faces without area, are not crossings but flaws of their own.
/// @param needles   whether faces that are nowhere wider than a nanometre, but have an area, are judged too
/// @param asked     of each face: 0 if two such faces are known not to cross; empty: nothing is known
[[nodiscard]] std::vector<Crossing> crossings_of(const SurfaceMesh& mesh, const TriangleTree& tree,
                                                 bool needles = false, const std::vector<std::uint8_t>& asked = {});

/// Whether a face has no area: it is nowhere wider than a nanometre. (Exactly none it has only in its file's unit;
/// metres are rounded.)   [any] pure.
[[nodiscard]] bool is_flat(Vec3 a, Vec3 b, Vec3 c) noexcept;

}  // namespace kerf
