// SPDX-License-Identifier: Apache-2.0
#include "conformance/plane_bone.h"

#include <algorithm>
#include <utility>

namespace kerf::conformance {

PlaneBone::PlaneBone(const Settings& settings) : settings_(settings) {
    constexpr double reach_in_voxels = 4.0;  // as the host's fields
    query_ = {sizeof(kerf_bone_query), settings.tissues, reach_in_voxels * settings.voxel,        &sample_entry,
              &nearest_entry,          &threads_entry,   reinterpret_cast<const kerf_bone*>(this)};
}

PlaneBone::Counts PlaneBone::take_counts() noexcept { return std::exchange(counts_, {}); }

/// Negative inside bone [m].
double PlaneBone::distance_at(Vec3 point_in_tool, Vec3* normal_in_tool) const noexcept {
    if (settings_.shape == Shape::air) return query_.reach;
    if (settings_.shape == Shape::endless) return -query_.reach;
    const double z = (bone_from_tool_ * point_in_tool).z, above = z, below = -settings_.thickness - z;
    if (normal_in_tool != nullptr)
        *normal_in_tool = rotate(conjugate(bone_from_tool_.rotation), Vec3{0, 0, above >= below ? 1.0 : -1.0});
    return std::max(above, below);
}

std::int32_t PlaneBone::body_at(Vec3 point_in_tool) const noexcept {
    return settings_.body + (settings_.is_split && (bone_from_tool_ * point_in_tool).x > 0.0 ? 1 : 0);
}

void PlaneBone::sample(const Vec3* points, std::uint32_t count, kerf_bone_sample* out) noexcept {
    const double ramp = 0.25 * settings_.voxel;  // as in core/field/grid/body.h
    for (std::uint32_t i = 0; i < count; ++i) {
        kerf_bone_sample& s = out[i] = kerf_bone_sample{};
        s.engagement = std::clamp(0.5 - distance_at(points[i], nullptr) / ramp, 0.0, 1.0);
        for (std::uint32_t t = 0; t < settings_.tissues; ++t) {
            const std::uint32_t rank = (t + settings_.tissues - settings_.first) % settings_.tissues;
            s.weight[t] = rank == 0 ? settings_.fraction_of_first : rank == 1 ? 1.0 - settings_.fraction_of_first : 0.0;
            s.density[t] = (rank == 0 ? 1.0 : settings_.others) * settings_.density;
        }
        if (s.engagement > 0.0) s.gap = settings_.gap;
        s.body = s.engagement > 0.0 ? body_at(points[i]) : -1;
    }
}

void PlaneBone::nearest(const Vec3* points, std::uint32_t count, kerf_surface_point* out) noexcept {
    for (std::uint32_t i = 0; i < count; ++i) {
        kerf_surface_point& s = out[i] = kerf_surface_point{};
        Vec3 normal{};
        const double distance = distance_at(points[i], &normal);
        s.distance = std::clamp(distance, -query_.reach, query_.reach);
        s.body = distance > -query_.reach && distance < query_.reach ? body_at(points[i]) : -1;
        s.normal = s.body < 0 ? Vec3{} : normal;
    }
}

void PlaneBone::sample_entry(const kerf_bone* bone, const kerf_vec3* points, std::uint32_t count, const kerf_vec3*,
                             std::uint32_t, kerf_bone_sample* out) {
    auto& self = *const_cast<PlaneBone*>(reinterpret_cast<const PlaneBone*>(bone));
    ++self.counts_.queries;
    self.counts_.points += count;
    self.sample(points, count, out);
}

void PlaneBone::nearest_entry(const kerf_bone* bone, const kerf_vec3* points, std::uint32_t count,
                              kerf_surface_point* out) {
    auto& self = *const_cast<PlaneBone*>(reinterpret_cast<const PlaneBone*>(bone));
    ++self.counts_.queries;
    self.counts_.points += count;
    self.nearest(points, count, out);
}

std::uint32_t PlaneBone::threads_entry(const kerf_bone* bone, kerf_thread* out, std::uint32_t capacity) {
    const auto& self = *reinterpret_cast<const PlaneBone*>(bone);
    const ToolInBody here{self.settings_.body, self.bone_from_tool_};
    return self.threads_.write({&here, 1}, out, capacity);
}

}  // namespace kerf::conformance
