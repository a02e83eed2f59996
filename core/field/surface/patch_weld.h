// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/field/surface/brick_mesher.h"
#include "core/field/surface/mesh.h"

namespace kerf {

/// Joins the patches of a grid into one mesh. Shared vertices are stored once. The mesh is closed if all of the grid's
/// patches are added: each edge belongs to two triangles that run along it in opposite directions. The numbering
/// depends on the patches alone.   [worker] one thread at a time.
class PatchWeld {
public:
    /// Reserves memory for this many vertices and triangles; more may be added.
    PatchWeld(const Grid& grid, std::size_t vertices, std::size_t triangles);

    /// Adds the patch of a brick. Pre: bricks in ascending order.
    void add(std::size_t brick, const PatchView& patch);
    [[nodiscard]] Mesh mesh() && { return static_cast<Mesh&&>(mesh_); }

private:
    struct Numbered {
        std::uint32_t fresh;                            ///< number of vertices that are new to the mesh
        std::array<const std::uint32_t*, 3> upper_end;  ///< end of the valid part of each list of `upper_`
    };
    /// Fills `number_`, `fresh_` and `upper_` for a patch.
    Numbered number(std::size_t brick, const PatchView& patch);
    /// Adds the first `fresh` vertices of `fresh_`, and the patch's triangles, to the mesh.
    void append(const PatchView& patch, std::size_t fresh);

    Grid grid_;
    Mesh mesh_;
    /// Mesh indices of the vertices that each brick has in common with its neighbours at +x, +y, +z, in its patch's
    /// order.
    std::vector<std::uint32_t> shared_;
    std::vector<std::array<std::uint32_t, 3>> first_shared_;  ///< by brick
    std::vector<std::uint32_t> number_;                       ///< mesh index of each vertex of the patch
    std::vector<std::uint32_t> fresh_, on_face_;              ///< vertices of the patch: new to the mesh; on a face
    std::array<std::vector<std::uint32_t>, 3> upper_;         ///< mesh indices of the vertices on its upper faces
    std::vector<Vec3> vertices_, normals_;                    ///< those that the patch adds
    std::vector<std::uint8_t> tissue_;
    std::vector<std::array<std::uint32_t, 3>> triangles_;
};

}  // namespace kerf
