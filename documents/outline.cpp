// SPDX-License-Identifier: Apache-2.0
#include "documents/outline.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace kerf::documents {
namespace {

constexpr std::size_t pieces_per_point = 6;

/// Returns the z of a × b: positive if b lies to the left of a.
double turn(Vec3 a, Vec3 b) noexcept { return a.x * b.y - a.y * b.x; }

std::size_t next(const Outline& outline, std::size_t i) noexcept { return i + 1 < outline.size() ? i + 1 : 0; }

}  // namespace

Outline smoothed(const Outline& points) {
    const std::size_t count = points.size();
    Outline curve;
    curve.reserve(count * pieces_per_point);
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 before = points[(i + count - 1) % count], from = points[i], to = points[(i + 1) % count],
                   after = points[(i + 2) % count];
        const Vec3 leaves = 0.5 * (to - before), arrives = 0.5 * (after - from);
        for (std::size_t k = 0; k < pieces_per_point; ++k) {
            const double t = static_cast<double>(k) / static_cast<double>(pieces_per_point), t2 = t * t, t3 = t2 * t;
            curve.push_back((2.0 * t3 - 3.0 * t2 + 1.0) * from + (t3 - 2.0 * t2 + t) * leaves +
                            (3.0 * t2 - 2.0 * t3) * to + (t3 - t2) * arrives);
        }
    }
    return curve;
}

double area_of(const Outline& outline) noexcept {
    double twice = 0.0;
    for (std::size_t i = 0; i < outline.size(); ++i) twice += turn(outline[i], outline[next(outline, i)]);
    return 0.5 * twice;
}

bool crosses_itself(const Outline& outline) noexcept {
    const std::size_t count = outline.size();
    const auto are_apart = [&](std::size_t i, std::size_t j) {
        const Vec3 a = outline[i], b = outline[next(outline, i)], c = outline[j], d = outline[next(outline, j)];
        return turn(b - a, c - a) * turn(b - a, d - a) > 0.0 || turn(d - c, a - c) * turn(d - c, b - c) > 0.0;
    };
    for (std::size_t i = 0; i + 2 < count; ++i)
        for (std::size_t j = i + 2; j < count; ++j)
            if (next(outline, j) != i && !are_apart(i, j)) return true;
    return false;
}

double sharpest_radius(const Outline& outline) noexcept {
    double sharpest = HUGE_VAL;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const std::size_t j = next(outline, i), k = next(outline, j);
        const Vec3 in = outline[j] - outline[i], out = outline[k] - outline[j], across = outline[k] - outline[i];
        const double twice_area = turn(in, out);
        if (twice_area > 0.0)
            sharpest = std::min(sharpest, length(in) * length(out) * length(across) / (2.0 * twice_area));
    }
    return sharpest;
}

NearestOnOutline nearest_between(const Outline& a, const Outline& b, double t, double apart, Vec3 p) noexcept {
    const auto at = [&](std::size_t i) { return a[i] + t * (b[i] - a[i]); };
    double nearest = HUGE_VAL, on_piece = 0.0;
    std::size_t piece = 0;
    bool is_inside = false;
    Vec3 to = at(0);
    for (std::size_t i = 0; i < a.size(); ++i) {
        const Vec3 from = to, along = (to = at(next(a, i))) - from, off = p - from;
        const double square = dot(along, along);
        const double s = square > 0.0 ? std::clamp(dot(off, along) / square, 0.0, 1.0) : 0.0;
        const Vec3 beside = off - s * along;
        if (const double far = dot(beside, beside); far < nearest) nearest = far, piece = i, on_piece = s;
        // A ray towards positive x crosses the pieces around a point inside once more in one direction than in the
        // other.
        if ((from.y > p.y) != (to.y > p.y) && (turn(along, off) > 0.0) == (to.y > from.y)) is_inside = !is_inside;
    }
    const std::size_t end = next(a, piece);
    const Vec3 along = at(end) - at(piece), outwards = normalized(Vec3{along.y, -along.x, 0.0});
    const Vec3 moved = (1.0 - on_piece) * (b[piece] - a[piece]) + on_piece * (b[end] - a[end]);
    const double distance = std::sqrt(nearest);
    return {is_inside ? -distance : distance, apart > 0.0 ? dot(moved, outwards) / apart : 0.0};
}

}  // namespace kerf::documents
