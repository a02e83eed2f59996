// SPDX-License-Identifier: Apache-2.0
#include "bone/surface/edges.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace kerf::bone {

std::vector<HalfEdge> half_edges_of(const SurfaceMesh& mesh) {
    std::vector<HalfEdge> all;
    all.reserve(3 * mesh.triangles.size());
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
        for (std::uint8_t side = 0; side < 3; ++side) {
            const std::uint32_t from = mesh.triangles[f][side], to = mesh.triangles[f][(side + 1u) % 3u];
            all.push_back({std::min(from, to), std::max(from, to), static_cast<std::uint32_t>(f), side, from < to});
        }
    std::sort(all.begin(), all.end(), [](const HalfEdge& a, const HalfEdge& b) {
        return std::tie(a.low, a.high, a.face, a.side) < std::tie(b.low, b.high, b.face, b.side);
    });
    return all;
}

int balance_of(const HalfEdge* first, const HalfEdge* last) noexcept {
    int balance = 0;
    for (; first != last; ++first) balance += first->is_forward ? 1 : -1;
    return balance;
}

std::vector<BorderLoop> border_loops_of(const std::vector<HalfEdge>& edges) {
    struct Step {
        std::uint32_t from, to;
        bool is_used = false;
    };
    std::vector<Step> steps;  // against the direction of the only face
    for_each_edge(edges, [&](const HalfEdge* first, const HalfEdge* last) {
        if (last - first == 1) steps.push_back({first->to(), first->from()});
    });
    std::sort(steps.begin(), steps.end(),
              [](const Step& a, const Step& b) { return std::tie(a.from, a.to) < std::tie(b.from, b.to); });
    const auto next_from = [&](std::uint32_t v) {
        auto at =
            std::lower_bound(steps.begin(), steps.end(), v, [](const Step& s, std::uint32_t n) { return s.from < n; });
        while (at != steps.end() && at->from == v && at->is_used) ++at;
        return at != steps.end() && at->from == v ? at : steps.end();
    };
    std::vector<BorderLoop> loops;
    for (Step& start : steps) {
        if (start.is_used) continue;
        start.is_used = true;
        BorderLoop loop{{start.from}, true};
        for (std::uint32_t at = start.to; at != start.from;) {
            loop.vertices.push_back(at);
            const auto step = next_from(at);
            if (step == steps.end()) {
                loop.is_closed = false;
                break;
            }
            step->is_used = true;
            at = step->to;
        }
        loops.push_back(std::move(loop));
    }
    return loops;
}

Pieces pieces_of(const SurfaceMesh& mesh, const std::vector<HalfEdge>& edges) {
    std::vector<std::uint32_t> parent(mesh.triangles.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t f) {
        while (parent[f] != f) f = parent[f] = parent[parent[f]];
        return f;
    };
    for_each_edge(edges, [&](const HalfEdge* first, const HalfEdge* last) {
        for (const HalfEdge* e = first + 1; e < last; ++e) {
            const std::uint32_t a = root(first->face), b = root(e->face);
            parent[std::max(a, b)] = std::min(a, b);
        }
    });
    Pieces pieces;
    pieces.of_face.resize(mesh.triangles.size());
    for (std::uint32_t f = 0; f < pieces.of_face.size(); ++f) {
        const std::uint32_t r = root(f);  // never above f
        pieces.of_face[f] = r == f ? pieces.count++ : pieces.of_face[r];
    }
    return pieces;
}

std::vector<std::uint32_t> pinched_vertices_of(const SurfaceMesh& mesh, const std::vector<HalfEdge>& edges) {
    // Corners (face, corner) at one vertex that are connected over edges form a fan.
    std::vector<std::uint32_t> parent(3 * mesh.triangles.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t c) {
        while (parent[c] != c) c = parent[c] = parent[parent[c]];
        return c;
    };
    const auto corner_at = [&](const HalfEdge& e, std::uint32_t vertex) {
        for (std::uint32_t c = 0; c < 3; ++c)
            if (mesh.triangles[e.face][c] == vertex) return 3 * e.face + c;
        return 3 * e.face;
    };
    for_each_edge(edges, [&](const HalfEdge* first, const HalfEdge* last) {
        for (const HalfEdge* e = first + 1; e < last; ++e)
            for (const std::uint32_t vertex : {first->low, first->high}) {
                const std::uint32_t a = root(corner_at(*first, vertex)), b = root(corner_at(*e, vertex));
                parent[std::max(a, b)] = std::min(a, b);
            }
    });
    std::vector<std::uint32_t> fans(mesh.vertices.size(), 0);
    for (std::uint32_t c = 0; c < parent.size(); ++c)
        if (root(c) == c) ++fans[mesh.triangles[c / 3][c % 3]];
    std::vector<std::uint32_t> pinched;
    for (std::uint32_t v = 0; v < fans.size(); ++v)
        if (fans[v] > 1) pinched.push_back(v);
    return pinched;
}

}  // namespace kerf::bone
