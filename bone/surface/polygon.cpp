// SPDX-License-Identifier: Apache-2.0
#include "bone/surface/polygon.h"

#include <algorithm>
#include <cstddef>

namespace kerf::bone {
namespace {

/// Returns the normal of the polygon with twice its area as length (Newell).
Vec3 normal_of(const SurfaceMesh& mesh, const std::vector<std::uint32_t>& corners) {
    Vec3 sum{};
    const Vec3 origin = mesh.vertices[corners[0]];
    for (std::size_t i = 0; i < corners.size(); ++i)
        sum =
            sum + cross(mesh.vertices[corners[i]] - origin, mesh.vertices[corners[(i + 1) % corners.size()]] - origin);
    return sum;
}

/// Returns whether the polygon's corner `i` can be cut off: it is convex and its triangle contains no other corner.
bool is_ear(const SurfaceMesh& mesh, const std::vector<std::uint32_t>& corners, std::size_t i, Vec3 normal) {
    const std::size_t n = corners.size();
    const std::uint32_t before = corners[(i + n - 1) % n], here = corners[i], after = corners[(i + 1) % n];
    const Vec3 a = mesh.vertices[before], b = mesh.vertices[here], c = mesh.vertices[after];
    const auto side = [&](Vec3 from, Vec3 to, Vec3 p) { return dot(normal, cross(to - from, p - from)); };
    if (!(side(a, b, c) > 0.0)) return false;
    return std::none_of(corners.begin(), corners.end(), [&](std::uint32_t v) {
        if (v == before || v == here || v == after) return false;
        const Vec3 p = mesh.vertices[v];
        return side(a, b, p) >= 0.0 && side(b, c, p) >= 0.0 && side(c, a, p) >= 0.0;
    });
}

}  // namespace

void add_polygon(SurfaceMesh& mesh, const std::vector<std::uint32_t>& corners) {
    if (corners.size() == 3) {
        mesh.triangles.push_back({corners[0], corners[1], corners[2]});
        return;
    }
    const Vec3 normal = normal_of(mesh, corners);
    std::vector<std::uint32_t> left = corners;
    while (left.size() > 3) {
        std::size_t ear = 0;
        while (ear < left.size() && !is_ear(mesh, left, ear, normal)) ++ear;
        if (ear == left.size()) break;  // it crosses itself, or has no area
        const std::size_t n = left.size();
        mesh.triangles.push_back({left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    for (std::size_t i = 2; i < left.size(); ++i) mesh.triangles.push_back({left[0], left[i - 1], left[i]});
}

}  // namespace kerf::bone
