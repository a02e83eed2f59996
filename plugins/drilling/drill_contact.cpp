// SPDX-License-Identifier: Apache-2.0
#include "drill_contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "bit_stiffness.h"
#include "kerf/contact.hpp"

namespace kerf::drilling {

namespace {

constexpr std::size_t near_levels = 8, far_levels = 16, max_cones = TwistDrill::max_corners + 1,
                      max_walls = TwistDrill::max_lands - 1;
static_assert((near_levels + far_levels + max_cones + max_walls) * azimuth_count <= ContactPoints::max_points);
constexpr double grazing = 0.05;  // cosine between the normals from which on bone supports the shank
/// Contact slots: one for each azimuth of the still tip, which is stiff, and one for each quadrant of the shank, which
/// bends. Front and rear of the shank have separate slots, so that the law contains the hole's stiffness against tilt.
using Slots = std::array<std::size_t, azimuth_count>;
constexpr Slots of_tip{0, 1, 2, 3, 4, 5, 6, 7}, of_front{11, 11, 11, 10, 10, 8, 9, 9},
    of_rear{15, 15, 15, 14, 14, 12, 13, 13};

/// Adds a ring of points of radius `r` at `z` with these radial and axial parts of the normal.
void add_ring(ContactPoints& points, double r, double z, double radial, double axial, double stiffness, double facing,
              const Slots& slots) noexcept {
    for (std::size_t n = 0; n < azimuth_count; ++n) {
        const auto [x, y] = azimuths[n];
        points.add({r * x, r * y, z}, {radial * x, radial * y, axial}, stiffness, facing, slots[n]);
    }
}

}  // namespace

ContactPoints touching_points(const TwistDrill& drill, const DrillParameters& law, const BoneQuery& bone,
                              bool removes) noexcept {
    const double stiffness = law.contact_stiffness;
    const Outline::Bending tip = tip_bending(drill);
    ContactPoints points;
    const TwistDrill::Cones cones = drill.cones();
    const std::size_t rings = rings_on_each(cones.count, 8, 4);
    for (const Cone& cone : cones) {
        if (removes) break;
        const SinCos p = cone.half_angle;
        // A cone rests on bone ahead of it. Its threshold keeps it from climbing the wall of its hole.
        const double facing = std::max(std::min(0.6, p.sin - 0.1), grazing);
        for (std::size_t ring = 0; ring < rings; ++ring) {
            const double along =
                (0.4 + static_cast<double>(ring)) / static_cast<double>(rings);  // stops short of the wall of its hole
            double r = cone.inner + (cone.outer - cone.inner) * along;
            // A slender tip touches as early as the voxel size permits. Closer to the tip, the bottom of its own hole
            // is rounded off.
            if (cone.inner <= 0.0 && ring == 0) r = std::min(r, 0.5 * bone.voxel() * p.sin / p.cos);
            add_ring(points, r, cone.z_at(r), p.cos, p.sin, stiffness, facing, of_tip);
        }
        if (&cone == &cones.last() || cone.straight <= 0.0) continue;
        const double z = cone.end() - 0.5 * cone.straight;
        add_ring(points, cone.outer - inside_of_hole(law, bone, cone.outer), z, 1.0, 0.0,
                 shank_stiffness(drill, tip, z, stiffness), grazing, of_front);
    }
    // Points along the shank: the first eight levels are a diameter apart, the others spread to the end of the shank.
    // While bone is removed, the land behind the last cone is an edge. Otherwise it touches like the shank.
    const double widest = drill.widest_radius(), apart = 2.0 * widest;
    const double of_head = widest - inside_of_hole(law, bone, widest),
                 of_shank = std::min(drill.shank_radius(), of_head), head = drill.head();
    const double front = cones.last().end() - (removes ? drill.land() + 0.25 * apart : 0.05 * apart);
    const double far = front - apart * near_levels;
    const double far_apart = std::max(apart, (drill.length + far) / static_cast<double>(far_levels));
    for (std::size_t level = 0; level < near_levels + far_levels; ++level) {
        const double z = level < near_levels ? front - apart * static_cast<double>(level)
                                             : far - far_apart * static_cast<double>(level - near_levels);
        if (z < -drill.length) break;
        add_ring(points, z > -head ? of_head : of_shank, z, 1.0, 0.0, shank_stiffness(drill, tip, z, stiffness),
                 grazing, level < near_levels / 2 ? of_front : of_rear);
    }
    return points;
}

namespace {

/// Returns the largest force [N] with which bone supports the length of shank that a ring represents.
double crushing_force(const TwistDrill& drill, const kerf_bone_sample& bone, std::uint32_t tissues) noexcept {
    return crushing_pressure(bone, tissues) * 2.0 * drill.shank_radius() * 2.0 * drill.widest_radius();
}

/// Where a shank is too deep in bone to find a wall, the wall of the hole that it left supports it. Returns whether
/// there is such a point.
bool hold_bent_shank(const HoleLine& hole, const ContactPoints& points, Contact& contact) noexcept {
    bool is_bent = false;
    for (const Contact::DeepPoint& one : contact.deep()) {
        if (points.outwards(one.point).z != 0.0) continue;  // of the tip
        contact.hold(one, hole.offset(points.at(one.point), points.outwards(one.point)));
        is_bent = true;
    }
    return is_bent;
}

/// Limits the force on the shank to the bone's crushing force.
void limit_shank_contact(const TwistDrill& drill, const BoneQuery& bone, const ContactPoints& points,
                         Contact& contact) noexcept {
    std::array<std::size_t, ContactPoints::max_points> pressed;
    std::array<Vec3, ContactPoints::max_points> at;
    std::array<kerf_bone_sample, ContactPoints::max_points> here;
    std::size_t count = 0;
    for (std::size_t i = 0; i < points.count(); ++i) {
        if (points.outwards(i).z != 0.0 || contact.depth(i) <= 0.0 || !contact.faces_bone(i)) continue;
        at[count] = points.at(i);
        pressed[count++] = i;
    }
    if (count == 0) return;
    bone.sample({at.data(), count}, Vec3{0, 0, 1}, {here.data(), count});
    for (std::size_t n = 0; n < count; ++n)
        contact.limit_force(pressed[n], crushing_force(drill, here[n], bone.tissue_count()));
}

/// Adds friction of the contact force in the last tick. A turning drill uses nearly all friction against its turn, and
/// little against its motion.
void add_friction(std::uint32_t id, Vec3 along, double carried, const TwistDrill& drill, const DrillParameters& law,
                  const Turning& turning, Channels& channels) noexcept {
    channels.friction({.id = id,
                       .along = along,
                       .limit = law.friction * carried,
                       .onset = 2.0 * pi * turning.speed * drill.shank_radius()});
}

}  // namespace

bool add_contact(const TwistDrill& drill, const ContactPoints& points, const DrillParameters& law,
                 const BoneQuery& bone, const Turning& turning, const HoleLine& hole, const Carried& last,
                 Channels& channels) noexcept {
    Contact contact(points);
    contact.query_bone(bone, drill.widest_radius());
    const bool is_bent = hold_bent_shank(hole, points, contact);
    limit_shank_contact(drill, bone, points, contact);
    const bool rubs = last.by_shank > 0.0, sticks = last.by_tip > 0.0;
    Vec6 follow{};
    if (turning.cutting.removes_bone())
        follow[5] = -law.friction * drill.shank_radius();  // friction torque against
                                                           // the turn
    contact.write(channels, id_contact, (rubs ? 1 : 0) + (sticks ? 2 : 0), follow);

    if (rubs) add_friction(id_rub, {0, 0, 1}, last.by_shank, drill, law, turning, channels);
    if (!sticks) return is_bent;
    add_friction(id_stick, {1, 0, 0}, last.by_tip, drill, law, turning, channels);
    add_friction(id_stick + 1, {0, 1, 0}, last.by_tip, drill, law, turning, channels);
    return is_bent;
}

Carried::Carried(const Advance& advance) noexcept {
    constexpr double across = 0.1;  // axial part of the normal; the tip's is larger
    for (std::size_t c = 0; c < advance.channel.size(); ++c) {
        if (advance.channel[c].kind != KERF_CONTACT) continue;
        (std::abs(advance.channel[c].d[2]) < across ? by_shank : by_tip) += advance.lambda[c];
    }
}

}  // namespace kerf::drilling
