// SPDX-License-Identifier: Apache-2.0
#include "half_edges.h"

#include <cstddef>

namespace kerf::burring::displacement {

bool load(const Triangles& mesh, HalfEdges& half_edges, FaceTags& tags) {
    omerr().disable();  // our own message reports faces that it cannot add
    half_edges.add_property(tags, "tag");
    for (const Vec3 v : mesh.vertices) half_edges.add_vertex(point_of(v));
    const auto& t = mesh.triangles;
    for (std::size_t f = 0; f < mesh.tags.size(); ++f) {
        const auto corner = [&](std::size_t i) { return half_edges.vertex_handle(t[3 * f + i]); };
        const auto face = half_edges.add_face(corner(0), corner(1), corner(2));
        if (!face.is_valid()) return false;
        half_edges.property(tags, face) = mesh.tags[f];
    }
    return true;
}

Triangles faces_of(const HalfEdges& half_edges, const FaceTags& tags) {
    Triangles mesh;
    for (std::size_t v = 0; v < half_edges.n_vertices(); ++v)
        mesh.vertices.push_back(position(half_edges, half_edges.vertex_handle(static_cast<unsigned>(v))));
    for (std::size_t f = 0; f < half_edges.n_faces(); ++f) {
        const auto face = half_edges.face_handle(static_cast<unsigned>(f));
        if (half_edges.status(face).deleted()) continue;
        for (const auto v : half_edges.fv_range(face)) mesh.triangles.push_back(static_cast<std::uint32_t>(v.idx()));
        mesh.tags.push_back(half_edges.property(tags, face));
    }
    return mesh;
}

}  // namespace kerf::burring::displacement
