// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/field/bone_view.h"

/// What `BoneView` answers, point by point and straight down: the reference for the batch kernel.
namespace kerf::test {

struct ScalarBoneQuery {
    const Body& body;
    const CutField& committed;
    const CutTracker& tracker;
    Pose body_from_tool;

    [[nodiscard]] kerf_bone_sample sample(Vec3 point, Vec3 direction) const {
        const Vec3 p = body_from_tool * point;
        const BrickPlace place = locate(body, p);
        kerf_bone_sample s{};
        s.body = -1;
        s.engagement = coverage(std::max(body.surface.at(place), committed.at(place)), body.grid().spacing);
        if (s.engagement <= 0.0) return s;
        s.body = 0;
        if (body.region.contains(p)) s.gap = tracker.gap(p, rotate(body_from_tool.rotation, direction));
        material_weights(body, place, s.weight);
        for (std::size_t m = 0; m < body.materials.size(); ++m)
            s.density[m] = body.materials[m].densities.at(place, body.materials[m].density);
        return s;
    }

    [[nodiscard]] kerf_surface_point nearest(Vec3 point) const {
        const Vec3 p = body_from_tool * point;
        const double clamp = body.grid().clamp(), e = 0.5 * body.grid().spacing;
        kerf_surface_point s{};
        s.body = -1;
        s.distance = present(p);
        if (s.distance >= clamp || s.distance <= -clamp) return s;
        s.body = 0;
        const Vec3 gradient{present(p + Vec3{e, 0, 0}) - present(p - Vec3{e, 0, 0}),
                            present(p + Vec3{0, e, 0}) - present(p - Vec3{0, e, 0}),
                            present(p + Vec3{0, 0, e}) - present(p - Vec3{0, 0, e})};
        s.normal = rotate(conjugate(body_from_tool.rotation), normalized(gradient));
        return s;
    }

private:
    [[nodiscard]] double present(Vec3 p) const {
        const BrickPlace place = locate(body, p);
        const double bone = std::max(body.surface.at(place), committed.at(place));
        if (bone >= body.grid().clamp()) return bone;
        return std::max(bone, body.region.contains(p) ? tracker.depth_in_pending(p) : -body.grid().clamp());
    }
};

}  // namespace kerf::test
