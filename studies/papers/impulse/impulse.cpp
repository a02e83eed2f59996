// SPDX-License-Identifier: Apache-2.0
#include "impulse.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>

namespace kerf::papers {

namespace {

/// Returns the impulse of a single strike; `u` [m/s] is the velocity at its point before the strike.
Vec3 impulse_of(const Strike& strike, Vec3 u, double friction) noexcept {
    const Vec3 n = strike.normal;
    const double approach = dot(u, n);
    const Vec3 sticking = strike.inverse * (strike.rebound * n - u);
    const double pressed = dot(sticking, n);
    const Vec3 sideways = sticking - pressed * n;
    if (pressed >= 0.0 && dot(sideways, sideways) <= friction * friction * pressed * pressed) return sticking;

    const Vec3 t = normalized(u - approach * n), direction = n - friction * t;
    // If friction pressed the point into bone faster than the impulse lifts it, only a part of it counts.
    constexpr double min_lift = 0.1;  // [–] of that without friction
    const double alone = dot(n, strike.softened * n),
                 lift = std::max(dot(n, strike.softened * direction), min_lift * alone);
    return std::max(0.0, (strike.rebound - approach) / lift) * direction;
}

/// Returns one strike that replaces all: their mean point, normal and softness.
Strike middle_of(std::span<const Strike> strikes) noexcept {
    Strike sum{};
    if (strikes.empty()) return sum;
    for (const Strike& one : strikes) {
        sum.r = sum.r + one.r;
        sum.normal = sum.normal + one.normal;
        sum.softness += one.softness;
    }
    const auto count = static_cast<double>(strikes.size());
    sum.r = sum.r / count;
    sum.normal = normalized(sum.normal);
    sum.softness /= count * count;  // side by side
    return sum;
}

/// Returns the step from one strike to the next of a sweep: near the golden section of `count`, without a common
/// divisor. From neighbour to neighbour a sweep along a row would hand the row's turning on and never take it away.
std::size_t stride_of(std::size_t count) noexcept {
    if (count < 3) return 1;
    auto stride = static_cast<std::size_t>(0.6180339887498949 * static_cast<double>(count));
    while (std::gcd(stride, count) != 1) ++stride;
    return stride;
}

}  // namespace

Symmetric3 inverse_of(const Symmetric3& m) noexcept {
    const double xx = m.yy * m.zz - m.yz * m.yz, xy = m.xz * m.yz - m.xy * m.zz, xz = m.xy * m.yz - m.xz * m.yy;
    const double determinant = m.xx * xx + m.xy * xy + m.xz * xz;
    return {xx / determinant,
            (m.xx * m.zz - m.xz * m.xz) / determinant,
            (m.xx * m.yy - m.xy * m.xy) / determinant,
            xy / determinant,
            xz / determinant,
            (m.xy * m.xz - m.xx * m.yz) / determinant};
}

Symmetric3 collision_matrix(const RigidTool& tool, Vec3 r) noexcept {
    // Column i is e_i/M + (J⁻¹ (r × e_i)) × r.
    const auto column = [&](Vec3 e) { return cross(tool.inverse_inertia * cross(r, e), r); };
    const Vec3 x = column({1, 0, 0}), y = column({0, 1, 0}), z = column({0, 0, 1});
    const double of_mass = 1.0 / tool.mass;
    return {of_mass + x.x, of_mass + y.y, of_mass + z.z, y.x, z.x, z.y};
}

Struck solve_strikes(const RigidTool& tool, const RigidMotion& before, const Restitution& law,
                     std::span<Strike> strikes) noexcept {
    const auto prepare = [&](Strike& one) {
        one.k = collision_matrix(tool, one.r);
        one.softened = one.k;
        for (double* diagonal : {&one.softened.xx, &one.softened.yy, &one.softened.zz}) *diagonal += one.softness;
        one.inverse = inverse_of(one.softened);
        one.rebound = -law.restitution * std::min(0.0, dot(before.at(one.r), one.normal));
    };
    for (Strike& one : strikes) prepare(one);
    // Begin with one strike in the middle of all: sweeps bring a row to one speed at once, and slowly to one direction.
    const Strike middle = middle_of(strikes);
    Vec3 first{0, 0, 0};
    if (middle.normal != Vec3{0, 0, 0}) {
        Strike all = middle;
        prepare(all);
        first = impulse_of(all, before.at(all.r), law.friction) / static_cast<double>(strikes.size());
    }
    RigidMotion now = before;
    const auto apply = [&](const Strike& one, Vec3 impulse) {
        now.velocity = now.velocity + impulse / tool.mass;
        now.turn = now.turn + tool.inverse_inertia * cross(one.r, impulse);
    };
    for (Strike& one : strikes) {
        one.impulse = first;
        apply(one, first);
    }
    const std::size_t stride = stride_of(strikes.size());
    std::size_t at = 0;
    for (int sweep = 0; sweep < impulse_sweeps; ++sweep)
        for (std::size_t n = 0; n < strikes.size(); ++n, at = (at + stride) % strikes.size()) {
            Strike& one = strikes[at];
            const Vec3 without = now.at(one.r) - one.k * one.impulse;
            const Vec3 impulse = impulse_of(one, without, law.friction);
            apply(one, impulse - one.impulse);
            one.impulse = impulse;
        }

    // With all impulses times α the energy changes by α b + α² a.
    double b = 0.0;
    Vec3 sum{0, 0, 0}, moment{0, 0, 0};
    for (const Strike& one : strikes) {
        b += dot(one.impulse, before.at(one.r));
        sum = sum + one.impulse;
        moment = moment + cross(one.r, one.impulse);
    }
    const Vec3 gained = sum / tool.mass, turned = tool.inverse_inertia * moment;
    const double a = 0.5 * (dot(sum, gained) + dot(moment, turned));
    Struck struck;
    if (a > 0.0) struck.fraction = std::clamp(-b / a, 0.0, 1.0);
    for (Strike& one : strikes) one.impulse = struck.fraction * one.impulse;
    struck.motion = {before.velocity + struck.fraction * gained, before.turn + struck.fraction * turned};
    struck.energy = struck.fraction * (b + struck.fraction * a);
    return struck;
}

}  // namespace kerf::papers
