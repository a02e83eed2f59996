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
        s.engagement = engagement(body.surface.at(place), committed.at(place), body.grid().spacing);
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
        const double clamp = body.grid().clamp();
        kerf_surface_point s{};
        s.body = -1;
        s.distance = present(p);
        if (s.distance >= clamp || s.distance <= -clamp) return s;
        s.body = 0;
        s.normal = rotate(conjugate(body_from_tool.rotation), normalized(gradient(p)));
        return s;
    }

    /// As central differences over a voxel have the normal: smoother than the gradient, and seven times the work.
    [[nodiscard]] Vec3 normal_by_differences(Vec3 point) const {
        const Vec3 p = body_from_tool * point;
        const double e = 0.5 * body.grid().spacing;
        const Vec3 differences{present(p + Vec3{e, 0, 0}) - present(p - Vec3{e, 0, 0}),
                               present(p + Vec3{0, e, 0}) - present(p - Vec3{0, e, 0}),
                               present(p + Vec3{0, 0, e}) - present(p - Vec3{0, 0, e})};
        return rotate(conjugate(body_from_tool.rotation), normalized(differences));
    }

private:
    [[nodiscard]] double committed_distance(const BrickPlace& place) const {
        return std::max(body.surface.at(place), committed.at(place));
    }
    [[nodiscard]] double present(Vec3 p) const {
        const double bone = committed_distance(locate(body, p));
        if (bone >= body.grid().clamp()) return bone;
        return std::max(bone, body.region.contains(p) ? tracker.depth_in_pending(p) : -body.grid().clamp());
    }
    /// Of the field that has the surface nearest to the point; any length.
    [[nodiscard]] Vec3 gradient(Vec3 p) const {
        const BrickPlace place = locate(body, p);
        if (present(p) > std::max(committed_distance(place), -body.grid().clamp())) {
            const double depth = tracker.depth_in_pending(p);
            std::uint8_t wall = static_cast<std::uint8_t>(tracker.pending_count() - 1);
            if (tracker.depth_in_pending(wall, p) != depth)
                for (wall = 0; tracker.depth_in_pending(wall, p) != depth;) ++wall;
            return tracker.normal_of(wall, p);
        }
        const bool is_cut = body.surface.at(place) < committed.at(place);
        const std::int16_t* brick = is_cut ? committed.stored(place.brick) : body.surface.stored(place.brick);
        if (brick == nullptr) return {0, 0, 0};
        Vec3 slope = trilinear_gradient(brick, place);
        const Vec3 within = body.region.nearest(p);
        return {within.x == p.x ? slope.x : 0.0, within.y == p.y ? slope.y : 0.0, within.z == p.z ? slope.z : 0.0};
    }
    static Vec3 trilinear_gradient(const std::int16_t* brick, const BrickPlace& at) {
        const std::int16_t* v = brick + at.offset;
        constexpr int y = stored_edge, z = stored_edge * stored_edge;
        const auto lerp = [](double a, double b, double t) { return a + (b - a) * t; };
        const auto bilinear = [&](double a, double b, double c, double d, double s, double t) {
            return lerp(lerp(a, b, s), lerp(c, d, s), t);
        };
        const auto along_x = [&](int i) { return lerp(v[i], v[i + 1], at.fx); };
        return {bilinear(v[1] - v[0], v[y + 1] - v[y], v[z + 1] - v[z], v[z + y + 1] - v[z + y], at.fy, at.fz),
                lerp(along_x(y) - along_x(0), along_x(z + y) - along_x(z), at.fz),
                lerp(along_x(z), along_x(z + y), at.fy) - lerp(along_x(0), along_x(y), at.fy)};
    }
};

}  // namespace kerf::test
