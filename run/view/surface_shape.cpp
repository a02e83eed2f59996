// SPDX-License-Identifier: Apache-2.0
#include "run/view/surface_shape.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace kerf::run {

namespace {

std::array<float, 3> single(Vec3 v) noexcept {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

}  // namespace

ViewedMesh viewed(const Mesh& mesh) {
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    constexpr double min_area = 1e-15;  // [m²] 1 µm × 1 nm
    ViewedMesh out;
    std::vector<std::uint32_t> index(mesh.vertices.size(), none);
    for (const auto& triangle : mesh.triangles) {
        const Vec3 a = mesh.vertices[triangle[0]], b = mesh.vertices[triangle[1]], c = mesh.vertices[triangle[2]];
        const Vec3 twice = cross(b - a, c - a);
        if (!(length(twice) > 2.0 * min_area)) continue;
        std::array<std::uint32_t, 3> kept{};
        for (std::size_t m = 0; m < 3; ++m) {
            std::uint32_t& at = index[triangle[m]];
            if (at == none) {
                at = static_cast<std::uint32_t>(out.positions.size());
                out.positions.push_back(single(mesh.vertices[triangle[m]]));
                // A field without a gradient has no normal there: the triangle's own is near it.
                const Vec3 normal = mesh.normals[triangle[m]];
                out.normals.push_back(single(dot(normal, normal) > 0.5 ? normalized(normal) : normalized(twice)));
            }
            kept[m] = at;
        }
        out.triangles.push_back(kept);
    }
    return out;
}

}  // namespace kerf::run
