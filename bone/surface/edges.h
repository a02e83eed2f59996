// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bone/surface/surface_mesh.h"

namespace kerf::bone {

/// One side of a triangle, from its corner `side` to the next.
struct HalfEdge {
    std::uint32_t low = 0, high = 0;  ///< the two vertices, the smaller number first
    std::uint32_t face = 0;
    std::uint8_t side = 0;
    bool is_forward = false;  ///< the face runs from `low` to `high`

    [[nodiscard]] std::uint32_t from() const noexcept { return is_forward ? low : high; }
    [[nodiscard]] std::uint32_t to() const noexcept { return is_forward ? high : low; }
};

/// Returns all sides, grouped by edge, ordered by number of vertex and face. The order depends on the file alone.
[[nodiscard]] std::vector<HalfEdge> half_edges_of(const SurfaceMesh& mesh);

/// Calls visit(first, last) for the half-edges of each edge.
template <class Visit>
void for_each_edge(const std::vector<HalfEdge>& all, const Visit& visit) {
    for (std::size_t i = 0; i < all.size();) {
        std::size_t j = i + 1;
        while (j < all.size() && all[j].low == all[i].low && all[j].high == all[i].high) ++j;
        visit(all.data() + i, all.data() + j);
        i = j;
    }
}

/// Returns the number of faces that run along an edge forwards, less those that run backwards: 0 at every edge of a
/// closed, oriented surface.
[[nodiscard]] int balance_of(const HalfEdge* first, const HalfEdge* last) noexcept;

/// Part of the border of an open surface: its vertices in the direction of a face that would close it.
struct BorderLoop {
    std::vector<std::uint32_t> vertices;
    bool is_closed = true;  ///< the last vertex leads to the first; false if the border ends at an edge of three faces
};

/// Returns loops of edges that have one face only. Edges of more faces are left out.
[[nodiscard]] std::vector<BorderLoop> border_loops_of(const std::vector<HalfEdge>& edges);

/// Piece number of each face. Pieces are connected over edges, and numbered in the order of their first face.
struct Pieces {
    std::vector<std::uint32_t> of_face;
    std::uint32_t count = 0;
};
[[nodiscard]] Pieces pieces_of(const SurfaceMesh& mesh, const std::vector<HalfEdge>& edges);

/// Returns the vertices whose faces are not connected over edges at the vertex, ascending.
[[nodiscard]] std::vector<std::uint32_t> pinched_vertices_of(const SurfaceMesh& mesh,
                                                             const std::vector<HalfEdge>& edges);

}  // namespace kerf::bone
