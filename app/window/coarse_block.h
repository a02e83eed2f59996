// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "run/view/viewed_run.h"

namespace kerf::window {

/// A block of bricks: `edge` bricks along each axis, from this brick on.
struct Block {
    static constexpr int edge = 2;
    std::array<int, 3> first_brick{};
};

/// The surface of a block.
struct BlockMesh {
    std::vector<run::ViewedVertex> vertices{};
    std::vector<std::array<std::uint16_t, 3>> triangles{};
};

/// Returns the patches of a block as one mesh. With `lattice` > 1, vertices that lie in one cell of `lattice` voxels,
/// and have the same tissue and the same main direction of the normal, become one, and triangles without area are left
/// out. Vertices that also belong to other blocks stay as they are. So blocks of any lattice fit together without a
/// gap. [any] pure
/// @param lattice  edge of a cell [voxels]; 1: nothing is merged
[[nodiscard]] BlockMesh block_mesh(const run::ViewedBodySurface& surface, const Block& block, int lattice);

}  // namespace kerf::window
