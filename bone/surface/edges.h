// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bone/surface/surface_mesh.h"

namespace kerf {

/// One side of a triangle, from its corner `side` to the next.
struct HalfEdge {
    std::uint32_t low = 0, high = 0;  ///< the two vertices, the smaller number first
    std::uint32_t face = 0;
    std::uint8_t side = 0;
    bool is_forward = false;  ///< the face runs from `low` to `high`

    [[nodiscard]] std::uint32_t from() const noexcept { return is_forward ? low : high; }
    [[nodiscard]] std::uint32_t to() const noexcept { return is_forward ? high : low; }
};

/// All sides, those of one edge together, by number of vertex and face: the order of the file and of nothing else.
[[nodiscard]] std::vector<HalfEdge> half_edges_of(const SurfaceMesh& mesh);

/// visit(first, last) for the half-edges of each edge.
template <class Visit>
void for_each_edge(const std::vector<HalfEdge>& all, const Visit& visit) {
    for (std::size_t i = 0; i < all.size();) {
        std::size_t j = i + 1;
        while (j < all.size() && all[j].low == all[i].low && all[j].high == all[i].high) ++j;
        visit(all.data() + i, all.data() + j);
        i = j;
    }
}

/// How many more faces run along an edge forwards than backwards: 0 at every edge of a closed, oriented surface.
[[nodiscard]] int balance_of(const HalfEdge* first, const HalfEdge* last) noexcept;

/// Part of the border of an open surface: its vertices in the direction in which a face that closes it would run.
struct BorderLoop {
    std::vector<std::uint32_t> vertices;
    bool is_closed = true;  ///< the last vertex leads to the first; not so where it ends at an edge of three faces
};

/// Loops of edges that have a face on one side only. Edges of more faces take no part.
[[nodiscard]] std::vector<BorderLoop> border_loops_of(const std::vector<HalfEdge>& edges);

/// Number of the piece for every face; pieces hang together over edges, and are counted in the order of their first
/// face.
struct Pieces {
    std::vector<std::uint32_t> of_face;
    std::uint32_t count = 0;
};
[[nodiscard]] Pieces pieces_of(const SurfaceMesh& mesh, const std::vector<HalfEdge>& edges);

/// Vertices whose faces do not hang together over edges that end in them, ascending.
[[nodiscard]] std::vector<std::uint32_t> pinched_vertices_of(const SurfaceMesh& mesh,
                                                             const std::vector<HalfEdge>& edges);

}  // namespace kerf
