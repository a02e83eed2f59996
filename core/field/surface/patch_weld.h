// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/field/surface/brick_mesher.h"
#include "core/field/surface/mesh.h"

namespace kerf {

/// One mesh of the patches of a grid: what two of them have in common is there once. Closed, if all of the grid's
/// patches are added: each edge belongs to two triangles that run along it in opposite directions. Numbering follows
/// from the patches alone.   [worker] one thread at a time.
class PatchWeld {
public:
    /// Makes room for so many vertices and triangles; more may come.
    PatchWeld(const Grid& grid, std::size_t vertices, std::size_t triangles);

    /// Pre: bricks in ascending order.
    void add(std::size_t brick, const PatchView& patch);
    [[nodiscard]] Mesh mesh() && { return static_cast<Mesh&&>(mesh_); }

private:
    Grid grid_;
    Mesh mesh_;
    /// Numbers of the vertices that a brick's upper neighbours will have too, at +x, +y, +z, in the order of the patch.
    std::vector<std::uint32_t> shared_;
    std::vector<std::array<std::uint32_t, 3>> first_shared_;  ///< by brick
    std::vector<std::uint32_t> number_;                       ///< in the mesh, of the vertices of the patch
    std::vector<std::uint32_t> fresh_, on_face_;       ///< vertices of the patch: that are new, that may be shared
    std::array<std::vector<std::uint32_t>, 3> upper_;  ///< numbers of those that are shared
    std::vector<Vec3> vertices_, normals_;             ///< what a patch adds
    std::vector<std::uint8_t> tissue_;
    std::vector<std::array<std::uint32_t, 3>> triangles_;
};

}  // namespace kerf
