// SPDX-License-Identifier: Apache-2.0
#include "drill_contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "kerf/beam.hpp"
#include "kerf/contact.hpp"

namespace kerf::drilling {

namespace {

constexpr std::size_t near_levels = 8, far_levels = 16, most_cones = TwistDrill::most_corners + 1,
                      most_walls = TwistDrill::most_lands - 1;
static_assert((near_levels + far_levels + most_cones + most_walls) * azimuth_count <= ContactPoints::most);
constexpr double grazing = 0.05;  // cosine from which on bone holds the shank
/// A channel for each azimuth of the still tip, which carries hard, and for each quadrant of the shank, which bends:
/// near the tip and far from it, so that the law knows how stiffly the hole holds a drill that tilts.
using Slots = std::array<std::size_t, azimuth_count>;
constexpr Slots of_tip{0, 1, 2, 3, 4, 5, 6, 7}, of_front{11, 11, 11, 10, 10, 8, 9, 9},
    of_rear{15, 15, 15, 14, 14, 12, 13, 13};

/// A ring of points of radius `r` at `z` whose normals have these radial and axial parts.
void add_ring(ContactPoints& points, double r, double z, double radial, double axial, double stiffness, double facing,
              const Slots& slots) noexcept {
    for (std::size_t n = 0; n < azimuth_count; ++n) {
        const auto [x, y] = azimuths[n];
        points.add({r * x, r * y, z}, {radial * x, radial * y, axial}, stiffness, facing, slots[n]);
    }
}

/// Bending stiffness [N/m] of the bit at `z`, held at its far end, in series with the bone's `contact` stiffness.
///
///     k = 3 E I / Σ (x₂³ − x₁³) I/I_i,    I_i = ½ π d_i⁴/64
///
/// summed over its pieces of one diameter d_i, from x₁ to x₂ behind z; I the shank's, and half of the round section's
/// left by the flutes [assumed]. A cone counts as wide as it ends; what is wider than the shank as the shank. E of
/// stainless steel.
double shank_stiffness(const TwistDrill& drill, double z, double contact) noexcept {
    const double d = 2.0 * drill.shank_radius(), d2 = d * d, l = std::max(drill.length + z, d);
    double bent = l * l * l, before = 0.0;                     // [m³], [m³] x₁³
    OutlineCorner piece{drill.point_depth(), drill.radius()};  // where it ends, and its radius
    for (std::size_t i = 0; i <= drill.corner_count; ++i) {
        const double x = std::max(0.0, piece.depth + z), x3 = x * x * x,
                     thinner = d2 / (4.0 * piece.radius * piece.radius);
        if (thinner > 1.0) bent += (x3 - before) * (thinner * thinner - 1.0);
        before = x3;
        if (i < drill.corner_count) piece = drill.corners[i];
    }
    return in_series(cantilever_stiffness(stainless_steel, 0.5 * pi * d2 * d2 / 64.0, bent), contact);
}

}  // namespace

ContactPoints touching_points(const TwistDrill& drill, const DrillParameters& law, const BoneQuery& bone,
                              bool removes) noexcept {
    const double stiffness = law.contact_stiffness;
    ContactPoints points;
    const TwistDrill::Cones cones = drill.cones();
    const std::size_t rings = rings_on_each(cones.count, 8, 4);
    for (const Cone& cone : cones) {
        if (removes) break;
        const SinCos p = cone.half_angle;
        // A cone stands on bone ahead of it; it does not climb the wall of its hole.
        const double facing = std::max(std::min(0.6, p.sin - 0.1), grazing);
        for (std::size_t ring = 0; ring < rings; ++ring) {
            const double along =
                (0.4 + static_cast<double>(ring)) / static_cast<double>(rings);  // short of the wall of its hole
            double r = cone.inner + (cone.outer - cone.inner) * along;
            // A slender tip touches as soon as a voxel lets it: nearer to its end the bottom of its own hole is rounded
            // off.
            if (cone.inner <= 0.0 && ring == 0) r = std::min(r, 0.5 * bone.voxel() * p.sin / p.cos);
            add_ring(points, r, cone.z_at(r), p.cos, p.sin, stiffness, facing, of_tip);
        }
        if (&cone == &cones.last() || cone.straight <= 0.0) continue;
        const double z = cone.end() - 0.5 * cone.straight;
        add_ring(points, cone.outer - inside_of_hole(law, bone, cone.outer), z, 1.0, 0.0,
                 shank_stiffness(drill, z, stiffness), grazing, of_front);
    }
    // Along the shank a diameter apart, and from the eighth on as far apart as it takes to come to its end. While bone
    // is taken the land behind the last cone is an edge; else it touches as the shank does.
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
        add_ring(points, z > -head ? of_head : of_shank, z, 1.0, 0.0, shank_stiffness(drill, z, stiffness), grazing,
                 level < near_levels / 2 ? of_front : of_rear);
    }
    return points;
}

namespace {

/// [N] with which bone can hold as much of the shank as a ring stands for.
double crushing_force(const TwistDrill& drill, const kerf_bone_sample& bone, std::uint32_t tissues) noexcept {
    return crushing_pressure(bone, tissues) * 2.0 * drill.shank_radius() * 2.0 * drill.widest_radius();
}

/// Where the shank lies deep in bone it is held by no more than crushes that; where it finds no wall, by the one of the
/// hole that it was pulled out of. Whether it lies so deep anywhere.
bool hold_bent_shank(const TwistDrill& drill, const BoneQuery& bone, const HoleLine& hole, const ContactPoints& points,
                     Contact& contact) noexcept {
    std::array<Contact::Deep, ContactPoints::most> deep;
    std::array<Vec3, ContactPoints::most> at;
    std::array<kerf_bone_sample, ContactPoints::most> here;
    std::size_t count = 0;
    for (const Contact::Deep& one : contact.deep()) {
        if (points.outwards(one.point).z != 0.0) continue;  // of the tip
        at[count] = points.at(one.point);
        deep[count++] = one;
    }
    if (count == 0) return false;
    bone.sample({at.data(), count}, Vec3{0, 0, 1}, {here.data(), count});
    for (std::size_t n = 0; n < count; ++n) {
        const std::size_t i = deep[n].point;
        const double borne = crushing_force(drill, here[n], bone.tissue_count()) / points.stiffness(i);
        contact.hold(deep[n], hole.gone(at[n], points.outwards(i)));
        if (contact.depth(i) > borne) contact.set_depth(i, borne);
    }
    return true;
}

/// Friction of what was carried in the last tick: nearly all of it goes into the turn of a drill that turns, and little
/// into what moves it.
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
    contact.ask(bone, drill.widest_radius());
    const bool is_bent = hold_bent_shank(drill, bone, hole, points, contact);
    const bool rubs = last.by_shank > 0.0, sticks = last.by_tip > 0.0;
    Vec6 follow{};
    if (turning.cutting.removes_bone()) follow[5] = -law.friction * drill.shank_radius();  // rubbing against the turn
    contact.write(channels, id_contact, (rubs ? 1 : 0) + (sticks ? 2 : 0), follow);

    if (rubs) add_friction(id_rub, {0, 0, 1}, last.by_shank, drill, law, turning, channels);
    if (!sticks) return is_bent;
    add_friction(id_stick, {1, 0, 0}, last.by_tip, drill, law, turning, channels);
    add_friction(id_stick + 1, {0, 1, 0}, last.by_tip, drill, law, turning, channels);
    return is_bent;
}

Carried::Carried(const Advance& advance) noexcept {
    constexpr double across = 0.1;  // of the normal's axial part: the tip's is larger
    for (std::size_t c = 0; c < advance.channel.size(); ++c) {
        if (advance.channel[c].kind != KERF_CONTACT) continue;
        (std::abs(advance.channel[c].d[2]) < across ? by_shank : by_tip) += advance.lambda[c];
    }
}

}  // namespace kerf::drilling
