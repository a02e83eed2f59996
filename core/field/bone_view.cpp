// SPDX-License-Identifier: Apache-2.0
#include "core/field/bone_view.h"

#include <algorithm>

namespace kerf {

void BoneView::sample(const Vec3* points, std::uint32_t count, Vec3 direction, kerf_bone_sample* out) const noexcept {
    const double h = body_->grid().spacing;
    const Vec3 direction_in_body = rotate(body_from_tool_.rotation, direction);
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3 p = body_from_tool_ * points[i];
        const BrickPlace place = locate(body_->grid(), p);
        kerf_bone_sample& s = out[i];
        s = kerf_bone_sample{};
        s.body = -1;
        s.engagement = coverage(std::max(body_->surface.at(place), committed_->at(place)), h);
        if (s.engagement <= 0.0) continue;
        s.body = 0;
        s.gap = tracker_->gap(p, direction_in_body);
        material_weights(*body_, place, s.weight);
        for (std::size_t m = 0; m < body_->materials.size(); ++m) s.density[m] = body_->materials[m].density;
    }
}

double BoneView::present_distance(Vec3 p) const noexcept {
    const BrickPlace place = locate(body_->grid(), p);
    const double bone = std::max(body_->surface.at(place), committed_->at(place));
    if (bone >= body_->grid().clamp()) return bone;
    return std::max(bone, tracker_->depth_in_pending(p));
}

void BoneView::nearest(const Vec3* points, std::uint32_t count, kerf_surface_point* out) const noexcept {
    const double h = body_->grid().spacing;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec3 p = body_from_tool_ * points[i];
        kerf_surface_point& s = out[i];
        s = kerf_surface_point{};
        s.body = -1;
        s.distance = present_distance(p);
        if (s.distance >= body_->grid().clamp() || s.distance <= -body_->grid().clamp()) continue;
        s.body = 0;
        const double e = 0.5 * h;
        const Vec3 gradient{present_distance(p + Vec3{e, 0, 0}) - present_distance(p - Vec3{e, 0, 0}),
                            present_distance(p + Vec3{0, e, 0}) - present_distance(p - Vec3{0, e, 0}),
                            present_distance(p + Vec3{0, 0, e}) - present_distance(p - Vec3{0, 0, e})};
        s.normal = rotate(conjugate(body_from_tool_.rotation), normalized(gradient));
    }
}

}  // namespace kerf
