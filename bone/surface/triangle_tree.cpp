// SPDX-License-Identifier: Apache-2.0
#include "bone/surface/triangle_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace kerf::bone {
namespace {

// Balanced by count: a tree of 2³² triangles is 32 deep.
constexpr std::size_t deepest = 64;
// Beyond this many of its radii a group counts as a dipole.
constexpr double far_radii = 3.0;

Vec3 min_corner(Vec3 a, Vec3 b) noexcept { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3 max_corner(Vec3 a, Vec3 b) noexcept { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

/// Returns the signed solid angle seen from p, 2π at most.
double solid_angle(Vec3 p, Vec3 a, Vec3 b, Vec3 c) noexcept {
    const Vec3 u = a - p, v = b - p, w = c - p;
    const double lu = length(u), lv = length(v), lw = length(w);
    const double below = lu * lv * lw + dot(u, v) * lw + dot(v, w) * lu + dot(w, u) * lv;
    return 2.0 * std::atan2(dot(u, cross(v, w)), below);
}

double component(Vec3 v, int axis) noexcept { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

}  // namespace

TriangleTree::TriangleTree(const SurfaceMesh& mesh) {
    items_.reserve(mesh.triangles.size());
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        const auto [a, b, c] = mesh.corners(mesh.triangles[f]);
        items_.push_back({a, b, c, static_cast<std::uint32_t>(f)});
    }
    if (items_.empty()) return;
    nodes_.reserve(items_.size());
    build(0, static_cast<std::uint32_t>(items_.size()));
}

void TriangleTree::build(std::uint32_t first, std::uint32_t count) {
    const std::size_t here = nodes_.size();
    Node node;
    node.first = first;
    node.count = count;
    node.low = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
    node.high = -node.low;
    Vec3 weighted{}, plain{};
    double area = 0.0;
    Vec3 low_centre = node.low, high_centre = node.high;
    for (std::uint32_t i = first; i < first + count; ++i) {
        const Item& t = items_[i];
        for (const Vec3 p : {t.a, t.b, t.c}) {
            node.low = min_corner(node.low, p);
            node.high = max_corner(node.high, p);
        }
        const Vec3 normal = 0.5 * cross(t.b - t.a, t.c - t.a), centre = (t.a + t.b + t.c) / 3.0;
        node.area = node.area + normal;
        area += length(normal);
        weighted = weighted + length(normal) * centre;
        plain = plain + centre;
        low_centre = min_corner(low_centre, t.a + t.b + t.c);
        high_centre = max_corner(high_centre, t.a + t.b + t.c);
    }
    node.centre = area > 0.0 ? weighted / area : plain / static_cast<double>(count);
    double radius = 0.0;
    for (std::uint32_t i = first; i < first + count; ++i)
        for (const Vec3 p : {items_[i].a, items_[i].b, items_[i].c})
            radius = std::max(radius, squared(p - node.centre));
    node.radius = std::sqrt(radius);
    nodes_.push_back(node);
    if (count <= max_in_leaf) return;

    // Splits in half across the longest extent of the centres; equal centres by number.
    const Vec3 extent = high_centre - low_centre;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const std::uint32_t half = count / 2;
    const auto begin = items_.begin() + first;
    std::nth_element(begin, begin + half, begin + count, [&](const Item& s, const Item& t) {
        const double at_s = component(s.a + s.b + s.c, axis), at_t = component(t.a + t.b + t.c, axis);
        return at_s != at_t ? at_s < at_t : s.face < t.face;
    });
    // The order that nth_element leaves within the halves depends on the library. Sorting by number fixes it.
    const auto by_number = [](const Item& s, const Item& t) { return s.face < t.face; };
    std::sort(begin, begin + half, by_number);
    std::sort(begin + half, begin + count, by_number);
    build(first, half);
    nodes_[here].second_child = static_cast<std::uint32_t>(nodes_.size());
    build(first + half, count - half);
}

double TriangleTree::distance(Vec3 p, double limit) const noexcept {
    if (nodes_.empty()) return limit;
    double best = limit * limit;
    std::array<std::pair<double, std::uint32_t>, deepest> open;
    std::size_t count = 0;
    open[count++] = {squared_to_box(p, nodes_[0].low, nodes_[0].high), 0};
    while (count > 0) {
        const auto [to_box, n] = open[--count];
        if (to_box >= best) continue;
        const Node& node = nodes_[n];
        if (node.second_child == 0) {
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
                best = std::min(best, squared_to_triangle(p, items_[i].a, items_[i].b, items_[i].c));
            continue;
        }
        const Node &one = nodes_[n + 1], &two = nodes_[node.second_child];
        const double to_one = squared_to_box(p, one.low, one.high), to_two = squared_to_box(p, two.low, two.high);
        // Pushes the nearer child last, so that it is visited first.
        if (to_one < to_two) {
            open[count++] = {to_two, node.second_child};
            open[count++] = {to_one, n + 1};
        } else {
            open[count++] = {to_one, n + 1};
            open[count++] = {to_two, node.second_child};
        }
    }
    return std::sqrt(best);
}

double TriangleTree::winding(Vec3 p) const noexcept {
    if (nodes_.empty()) return 0.0;
    std::array<std::uint32_t, deepest> open;
    std::size_t count = 0;
    open[count++] = 0;
    double sum = 0.0;
    while (count > 0) {
        const std::uint32_t n = open[--count];
        const Node& node = nodes_[n];
        const Vec3 to = node.centre - p;
        const double away = squared(to);
        if (away > far_radii * far_radii * node.radius * node.radius) {
            sum += dot(to, node.area) / (away * std::sqrt(away));
        } else if (node.second_child == 0) {
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
                sum += solid_angle(p, items_[i].a, items_[i].b, items_[i].c);
        } else {
            open[count++] = node.second_child;
            open[count++] = n + 1;
        }
    }
    return sum / (4.0 * std::numbers::pi);
}

double TriangleTree::exact_winding(Vec3 p) const noexcept {
    double sum = 0.0;
    for (const Item& t : items_) sum += solid_angle(p, t.a, t.b, t.c);
    return sum / (4.0 * std::numbers::pi);
}

bool TriangleTree::is_inside(Vec3 p) const noexcept {
    const double quick = winding(p);
    if (std::abs(quick - 0.5) > 0.25) return quick > 0.5;
    return exact_winding(p) > 0.5;
}

std::optional<TriangleTree::Hit> TriangleTree::first_hit(Vec3 origin, Vec3 direction, double from,
                                                         std::uint32_t ignored) const noexcept {
    std::optional<Hit> best;
    double limit = HUGE_VAL;
    const auto meets_box = [&](const Node& node) {
        double enter = from, leave = limit;
        for (int axis = 0; axis < 3; ++axis) {
            const double o = component(origin, axis), d = component(direction, axis);
            const double low = component(node.low, axis), high = component(node.high, axis);
            if (d == 0.0) {
                if (o < low || o > high) return false;
                continue;
            }
            const double one = (low - o) / d, two = (high - o) / d;
            enter = std::max(enter, std::min(one, two));
            leave = std::min(leave, std::max(one, two));
        }
        return enter <= leave * (1.0 + 1e-12);
    };
    std::array<std::uint32_t, deepest> open;
    std::size_t count = 0;
    if (!nodes_.empty()) open[count++] = 0;
    while (count > 0) {
        const std::uint32_t n = open[--count];
        const Node& node = nodes_[n];
        if (!meets_box(node)) continue;
        if (node.second_child != 0) {
            open[count++] = node.second_child;
            open[count++] = n + 1;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const Item& t = items_[i];
            if (t.face == ignored) continue;
            const Vec3 ab = t.b - t.a, ac = t.c - t.a, across = cross(direction, ac);
            const double det = dot(ab, across);
            if (det == 0.0) continue;  // parallel to its plane
            const Vec3 s = origin - t.a;
            const double u = dot(s, across) / det;
            const Vec3 q = cross(s, ab);
            const double v = dot(direction, q) / det, at = dot(ac, q) / det;
            if (u < 0.0 || v < 0.0 || u + v > 1.0 || at <= from) continue;
            if (at < limit || (at == limit && best && t.face < best->face)) {
                limit = at;
                best = Hit{at, t.face};
            }
        }
    }
    return best;
}

bool TriangleTree::meet(const Item& a, const Item& b) noexcept {
    const Vec3 low_a = min_corner(a.a, min_corner(a.b, a.c)), high_a = max_corner(a.a, max_corner(a.b, a.c));
    const Vec3 low_b = min_corner(b.a, min_corner(b.b, b.c)), high_b = max_corner(b.a, max_corner(b.b, b.c));
    return low_a.x <= high_b.x && low_b.x <= high_a.x && low_a.y <= high_b.y && low_b.y <= high_a.y &&
           low_a.z <= high_b.z && low_b.z <= high_a.z;
}

}  // namespace kerf::bone
