// SPDX-License-Identifier: Apache-2.0
#include "saw_contact.h"

#include <algorithm>
#include <cmath>

namespace kerf::sawing {

namespace {

constexpr double near_contact = 0.3e-3;  // [m] surface points farther away get no channel
constexpr double nearly = 20e-6;         // [m] behind the deepest, or half as deep: shares its channel
constexpr std::size_t tip_points = 9, columns = 3, rows = 5;
constexpr double row_behind[rows] = {0.25e-3, 3e-3, 7e-3, 15e-3, 30e-3};  // [m] behind the roots of the teeth
constexpr std::size_t most_points = tip_points + 2 * rows * columns + 2 * rows;
/// Three sectors of the still front; each side, near the front and far from it; both narrow edges.
enum Place : std::uint32_t { slot_tip = 0, slot_side = 3, slot_edge = 7, slot_count = 9 };
static_assert(slot_side == sector_count);

/// Points of the blade's own surface, with its outward normals and how stiff it is there [N/m]: what may touch.
struct ContactPoints {
    std::array<Vec3, most_points> point, normal;
    std::array<double, most_points> stiffness;
    std::array<std::size_t, most_points> slot;
    std::array<double, most_points> behind;  ///< [m] the roots of the teeth
    std::size_t count = 0;

    void add(Vec3 at, Vec3 outwards, double k, std::size_t of, double back) noexcept {
        point[count] = at;
        normal[count] = outwards;
        stiffness[count] = k;
        behind[count] = back;
        slot[count++] = of;
    }
};

/// Bending stiffness across the blade [N/m] at `z`, the blade held at the axis of its swing, in series with the bone's.
///
///     k = 3 E I / l³,    I = w d³/12
///
/// with l the length from the axis, w the blade's width, d its thickness; E of stainless steel.
double side_stiffness(const SawBlade& blade, double z, double contact) noexcept {
    constexpr double steel = 193e9;  // [Pa]
    const double width = blade.tooth_count * blade.pitch, l = std::max(blade.radius + z, 0.1 * blade.radius);
    const double bending = 3.0 * steel * (width * blade.thickness * blade.thickness * blade.thickness / 12.0) / (l * l * l);
    return bending * contact / (bending + contact);
}

ContactPoints points_of(const SawBlade& blade, const Tick& tick, const Going& going, double front_inside) noexcept {
    const double stiffness = tick.force[force_contact_stiffness];
    ContactPoints points;
    if (!going.removes())
        for (std::size_t i = 0; i < tip_points; ++i) {
            const double share = 2.0 * (static_cast<double>(i) + 0.5) / tip_points - 1.0;
            const SinCos angle = sin_cos_exact(share * blade.half_front());
            points.add(blade.on_front(angle), {angle.sin, 0.0, angle.cos}, stiffness, slot_tip + i * sector_count / tip_points, 0.0);
        }
    const SinCos last = sin_cos_exact(blade.half_front());
    for (std::size_t row = 0; row < rows; ++row) {
        const double back = blade.tooth_height + row_behind[row];
        if (back > 0.8 * blade.radius) break;
        for (std::size_t column = 0; column < columns; ++column) {
            const double share = (static_cast<double>(column) - 1.0) * 0.9;  // both ends and the middle
            const Vec3 front = blade.on_front(sin_cos_exact(share * blade.half_front()));
            const double z = front.z - back, k = side_stiffness(blade, z, stiffness);
            for (const double side : {1.0, -1.0})
                points.add({front.x, side * 0.5 * blade.thickness, z}, {0, side, 0}, k,
                           slot_side + (side > 0.0 ? 0u : 2u) + (row < 3 ? 0u : 1u), row_behind[row]);
        }
        for (const double side : {1.0, -1.0})
            points.add({side * (blade.radius * last.sin - front_inside), 0.0, blade.radius * (last.cos - 1.0) - back}, {side, 0, 0}, stiffness,
                       slot_edge + (side > 0.0 ? 0u : 1u), row_behind[row]);
    }
    return points;
}

/// How a point of the blade's surface and the bone's surface nearest to it face each other.
struct Facing {
    double against = 0.0;  ///< [–] cosine between the two normals, the blade's reversed
    double share = 0.0;    ///< [–] of the stiffness: nothing far from the bone, or where it does not face the blade
};
Facing facing(const kerf_surface_point& surface, Vec3 normal, double least, double reach) noexcept {
    constexpr double ramp = 0.1;
    if (surface.body < 0 || surface.distance > near_contact) return {};
    const double against = -dot(surface.normal, normal);
    const double faces = std::clamp((against - least) / ramp, 0.0, 1.0);
    const double known = std::clamp((reach + surface.distance) / (0.5 * reach), 0.0, 1.0);
    return {against, faces * known};
}

}  // namespace

void add_contact(const SawBlade& blade, const Tick& tick, const BoneQuery& bone, const Going& going, const OwnSlot& slot,
                 double last_binding, Channels& channels) noexcept {
    const double voxel = 0.25 * bone.reach();
    const ContactPoints c = points_of(blade, tick, going, 0.1 * voxel);
    std::array<kerf_surface_point, most_points> surface;
    bone.nearest({c.point.data(), c.count}, {surface.data(), c.count});

    // Where the blade has cut the last two voxels itself, its slot is known better than samples tell it: there is a wall
    // where the bone has one, but it stands where the teeth have put it (B5).
    const double own = std::min(slot.depth - blade.tooth_height, 2.0 * voxel);
    std::array<Facing, most_points> face;
    std::array<double, most_points> depth, pressed;  // [m] for which comes first; as it pushes
    std::array<double, slot_count> deepest;
    deepest.fill(-near_contact);
    for (std::size_t i = 0; i < c.count; ++i) {
        const bool is_tip = c.slot[i] < slot_side, is_side = !is_tip && c.slot[i] < slot_edge;
        face[i] = facing(surface[i], c.normal[i], is_tip ? 0.5 : 0.3, bone.reach());
        if (face[i].share <= 0.0) continue;
        pressed[i] = -surface[i].distance;
        if (is_side && c.behind[i] <= own)
            pressed[i] = -blade.set - c.normal[i].y * slot.middle(c.point[i].x, c.point[i].z);
        depth[i] = pressed[i] * (pressed[i] > 0.0 ? face[i].share * face[i].against : 1.0);
        deepest[c.slot[i]] = std::max(deepest[c.slot[i]], depth[i]);
    }
    // Points nearly as deep as the deepest share the channel: were it one point's, the choice between two would chatter.
    struct Touch {
        double weight = 0.0, force = 0.0, stiffness = 0.0;
        Vec6 d{};
    };
    std::array<Touch, slot_count> touch{};
    for (std::size_t i = 0; i < c.count; ++i) {
        if (face[i].share <= 0.0) continue;
        const double most = deepest[c.slot[i]], ahead = depth[i] - most + std::max(nearly, 0.5 * most);
        if (ahead <= 0.0) continue;
        Touch& t = touch[c.slot[i]];
        const double weight = ahead * ahead, against = face[i].against;
        const double stiffness = weight * face[i].share * against * against * c.stiffness[i];
        const Vec6 d = rate_at(c.point[i], c.normal[i]);
        t.weight += weight;
        t.stiffness += stiffness;
        t.force += stiffness * pressed[i] / against;
        for (std::size_t k = 0; k < 6; ++k) t.d[k] += stiffness * d[k];
    }
    // Where there are more than channels for them, those farthest from touching are left out.
    const bool rubs = last_binding > 0.0;
    const std::size_t room = KERF_MAX_CHANNELS - channels.count() - (rubs ? 1 : 0);
    std::size_t touching = 0;
    for (const Touch& t : touch) touching += t.weight > 0.0;
    for (; touching > room; --touching) {
        std::size_t farthest = slot_count;
        for (std::size_t s = 0; s < slot_count; ++s)
            if (touch[s].weight > 0.0 && (farthest == slot_count || deepest[s] < deepest[farthest])) farthest = s;
        touch[farthest].weight = 0.0;
    }
    for (std::size_t s = 0; s < slot_count; ++s) {
        const Touch& t = touch[s];
        if (t.weight <= 0.0) continue;
        kerf_channel* channel = channels.add(KERF_CONTACT, id_contact + static_cast<std::uint32_t>(s));
        for (std::size_t k = 0; k < 6; ++k) channel->d[k] = t.d[k] / t.stiffness;
        channel->k = t.stiffness / t.weight;
        channel->delta = t.force / t.stiffness;
    }

    // While the saw goes, nearly all of the rubbing goes into the oscillation and little into the feed.
    if (!rubs) return;
    if (kerf_channel* rub = channels.add(KERF_FRICTION, id_rub)) {
        rub->d[2] = 1.0;
        rub->tau = tick.force[force_friction] * last_binding;
        rub->w = going.removes() ? std::max(1e-6, going.stroke.mean_speed()) : 1e-6;
    }
}

double binding_of(const Advance& advance) noexcept {
    double sum = 0.0;
    for (std::size_t c = 0; c < advance.channel.size(); ++c) {
        const std::uint32_t id = advance.channel[c].id, first = id_contact;
        if (id >= first + slot_side && id < first + slot_edge) sum += advance.lambda[c];
    }
    return sum;
}

}  // namespace kerf::sawing
