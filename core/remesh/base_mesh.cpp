// SPDX-License-Identifier: Apache-2.0
#include "core/remesh/base_mesh.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

#include "core/field/bone_surface.h"
#include "core/import/surface/diagnose.h"
#include "core/import/surface/repair.h"

namespace kerf {

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

std::string flaw_of_base(const SurfaceMesh& mesh) {
    const SurfaceDiagnosis found = diagnose(mesh, 1.0);
    const auto flaw = [](const Flaw& one, const char* what) {
        return std::to_string(one.count) + what + ", the first at " + place_text(one.at);
    };
    if (mesh.triangles.empty()) return "it has no faces";
    if (found.open_edges.count > 0) return flaw(found.open_edges, " open edges");
    if (found.crowded_edges.count > 0) return flaw(found.crowded_edges, " edges of more than two faces");
    if (found.turned_edges.count > 0) return flaw(found.turned_edges, " edges whose faces look to different sides");
    if (found.is_inside_out) return "its faces look inwards";
    if (found.pinched_vertices.count > 0) return flaw(found.pinched_vertices, " vertices where parts only touch");
    if (found.duplicate_faces.count > 0) return flaw(found.duplicate_faces, " faces that are there twice");
    if (found.crossings.count > 0) return flaw(found.crossings, " pairs of faces that cross");
    return {};
}

}  // namespace kerf
