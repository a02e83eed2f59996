// SPDX-License-Identifier: Apache-2.0
#include "saw_contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "kerf/beam.hpp"
#include "kerf/contact.hpp"

namespace kerf::sawing {

namespace {

constexpr std::size_t columns = 3, rows = row_behind.size();
static_assert(tip_points + 2 * rows * columns + 2 * rows <= ContactPoints::max_points &&
              2 * rows * columns <= TouchingPoints::max_on_sides);

/// Returns the stiffness across the blade [N/m] at `z`: bending of a blade clamped at the axis of its swing, in series
/// with the bone.
///
///     k = 3 E I / l³,    I = w d³/12
///
/// with l the length from the axis, w the blade's width, d its thickness; E of stainless steel.
double side_stiffness(const SawBlade& blade, double z, double contact) noexcept {
    const double width = blade.tooth_count * blade.pitch, l = std::max(blade.radius + z, 0.1 * blade.radius);
    const double second_moment = width * blade.thickness * blade.thickness * blade.thickness / 12.0;
    return in_series(cantilever_stiffness(stainless_steel, second_moment, l * l * l), contact);
}

}  // namespace

TouchingPoints touching_points(const SawBlade& blade, const SawParameters& law, const BoneQuery& bone,
                               bool removes) noexcept {
    const double stiffness = law.contact_stiffness;
    TouchingPoints points;
    if (!removes) points.add_still_teeth(blade, stiffness);
    const SinCos last = sin_cos_exact(blade.half_front());
    for (std::size_t row = 0; row < rows; ++row) {
        const double back = blade.tooth_height + row_behind[row];
        if (back > 0.8 * blade.radius) break;
        for (std::size_t column = 0; column < columns; ++column) {
            const double fraction = (static_cast<double>(column) - 1.0) * 0.9;  // both ends and the middle
            const Vec3 front = blade.on_front(sin_cos_exact(fraction * blade.half_front()));
            const double z = front.z - back, k = side_stiffness(blade, z, stiffness);
            points.add_sides(front.x, z, blade.thickness, row_behind[row], k, row >= 3);
        }
        points.add_ends(blade.radius * last.sin - bone.wall_error(), blade.radius * (last.cos - 1.0) - back, stiffness);
    }
    return points;
}

template <class Blade>
void add_contact(const Blade& blade, const TouchingPoints& points, const SawParameters& law, const BoneQuery& bone,
                 const Oscillation& motion, const OwnSlot& slot, double last_binding, Channels& channels) noexcept {
    Contact contact(points.all);
    contact.query_bone(bone, blade.thickness);

    // Along the last two voxels of its cut, the blade's own slot is more accurate than samples. The bone decides
    // whether there is a wall, the slot where it is.
    const double own = std::min(slot.depth - blade.tooth_height, 2.0 * bone.voxel());
    for (std::size_t n = 0; n < points.side_count; ++n) {
        const TouchingPoints::OnSide& one = points.of_sides[n];
        if (one.behind > own) continue;
        const Vec3 at = points.all.at(one.index);
        contact.set_depth(one.index, -blade.set - points.all.outwards(one.index).y * slot.middle(at.x, at.z));
    }
    const bool rubs = last_binding > 0.0;
    contact.write(channels, id_contact, rubs ? 1 : 0);

    // A moving saw uses nearly all friction against its oscillation, and little against the feed.
    if (!rubs) return;
    channels.friction({.id = id_rub,
                       .along = {0, 0, 1},
                       .limit = law.friction * last_binding,
                       .onset = motion.cutting.removes_bone() ? motion.stroke.mean_speed() : 0.0});
}

template void add_contact(const SawBlade&, const TouchingPoints&, const SawParameters&, const BoneQuery&,
                          const Oscillation&, const OwnSlot&, double, Channels&) noexcept;
template void add_contact(const StraightBlade&, const TouchingPoints&, const SawParameters&, const BoneQuery&,
                          const Oscillation&, const OwnSlot&, double, Channels&) noexcept;

double binding_of(const Advance& advance) noexcept {
    double sum = 0.0;
    for (std::size_t c = 0; c < advance.channel.size(); ++c) {
        const std::uint32_t id = advance.channel[c].id, first = id_contact;
        if (id >= first + slot_side && id < first + slot_edge) sum += advance.lambda[c];
    }
    return sum;
}

}  // namespace kerf::sawing
