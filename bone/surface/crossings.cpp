// SPDX-License-Identifier: Apache-2.0
#include "bone/surface/crossings.h"

#include <algorithm>
#include <cstddef>

#include "bone/surface/orient3d.h"

namespace kerf::bone {
namespace {

struct Point2 {
    double x, y;
};
int turn(Point2 a, Point2 b, Point2 c) noexcept { return orient2d(a.x, a.y, b.x, b.y, c.x, c.y); }

Point2 without(int axis, Vec3 p) noexcept {
    if (axis == 0) return {p.y, p.z};
    if (axis == 1) return {p.z, p.x};
    return {p.x, p.y};
}

/// Returns an axis along which the triangle's projection is not a line; 3 if there is none.
int axis_across(Vec3 a, Vec3 b, Vec3 c) noexcept {
    int axis = 0;
    while (axis < 3 && turn(without(axis, a), without(axis, b), without(axis, c)) == 0) ++axis;
    return axis;
}

bool lies_on(Point2 p, Point2 a, Point2 b) noexcept {  // Pre: the points are collinear
    return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
           p.y <= std::max(a.y, b.y);
}

bool segments_meet(Point2 p, Point2 q, Point2 a, Point2 b) noexcept {
    const int ap = turn(a, b, p), aq = turn(a, b, q), pa = turn(p, q, a), pb = turn(p, q, b);
    if (ap * aq < 0 && pa * pb < 0) return true;
    return (ap == 0 && lies_on(p, a, b)) || (aq == 0 && lies_on(q, a, b)) || (pa == 0 && lies_on(a, p, q)) ||
           (pb == 0 && lies_on(b, p, q));
}

/// Returns whether a segment and a triangle in a common plane meet.
bool meet_in_plane(Vec3 p, Vec3 q, Vec3 a, Vec3 b, Vec3 c) noexcept {
    const int axis = axis_across(a, b, c);
    const Point2 p2 = without(axis, p), q2 = without(axis, q), a2 = without(axis, a), b2 = without(axis, b),
                 c2 = without(axis, c);
    if (segments_meet(p2, q2, a2, b2) || segments_meet(p2, q2, b2, c2) || segments_meet(p2, q2, c2, a2)) return true;
    const int one = turn(a2, b2, p2), two = turn(b2, c2, p2), three = turn(c2, a2, p2);
    return one == two && two == three;  // completely inside
}

bool segment_meets(Vec3 p, Vec3 q, Vec3 a, Vec3 b, Vec3 c) noexcept {
    const int above_p = orient3d(a, b, c, p), above_q = orient3d(a, b, c, q);
    if (above_p * above_q > 0) return false;
    if (above_p == 0 && above_q == 0) return meet_in_plane(p, q, a, b, c);
    const int ab = orient3d(p, q, a, b), bc = orient3d(p, q, b, c), ca = orient3d(p, q, c, a);
    return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

/// Returns the corners, rotated so that corner `first` comes first.
std::array<Vec3, 3> from_corner(const std::array<Vec3, 3>& t, std::size_t first) noexcept {
    return {t[first], t[(first + 1) % 3], t[(first + 2) % 3]};
}

bool do_cross(const SurfaceMesh& mesh, std::uint32_t face, std::uint32_t other, bool test_needles) {
    const std::array<Vec3, 3> a = mesh.corners(mesh.triangles[face]), b = mesh.corners(mesh.triangles[other]);
    const auto is_left_out = [test_needles](const std::array<Vec3, 3>& t) {
        return is_flat(t[0], t[1], t[2]) && (!test_needles || axis_across(t[0], t[1], t[2]) == 3);
    };
    if (is_left_out(a) || is_left_out(b)) return false;

    std::size_t shared = 0, in_a = 0, in_b = 0;  // index of the common corner, or, of two, of the other one
    std::array<bool, 3> a_is_shared{}, b_is_shared{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            if (a[i] == b[j]) {
                ++shared;
                a_is_shared[i] = b_is_shared[j] = true;
            }
    for (std::size_t i = 0; i < 3; ++i) {
        if (a_is_shared[i] == (shared == 1)) in_a = i;
        if (b_is_shared[i] == (shared == 1)) in_b = i;
    }

    if (shared >= 3) return false;
    if (shared == 2) {  // folded flat onto each other?
        const auto [c, e, f] = from_corner(a, in_a);
        const Vec3 d = b[in_b];
        if (orient3d(c, e, f, d) != 0) return false;
        const int axis = axis_across(c, e, f);
        const Point2 e2 = without(axis, e), f2 = without(axis, f);
        return turn(e2, f2, without(axis, c)) == turn(e2, f2, without(axis, d));
    }
    if (shared == 1) {
        const auto [v, p, q] = from_corner(a, in_a);
        const auto [w, r, u] = from_corner(b, in_b);
        return segment_meets(p, q, w, r, u) || segment_meets(r, u, v, p, q);
    }
    // All of one triangle on one side of the other's plane is by far the most frequent case.
    const auto is_aside = [](const std::array<Vec3, 3>& plane, const std::array<Vec3, 3>& of) {
        const int one = orient3d(plane[0], plane[1], plane[2], of[0]);
        return one != 0 && one == orient3d(plane[0], plane[1], plane[2], of[1]) &&
               one == orient3d(plane[0], plane[1], plane[2], of[2]);
    };
    if (is_aside(a, b) || is_aside(b, a)) return false;
    for (std::size_t i = 0; i < 3; ++i)
        if (segment_meets(a[i], a[(i + 1) % 3], b[0], b[1], b[2]) ||
            segment_meets(b[i], b[(i + 1) % 3], a[0], a[1], a[2]))
            return true;
    return false;
}

}  // namespace

bool is_flat(Vec3 a, Vec3 b, Vec3 c) noexcept {
    constexpr double nanometre = 1e-9;
    const double longest = std::max({length(b - a), length(c - b), length(a - c)});
    return length(cross(b - a, c - a)) <= nanometre * longest;
}

std::vector<Crossing> crossings_of(const SurfaceMesh& mesh, const TriangleTree& tree, bool test_needles,
                                   const std::vector<std::uint8_t>& is_tested) {
    std::vector<Crossing> found;
    tree.for_each_near_pair([&](std::uint32_t face, std::uint32_t other) {
        if (!is_tested.empty() && is_tested[face] == 0 && is_tested[other] == 0) return;
        if (do_cross(mesh, face, other, test_needles)) found.push_back({face, other});
    });
    std::sort(found.begin(), found.end());
    return found;
}

}  // namespace kerf::bone
