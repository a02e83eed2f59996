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

/// How points of a tool touch bone, and the few contact channels that they make together.
///
/// A smooth tool pushes along its own normal: bone that it meets askew at depth p pushes with k p a and stiffens with k
/// a², a the cosine between bone's normal and the tool's own reversed. So a point that turns away lets go without a
/// jump, and a ledge in the wall of a hole does not hold a round shank back.
///
/// Points belong to slots, one channel each. It lies where the slot's points are deepest; those nearly as deep share
/// it: were it one point's, the choice between two would chatter. Ask the bone, write the channels.   [haptic,
/// nonblocking]
class Contact {
public:
    static constexpr std::size_t most = ContactPoints::most, most_slots = ContactPoints::most_slots;

    /// `points` must outlive it.
    explicit Contact(const ContactPoints& points) noexcept : points_(points) {}

    /// Asks the bone about all of them. For one that lies deep the wall is looked for inside the tool, from no farther
    /// than `inwards` [m] behind it: the nearest surface of where it lies may be another one, or none that a fine grid
    /// knows of, and how firmly a hole holds a bent drill is no matter of either.
    void ask(const BoneQuery& bone, double inwards) noexcept {
        std::array<kerf_surface_point, most> found;
        bone.nearest(points_.all(), {found.data(), points_.count()});
        const double deep = std::min(deep_contact, 0.25 * bone.reach());
        std::array<Wall, most> walls;
        std::size_t wall_count = 0;
        deep_count_ = 0;
        for (std::size_t i = 0; i < points_.count(); ++i) {
            touch_[i] = touch(i, found[i]);
            depth_[i] = -found[i].distance;
            if (depth_[i] <= deep) continue;
            const double beyond = std::min(
                1.0, depth_[i] / deep - 1.0);  // looked for from there on, and told by nothing else from twice that
            if (beyond <= 0.0) continue;
            Wall& wall = walls[wall_count++] = {i, beyond};
            wall.add(1.0 - beyond, touch_[i], depth_[i], 0.0);
        }
        if (wall_count > 0) look_inside(bone, inwards, {walls.data(), wall_count});
    }
    /// A point that lies so deep that its wall was looked for.
    struct Deep {
        std::size_t point;
        double found;  ///< [–] how well that was found; by the rest nothing holds the point, unless `hold` says so
    };
    [[nodiscard]] std::span<const Deep> deep() const noexcept { return {deep_.data(), deep_count_}; }
    [[nodiscard]] double depth(std::size_t i) const noexcept { return depth_[i]; }
    /// By what was not found of its wall, one that faces it holds it, in which it lies so deep [m]: as the tool knows
    /// by itself.
    void hold(const Deep& one, double depth) noexcept {
        if (depth <= 0.0 || one.found >= 1.0) return;
        const Touch& seen = touch_[one.point];
        Wall wall{one.point, 1.0};
        wall.add(1.0, seen, depth_[one.point], 0.0);
        wall.add(1.0 - one.found, {1.0, 1.0}, depth, 0.0);
        take(wall);
    }

    /// Whether bone near it faces the point.
    [[nodiscard]] bool faces_bone(std::size_t i) const noexcept { return touch_[i].share > 0.0; }
    /// The bone is known to be so deep there [m], along its own normal, from elsewhere.
    void set_depth(std::size_t i, double depth) noexcept { depth_[i] = depth; }
    /// Bone holds it by `force` [N] at most: deeper, it gives way.
    void bear_at_most(std::size_t i, double force) noexcept {
        const double pressed = points_.stiffness(i) * depth_[i];
        if (pressed > force) touch_[i].share *= force / pressed;
    }

    /// A channel for each slot that touches or soon may, as many as there is room for if `kept_free` are to be left:
    /// those farthest from touching are left out.
    /// @param follow  of each of them
    void write(Channels& channels, std::uint32_t first_id, std::size_t kept_free,
               const Vec6& follow = {}) const noexcept {
        std::array<double, most_slots> deepest;
        deepest.fill(-near_contact);
        std::array<double, most> pressed;  // [m] less where the bone does not face the tool: as it pushes, so it counts
        for (std::size_t i = 0; i < points_.count(); ++i) {
            if (!faces_bone(i)) continue;
            pressed[i] = depth_[i] * (depth_[i] > 0.0 ? touch_[i].share * touch_[i].against : 1.0);
            deepest[points_.slot(i)] = std::max(deepest[points_.slot(i)], pressed[i]);
        }
        struct Sum {
            double weight = 0.0, force = 0.0, stiffness = 0.0;
            Vec6 d{};
        };
        std::array<Sum, most_slots> sums{};
        for (std::size_t i = 0; i < points_.count(); ++i) {
            if (!faces_bone(i)) continue;
            const double of_slot = deepest[points_.slot(i)],
                         ahead = pressed[i] - of_slot + std::max(nearly, 0.5 * of_slot);
            if (ahead <= 0.0) continue;
            Sum& sum = sums[points_.slot(i)];
            const double weight = ahead * ahead, against = touch_[i].against;
            const double stiffness = weight * touch_[i].share * against * against * points_.stiffness(i);
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
            std::size_t farthest = most_slots;
            for (std::size_t slot = 0; slot < most_slots; ++slot)
                if (sums[slot].weight > 0.0 && (farthest == most_slots || deepest[slot] < deepest[farthest]))
                    farthest = slot;
            sums[farthest].weight = 0.0;
        }
        for (std::size_t slot = 0; slot < most_slots; ++slot) {
            const Sum& sum = sums[slot];
            if (sum.weight <= 0.0) continue;
            kerf_channel* channel = channels.add(KERF_CONTACT, first_id + static_cast<std::uint32_t>(slot));
            for (std::size_t k = 0; k < 6; ++k) channel->d[k] = sum.d[k] / sum.stiffness;
            channel->k = sum.stiffness / sum.weight;
            channel->delta = sum.force / sum.stiffness;  // so that what it carries lies between what its points would
            std::copy(follow.begin(), follow.end(), channel->follow);
        }
    }

private:
    static constexpr double near_contact = 0.3e-3;  ///< [m] points farther from bone make no channel
    static constexpr double nearly = 20e-6;         ///< [m] behind the deepest, or half as deep: shares its channel
    static constexpr double ramp = 0.1;             ///< [–] of the cosine
    static constexpr double deep_contact = 0.1e-3;  ///< [m] from which on a wall is looked for [judgement]
    static constexpr double look_step =
        0.2e-3;  ///< [m] no longer than this, and than half of what distances tell [judgement]
    static constexpr std::size_t most_looks = 16;  ///< but no more of them
    static constexpr double far_end = 0.25;  ///< [–] of the way inwards: a wall there is less and less one [judgement]
    static constexpr double wide_gap = 0.1e-3;  ///< [m] so wide a gap before it makes a wall all of one [judgement]

    /// How a point of the tool's surface and the bone's surface nearest to it face each other.
    struct Touch {
        double against;  ///< [–] cosine between the two normals, the tool's reversed
        double share;    ///< [–] of the stiffness: nothing far from the bone, or where it does not face the tool
    };
    /// The wall that a deep point presses on: sums over what tells of it.
    struct Wall {
        std::size_t point;
        double looked_for;                                 ///< [–] share of it that is
        double share = 0.0, stiffness = 0.0, force = 0.0;  ///< [–], a² [–] and p a [m], by the shares that tell of it

        /// From `inside` [m] behind the point, where bone has this depth.
        void add(double weight, const Touch& seen, double bone, double inside) noexcept {
            const double here = weight * seen.share, pushes = here * seen.against;
            share += here;
            stiffness += pushes * seen.against;
            force += pushes * (bone + inside * seen.against);
        }
    };

    [[nodiscard]] Touch touch(std::size_t i, const kerf_surface_point& bone) const noexcept {
        if (bone.body < 0 || bone.distance > near_contact) return {0.0, 0.0};
        const double against = -dot(bone.normal, points_.outwards(i));
        return {against, std::clamp((against - points_.facing(i)) / ramp, 0.0, 1.0)};
    }

    void look_inside(const BoneQuery& bone, double inwards, std::span<Wall> walls) noexcept {
        const double longest = std::min(look_step, 0.5 * bone.reach());
        const auto looks =
            static_cast<std::size_t>(std::clamp(std::ceil(inwards / longest), 1.0, static_cast<double>(most_looks)));
        const double step = inwards / static_cast<double>(looks);
        std::array<Vec3, most> at;
        std::array<kerf_surface_point, most> found;
        for (std::size_t first = 0; first < walls.size(); first += most / looks) {
            const std::span<Wall> some = walls.subspan(first, std::min(most / looks, walls.size() - first));
            for (std::size_t n = 0; n < some.size(); ++n)
                for (std::size_t look = 1; look <= looks; ++look)
                    at[n * looks + look - 1] =
                        points_.at(some[n].point) - static_cast<double>(look) * step * points_.outwards(some[n].point);
            bone.nearest({at.data(), some.size() * looks}, {found.data(), some.size() * looks});
            for (std::size_t n = 0; n < some.size(); ++n) find_wall(some[n], {found.data() + n * looks, looks}, step);
        }
    }
    /// `inside`: what was found at each step behind the point. The wall is where, from the farthest that lies in air on
    /// outwards, the first lies in bone; that one and the last in air tell of it together, the nearer the more, so that
    /// it moves without a jump.
    void find_wall(Wall& wall, std::span<const kerf_surface_point> inside, double step) noexcept {
        std::size_t in_air = inside.size();
        while (in_air > 0 && inside[in_air - 1].distance < 0.0) --in_air;
        double widest = 0.0;
        for (std::size_t look = in_air; look > 0 && inside[look - 1].distance >= 0.0; in_air = look--)
            widest = std::max(widest, inside[look - 1].distance);
        double found = 0.0;
        if (in_air > 0) {
            const kerf_surface_point& air = inside[in_air - 1];
            const double before = in_air > 1 ? -inside[in_air - 2].distance : depth_[wall.point],
                         of_air = before / (before + air.distance);
            // It comes and goes at the far end, or as a gap that opens: not at once.
            const double from_end = static_cast<double>(inside.size() - in_air) + 1.0 - of_air;
            found = std::min({1.0, from_end / (far_end * static_cast<double>(inside.size())), widest / wide_gap});
            const double share = wall.looked_for * found * of_air;
            wall.add(share, touch(wall.point, air), -air.distance, step * static_cast<double>(in_air));
            const Touch seen = in_air > 1 ? touch(wall.point, inside[in_air - 2]) : touch_[wall.point];
            wall.add(wall.looked_for * found - share, seen, before, step * static_cast<double>(in_air - 1));
        }
        deep_[deep_count_++] = {wall.point, 1.0 - wall.looked_for * (1.0 - found)};
        take(wall);
    }
    /// What tells of it, put together.
    void take(const Wall& wall) noexcept {
        touch_[wall.point].share = wall.share;
        if (wall.share <= 0.0) return;
        touch_[wall.point].against = std::sqrt(wall.stiffness / wall.share);
        depth_[wall.point] = wall.force / wall.stiffness * touch_[wall.point].against;
    }

    const ContactPoints& points_;
    std::array<double, most> depth_;  ///< [m] of the bone along its own normal, negative outside
    std::array<Touch, most> touch_;
    std::array<Deep, most> deep_;
    std::size_t deep_count_ = 0;
};

}  // namespace kerf
