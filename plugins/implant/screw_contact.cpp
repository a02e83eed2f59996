// SPDX-License-Identifier: Apache-2.0
#include "screw_contact.h"

#include <algorithm>
#include <cstddef>

#include "kerf/edge_law.hpp"

namespace kerf::implant {

namespace {

using namespace literals;

constexpr double soon = 0.3_mm;  // a contact is stated from there on, so that it is in the solve when it closes

Vec3 at(double radius, double z, std::size_t i, std::size_t of) noexcept {
    const SinCos angle = sin_cos_exact(2.0 * pi * static_cast<double>(i) / static_cast<double>(of));
    return {radius * angle.cos, radius * angle.sin, z};
}

}  // namespace

ScrewContact::ScrewContact(const ScrewThread& thread) noexcept {
    const double low = -thread.core_at_tip, high = -std::min(0.5 * thread.length, low + 0.4 * thread.length);
    for (std::size_t i = 0; i < ways; ++i) {
        wall[i] = at(0.5 * thread.core_at(low), low, i, ways);
        wall[ways + i] = at(0.5 * thread.core_at(high), high, i, ways);
    }
    const double radius = 0.5 * thread.core_at_tip, area = pi * radius * radius;
    tip[0] = {};
    tip_area[0] = 0.25 * area;
    for (std::size_t i = 0; i < around; ++i) {  // the middle of the cone's rest
        tip[i + 1] = at(0.75 * radius, -1.5 * radius, i, around);
        tip_area[i + 1] = 0.75 * area / around;
        seat[i] = at(0.25 * (thread.outer + thread.head), -thread.length, i, around);
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

    std::array<kerf_surface_point, levels * ways> walls;
    bone.nearest(wall, walls);
    for (std::size_t i = 0; i < walls.size(); ++i) {
        const Vec3 out = normalized(Vec3{wall[i].x, wall[i].y, 0.0});
        const double faces = -dot(Vec3{walls[i].normal.x, walls[i].normal.y, walls[i].normal.z}, out);
        if (walls[i].body < 0 || faces <= 0.0 || walls[i].distance > soon) continue;
        channels.contact({.id = id_wall + static_cast<std::uint32_t>(i),
                          .at = wall[i],
                          .along = out,
                          .stiffness = law.wall_stiffness * faces * faces,
                          .depth = -walls[i].distance / std::max(faces, 0.1)});
    }

    std::array<kerf_surface_point, around> seats;
    bone.nearest(seat, seats);
    double deepest = -soon, share = 0.0;
    for (const kerf_surface_point& s : seats) {
        if (s.body < 0 || s.distance > soon) continue;
        share += std::max(0.0, -s.normal.z) / around;
        deepest = std::max(deepest, -s.distance);
    }
    if (share > 0.0)
        channels.contact(
            {.id = id_seat, .along = {0, 0, 1}, .stiffness = law.seat_stiffness * share, .depth = deepest});
}

}  // namespace kerf::implant
