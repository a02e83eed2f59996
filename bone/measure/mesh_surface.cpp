// SPDX-License-Identifier: Apache-2.0
#include "bone/measure/mesh_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace kerf::bone {
namespace {

constexpr double apart = 0.5e-3;  // [m] between samples of a triangle
constexpr double max_steps = 1000.0;

bool meets(const Box& box, const std::array<Vec3, 3>& corners) noexcept {
    const auto outside = [&](double Vec3::*axis) {
        const auto [smallest, largest] = std::minmax({corners[0].*axis, corners[1].*axis, corners[2].*axis});
        return largest < box.low.*axis || smallest > box.high.*axis;
    };
    return !outside(&Vec3::x) && !outside(&Vec3::y) && !outside(&Vec3::z);
}

struct Hit {
    double at = 0.0, cosine = 1.0;
};

/// Returns where a line passes a triangle [m]. Borders count with a small margin, so that no hit falls between two.
std::optional<Hit> pass(const Line& line, const std::array<Vec3, 3>& corners) noexcept {
    constexpr double margin = 1e-9;  // [–] of the triangle
    const Vec3 u = corners[1] - corners[0], v = corners[2] - corners[0];
    const Vec3 normal = cross(u, v), across = cross(line.direction, v);
    const double determinant = dot(u, across), area = length(normal);
    if (!(std::abs(determinant) > 1e-12 * area)) return std::nullopt;
    const Vec3 away = line.point - corners[0], turned = cross(away, u);
    const double a = dot(away, across) / determinant, b = dot(line.direction, turned) / determinant;
    if (a < -margin || b < -margin || a + b > 1.0 + margin) return std::nullopt;
    return Hit{dot(v, turned) / determinant, std::abs(dot(normal, line.direction)) / area};
}

}  // namespace

std::vector<Vec3> MeshSurface::points_in(const Path& region) const {
    const Box box = bounds_of(region);
    std::vector<Vec3> points;
    for (const Triangle& triangle : mesh_->triangles) {
        const std::array<Vec3, 3> corners = mesh_->corners(triangle);
        if (!meets(box, corners)) continue;
        const Vec3 u = corners[1] - corners[0], v = corners[2] - corners[0];
        const double longest = std::max({length(u), length(v), length(v - u)});
        const int steps = static_cast<int>(std::clamp(std::ceil(longest / apart), 1.0, max_steps));
        for (int i = 0; i <= steps; ++i)
            for (int j = 0; i + j <= steps; ++j) {
                const Vec3 p = corners[0] + static_cast<double>(i) / steps * u + static_cast<double>(j) / steps * v;
                if (bone::distance_to(region, p) <= region.within) points.push_back(p);
            }
    }
    return points;
}

std::vector<Stretch> MeshSurface::stretches_on(const Line& line, double low, double high) const {
    std::vector<Hit> hits{{low, 1.0}};
    for (const Triangle& triangle : mesh_->triangles)
        if (const auto hit = pass(line, mesh_->corners(triangle)); hit && hit->at > low && hit->at < high)
            hits.push_back(*hit);
    std::sort(hits.begin(), hits.end(),
              [](const Hit& a, const Hit& b) { return a.at < b.at || (a.at == b.at && a.cosine < b.cosine); });
    hits.push_back({high, 1.0});
    // A line through an edge passes several triangles at one point, so the middle between two hits decides.
    std::vector<Stretch> stretches;
    bool continues = false;
    for (std::size_t i = 0; i + 1 < hits.size(); ++i) {
        const Hit &from = hits[i], &to = hits[i + 1];
        if (to.at - from.at < 1e-9) continue;
        if (!tree_.is_inside(line.point + 0.5 * (from.at + to.at) * line.direction)) {
            continues = false;
            continue;
        }
        if (!continues)
            stretches.push_back({from.at, to.at, from.cosine, to.cosine, i > 0});
        else
            stretches.back().end = to.at, stretches.back().cosine_at_end = to.cosine;
        continues = true;
        if (i + 2 == hits.size()) stretches.back().is_complete = false;
    }
    return stretches;
}

std::optional<double> MeshSurface::distance_to(Vec3 p) const {
    if (mesh_->triangles.empty() || !is_finite(p)) return std::nullopt;
    const double distance = tree_.distance(p, HUGE_VAL);
    return tree_.is_inside(p) ? -distance : distance;
}

}  // namespace kerf::bone
