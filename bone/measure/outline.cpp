// SPDX-License-Identifier: Apache-2.0
#include "bone/measure/outline.h"

#include <algorithm>
#include <cmath>

namespace kerf::bone {

namespace {

/// Returns the distance of a point to the left of the line from `a` to `b`, times the length of the line.
double left_of(const PlanePoint& a, const PlanePoint& b, const PlanePoint& p) noexcept {
    return (b.along - a.along) * (p.out - a.out) - (b.out - a.out) * (p.along - a.along);
}

/// Leaves out points below the two lines from the outermost point to both ends. None of them is a corner, and most
/// points of a closed surface lie there.
std::vector<std::size_t> candidates(std::span<const PlanePoint> points) {
    std::vector<std::size_t> kept;
    if (points.empty()) return kept;
    PlanePoint first = points[0], last = points[0], top = points[0];
    for (const PlanePoint& p : points) {
        if (p.along < first.along || (p.along == first.along && p.out > first.out)) first = p;
        if (p.along > last.along || (p.along == last.along && p.out > last.out)) last = p;
        if (p.out > top.out) top = p;
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool is_before = points[i].along < top.along;
        if (left_of(is_before ? first : top, is_before ? top : last, points[i]) >= 0.0) kept.push_back(i);
    }
    return kept;
}

}  // namespace

std::vector<std::size_t> outer_hull(std::span<const PlanePoint> points) {
    std::vector<std::size_t> order = candidates(points);
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        const PlanePoint &p = points[a], &q = points[b];
        return p.along < q.along || (p.along == q.along && (p.out > q.out || (p.out == q.out && a < b)));
    });
    const auto turns_right = [&](std::size_t a, std::size_t b, std::size_t c) {
        return left_of(points[a], points[b], points[c]) < 0.0;
    };
    std::vector<std::size_t> hull;
    for (const std::size_t next : order) {
        if (!hull.empty() && points[hull.back()].along == points[next].along) continue;  // below or at the last one
        while (hull.size() >= 2 && !turns_right(hull[hull.size() - 2], hull.back(), next)) hull.pop_back();
        hull.push_back(next);
    }
    return hull;
}

std::optional<Contacts> contacts_of_ruler(std::span<const PlanePoint> points, double middle, double play) {
    const std::vector<std::size_t> hull = outer_hull(points);
    const auto behind = std::find_if(hull.begin(), hull.end(), [&](std::size_t i) { return points[i].along > middle; });
    if (behind == hull.begin() || behind == hull.end()) return std::nullopt;
    auto first = behind - 1, last = behind;
    const PlanePoint a = points[*first], b = points[*last];
    const double run = b.along - a.along, rise = b.out - a.out, size = std::hypot(run, rise);
    const auto below = [&](std::size_t i) {  // [m] under the ruler
        return ((points[i].along - a.along) * rise - (points[i].out - a.out) * run) / size;
    };
    while (first != hull.begin() && below(*(first - 1)) <= play) --first;
    while (last + 1 != hull.end() && below(*(last + 1)) <= play) ++last;
    return Contacts{*first, *last};
}

}  // namespace kerf::bone
