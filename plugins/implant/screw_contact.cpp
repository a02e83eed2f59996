// SPDX-License-Identifier: Apache-2.0
#include "screw_contact.h"

#include <algorithm>
#include <cstddef>

#include "kerf/edge_law.hpp"

namespace kerf::implant {

namespace {

using namespace literals;

constexpr double soon = 0.3_mm;  // gap from which on a contact is in the law, so that the solve has it when it closes

Vec3 at(double radius, double z, std::size_t i, std::size_t of) noexcept {
    const SinCos angle = sin_cos_exact(2.0 * pi * static_cast<double>(i) / static_cast<double>(of));
    return {radius * angle.cos, radius * angle.sin, z};
}

}  // namespace

ScrewContact::ScrewContact(const ScrewThread& thread) noexcept : has_head(thread.head > 0.0) {
    // Both levels lie behind the tip's cone, which is narrower than the core.
    const double low = -thread.cone(), high = std::min(low - 0.1 * thread.length, -0.4 * thread.length - low);
    for (std::size_t i = 0; i < directions; ++i) {
        wall[i] = at(0.5 * thread.core_at(low), low, i, directions);
        wall[directions + i] = at(0.5 * thread.core_at(high), high, i, directions);
    }
    const double radius = 0.5 * thread.core_at_tip, area = pi * radius * radius;
    tip[0] = {};
    tip_area[0] = 0.25 * area;
    for (std::size_t i = 0; i < around; ++i) {  // the middle of the cone's outer part
        tip[i + 1] = at(0.75 * radius, -1.5 * radius, i, around);
        tip_area[i + 1] = 0.75 * area / around;
        seat[i] = at(0.25 * (thread.outer + thread.head), -thread.seat, i, around);
    }
}

void ScrewContact::add_to(Channels& channels, const ScrewParameters& law, const BoneQuery& bone) const noexcept {
    std::array<kerf_bone_sample, around + 1> under;
    bone.sample(tip, Vec3{0, 0, 1}, under);
    double crushed = 0.0, gap = 1.0;
    for (std::size_t i = 0; i < under.size(); ++i) {
        const double m = resistance(under[i], bone.tissue_count(), reference_density);
        if (m <= 0.0) continue;
        crushed += law.crush * m * tip_area[i];
        gap = std::min(gap, under[i].gap);
    }
    if (crushed > 0.0)
        channels.cut(
            {.id = id_tip, .along = {0, 0, 1}, .edge_force = crushed, .onset = 1e-5, .slope = 0.0, .gap = gap});

    add_walls(channels, law, bone);
    if (has_head) add_seat(channels, law, bone);
}

namespace {

/// A wall that one point of the core may touch.
struct Wall {
    double stiffness = 0.0;  ///< [N/m]; 0: no wall
    double depth = 0.0;      ///< [m]
};

Wall wall_at(const kerf_surface_point& found, Vec3 point, double stiffness) noexcept {
    const Vec3 out = normalized(Vec3{point.x, point.y, 0.0});
    const double faces = -dot(Vec3{found.normal.x, found.normal.y, found.normal.z}, out);
    if (found.body < 0 || faces <= 0.0 || found.distance > soon) return {};
    return {stiffness * faces * faces, -found.distance / std::max(faces, 0.1)};
}

}  // namespace

/// Adds one channel for two opposite points, because a core that is wider than its hole rests between them.
void ScrewContact::add_walls(Channels& channels, const ScrewParameters& law, const BoneQuery& bone) const noexcept {
    std::array<kerf_surface_point, levels * directions> found;
    bone.nearest(wall, found);
    for (std::size_t level = 0; level < levels; ++level)
        for (std::size_t direction = 0; direction < directions / 2; ++direction) {
            const std::size_t i = level * directions + direction, j = i + directions / 2;
            const Wall ahead = wall_at(found[i], wall[i], law.wall_stiffness),
                       behind = wall_at(found[j], wall[j], law.wall_stiffness);
            const auto id = id_wall + static_cast<std::uint32_t>(i);
            const Vec3 out = normalized(Vec3{wall[i].x, wall[i].y, 0.0});
            const double both = ahead.stiffness + behind.stiffness;
            if (both <= 0.0) continue;
            if (ahead.stiffness > 0.0 && behind.stiffness > 0.0 && ahead.depth > 0.0 && behind.depth > 0.0)
                channels.hold({.id = id,
                               .d = rate_at(wall[i], out),
                               .stiffness = both,
                               .stretch = (ahead.stiffness * ahead.depth - behind.stiffness * behind.depth) / both});
            else if (behind.stiffness <= 0.0 || (ahead.stiffness > 0.0 && ahead.depth >= behind.depth))
                channels.contact(
                    {.id = id, .at = wall[i], .along = out, .stiffness = ahead.stiffness, .depth = ahead.depth});
            else
                channels.contact({.id = id + static_cast<std::uint32_t>(directions / 2),
                                  .at = wall[j],
                                  .along = -out,
                                  .stiffness = behind.stiffness,
                                  .depth = behind.depth});
        }
}

void ScrewContact::add_seat(Channels& channels, const ScrewParameters& law, const BoneQuery& bone) const noexcept {
    std::array<kerf_surface_point, around> seats;
    bone.nearest(seat, seats);
    double deepest = -soon, fraction = 0.0;
    for (const kerf_surface_point& s : seats) {
        if (s.body < 0 || s.distance > soon) continue;
        fraction += std::max(0.0, -s.normal.z) / around;
        deepest = std::max(deepest, -s.distance);
    }
    if (fraction > 0.0)
        channels.contact(
            {.id = id_seat, .along = {0, 0, 1}, .stiffness = law.seat_stiffness * fraction, .depth = deepest});
}

}  // namespace kerf::implant
