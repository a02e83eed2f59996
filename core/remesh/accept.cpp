// SPDX-License-Identifier: Apache-2.0
#include "core/remesh/accept.h"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <vector>

#include "core/import/surface/crossings.h"
#include "core/import/surface/diagnose.h"

namespace kerf {
namespace {

bool less(Vec3 a, Vec3 b) noexcept { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

/// A border edge by its ends, in the direction of its face. Numbers of vertices change; positions must not.
struct BorderEdge {
    Vec3 from, to;
    friend bool operator==(const BorderEdge& a, const BorderEdge& b) { return a.from == b.from && a.to == b.to; }
};

std::vector<BorderEdge> border_of(const SurfaceMesh& mesh) {
    std::vector<BorderEdge> border;
    const std::vector<HalfEdge> edges = half_edges_of(mesh);
    for_each_edge(edges, [&](const HalfEdge* first, const HalfEdge* last) {
        if (last - first == 1) border.push_back({mesh.vertices[first->from()], mesh.vertices[first->to()]});
    });
    std::sort(border.begin(), border.end(), [](const BorderEdge& a, const BorderEdge& b) {
        return less(a.from, b.from) || (a.from == b.from && less(a.to, b.to));
    });
    return border;
}

std::string flaw(const Flaw& one, const char* what) {
    return std::to_string(one.count) + what + ", the first at " + place_text(one.at);
}

/// Whether two corners of a face are one point.
bool is_collapsed(const SurfaceMesh& mesh, const Triangle& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0] || mesh.vertices[t[0]] == mesh.vertices[t[1]] ||
           mesh.vertices[t[1]] == mesh.vertices[t[2]] || mesh.vertices[t[2]] == mesh.vertices[t[0]];
}

}  // namespace

std::string flaw_of_result(const RemeshRequest& request, const TaggedMesh& result) {
    const SurfaceMesh& mesh = result.mesh;
    if (mesh.triangles.empty()) return {};  // all of it is gone
    if (result.tags.size() != mesh.triangles.size()) return "not every face has a tag";
    for (const Triangle& t : mesh.triangles)
        if (is_collapsed(mesh, t)) return "a face has no area at " + place_text(mesh.vertices[t[0]]);

    const SurfaceDiagnosis found = diagnose(mesh, 1.0);
    if (found.crowded_edges.count > 0) return flaw(found.crowded_edges, " edges of more than two faces");
    if (found.turned_edges.count > 0) return flaw(found.turned_edges, " edges whose faces look to different sides");
    const std::vector<BorderEdge> before = border_of(request.base.mesh), after = border_of(mesh);
    if (before.empty() && found.open_edges.count > 0) return flaw(found.open_edges, " open edges");
    if (before != after) return "its border is another one";
    if (found.pinched_vertices.count > 0) return flaw(found.pinched_vertices, " vertices where parts only touch");
    if (found.duplicate_vertices.count > 0) return flaw(found.duplicate_vertices, " vertices where another one is");
    if (found.duplicate_faces.count > 0) return flaw(found.duplicate_faces, " faces that are there twice");
    if (const auto crossings = crossings_of(mesh, TriangleTree(mesh), true); !crossings.empty())
        return std::to_string(crossings.size()) + " pairs of faces that cross, the first at " +
               place_text(mesh.vertices[mesh.triangles[crossings.front()[0]][0]]);

    if (!request.locked.empty()) {
        std::vector<Vec3> vertices = mesh.vertices;
        std::sort(vertices.begin(), vertices.end(), less);
        for (std::size_t v = 0; v < request.locked.size(); ++v)
            if (request.locked[v] != 0 &&
                !std::binary_search(vertices.begin(), vertices.end(), request.base.mesh.vertices[v], less))
                return "a locked vertex has moved, from " + place_text(request.base.mesh.vertices[v]);
    }
    const Box was = bounds_of(request.base.mesh), is = bounds_of(mesh);
    if (is.low.x < was.low.x || is.low.y < was.low.y || is.low.z < was.low.z || is.high.x > was.high.x ||
        is.high.y > was.high.y || is.high.z > was.high.z)
        return "it reaches beyond what it was";
    return {};
}

}  // namespace kerf
