// SPDX-License-Identifier: Apache-2.0
#include "drill_contact.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kerf/contact.hpp"

namespace kerf::drilling {

namespace {

constexpr std::size_t near_levels = 8, far_levels = 16, cone_levels = 4, around = 8;
static_assert((near_levels + far_levels + 2 * cone_levels + 1) * around <= ContactPoints::most);
constexpr double grazing = 0.05;  // cosine from which on bone holds the shank
/// A channel for each azimuth of the still tip, which carries hard, and for each quadrant of the shank, which bends: near the tip and
/// far from it, so that the law knows how stiffly the hole holds a drill that tilts.
using Slots = std::array<std::size_t, around>;
constexpr Slots of_tip{0, 1, 2, 3, 4, 5, 6, 7}, of_front{11, 11, 11, 10, 10, 8, 9, 9}, of_rear{15, 15, 15, 14, 14, 12, 13, 13};

/// A ring of points of radius `r` at `z` whose normals have these radial and axial parts.
void add_ring(ContactPoints& points, double r, double z, double radial, double axial, double stiffness, double facing, const Slots& slots) noexcept {
    constexpr double c = 0.70710678118654752440;
    constexpr double ring[around][2] = {{1, 0}, {c, c}, {0, 1}, {-c, c}, {-1, 0}, {-c, -c}, {0, -1}, {c, -c}};
    for (std::size_t n = 0; n < around; ++n)
        points.add({r * ring[n][0], r * ring[n][1], z}, {radial * ring[n][0], radial * ring[n][1], axial}, stiffness, facing, slots[n]);
}

/// Bending stiffness [N/m] of the bit at `z`, held at its far end, in series with the bone's `contact` stiffness.
///
///     k = 3 E I / (l³ + a³ (I/I_p − 1)),    I = ½ π d⁴/64
///
/// with l the length from the chuck, a what of it is pilot, thinner than the shoulder behind it, and half of the round section's I
/// left by the flutes [assumed]; E of stainless steel.
double shank_stiffness(const TwistDrill& drill, double z, double contact) noexcept {
    constexpr double steel = 193e9;  // [Pa]
    const double d = 2.0 * drill.widest_radius(), d2 = d * d, l = std::max(drill.length + z, d);
    const double a = drill.has_shoulder() ? std::max(0.0, drill.shoulder_depth + z) : 0.0, thinner = d2 / (drill.diameter * drill.diameter);
    const double bending = 3.0 * steel * (0.5 * pi * d2 * d2 / 64.0) / (l * l * l + a * a * a * (thinner * thinner - 1.0));
    return bending * contact / (bending + contact);
}

ContactPoints points_of(const TwistDrill& drill, const Tick& tick, const BoneQuery& bone, const Turning& turning) noexcept {
    const double stiffness = tick.force[force_contact_stiffness];
    ContactPoints points;
    const TwistDrill::Cones cones = drill.cones();
    for (const Cone& cone : cones) {
        if (turning.removes()) break;
        const SinCos p = cone.half_angle;
        // A cone stands on bone ahead of it; it does not climb the wall of its hole.
        const double facing = std::max(std::min(0.6, p.sin - 0.1), grazing);
        for (std::size_t level = 0; level < cone_levels; ++level) {
            const double r = cone.inner + (cone.outer - cone.inner) * (0.1 + 0.25 * static_cast<double>(level));  // short of the wall of its hole
            add_ring(points, r, cone.z_at(r), p.cos, p.sin, stiffness, facing, of_tip);
        }
    }
    if (!turning.removes() && drill.pilot() > 0.0) {
        const double z = -drill.point_depth() - 0.5 * drill.pilot();
        add_ring(points, drill.radius() - inside_of_hole(tick, bone, drill.radius()), z, 1.0, 0.0, shank_stiffness(drill, z, stiffness), grazing, of_front);
    }
    // Along the shank a diameter apart, and from the eighth on as far apart as it takes to come to its end. While bone is taken the land
    // behind the last cone is an edge; else it touches as the shank does.
    const double widest = drill.widest_radius(), r = widest - inside_of_hole(tick, bone, widest), apart = 2.0 * widest;
    const double front = cones.last().end() - (turning.removes() ? drill.land() + 0.25 * apart : 0.05 * apart);
    const double far = front - apart * near_levels;
    const double far_apart = std::max(apart, (drill.length + far) / static_cast<double>(far_levels));
    for (std::size_t level = 0; level < near_levels + far_levels; ++level) {
        const double z = level < near_levels ? front - apart * static_cast<double>(level) : far - far_apart * static_cast<double>(level - near_levels);
        if (z < -drill.length) break;
        add_ring(points, r, z, 1.0, 0.0, shank_stiffness(drill, z, stiffness), grazing, level < near_levels / 2 ? of_front : of_rear);
    }
    return points;
}

}  // namespace

void add_contact(const TwistDrill& drill, const Tick& tick, const BoneQuery& bone, const Turning& turning,
                 double shank_force, Channels& channels) noexcept {
    ContactPoints points = points_of(drill, tick, bone, turning);
    points.ask(bone, drill.widest_radius());
    const bool rubs = shank_force > 0.0;
    Vec6 follow{};
    if (turning.removes()) follow[5] = -tick.force[force_friction] * drill.widest_radius();  // rubbing against the turn
    points.write(channels, id_contact, rubs ? 1 : 0, follow);

    // While the drill turns, nearly all of the rubbing goes into the turn and little into the feed.
    if (!rubs) return;
    if (kerf_channel* rub = channels.add(KERF_FRICTION, id_rub)) {
        rub->d[2] = 1.0;
        rub->tau = tick.force[force_friction] * shank_force;
        rub->w = std::max(1e-6, 2.0 * pi * turning.speed * drill.widest_radius());
    }
}

double shank_force_of(const Advance& advance) noexcept {
    constexpr double across = 0.1;  // of the normal's axial part: the tip's is larger
    double sum = 0.0;
    for (std::size_t c = 0; c < advance.channel.size(); ++c)
        if (advance.channel[c].kind == KERF_CONTACT && std::abs(advance.channel[c].d[2]) < across) sum += advance.lambda[c];
    return sum;
}

}  // namespace kerf::drilling
