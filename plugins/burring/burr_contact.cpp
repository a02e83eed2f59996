// SPDX-License-Identifier: Apache-2.0
#include "burr_contact.h"

#include <algorithm>
#include <cstddef>

#include "kerf/contact.hpp"

namespace kerf::burring {

namespace {

constexpr std::size_t head_rings = 6, neck_rings = 3, slot_neck = wide_count, neck_slots = 3;
static_assert(slot_neck + neck_slots <= ContactPoints::max_slots && 2 * wide_count + 2 <= KERF_MAX_CHANNELS &&
              1 + head_rings * column_count + neck_rings * azimuth_count <= ContactPoints::max_points);
constexpr double facing_head = 0.4, facing_neck = 0.05;  // cosines between the normals from which on bone supports head
                                                         // and neck

}  // namespace

Carried::Carried(const Advance& advance) noexcept {
    for (std::size_t c = 0; c < advance.channel.size(); ++c) {
        if (advance.channel[c].kind != KERF_CONTACT) continue;
        (advance.channel[c].id >= id_contact + slot_neck ? by_neck : by_head) += advance.lambda[c];
    }
}

ContactPoints touching_points(const BurrHead& head, double length, const BurrParameters& law, const BoneQuery& bone,
                              bool removes) noexcept {
    ContactPoints points;
    const double meridian = head.meridian();
    // The points lie inside the groove that the head has cut, because its walls may be sampled too narrow.
    const auto add = [&](double along, std::size_t column, SinCos around) {
        const MeridianPoint p = head.at(along);
        const Vec3 outwards{p.normal_r * around.cos, p.normal_r * around.sin, p.normal_z};
        const double inside = std::min(p.sagitta(bone.voxel()), 0.25 * head.widest_radius());
        points.add(Vec3{p.radius * around.cos, p.radius * around.sin, p.z} - inside * outwards, outwards,
                   law.contact_stiffness, facing_head, wide_sector(EdgePoints::sector_of(p, along, meridian, column)));
    };
    if (!removes) {
        add(0.0, 0, {0.0, 1.0});
        for (std::size_t column = 0; column < column_count; ++column)
            for (std::size_t ring = 0; ring < head_rings; ++ring)
                add(meridian * (static_cast<double>(ring) + 1.0) / (static_cast<double>(head_rings) + 0.5), column,
                    azimuth_of(column));
    }
    const double front = head.end_z() - 0.5 * head.neck_radius, step = (length + front) / neck_rings;
    for (std::size_t ring = 0; ring < neck_rings; ++ring)
        for (std::size_t column = 0; column < column_count; column += column_count / azimuth_count) {
            const SinCos around = azimuth_of(column);
            points.add({head.neck_radius * around.cos, head.neck_radius * around.sin,
                        front - step * static_cast<double>(ring)},
                       {around.cos, around.sin, 0.0}, law.contact_stiffness, facing_neck,
                       slot_neck + column * neck_slots / column_count);
        }
    return points;
}

void add_contact(const BurrHead& head, const ContactPoints& points, const BurrParameters& law, const BoneQuery& bone,
                 const Turning& turning, double speed, const Carried& last, Channels& channels) noexcept {
    Contact contact(points);
    contact.query_bone(bone, head.widest_radius());
    const bool rubs = last.by_neck > 0.0, sticks = last.by_head > 0.0;
    Vec6 follow{};
    if (turning.cutting.removes_bone()) follow[5] = -turning.sense * law.friction * head.neck_radius;
    const std::size_t free_channels = KERF_MAX_CHANNELS - channels.count(),
                      friction = (rubs ? 1 : 0) + (sticks ? 2 : 0);
    contact.write(channels, id_contact, std::min(friction, free_channels), follow);

    // A turning neck uses nearly all friction against its turn, and little against its motion.
    if (rubs && channels.count() < KERF_MAX_CHANNELS)
        channels.friction({.id = id_rub,
                           .along = {0, 0, 1},
                           .limit = law.friction * last.by_neck,
                           .onset = 2.0 * pi * speed * head.neck_radius});
    if (!sticks) return;
    for (const std::uint32_t across : {0u, 1u})
        if (channels.count() < KERF_MAX_CHANNELS)
            channels.friction({.id = id_stick + across,
                               .at = {0, 0, -head.arc_radius},
                               .along = across == 0 ? Vec3{1, 0, 0} : Vec3{0, 1, 0},
                               .limit = law.friction * last.by_head,
                               .onset = 2.0 * pi * speed * head.widest_radius()});
}

}  // namespace kerf::burring
