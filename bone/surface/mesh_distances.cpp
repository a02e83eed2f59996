// SPDX-License-Identifier: Apache-2.0
#include "bone/surface/mesh_distances.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace kerf::bone {
namespace {

constexpr int block_edge = 3;  // samples of a block along each axis
static_assert(stored_edge % block_edge == 0);
constexpr double rounding_factor = 1.0 + 1e-9, rounding_margin = 1e-12;  // [–], [m] margins for rounding

/// Returns the distance [m] that may replace larger ones: outside the range, also after rounding.
double limit_of(DistanceRange needed) noexcept {
    return (1.0 + 1e-6) * std::max(std::abs(needed.low), std::abs(needed.high));
}

Vec3 sample(const BrickLattice& lattice, int i, int j, int k) noexcept {
    return {lattice.x[static_cast<std::size_t>(i)], lattice.y[static_cast<std::size_t>(j)],
            lattice.z[static_cast<std::size_t>(k)]};
}

constexpr std::size_t index_of(int i, int j, int k) noexcept {
    return static_cast<std::size_t>((k * stored_edge + j) * stored_edge + i);
}

double squared(double a) noexcept { return a * a; }

}  // namespace

double MeshDistances::at(Vec3 p, DistanceRange needed) { return single_(p, limit_of(needed)); }

void MeshDistances::fill(const BrickLattice& lattice, DistanceRange needed, BrickDistances distances) {
    constexpr int last = stored_edge - 1;
    const double limit = limit_of(needed);
    const Vec3 low = sample(lattice, 0, 0, 0), high = sample(lattice, last, last, last);
    gather(0.5 * (low + high), 0.5 * length(high - low), limit);
    for (int k = 0; k < stored_edge; k += block_edge)
        for (int j = 0; j < stored_edge; j += block_edge)
            for (int i = 0; i < stored_edge; i += block_edge) measure(lattice, {i, j, k}, limit, distances);
    for (double& d : distances) d = std::sqrt(d);
    sign(lattice, distances);
}

/// Collects the triangles within `limit` that may be nearest to a point at most `radius` from `centre`.
void MeshDistances::gather(Vec3 centre, double radius, double limit) {
    of_brick_.clear();
    const double reach =
        std::min(limit + radius, tree_->distance(centre, limit) + 2.0 * radius) * rounding_factor + rounding_margin;
    tree_->for_each_within(centre, reach, [&](Vec3 a, Vec3 b, Vec3 c) {
        Candidate one{a, b, c, {}, {}, 0.0};
        one.low = {std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})};
        one.high = {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})};
        one.nearest = std::sqrt(squared_to_box(centre, one.low, one.high));
        if (one.nearest <= reach) of_brick_.push_back(one);
    });
    std::sort(of_brick_.begin(), of_brick_.end(),
              [](const Candidate& s, const Candidate& t) { return s.nearest < t.nearest; });
}

/// Writes the squared distances of a block of samples, at most `limit`² [m²].
void MeshDistances::measure(const BrickLattice& lattice, SampleIndex first, double limit, BrickDistances squares) {
    const auto [i0, j0, k0] = first;
    const Vec3 centre = sample(lattice, i0 + 1, j0 + 1, k0 + 1);
    double squared_radius = 0.0;
    for (const int i : {i0, i0 + 2})
        for (const int j : {j0, j0 + 2})
            for (const int k : {k0, k0 + 2})
                squared_radius = std::max(squared_radius, squared(sample(lattice, i, j, k) - centre));
    const double radius = std::sqrt(squared_radius) * rounding_factor + rounding_margin;

    // First the distance of the centre, then all candidates at most twice the radius farther.
    double smallest = squared(limit + radius);
    of_block_.clear();
    for (const Candidate& one : of_brick_) {
        const double to_box = squared_to_box(centre, one.low, one.high);
        const double farthest = std::sqrt(smallest) + 2.0 * radius;
        if (to_box > farthest * farthest) continue;
        const double to_triangle = squared_to_triangle(centre, one.a, one.b, one.c);
        smallest = std::min(smallest, to_triangle);
        of_block_.push_back(one);
        of_block_.back().nearest = to_triangle;
    }
    const double farthest = std::sqrt(smallest) * rounding_factor + 2.0 * radius;
    std::erase_if(of_block_, [&](const Candidate& one) { return one.nearest > farthest * farthest; });
    std::sort(of_block_.begin(), of_block_.end(),
              [](const Candidate& s, const Candidate& t) { return s.nearest < t.nearest; });

    for (int k = k0; k < k0 + block_edge; ++k)
        for (int j = j0; j < j0 + block_edge; ++j)
            for (int i = i0; i < i0 + block_edge; ++i) {
                const Vec3 p = sample(lattice, i, j, k);
                const double from_centre = length(p - centre);
                double best = limit * limit, farthest_here = squared(limit + from_centre) * rounding_factor;
                for (const Candidate& one : of_block_) {
                    if (one.nearest > farthest_here) break;  // all later ones are farther
                    if (squared_to_box(p, one.low, one.high) > best * rounding_factor) continue;
                    const double square = squared_to_triangle(p, one.a, one.b, one.c);
                    if (square >= best) continue;
                    best = square;
                    farthest_here = squared(std::sqrt(best) + from_centre) * rounding_factor;
                }
                squares[index_of(i, j, k)] = best;
            }
}

/// Negates the distances of the samples inside.
void MeshDistances::sign(const BrickLattice& lattice, BrickDistances distances) {
    for (std::size_t n = 0; n < root_.size(); ++n) root_[n] = static_cast<std::uint16_t>(n);
    const auto root_of = [&](std::size_t n) {
        while (root_[n] != n) n = root_[n] = root_[root_[n]];
        return n;
    };
    const auto link = [&](std::size_t n, std::size_t m, double apart) {
        if (!(distances[n] + distances[m] > apart * rounding_factor + rounding_margin)) return;
        const std::size_t one = root_of(n), other = root_of(m);
        root_[std::max(one, other)] = static_cast<std::uint16_t>(std::min(one, other));
    };
    for (int k = 0; k < stored_edge; ++k)
        for (int j = 0; j < stored_edge; ++j)
            for (int i = 0; i < stored_edge; ++i) {
                const std::size_t n = index_of(i, j, k);
                const Vec3 p = sample(lattice, i, j, k);
                if (i > 0) link(n, index_of(i - 1, j, k), p.x - lattice.x[static_cast<std::size_t>(i - 1)]);
                if (j > 0) link(n, index_of(i, j - 1, k), p.y - lattice.y[static_cast<std::size_t>(j - 1)]);
                if (k > 0) link(n, index_of(i, j, k - 1), p.z - lattice.z[static_cast<std::size_t>(k - 1)]);
            }
    // A root is the first of its set, so its sign is known before the others'.
    for (std::size_t n = 0; n < root_.size(); ++n) {
        const std::size_t root = root_of(n);
        const auto at = static_cast<int>(n);
        const bool is_inside = root == n
                                   ? tree_->is_inside(sample(lattice, at % stored_edge, at / stored_edge % stored_edge,
                                                             at / (stored_edge * stored_edge)))
                                   : std::signbit(distances[root]);
        if (is_inside) distances[n] = -distances[n];
    }
}

}  // namespace kerf::bone
