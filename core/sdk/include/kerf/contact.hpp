// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "kerf/contact_points.hpp"
#include "kerf/force.hpp"

namespace kerf {

/// Contact between points of a tool and bone, combined into a few contact channels.
///
/// A smooth tool pushes along its own normal. Let a be the cosine between the bone's normal and the tool's reversed
/// normal. At depth p the force is k p a and the stiffness k a². So a point that turns away loses contact without a
/// jump, and a ledge in the wall of a hole does not stop a round shank.
///
/// Each point belongs to a slot, and each slot makes one channel: a weighted mean of its points nearly as deep as its
/// deepest one. With the deepest alone, the force would jump between two points.
/// Call `query_bone`, then `write`.   [haptic, nonblocking]
class Contact {
public:
    static constexpr std::size_t max_points = ContactPoints::max_points, max_slots = ContactPoints::max_slots;

    /// `points` must outlive this object.
    explicit Contact(const ContactPoints& points) noexcept : points_(points) {}

    /// Queries the bone near all points. Near a point deep in bone, the nearest surface may be another wall, or be out
    /// of the reach of a fine grid. So for a point deeper than 0.1 mm (or a quarter of the reach, if less), it also
    /// searches inside the tool. There it finds the own wall of the point, up to `inwards` [m] behind the point. So
    /// neither of them changes the stiffness of a bent drill in its hole.
    void query_bone(const BoneQuery& bone, double inwards) noexcept {
        std::array<kerf_surface_point, max_points> found;
        bone.nearest(points_.all(), {found.data(), points_.count()});
        const double deep = std::min(deep_contact, 0.25 * bone.reach());
        std::array<Wall, max_points> walls;
        std::size_t wall_count = 0;
        deep_count_ = 0;
        for (std::size_t i = 0; i < points_.count(); ++i) {
            touch_[i] = touch(i, found[i]);
            depth_[i] = -found[i].distance;
            if (depth_[i] <= deep) continue;
            // 0 at `deep`, where the search begins; 1 from twice that depth on, where the search alone counts.
            const double beyond = std::min(1.0, depth_[i] / deep - 1.0);
            if (beyond <= 0.0) continue;
            Wall& wall = walls[wall_count++] = {i, beyond};
            wall.add(1.0 - beyond, touch_[i], depth_[i], 0.0);
        }
        if (wall_count > 0) search_walls(bone, inwards, {walls.data(), wall_count});
    }
    /// A point so deep that its wall was searched for.
    struct DeepPoint {
        std::size_t point;
        double found;  ///< [–] fraction of the wall that the search found; the rest has no force, unless `hold` adds it
    };
    [[nodiscard]] std::span<const DeepPoint> deep() const noexcept { return {deep_.data(), deep_count_}; }
    [[nodiscard]] double depth(std::size_t i) const noexcept { return depth_[i]; }
    /// Adds the part of the point's wall that the search did not find, as a wall that faces the point squarely.
    /// @param depth  [m] of the point in that wall, which the law computes
    void hold(const DeepPoint& one, double depth) noexcept {
        if (depth <= 0.0 || one.found >= 1.0) return;
        const Touch& seen = touch_[one.point];
        Wall wall{one.point, 1.0};
        wall.add(1.0, seen, depth_[one.point], 0.0);
        wall.add(1.0 - one.found, {1.0, 1.0}, depth, 0.0);
        take(wall);
    }

    /// Returns whether the nearest bone is at most 0.3 mm away, or around the point, and faces it. Else the point has
    /// no force.
    [[nodiscard]] bool faces_bone(std::size_t i) const noexcept { return touch_[i].fraction > 0.0; }
    /// Replaces the queried depth [m] of the point along the bone's normal by one that the law computes.
    void set_depth(std::size_t i, double depth) noexcept { depth_[i] = depth; }
    /// Limits the force of the bone on the point to `force` [N]: deeper bone yields.
    void limit_force(std::size_t i, double force) noexcept {
        const double pressed = points_.stiffness(i) * depth_[i];
        if (pressed > force) touch_[i].fraction *= force / pressed;
    }

    /// Adds a channel for each slot in contact or near it. To leave `kept_free` channels free, it drops the slots
    /// farthest from contact.
    /// @param follow  wrench on the tool per newton of each of these channels [N/N, N·m/N]
    void write(Channels& channels, std::uint32_t first_id, std::size_t kept_free,
               const Vec6& follow = {}) const noexcept {
        std::array<double, max_slots> deepest;
        deepest.fill(-near_contact);
        std::array<double, max_points> pressed;  // [m] depth, reduced where the bone does not face the tool
        for (std::size_t i = 0; i < points_.count(); ++i) {
            if (!faces_bone(i)) continue;
            pressed[i] = depth_[i] * (depth_[i] > 0.0 ? touch_[i].fraction * touch_[i].against : 1.0);
            deepest[points_.slot(i)] = std::max(deepest[points_.slot(i)], pressed[i]);
        }
        struct Sum {
            double weight = 0.0, force = 0.0, stiffness = 0.0;
            Vec6 d{};
        };
        std::array<Sum, max_slots> sums{};
        for (std::size_t i = 0; i < points_.count(); ++i) {
            if (!faces_bone(i)) continue;
            const double of_slot = deepest[points_.slot(i)],
                         ahead = pressed[i] - of_slot + std::max(min_depth_range, 0.5 * of_slot);
            if (ahead <= 0.0) continue;
            Sum& sum = sums[points_.slot(i)];
            const double weight = ahead * ahead, against = touch_[i].against;
            const double stiffness = weight * touch_[i].fraction * against * against * points_.stiffness(i);
            const Vec6 d = rate_at(points_.at(i), points_.outwards(i));
            sum.weight += weight;
            sum.stiffness += stiffness;
            sum.force += stiffness * depth_[i] / against;
            for (std::size_t k = 0; k < 6; ++k) sum.d[k] += stiffness * d[k];
        }
        const std::size_t taken = std::min<std::size_t>(channels.count() + kept_free, KERF_MAX_CHANNELS),
                          room = KERF_MAX_CHANNELS - taken;
        std::size_t touching = 0;
        for (const Sum& sum : sums) touching += sum.weight > 0.0;
        for (; touching > room; --touching) {
            std::size_t farthest = max_slots;
            for (std::size_t slot = 0; slot < max_slots; ++slot)
                if (sums[slot].weight > 0.0 && (farthest == max_slots || deepest[slot] < deepest[farthest]))
                    farthest = slot;
            sums[farthest].weight = 0.0;
        }
        for (std::size_t slot = 0; slot < max_slots; ++slot) {
            const Sum& sum = sums[slot];
            if (sum.weight <= 0.0) continue;
            kerf_channel* channel = channels.add(KERF_CONTACT, first_id + static_cast<std::uint32_t>(slot));
            for (std::size_t k = 0; k < 6; ++k) channel->d[k] = sum.d[k] / sum.stiffness;
            channel->k = sum.stiffness / sum.weight;
            channel->delta = sum.force / sum.stiffness;  // so k delta is a mean of the points' forces
            std::copy(follow.begin(), follow.end(), channel->follow);
        }
    }

private:
    static constexpr double near_contact = 0.3e-3;  ///< [m] points farther from bone make no channel
    static constexpr double min_depth_range =
        20e-6;  ///< [m] a point contributes if it is less deep than the deepest by less than this, or half of its depth
    static constexpr double ramp = 0.1;  ///< [–] range of the cosine over which the stiffness rises from 0 to full
    static constexpr double deep_contact = 0.1e-3;     ///< [m] depth at which the search for a wall begins [judgement]
    static constexpr double max_search_step = 0.2e-3;  ///< [m] max step of the search; also half of `reach` [judgement]
    static constexpr std::size_t max_search_steps = 16;  ///< max steps of the search
    static constexpr double end_fraction =
        0.25;  ///< [–] last part of the search: a wall there loses weight [judgement]
    static constexpr double wide_gap = 0.1e-3;  ///< [m] distance of air from bone at which a wall has full weight
                                                ///< [judgement]

    /// The relative orientation of a point of the tool's surface and the nearest surface of bone.
    struct Touch {
        double against;   ///< [–] cosine between the two normals, the tool's reversed
        double fraction;  ///< [–] fraction of the stiffness: 0 far from the bone, or where it does not face the tool
    };
    /// The wall that a deep point presses on, as weighted sums over samples of the bone.
    struct Wall {
        std::size_t point;
        double search_weight;                                 ///< [–] weight of the search, 0 … 1
        double fraction = 0.0, stiffness = 0.0, force = 0.0;  ///< [–], a² [–] and p a [m], each weighted

        /// Adds a sample `inside` [m] behind the point, where the bone has the depth `bone` [m].
        void add(double weight, const Touch& seen, double bone, double inside) noexcept {
            const double here = weight * seen.fraction, pushes = here * seen.against;
            fraction += here;
            stiffness += pushes * seen.against;
            force += pushes * (bone + inside * seen.against);
        }
    };

    [[nodiscard]] Touch touch(std::size_t i, const kerf_surface_point& bone) const noexcept {
        if (bone.body < 0 || bone.distance > near_contact) return {0.0, 0.0};
        const double against = -dot(bone.normal, points_.outwards(i));
        return {against, std::clamp((against - points_.facing(i)) / ramp, 0.0, 1.0)};
    }

    void search_walls(const BoneQuery& bone, double inwards, std::span<Wall> walls) noexcept {
        const double longest = std::min(max_search_step, 0.5 * bone.reach());
        const auto search_steps = static_cast<std::size_t>(
            std::clamp(std::ceil(inwards / longest), 1.0, static_cast<double>(max_search_steps)));
        const double step = inwards / static_cast<double>(search_steps);
        std::array<Vec3, max_points> at;
        std::array<kerf_surface_point, max_points> found;
        for (std::size_t first = 0; first < walls.size(); first += max_points / search_steps) {
            const std::span<Wall> some =
                walls.subspan(first, std::min(max_points / search_steps, walls.size() - first));
            for (std::size_t n = 0; n < some.size(); ++n)
                for (std::size_t search_index = 1; search_index <= search_steps; ++search_index)
                    at[n * search_steps + search_index - 1] =
                        points_.at(some[n].point) -
                        static_cast<double>(search_index) * step * points_.outwards(some[n].point);
            bone.nearest({at.data(), some.size() * search_steps}, {found.data(), some.size() * search_steps});
            for (std::size_t n = 0; n < some.size(); ++n)
                find_wall(some[n], {found.data() + n * search_steps, search_steps}, step);
        }
    }
    /// Finds the wall in the samples `inside`, one each `step` [m] behind the point. From the farthest sample in air,
    /// it goes outwards to the first one in bone. This sample and the last one in air are interpolated linearly, so
    /// that the wall moves without a jump.
    void find_wall(Wall& wall, std::span<const kerf_surface_point> inside, double step) noexcept {
        std::size_t in_air = inside.size();
        while (in_air > 0 && inside[in_air - 1].distance < 0.0) --in_air;
        double widest = 0.0;
        for (std::size_t search_index = in_air; search_index > 0 && inside[search_index - 1].distance >= 0.0;
             in_air = search_index--)
            widest = std::max(widest, inside[search_index - 1].distance);
        double found = 0.0;
        if (in_air > 0) {
            const kerf_surface_point& air = inside[in_air - 1];
            const double before = in_air > 1 ? -inside[in_air - 2].distance : depth_[wall.point],
                         of_air = before / (before + air.distance);
            // A wall appears and disappears gradually at the far end, and where a gap opens.
            const double from_end = static_cast<double>(inside.size() - in_air) + 1.0 - of_air;
            found = std::min({1.0, from_end / (end_fraction * static_cast<double>(inside.size())), widest / wide_gap});
            const double fraction = wall.search_weight * found * of_air;
            wall.add(fraction, touch(wall.point, air), -air.distance, step * static_cast<double>(in_air));
            const Touch seen = in_air > 1 ? touch(wall.point, inside[in_air - 2]) : touch_[wall.point];
            wall.add(wall.search_weight * found - fraction, seen, before, step * static_cast<double>(in_air - 1));
        }
        deep_[deep_count_++] = {wall.point, 1.0 - wall.search_weight * (1.0 - found)};
        take(wall);
    }
    /// Writes the sums of a wall as depth and touch of its point.
    void take(const Wall& wall) noexcept {
        touch_[wall.point].fraction = wall.fraction;
        if (wall.fraction <= 0.0) return;
        touch_[wall.point].against = std::sqrt(wall.stiffness / wall.fraction);
        depth_[wall.point] = wall.force / wall.stiffness * touch_[wall.point].against;
    }

    const ContactPoints& points_;
    std::array<double, max_points> depth_;  ///< [m] along the bone's normal, negative outside
    std::array<Touch, max_points> touch_;
    std::array<DeepPoint, max_points> deep_;
    std::size_t deep_count_ = 0;
};

}  // namespace kerf
