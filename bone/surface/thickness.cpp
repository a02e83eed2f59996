// SPDX-License-Identifier: Apache-2.0
#include "bone/surface/thickness.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace kerf::bone {
namespace {

constexpr int max_per_side = 16;
constexpr double min_opposed = 0.8;  // −cos of the angle between both outward normals: faces at 37° form a crest

bool is_within(const Box& box, Vec3 p) noexcept {
    return p.x >= box.low.x && p.y >= box.low.y && p.z >= box.low.z && p.x <= box.high.x && p.y <= box.high.y &&
           p.z <= box.high.z;
}

Vec3 normal_of(const SurfaceMesh& mesh, std::uint32_t face) noexcept {
    const auto [a, b, c] = mesh.corners(mesh.triangles[face]);
    return normalized(cross(b - a, c - a));
}

}  // namespace

std::vector<WallSample> measure_walls(const SurfaceMesh& mesh, const TriangleTree& tree, const Box& region,
                                      double fineness) {
    std::vector<WallSample> walls;
    for (std::uint32_t face = 0; face < mesh.triangles.size(); ++face) {
        const auto [a, b, c] = mesh.corners(mesh.triangles[face]);
        const Vec3 normal = normal_of(mesh, face);
        if (normal == Vec3{}) continue;
        const double longest = std::max({length(b - a), length(c - b), length(a - c)});
        const int n = std::clamp(static_cast<int>(std::ceil(longest / fineness)), 1, max_per_side);
        const double area = 0.5 * length(cross(b - a, c - a)) / (n * n);
        // The centres of n² equal triangles: upright ones, then inverted ones.
        const auto measure = [&, a = a, b = b, c = c](double u, double v) {  // captured by name: clang before 16
            const Vec3 at = a + u / (3.0 * n) * (b - a) + v / (3.0 * n) * (c - a);
            if (!is_within(region, at)) return;
            const auto hit = tree.first_hit(at, -normal, 0.0, face);
            if (!hit || dot(normal, normal_of(mesh, hit->face)) > -min_opposed) return;
            walls.push_back({hit->distance, area, at});
        };
        for (int i = 0; i < n; ++i)
            for (int j = 0; i + j < n; ++j) {
                measure(3.0 * i + 1.0, 3.0 * j + 1.0);
                if (i + j + 1 < n) measure(3.0 * i + 2.0, 3.0 * j + 2.0);
            }
    }
    return walls;
}

std::optional<WallSample> thinnest(const std::vector<WallSample>& walls) {
    const auto smallest = std::min_element(
        walls.begin(), walls.end(), [](const WallSample& a, const WallSample& b) { return a.thickness < b.thickness; });
    return smallest == walls.end() ? std::nullopt : std::optional(*smallest);
}

double thickness_at(const std::vector<WallSample>& walls, double fraction) {
    std::vector<WallSample> sorted = walls;
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const WallSample& a, const WallSample& b) { return a.thickness < b.thickness; });
    double all = 0.0, sum = 0.0;
    for (const WallSample& wall : sorted) all += wall.area;
    for (const WallSample& wall : sorted)
        if ((sum += wall.area) >= fraction * all) return wall.thickness;
    return 0.0;
}

double fraction_under(const std::vector<WallSample>& walls, double limit) {
    double all = 0.0, under = 0.0;
    for (const WallSample& wall : walls) {
        all += wall.area;
        if (wall.thickness < limit) under += wall.area;
    }
    return all > 0.0 ? under / all : 0.0;
}

}  // namespace kerf::bone
