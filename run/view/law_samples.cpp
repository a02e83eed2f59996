// SPDX-License-Identifier: Apache-2.0
#include "run/view/law_samples.h"

namespace kerf::run {

namespace {

LawSamples* self(const kerf_bone* bone) {
    return reinterpret_cast<LawSamples*>(const_cast<kerf_bone*>(bone));  // made from a LawSamples that is not const
}

}  // namespace

LawSamples::LawSamples(const kerf_bone_query& bone) : bone_(&bone), query_(bone) {
    points_.reserve(max_viewed_samples);
    query_.bone = reinterpret_cast<const kerf_bone*>(this);
    query_.sample = [](const kerf_bone* of, const kerf_vec3* points, std::uint32_t count, const kerf_vec3* directions,
                       std::uint32_t direction_count, kerf_bone_sample* out) {
        const kerf_bone_query& inner = *self(of)->bone_;
        inner.sample(inner.bone, points, count, directions, direction_count, out);
        self(of)->add_edges(points, count, directions, direction_count, out);
    };
    query_.nearest = [](const kerf_bone* of, const kerf_vec3* points, std::uint32_t count, kerf_surface_point* out) {
        const kerf_bone_query& inner = *self(of)->bone_;
        inner.nearest(inner.bone, points, count, out);
        self(of)->add_contacts(points, count, out);
    };
    if (bone.threads == nullptr) return;
    query_.threads = [](const kerf_bone* of, kerf_thread* out, std::uint32_t capacity) {
        const kerf_bone_query& inner = *self(of)->bone_;
        return inner.threads(inner.bone, out, capacity);
    };
}

void LawSamples::add_edges(const kerf_vec3* points, std::uint32_t count, const kerf_vec3* directions,
                           std::uint32_t direction_count, const kerf_bone_sample* answers) {
    count_ += count;
    for (std::uint32_t i = 0; i < count && points_.size() < max_viewed_samples; ++i)
        points_.push_back({.point = points[i],
                           .direction = directions[direction_count == count ? i : 0],
                           .distance = answers[i].gap,
                           .engagement = answers[i].engagement,
                           .is_edge = true,
                           .body = static_cast<std::int16_t>(answers[i].body)});
}

void LawSamples::add_contacts(const kerf_vec3* points, std::uint32_t count, const kerf_surface_point* answers) {
    count_ += count;
    for (std::uint32_t i = 0; i < count && points_.size() < max_viewed_samples; ++i)
        points_.push_back({.point = points[i],
                           .direction = answers[i].normal,
                           .distance = answers[i].distance,
                           .engagement = answers[i].body >= 0 && answers[i].distance < 0.0 ? 1.0 : 0.0,
                           .is_edge = false,
                           .body = static_cast<std::int16_t>(answers[i].body)});
}

}  // namespace kerf::run
