// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "bone/surface/surface_mesh.h"
#include "kerf/remesh.h"

namespace kerf::bone {

/// An exact surface: triangles in double precision, body frame [m], with the origin of each.
struct TaggedMesh {
    SurfaceMesh mesh;
    std::vector<std::uint8_t> tags;  ///< #triangles, KERF_FACE_…
};

/// Returns an uncut surface: all its faces are KERF_FACE_SURFACE.   [any] pure.
[[nodiscard]] inline TaggedMesh tagged(SurfaceMesh mesh) {
    std::vector<std::uint8_t> tags(mesh.triangles.size(), KERF_FACE_SURFACE);
    return {std::move(mesh), std::move(tags)};
}

/// Returns whether two meshes have the same bytes.   [any] pure.
[[nodiscard]] inline bool has_same_bytes(const TaggedMesh& a, const TaggedMesh& b) noexcept {
    const auto &x = a.mesh.vertices, &y = b.mesh.vertices;
    return a.tags == b.tags && a.mesh.triangles == b.mesh.triangles && x.size() == y.size() &&
           (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof(Vec3)) == 0);
}

/// Returns the volume between two surfaces with the same border [m³], or the difference of two closed ones; positive if
/// `outer` is outside.   [any] pure.
[[nodiscard]] inline double volume_between(const SurfaceMesh& inner, const SurfaceMesh& outer) noexcept {
    // Both sums use the same reference point: an open surface alone has no volume.
    const Vec3 about = outer.vertices.empty() ? Vec3{} : outer.vertices.front();
    const auto six_volumes = [about](const SurfaceMesh& mesh) {
        double sum = 0.0;
        for (const Triangle& t : mesh.triangles) {
            const auto [a, b, c] = mesh.corners(t);
            sum += dot(a - about, cross(b - about, c - about));
        }
        return sum;
    };
    return (six_volumes(outer) - six_volumes(inner)) / 6.0;
}

}  // namespace kerf::bone
