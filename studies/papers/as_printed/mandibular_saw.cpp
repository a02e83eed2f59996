// SPDX-License-Identifier: Apache-2.0
#include "mandibular_saw.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "kerf/exact_math.hpp"

namespace kerf::as_printed {

namespace {

constexpr std::size_t max_points = 128;

/// K⁻¹ v by Cramer's rule. No guard: as printed K may be singular.
Vec3 solved(const Matrix3& k, Vec3 v) noexcept {
    const Vec3 x{k[0].x, k[1].x, k[2].x}, y{k[0].y, k[1].y, k[2].y}, z{k[0].z, k[1].z, k[2].z};
    const double determinant = dot(x, cross(y, z));
    return {dot(v, cross(y, z)) / determinant, dot(x, cross(v, z)) / determinant, dot(x, cross(y, v)) / determinant};
}

struct Sum {
    int contacts = 0;
    Vec3 force{0, 0, 0}, torque{0, 0, 0};  ///< on the saw, about the middle of the blade; tool frame
    Vec3 compared{0, 0, 0};                ///< τ_r,t of equation (6)
};

/// Each contact alone (E04-5), its impulse over the length of the tick (E04-6).
Sum contacts_of(const MandibularSaw& law, const Held<PaperReciprocatingSaw>& tool, const BoneQuery& bone,
                const MandibularSaw::State& last) noexcept {
    const auto per_edge = std::min(static_cast<std::size_t>(law.points), max_points);
    const double inverse = 1.0 / (law.mass * law.gyration * law.gyration);
    const double direction = sin_cos_exact(last.phase).cos < 0.0 ? -1.0 : 1.0;
    const Vec3 w{4.0 * (0.5 * tool.stroke) * tool.reciprocation * direction, 0.0, 0.0};  // 4AFD
    const Vec3 middle{0.0, 0.0, -0.5 * tool.height};
    std::array<Vec3, max_points> point{};
    std::array<kerf_bone_sample, max_points> sample;
    std::array<kerf_surface_point, max_points> found;
    Sum sum;
    for (const double z : {0.0, -tool.height}) {
        for (std::size_t i = 0; i < per_edge; ++i) {
            const double fraction = (static_cast<double>(i) + 0.5) / static_cast<double>(per_edge) - 0.5;
            point[i] = {fraction * tool.length, 0.0, z};
        }
        bone.sample({point.data(), per_edge}, {0, 0, 1}, {sample.data(), per_edge});
        bone.nearest({point.data(), per_edge}, {found.data(), per_edge});
        for (std::size_t i = 0; i < per_edge; ++i) {
            const Vec3 normal = found[i].normal;
            if (sample[i].engagement < 0.5 || normal == Vec3{0, 0, 0} || dot(w, normal) > 0.0) continue;
            const Vec3 r = point[i] - middle;
            const Vec3 u = linear(last.rate) + cross(angular(last.rate), point[i]) + w;
            if (u == Vec3{0, 0, 0}) continue;
            const Matrix3 k = collision_matrix_as_printed(law.mass, {inverse, inverse, inverse}, r);
            Vec3 p = sticking_as_printed(k, u, law.restitution);
            const double pressed = dot(p, normal);
            if (length(p - pressed * normal) > law.friction * pressed)
                p = sliding_as_printed(k, u, normal, law.restitution, law.friction);
            const Vec3 force = p / tool.tick.dt;
            sum.contacts += z == 0.0;
            sum.force = sum.force + force;
            sum.torque = sum.torque + cross(r, force);
            sum.compared = sum.compared + torque_parts(r, force).in_plane;
        }
    }
    return sum;
}

}  // namespace

Vec3 times(const Matrix3& m, Vec3 v) noexcept { return {dot(m[0], v), dot(m[1], v), dot(m[2], v)}; }

Matrix3 collision_matrix_as_printed(double mass, Vec3 inverse_inertia, Vec3 r) noexcept {
    const auto column = [&](Vec3 e) {
        const Vec3 a = cross(r, e);
        return e / mass +
               cross(r, {inverse_inertia.x * a.x, inverse_inertia.y * a.y, inverse_inertia.z * a.z});  // r* J⁻¹ r* e
    };
    const Vec3 x = column({1, 0, 0}), y = column({0, 1, 0}), z = column({0, 0, 1});
    return {Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}};
}
Vec3 sticking_as_printed(const Matrix3& k, Vec3 u, double restitution) noexcept {
    return solved(k, -restitution * u - u);
}
double denominator_as_printed(const Matrix3& k, Vec3 u, Vec3 normal, double friction) noexcept {
    return dot(normal, times(k, normal - friction * normalized(u)));
}
Vec3 sliding_as_printed(const Matrix3& k, Vec3 u, Vec3 normal, double restitution, double friction) noexcept {
    const Vec3 direction = normal - friction * normalized(u);
    const double factor = -(restitution + 1.0) / denominator_as_printed(k, u, normal, friction);
    return {factor * u.x * direction.x, factor * u.y * direction.y, factor * u.z * direction.z};
}
TorqueParts torque_parts(Vec3 arm, Vec3 force) noexcept {
    const Vec3 across{0.0, force.y, 0.0};
    return {cross(arm, across), cross(arm, force - across)};
}

void MandibularSaw::resist(const Held<PaperReciprocatingSaw>& tool, const BoneQuery& bone, const State& state,
                           Channels& channels) const noexcept {
    const Sum sum = contacts_of(*this, tool, bone, state);
    channels.push(sum.force, sum.torque + cross({0.0, 0.0, -0.5 * tool.height}, sum.force));
}

void MandibularSaw::commit(const Held<PaperReciprocatingSaw>& tool, const BoneQuery& bone, const Advance& advance,
                           State& state, Signals& signals, Actions& actions) const noexcept {
    const Sum sum = contacts_of(*this, tool, bone, state);
    signals.contacts = sum.contacts;
    signals.f_x = sum.force.x;
    signals.f_y = sum.force.y;
    signals.f_z = -sum.force.z;
    signals.torque = length(sum.compared);
    state.rate = advance.rate;
    state.phase += 2.0 * pi * tool.reciprocation * tool.tick.dt;
    while (state.phase >= 2.0 * pi) state.phase -= 2.0 * pi;
    if (tool.reciprocation > 0.0) actions.cut();
}

}  // namespace kerf::as_printed
