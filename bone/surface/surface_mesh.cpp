// SPDX-License-Identifier: Apache-2.0
#include "bone/surface/surface_mesh.h"

#include <algorithm>
#include <cmath>

namespace kerf::bone {

Box bounds_of(const SurfaceMesh& mesh) noexcept {
    Box box = empty_box;
    for (const Triangle& t : mesh.triangles)
        for (const Vec3 p : mesh.corners(t)) box = joined(box, p);
    return box;
}

double area_of(const SurfaceMesh& mesh) noexcept {
    double sum = 0.0;
    for (const Triangle& t : mesh.triangles) {
        const auto [a, b, c] = mesh.corners(t);
        sum += 0.5 * length(cross(b - a, c - a));
    }
    return sum;
}

double signed_volume_of(const SurfaceMesh& mesh) noexcept {
    if (mesh.triangles.empty()) return 0.0;
    const Box box = bounds_of(mesh);
    const Vec3 centre = 0.5 * (box.low + box.high);  // far from the origin the terms would cancel badly
    double sum = 0.0;
    for (const Triangle& t : mesh.triangles) {
        const auto [a, b, c] = mesh.corners(t);
        sum += dot(a - centre, cross(b - centre, c - centre)) / 6.0;
    }
    return sum;
}

void drop_unused_vertices(SurfaceMesh& mesh) {
    constexpr std::uint32_t unused = 0xffffffff;
    std::vector<std::uint32_t> new_index(mesh.vertices.size(), unused);
    for (const Triangle& t : mesh.triangles)
        for (const std::uint32_t v : t) new_index[v] = 0;
    std::uint32_t count = 0;
    for (std::size_t v = 0; v < new_index.size(); ++v) {
        if (new_index[v] == unused) continue;
        mesh.vertices[count] = mesh.vertices[v];
        new_index[v] = count++;
    }
    mesh.vertices.resize(count);
    for (Triangle& t : mesh.triangles)
        for (std::uint32_t& v : t) v = new_index[v];
}

}  // namespace kerf::bone
