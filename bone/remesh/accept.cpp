// SPDX-License-Identifier: Apache-2.0
#include "bone/remesh/accept.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <tuple>
#include <vector>

#include "bone/remesh/base_mesh.h"
#include "bone/remesh/new_faces.h"
#include "bone/surface/crossings.h"
#include "bone/surface/diagnose.h"
#include "bone/surface/edges.h"
#include "bone/surface/orient3d.h"

namespace kerf::bone {
namespace {

bool less(Vec3 a, Vec3 b) noexcept { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

/// A border edge by its ends, in the direction of its face. Vertex numbers may change, positions may not.
struct BorderEdge {
    Vec3 from, to;
    friend bool operator==(const BorderEdge& a, const BorderEdge& b) { return a.from == b.from && a.to == b.to; }
};

/// Returns the first flaw of a mesh's edges, or an empty text; `border` receives its border, sorted.
std::string flaw_of_edges(const SurfaceMesh& mesh, const std::vector<HalfEdge>& edges,
                          std::vector<BorderEdge>& border) {
    std::string flaw;
    for_each_edge(edges, [&](const HalfEdge* first, const HalfEdge* last) {
        if (!flaw.empty()) return;
        const Vec3 from = mesh.vertices[first->from()], to = mesh.vertices[first->to()];
        if (last - first > 2)
            flaw = "an edge has more than two faces, at " + position_text(from);
        else if (last - first == 1)
            border.push_back({from, to});
        else if (balance_of(first, last) != 0)
            flaw = "the faces of an edge look to different sides, at " + position_text(from);
    });
    std::sort(border.begin(), border.end(), [](const BorderEdge& a, const BorderEdge& b) {
        return less(a.from, b.from) || (a.from == b.from && less(a.to, b.to));
    });
    return flaw;
}

/// Returns whether two faces have the same corners, in either orientation.
bool has_faces_twice(const SurfaceMesh& mesh) {
    std::vector<Triangle> sorted = mesh.triangles;
    for (Triangle& t : sorted) std::sort(t.begin(), t.end());
    std::sort(sorted.begin(), sorted.end());
    return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

/// Returns whether an inner edge of a mesh is also an edge of the ring: it would have four faces.
bool has_edge_of(const TaggedMesh& ring, const SurfaceMesh& mesh, const std::vector<HalfEdge>& edges) {
    const auto sorted = [](Vec3 a, Vec3 b) { return less(b, a) ? BorderEdge{b, a} : BorderEdge{a, b}; };
    const auto before = [](const BorderEdge& a, const BorderEdge& b) {
        return less(a.from, b.from) || (a.from == b.from && less(a.to, b.to));
    };
    std::vector<BorderEdge> beyond;
    for (const Triangle& t : ring.mesh.triangles) {
        const auto corners = ring.mesh.corners(t);
        for (std::size_t i = 0; i < 3; ++i) beyond.push_back(sorted(corners[i], corners[(i + 1) % 3]));
    }
    std::sort(beyond.begin(), beyond.end(), before);
    bool has_one = false;
    for_each_edge(edges, [&](const HalfEdge* first, const HalfEdge* last) {
        if (last - first != 2 || has_one || beyond.empty()) return;
        const BorderEdge edge = sorted(mesh.vertices[first->low], mesh.vertices[first->high]);
        has_one = std::binary_search(beyond.begin(), beyond.end(), edge, before);
    });
    return has_one;
}

/// @param before  a mesh whose faces cross neither each other nor the ring; null: all faces are tested
std::string flaw_of_faces(const SurfaceMesh& mesh, const TaggedMesh& ring, const SurfaceMesh* before) {
    const std::size_t count = mesh.triangles.size();
    SurfaceMesh both = mesh;
    const auto first = static_cast<std::uint32_t>(both.vertices.size());
    both.vertices.insert(both.vertices.end(), ring.mesh.vertices.begin(), ring.mesh.vertices.end());
    for (const Triangle& t : ring.mesh.triangles) both.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    std::vector<std::uint8_t> is_tested(both.triangles.size(), 1);
    std::fill(is_tested.begin() + static_cast<std::ptrdiff_t>(count), is_tested.end(), std::uint8_t{0});
    if (before != nullptr) {
        const std::vector<std::uint8_t> is_new = new_faces_of(mesh, *before);
        std::copy(is_new.begin(), is_new.end(), is_tested.begin());
    }
    const auto crossings = crossings_of(both, TriangleTree(both), true, is_tested);
    if (crossings.empty()) return {};
    return std::to_string(crossings.size()) + (crossings.size() == 1 ? " pair" : " pairs") +
           " of faces cross, the first at " + position_text(both.vertices[both.triangles[crossings.front()[0]][0]]);
}

/// Returns the difference between a border and the border before the cut.
std::string flaw_of_border(const std::vector<BorderEdge>& border, const std::vector<BorderEdge>& before) {
    const auto is_less = [](const BorderEdge& a, const BorderEdge& b) {
        return less(a.from, b.from) || (a.from == b.from && less(a.to, b.to));
    };
    std::vector<BorderEdge> more, missing;
    std::set_difference(border.begin(), border.end(), before.begin(), before.end(), std::back_inserter(more), is_less);
    std::set_difference(before.begin(), before.end(), border.begin(), border.end(), std::back_inserter(missing),
                        is_less);
    if (missing.empty())
        return std::to_string(more.size()) + " open edges within its border, the first at " +
               position_text(more.front().from);
    return std::to_string(missing.size()) + (missing.size() == 1 ? " edge" : " edges") +
           " of its border did not come back, the first at " + position_text(missing.front().from);
}

/// Refuses more faces than any tolerance needs. A strategy that splits all faces in each call would soon need minutes
/// for the checks.
std::string flaw_of_count(const RemeshRequest& request, const SurfaceMesh& mesh) {
    const std::size_t before = request.base.mesh.triangles.size(), count = mesh.triangles.size();
    constexpr std::size_t few = 50000;  // so many are checked quickly
    if (count <= std::max(before, few)) return {};
    const double largest = area_of(mesh) / (request.tolerance * request.tolerance);
    if (static_cast<double>(count) <= largest) return {};
    return "it has " + std::to_string(count) + " faces, before the cut " + std::to_string(before) + "; a surface to " +
           std::to_string(std::lround(request.tolerance * 1e6)) + " um needs fewer than " +
           std::to_string(std::llround(largest));
}

/// Returns the vertices of a mesh, sorted by position.
std::vector<Vec3> sorted_vertices(const SurfaceMesh& mesh) {
    std::vector<Vec3> vertices = mesh.vertices;
    std::sort(vertices.begin(), vertices.end(), less);
    return vertices;
}

/// @param ring  null: the result is a whole mesh
std::string flaw_of(const RemeshRequest& request, const TaggedMesh& result, const TaggedMesh* ring) {
    const SurfaceMesh& mesh = result.mesh;
    if (result.tags.size() != mesh.triangles.size()) return "not every face has a tag";
    if (std::string flaw = flaw_of_count(request, mesh); !flaw.empty()) return flaw;
    std::vector<BorderEdge> border_before, border;
    if (std::string flaw = flaw_of_edges(request.base.mesh, half_edges_of(request.base.mesh), border_before);
        !flaw.empty())
        return "the mesh that was to be cut is unsound: " + flaw;
    if (mesh.triangles.empty()) return border_before.empty() ? "" : "nothing is left, not even its border";
    for (const Triangle& t : mesh.triangles)
        if (has_no_area(mesh, t)) return "a face has no area, at " + position_text(mesh.vertices[t[0]]);

    if (has_faces_twice(mesh)) return "a face lies twice";
    const std::vector<HalfEdge> edges = half_edges_of(mesh);
    if (std::string flaw = flaw_of_edges(mesh, edges, border); !flaw.empty()) return flaw;
    if (border_before.empty() && !border.empty())
        return std::to_string(border.size()) + " open edges, the first at " + position_text(border.front().from);
    if (border != border_before) return flaw_of_border(border, border_before);
    if (ring != nullptr && has_edge_of(*ring, mesh, edges))
        return "an edge has two faces, and two more beyond the border";
    if (const auto pinched = pinched_vertices_of(mesh, edges); !pinched.empty())
        return "parts only touch in a vertex, at " + position_text(mesh.vertices[pinched.front()]);
    const std::vector<Vec3> vertices = sorted_vertices(mesh);
    for (std::size_t v = 1; v < vertices.size(); ++v)
        if (vertices[v] == vertices[v - 1])
            return "a vertex lies where another one is, at " + position_text(vertices[v]);
    for (std::size_t v = 0; v < request.locked.size(); ++v)
        if (request.locked[v] != 0 &&
            !std::binary_search(vertices.begin(), vertices.end(), request.base.mesh.vertices[v], less))
            return "a locked vertex has moved, from " + position_text(request.base.mesh.vertices[v]);
    const Box was = bounds_of(request.base.mesh), is = bounds_of(mesh);
    if (border.empty() && (is.low.x < was.low.x || is.low.y < was.low.y || is.low.z < was.low.z ||
                           is.high.x > was.high.x || is.high.y > was.high.y || is.high.z > was.high.z))
        return "it reaches beyond what it was";  // walls of an open patch may reach beyond
    return ring != nullptr ? flaw_of_faces(mesh, *ring, &request.base.mesh) : flaw_of_faces(mesh, {}, nullptr);
}

}  // namespace

std::string flaw_of_result(const RemeshRequest& request, const TaggedMesh& result) {
    return flaw_of(request, result, nullptr);
}

std::string flaw_of_patch(const RemeshRequest& request, const TaggedMesh& result, const TaggedMesh& ring) {
    return flaw_of(request, result, &ring);
}

}  // namespace kerf::bone
