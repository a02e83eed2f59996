// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "kerf/abi.h"

/// Vectors, rotations and poses of the boundary, with operators. Double precision, SI.
namespace kerf {

using Vec3 = kerf_vec3;
using Quat = kerf_quat;
using Pose = kerf_pose;
/// Linear part first, then angular: a rate [m/s, rad/s] or a wrench [N, N·m].
using Vec6 = std::array<double, 6>;

constexpr Vec3 operator+(Vec3 a, Vec3 b) noexcept { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(Vec3 a, Vec3 b) noexcept { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator-(Vec3 a) noexcept { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(double s, Vec3 a) noexcept { return {s * a.x, s * a.y, s * a.z}; }
constexpr Vec3 operator*(Vec3 a, double s) noexcept { return s * a; }
constexpr Vec3 operator/(Vec3 a, double s) noexcept { return {a.x / s, a.y / s, a.z / s}; }
constexpr bool operator==(Vec3 a, Vec3 b) noexcept { return a.x == b.x && a.y == b.y && a.z == b.z; }
constexpr double dot(Vec3 a, Vec3 b) noexcept { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(Vec3 a, Vec3 b) noexcept {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec3 a) noexcept { return std::sqrt(dot(a, a)); }
/// Returns the unit vector along `a`; zero for a zero vector.
inline Vec3 normalized(Vec3 a) noexcept {
    const double l = length(a);
    return l > 0.0 ? a / l : Vec3{0, 0, 0};
}
inline bool is_finite(Vec3 a) noexcept { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

constexpr Quat operator*(Quat a, Quat b) noexcept {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
constexpr Quat conjugate(Quat q) noexcept { return {q.w, -q.x, -q.y, -q.z}; }
constexpr Vec3 rotate(Quat q, Vec3 v) noexcept {
    const Vec3 u{q.x, q.y, q.z};
    const Vec3 t = 2.0 * cross(u, v);
    return v + q.w * t + cross(u, t);
}
inline Quat normalized(Quat q) noexcept {
    const double l = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return {q.w / l, q.x / l, q.y / l, q.z / l};
}
/// Returns the rotation by |r| about r [rad]. Uses only +, −, ×, ÷ and sqrt, so that it gives the same bits on every
/// machine.
///
///     q = ±normalise(1, tan(|r|/2) r/|r|) ≈ normalise(1, r/2 (1 + |r|²/12 + |r|⁴/120))    for |r| ≤ 0.01
///
/// Larger rotations, up to 655 rad, are composed from halves.   [any] pure.
inline Quat quat_from_rotation_vector(Vec3 r) noexcept {
    int halvings = 0;
    while (dot(r, r) > 1e-4 && halvings < 16) {
        r = 0.5 * r;
        ++halvings;
    }
    const double s = 0.5 * (1.0 + dot(r, r) / 12.0 + dot(r, r) * dot(r, r) / 120.0);
    Quat q = normalized(Quat{1.0, s * r.x, s * r.y, s * r.z});
    for (int i = 0; i < halvings; ++i) q = normalized(q * q);
    return q;
}
/// Returns the rotation vector [rad] of `q`, exact to third order in the angle and within 2e-4 rad at 0.5 rad.
/// [any] pure.
inline Vec3 small_rotation_vector(Quat q) noexcept {
    if (q.w < 0.0) q = {-q.w, -q.x, -q.y, -q.z};
    const Vec3 v{q.x, q.y, q.z};
    const double s2 = dot(v, v);
    return (2.0 * (1.0 + s2 / 6.0 + 0.075 * s2 * s2)) * v;
}
/// Returns the shortest rotation from unit vector `from` to unit vector `to`.
inline Quat quat_between(Vec3 from, Vec3 to) noexcept {
    const double c = dot(from, to);
    if (c < -0.999999) {
        const Vec3 other = std::abs(from.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
        const Vec3 axis = normalized(cross(from, other));
        return {0.0, axis.x, axis.y, axis.z};
    }
    const Vec3 v = cross(from, to);
    return normalized(Quat{1.0 + c, v.x, v.y, v.z});
}

constexpr Pose identity_pose() noexcept { return {{0, 0, 0}, {1, 0, 0, 0}}; }
/// Returns the point in frame a: a_from_b * point_in_b = point_in_a.
constexpr Vec3 operator*(const Pose& a_from_b, Vec3 point_in_b) noexcept {
    return a_from_b.position + rotate(a_from_b.rotation, point_in_b);
}
constexpr Pose operator*(const Pose& a_from_b, const Pose& b_from_c) noexcept {
    return {a_from_b * b_from_c.position, a_from_b.rotation * b_from_c.rotation};
}
constexpr Pose inverse(const Pose& a_from_b) noexcept {
    const Quat b_from_a = conjugate(a_from_b.rotation);
    return {rotate(b_from_a, -a_from_b.position), b_from_a};
}
/// Returns the pose after motion for `dt` [s] at `rate` [m/s, rad/s], which is in the tool frame.
inline Pose advanced(const Pose& world_from_tool, const Vec6& rate, double dt) noexcept {
    const Pose tool_from_next{{rate[0] * dt, rate[1] * dt, rate[2] * dt},
                              quat_from_rotation_vector({rate[3] * dt, rate[4] * dt, rate[5] * dt})};
    Pose next = world_from_tool * tool_from_next;
    next.rotation = normalized(next.rotation);
    return next;
}
inline bool is_finite(const Pose& p) noexcept {
    return is_finite(p.position) && std::isfinite(p.rotation.w) &&
           is_finite(Vec3{p.rotation.x, p.rotation.y, p.rotation.z});
}

constexpr Vec3 linear(const Vec6& v) noexcept { return {v[0], v[1], v[2]}; }
constexpr Vec3 angular(const Vec6& v) noexcept { return {v[3], v[4], v[5]}; }
constexpr Vec6 make_vec6(Vec3 linear_part, Vec3 angular_part) noexcept {
    return {linear_part.x, linear_part.y, linear_part.z, angular_part.x, angular_part.y, angular_part.z};
}
constexpr Vec6 scaled(double by, Vec6 v) noexcept {
    for (double& component : v) component *= by;
    return v;
}
constexpr double dot(const Vec6& a, const Vec6& b) noexcept {
    double sum = 0.0;
    for (std::size_t i = 0; i < 6; ++i) sum += a[i] * b[i];
    return sum;
}

}  // namespace kerf
