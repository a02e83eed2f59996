// SPDX-License-Identifier: Apache-2.0
#include "bone/remesh/base_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "bone/surface/diagnose.h"
#include "bone/surface/orient3d.h"
#include "bone/surface/repair.h"
#include "core/field/surface/bone_surface.h"

namespace kerf::bone {

void snap(SurfaceMesh& mesh, double step) {
    for (Vec3& v : mesh.vertices)
        v = {step * std::round(v.x / step), step * std::round(v.y / step), step * std::round(v.z / step)};
    weld(mesh);
    std::erase_if(mesh.triangles, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    drop_unused_vertices(mesh);
}

SurfaceMesh field_surface(const Body& body) {
    constexpr double lattice = 0x1p-20;  // [m] 0.95 µm: exact in double precision
    const Mesh found = bone_surface(body, CutField(body, 0));
    SurfaceMesh surface;
    surface.vertices = found.vertices;
    surface.triangles.reserve(found.triangles.size());
    for (const auto& t : found.triangles) surface.triangles.push_back({t[0], t[1], t[2]});
    snap(surface, lattice);
    return surface;
}

bool has_no_area(const SurfaceMesh& mesh, const Triangle& face) noexcept {
    const auto [a, b, c] = mesh.corners(face);
    return orient2d(a.x, a.y, b.x, b.y, c.x, c.y) == 0 && orient2d(a.y, a.z, b.y, b.z, c.y, c.z) == 0 &&
           orient2d(a.z, a.x, b.z, b.x, c.z, c.x) == 0;
}

void remove_flat_faces(SurfaceMesh& mesh) {
    // Edges of zero length are removed, with the faces at their sides.
    std::map<std::uint32_t, std::uint32_t> same;
    const auto first_of = [&](std::uint32_t v) {
        for (auto at = same.find(v); at != same.end(); at = same.find(v)) v = at->second;
        return v;
    };
    for (const Triangle& t : mesh.triangles)
        for (std::size_t n = 0; n < 3; ++n) {
            const std::uint32_t a = first_of(t[n]), b = first_of(t[(n + 1) % 3]);
            if (a != b && mesh.vertices[a] == mesh.vertices[b]) same[std::max(a, b)] = std::min(a, b);
        }
    if (!same.empty()) {
        for (Triangle& t : mesh.triangles)
            for (std::uint32_t& corner : t) corner = first_of(corner);
        std::erase_if(mesh.triangles, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
        drop_unused_vertices(mesh);
    }

    std::vector<std::size_t> flat;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
        if (has_no_area(mesh, mesh.triangles[f])) flat.push_back(f);
    if (flat.empty()) return;
    using Edge = std::pair<std::uint32_t, std::uint32_t>;
    std::map<Edge, std::size_t> face_of;  // for each edge in the direction of its face
    const auto enter = [&](std::size_t f) {
        const Triangle& t = mesh.triangles[f];
        for (std::size_t n = 0; n < 3; ++n) face_of[{t[n], t[(n + 1) % 3]}] = f;
    };
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) enter(f);
    // A flat neighbour may gain area from its own neighbour in an earlier round. So there are several rounds.
    for (std::size_t round = 0; round < flat.size() && round < 8; ++round)
        for (const std::size_t f : flat) {
            const Triangle t = mesh.triangles[f];
            if (!has_no_area(mesh, t)) continue;
            std::size_t n = 0;  // begin of the longest edge
            const auto size = [&](std::size_t at) {
                const Vec3 edge_vector = mesh.vertices[t[(at + 1) % 3]] - mesh.vertices[t[at]];
                return dot(edge_vector, edge_vector);
            };
            for (std::size_t other = 1; other < 3; ++other)
                if (size(other) > size(n)) n = other;
            const std::uint32_t a = t[n], b = t[(n + 1) % 3], between = t[(n + 2) % 3];
            const auto there = face_of.find({b, a});
            if (there == face_of.end() || there->second == f) continue;
            const std::size_t neighbour = there->second;
            std::uint32_t beyond = a;
            for (const std::uint32_t corner : mesh.triangles[neighbour])
                if (corner != a && corner != b) beyond = corner;
            if (face_of.contains({between, beyond}) || face_of.contains({beyond, between})) continue;
            face_of.erase({a, b});
            face_of.erase({b, a});
            mesh.triangles[f] = {between, a, beyond};
            mesh.triangles[neighbour] = {between, beyond, b};
            enter(f);
            enter(neighbour);
        }
}

std::string flaw_of_base(const SurfaceMesh& mesh) {
    const SurfaceDiagnosis found = diagnose(mesh, 1.0);
    const auto flaw = [](const Flaw& one, const char* what) {
        return std::to_string(one.count) + what + ", the first at " + position_text(one.at);
    };
    if (mesh.triangles.empty()) return "it has no faces";
    if (found.open_edges.count > 0) return flaw(found.open_edges, " open edges");
    if (found.nonmanifold_edges.count > 0) return flaw(found.nonmanifold_edges, " edges of more than two faces");
    if (found.inconsistent_edges.count > 0)
        return flaw(found.inconsistent_edges, " edges whose faces look to different sides");
    if (found.is_inside_out) return "its faces look inwards";
    if (found.pinched_vertices.count > 0) return flaw(found.pinched_vertices, " vertices where parts only touch");
    if (found.duplicate_faces.count > 0) return flaw(found.duplicate_faces, " faces that are there twice");
    for (const Triangle& t : mesh.triangles)
        if (has_no_area(mesh, t)) return "a face has no area, at " + position_text(mesh.vertices[t[0]]);
    if (found.crossings.count > 0) return flaw(found.crossings, " pairs of faces that cross");
    return {};
}

}  // namespace kerf::bone
