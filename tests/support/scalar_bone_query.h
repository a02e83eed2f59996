// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/field/cut/body_query.h"

/// What `BodyQuery` answers, point by point and straight down: the reference for the batch kernel.
namespace kerf::test {

struct ScalarBoneQuery {
    const Body& body;
    const CutField& committed;
    const CutTracker& tracker;
    Pose body_from_tool;

    [[nodiscard]] kerf_bone_sample sample(Vec3 point, Vec3 direction) const {
        const LocatedPoint place = place_of(point);
        kerf_bone_sample s{};
        s.body = -1;
        s.engagement = static_cast<double>(engagement(body.surface.quanta_at(place), committed.quanta_at(place)));
        if (s.engagement <= 0.0) return s;
        s.body = 0;
        if (can_be_cut(point)) s.gap = gap(point, direction);
        material_weights(body, place, s.weight);
        for (std::size_t m = 0; m < body.materials.size(); ++m)
            s.density[m] = body.materials[m].densities.at(place, body.materials[m].density);
        return s;
    }

    /// Without pending solids: those `deepest_pending` tells.
    [[nodiscard]] kerf_surface_point nearest_committed(Vec3 point) const {
        const double clamp = body.grid().clamp();
        const LocatedPoint place = place_of(point);
        const bool is_cut = body.surface.quanta_at(place) < committed.quanta_at(place);
        kerf_surface_point s{};
        s.body = -1;
        s.distance = is_cut ? committed.at(place) : body.surface.at(place);
        if (s.distance >= clamp || s.distance <= -clamp) return s;
        s.body = 0;
        s.normal = committed_normal(point, place, is_cut);
        return s;
    }
    /// In double; nothing where no pending solid can change the answer.
    [[nodiscard]] double deepest_pending(Vec3 point) const {
        double deepest = -1.0;
        if (!can_be_cut(point) || nearest_committed(point).distance >= body.grid().clamp()) return deepest;
        for (std::size_t i = 0; i < tracker.solid_count(); ++i)
            deepest = std::max(deepest, -tracker.solid().distance(tracker.solid_from_tool(i, body_from_tool) * point));
        return deepest;
    }
    /// Whether a normal is that of a pending solid which is as deep, give or take `tolerance` [m].
    [[nodiscard]] bool is_pending_normal(Vec3 point, Vec3 normal, double deepest, double tolerance) const {
        for (std::size_t i = 0; i < tracker.solid_count(); ++i) {
            const Frame solid_from = tracker.solid_from_tool(i, body_from_tool);
            const Vec3 p = solid_from * point;
            if (-tracker.solid().distance(p) < deepest - tolerance) continue;
            if (length(turned_back(solid_from, tracker.solid().inward_direction(p)) - normal) < 1e-5) return true;
        }
        return false;
    }
    /// As all of the definition has it, in double.
    [[nodiscard]] kerf_surface_point nearest(Vec3 point) const {
        kerf_surface_point s = nearest_committed(point);
        const double deepest = deepest_pending(point);
        if (!(deepest > s.distance)) return s;
        s.distance = deepest;
        const bool is_near = deepest < body.grid().clamp();
        s.body = is_near ? 0 : -1;
        s.normal = {0, 0, 0};
        for (std::size_t i = 0; is_near && i < tracker.solid_count(); ++i) {
            const Frame solid_from = tracker.solid_from_tool(i, body_from_tool);
            if (-tracker.solid().distance(solid_from * point) == deepest)
                s.normal = turned_back(solid_from, tracker.solid().inward_direction(solid_from * point));
        }
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

    /// As the whole of the definition has it, in double: what the answer is near to.
    [[nodiscard]] double present(Vec3 p) const {
        const LocatedPoint place = locate(body, p);
        const double bone = std::max(body.surface.at(place), committed.at(place));
        if (bone >= body.grid().clamp()) return bone;
        return std::max(bone, body.region.contains(p) ? tracker.depth_in_pending(p) : -body.grid().clamp());
    }

private:
    [[nodiscard]] GridFrame grid() const { return {body.grid(), body.region, frame_of(body_from_tool)}; }
    [[nodiscard]] LocatedPoint place_of(Vec3 point) const {
        const Lattice lattice = grid().lattice();
        const Vec3 g = grid() * point;
        const auto kept = [&](std::size_t axis, double v) {
            return !lattice.is_bounded || v != v ? v : std::clamp(v, lattice.low[axis], lattice.high[axis]);
        };
        return locate_fixed(body.grid(), lattice.bits, kept(0, g.x), kept(1, g.y), kept(2, g.z));
    }
    /// −1 or 1 beyond the region's faces across an axis, 0 on one, else between.
    [[nodiscard]] double side(std::size_t axis, double v) const {
        const Lattice lattice = grid().lattice();
        return !lattice.is_bounded                               ? 0.5
               : v < lattice.low[axis]                           ? -1.0
               : v > lattice.high[axis]                          ? 1.0
               : v > lattice.low[axis] && v < lattice.high[axis] ? 0.5
                                                                 : 0.0;
    }
    [[nodiscard]] bool can_be_cut(Vec3 point) const {
        const Vec3 g = grid() * point;
        return side(0, g.x) == 0.5 && side(1, g.y) == 0.5 && side(2, g.z) == 0.5;
    }
    [[nodiscard]] double gap(Vec3 point, Vec3 direction) const {
        double gap = 0.0;
        for (std::size_t i = tracker.first_with_gap(); i < tracker.solid_count(); ++i) {
            const Frame solid_from = tracker.solid_from_tool(i, body_from_tool);
            gap = std::max(gap, tracker.solid().travel_to_leave(solid_from * point, turned(solid_from, direction)));
        }
        return gap;
    }
    /// Of the field that has the surface; tool frame, unit or zero.
    [[nodiscard]] Vec3 committed_normal(Vec3 point, const LocatedPoint& place, bool is_cut) const {
        const std::int16_t* brick = !place.is_inside ? nullptr
                                    : is_cut         ? committed.stored(place.brick)
                                                     : body.surface.stored(place.brick);
        if (brick == nullptr) return {0, 0, 0};
        std::array<float, 3> slope = trilinear_gradient(brick, place);
        const Vec3 g = grid() * point;
        if (std::abs(side(0, g.x)) == 1.0) slope[0] = 0.0f;
        if (std::abs(side(1, g.y)) == 1.0) slope[1] = 0.0f;
        if (std::abs(side(2, g.z)) == 1.0) slope[2] = 0.0f;
        const float length = std::sqrt((slope[0] * slope[0] + slope[1] * slope[1]) + slope[2] * slope[2]);
        const float to_unit = length > 0.0f ? 1.0f / length : 0.0f;
        const Frame f = frame_of(body_from_tool);
        const auto along = [&](Vec3 axis) {  // of the tool, in the body
            return static_cast<double>((static_cast<float>(axis.x) * (slope[0] * to_unit) +
                                        static_cast<float>(axis.y) * (slope[1] * to_unit)) +
                                       static_cast<float>(axis.z) * (slope[2] * to_unit));
        };
        return {along(f.x), along(f.y), along(f.z)};
    }
    static std::array<float, 3> trilinear_gradient(const std::int16_t* brick, const LocatedPoint& at) {
        const std::int16_t* v = brick + at.offset;
        constexpr int y = stored_edge, z = stored_edge * stored_edge;
        const auto lerp = [](float a, float b, float t) { return a + (b - a) * t; };
        const auto bilinear = [&](int a, int b, int c, int d, float s, float t) {
            return lerp(lerp(static_cast<float>(a), static_cast<float>(b), s),
                        lerp(static_cast<float>(c), static_cast<float>(d), s), t);
        };
        const auto along_x = [&](int i) { return lerp(v[i], v[i + 1], at.fx); };
        return {bilinear(v[1] - v[0], v[y + 1] - v[y], v[z + 1] - v[z], v[z + y + 1] - v[z + y], at.fy, at.fz),
                lerp(along_x(y) - along_x(0), along_x(z + y) - along_x(z), at.fz),
                lerp(along_x(z), along_x(z + y), at.fy) - lerp(along_x(0), along_x(y), at.fy)};
    }
};

}  // namespace kerf::test
