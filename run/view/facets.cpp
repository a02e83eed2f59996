// SPDX-License-Identifier: Apache-2.0
#include "run/view/facets.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace kerf::run {

namespace {

using Point = std::array<float, 3>;
using Triangle = std::array<std::uint32_t, 3>;

constexpr double crease = 0.86602540378443865;  // [–] cos 30°
constexpr double min_area = 1e-15;              // [m²] 1 µm × 1 nm

Vec3 vector_of(const Point& p) noexcept {
    return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

/// A triangle whose points are welded.
struct Facet {
    Triangle at;
    Vec3 normal;                    ///< unit
    std::array<double, 3> weights;  ///< [–] of its corners: their angle, by its sine and cosine
    std::uint8_t sheet;
};

/// A corner of a facet.
struct Corner {
    std::uint32_t point, facet, number;
};

/// Returns a measure that rises with the angle at `a`, like the angle itself. It needs no arc tangent, whose bits
/// differ between machines.
double weight_at(Vec3 a, Vec3 b, Vec3 c) noexcept {
    const Vec3 u = normalized(b - a), v = normalized(c - a);
    return std::max(1.0 - dot(u, v), 1e-12);
}

/// Rounds the points to single precision, and gives equal ones one index.
std::vector<Point> weld(const std::vector<Vec3>& points, std::vector<std::uint32_t>& index) {
    std::vector<Point> rounded;
    rounded.reserve(points.size());
    const auto single = [](double v) { return static_cast<float>(v) + 0.0f; };  // one zero
    for (const Vec3& p : points) rounded.push_back({single(p.x), single(p.y), single(p.z)});
    std::vector<std::uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return rounded[a] != rounded[b] ? rounded[a] < rounded[b] : a < b;
    });
    index.resize(points.size());
    for (std::size_t n = 0; n < order.size(); ++n)
        index[order[n]] = n > 0 && rounded[order[n]] == rounded[order[n - 1]] ? index[order[n - 1]] : order[n];
    return rounded;
}

std::vector<Facet> facets_with_area(const Facets& facets, const std::vector<Point>& points,
                                    const std::vector<std::uint32_t>& index) {
    std::vector<Facet> kept;
    kept.reserve(facets.triangles.size());
    for (std::size_t n = 0; n < facets.triangles.size(); ++n) {
        const auto& [a, b, c] = facets.triangles[n];
        const Triangle at{index[a], index[b], index[c]};
        const std::array<Vec3, 3> p{vector_of(points[at[0]]), vector_of(points[at[1]]), vector_of(points[at[2]])};
        const Vec3 twice = cross(p[1] - p[0], p[2] - p[0]);
        if (!(length(twice) > 2.0 * min_area)) continue;
        kept.push_back({at,
                        normalized(twice),
                        {weight_at(p[0], p[1], p[2]), weight_at(p[1], p[2], p[0]), weight_at(p[2], p[0], p[1])},
                        facets.sheets[n]});
    }
    return kept;
}

std::vector<Corner> corners_by_point(const std::vector<Facet>& facets) {
    std::vector<Corner> corners;
    corners.reserve(3 * facets.size());
    for (std::uint32_t f = 0; f < facets.size(); ++f)
        for (std::uint32_t m = 0; m < 3; ++m) corners.push_back({facets[f].at[m], f, m});
    std::stable_sort(corners.begin(), corners.end(),
                     [](const Corner& a, const Corner& b) { return a.point < b.point; });
    return corners;
}

/// Returns the normal of a facet at a corner, from all facets at the same point without a crease to it.
Point normal_at(const Facet& facet, std::span<const Corner> around, const std::vector<Facet>& facets) {
    Vec3 sum{};
    for (const Corner& other : around) {
        const Facet& one = facets[other.facet];
        const bool has_sheets = facet.sheet != 0 && one.sheet != 0;
        if (has_sheets ? facet.sheet == one.sheet : dot(facet.normal, one.normal) >= crease)
            sum = sum + one.weights[other.number] * one.normal;
    }
    sum = normalized(sum);
    return {static_cast<float>(sum.x), static_cast<float>(sum.y), static_cast<float>(sum.z)};
}

}  // namespace

void Facets::add(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d, std::uint8_t sheet) {
    const auto squared = [](Vec3 p) { return p.x * p.x + p.y * p.y; };
    const double ac = squared(points[a] + points[c]), bd = squared(points[b] + points[d]);
    if (ac >= bd * (1.0 - 1e-9)) {
        add(a, b, c, sheet);
        add(a, c, d, sheet);
    } else {
        add(a, b, d, sheet);
        add(b, c, d, sheet);
    }
}

void add_rows(Facets& facets, const Rows& rows) {
    const auto first = static_cast<std::uint32_t>(facets.points.size());
    facets.points.insert(facets.points.end(), rows.points.begin(), rows.points.end());
    const auto columns = static_cast<std::uint32_t>(rows.columns);
    for (std::uint32_t row = 0; row + 1 < rows.count(); ++row)
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t here = first + row * columns, next = (column + 1) % columns;
            facets.add(here + column, here + columns + column, here + columns + next, here + next, 0);
        }
}

ViewedMesh mesh_of(const Facets& facets) {
    std::vector<std::uint32_t> index;
    const std::vector<Point> points = weld(facets.points, index);
    const std::vector<Facet> kept = facets_with_area(facets, points, index);
    const std::vector<Corner> corners = corners_by_point(kept);

    ViewedMesh mesh;
    mesh.triangles.resize(kept.size());
    for (std::size_t from = 0; from < corners.size();) {
        std::size_t to = from;
        while (to < corners.size() && corners[to].point == corners[from].point) ++to;
        const std::span<const Corner> around(corners.data() + from, to - from);
        const std::size_t first = mesh.positions.size();
        for (const Corner& corner : around) {
            const Point normal = normal_at(kept[corner.facet], around, kept);
            const auto same =
                std::find(mesh.normals.begin() + static_cast<std::ptrdiff_t>(first), mesh.normals.end(), normal);
            const auto at = static_cast<std::uint32_t>(same - mesh.normals.begin());
            if (same == mesh.normals.end()) {
                mesh.positions.push_back(points[corner.point]);
                mesh.normals.push_back(normal);
            }
            mesh.triangles[corner.facet][corner.number] = at;
        }
        from = to;
    }
    return mesh;
}

}  // namespace kerf::run
