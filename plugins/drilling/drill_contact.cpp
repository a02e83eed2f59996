// SPDX-License-Identifier: Apache-2.0
#include "drill_contact.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace kerf::drilling {

namespace {

constexpr std::size_t shank_levels = 8, tip_levels = 4, around = 8;  // levels of the shank lie a diameter apart
constexpr std::size_t most_points = (shank_levels + tip_levels) * around;
constexpr double near_contact = 0.3e-3;  // [m] surface points farther away get no channel
constexpr double nearly = 20e-6;         // [m] behind the deepest, or half as deep: shares its channel

/// Points of the tool's own surface, with its outward normals and how stiff it is there [N/m]: what may touch.
struct ContactPoints {
    std::array<Vec3, most_points> point, normal;
    std::array<double, most_points> stiffness;
    std::size_t count = 0, of_tip = 0;

    /// A ring of radius `r` at `z` whose normals have these radial and axial parts.
    void add_ring(double r, double z, double radial, double axial, double k) noexcept {
        constexpr double c = 0.70710678118654752440;
        constexpr double ring[around][2] = {{1, 0}, {c, c}, {0, 1}, {-c, c}, {-1, 0}, {-c, -c}, {0, -1}, {c, -c}};
        for (const auto& at : ring) {
            point[count] = {r * at[0], r * at[1], z};
            normal[count] = {radial * at[0], radial * at[1], axial};
            stiffness[count++] = k;
        }
    }
};

/// Bending stiffness [N/m] of the bit at `z`, held at its far end, in series with the bone's `contact` stiffness.
///
///     k = 3 E I / l³,    I = ½ π d⁴/64
///
/// with l the length from the chuck and half of the round section's I left by the flutes [assumed]; E of stainless steel.
double shank_stiffness(const TwistDrill& drill, double z, double contact) noexcept {
    constexpr double steel = 193e9;  // [Pa]
    const double d2 = drill.diameter * drill.diameter, l = std::max(drill.length + z, drill.diameter);
    const double bending = 3.0 * steel * (0.5 * pi * d2 * d2 / 64.0) / (l * l * l);
    return bending * contact / (bending + contact);
}

ContactPoints points_of(const TwistDrill& drill, const Tick& tick, const Turning& turning) noexcept {
    const double stiffness = tick.force[force_contact_stiffness];
    ContactPoints points;
    if (!turning.removes()) {
        const SinCos p = drill.half_point;
        for (std::size_t level = 0; level < tip_levels; ++level) {
            const double r = drill.radius() * (0.1 + 0.25 * static_cast<double>(level));  // short of the wall of its hole
            points.add_ring(r, -r * p.cos / p.sin, p.cos, p.sin, stiffness);
        }
        points.of_tip = points.count;
    }
    const double corner = -drill.cone_end() - drill.corner * drill.diameter;
    for (std::size_t level = 0; level < shank_levels; ++level) {
        const double z = corner - drill.diameter * (0.25 + static_cast<double>(level));
        points.add_ring(drill.widest_radius() - tick.force[force_clearance], z, 1.0, 0.0, shank_stiffness(drill, z, stiffness));
    }
    return points;
}

/// How a point of the tool's surface and the bone's surface nearest to it face each other.
struct Facing {
    double against = 0.0;  ///< [–] cosine between the two normals, the tool's reversed
    double share = 0.0;    ///< [–] of the stiffness: nothing far from the bone, or where it does not face the tool
};

/// Along the tool's own normal, bone that it meets askew at depth p pushes with k p a and stiffens with k a², a = against:
/// so a point that turns away lets go without a jump. Near the end of what distances tell it fades as well: a shank that
/// lies so deep in the wall of a bent hole says more about the wander than about the force.
Facing facing(const kerf_surface_point& surface, Vec3 normal, double least, double reach) noexcept {
    constexpr double grazing = 0.05, ramp = 0.1;
    if (surface.body < 0 || surface.distance > near_contact) return {};
    const double against = -dot(surface.normal, normal);
    const double from = std::max(least, grazing);
    const double faces = std::clamp((against - from) / ramp, 0.0, 1.0);
    const double known = std::clamp((reach + surface.distance) / (0.5 * reach), 0.0, 1.0);
    return {against, faces * known};
}

}  // namespace

void add_contact(const TwistDrill& drill, const Tick& tick, const BoneQuery& bone, const Turning& turning,
                 double shank_force, Channels& channels) noexcept {
    const ContactPoints c = points_of(drill, tick, turning);
    std::array<kerf_surface_point, most_points> surface;
    bone.nearest({c.point.data(), c.count}, {surface.data(), c.count});

    // A channel for each azimuth of the still tip, which carries hard, and for each quadrant of the shank, which bends: near
    // the tip and far from it, so that the law knows how stiffly the hole holds a drill that tilts. It lies where points
    // are deepest.
    constexpr std::size_t none = 16;
    std::array<std::size_t, most_points> slot_of;
    std::array<double, none> deepest;
    deepest.fill(-near_contact);
    // The cone stands on bone ahead of it; it does not climb the wall of its hole.
    const double tip_facing = std::min(0.6, drill.half_point.sin - 0.1);
    const double rear = -drill.cone_end() - drill.diameter * (drill.corner + 0.5 * shank_levels);
    std::array<Facing, most_points> face;
    std::array<double, most_points> depth;  // [m] less where the bone does not face the tool: as it pushes, so it counts
    for (std::size_t i = 0; i < c.count; ++i) {
        const bool is_tip = i < c.of_tip;
        face[i] = facing(surface[i], c.normal[i], is_tip ? tip_facing : 0.0, bone.reach());
        slot_of[i] = none;
        if (face[i].share <= 0.0) continue;
        slot_of[i] = is_tip ? i % around
                            : around + (c.normal[i].x >= 0.0 ? 1u : 0u) + (c.normal[i].y >= 0.0 ? 2u : 0u) +
                                  (c.point[i].z < rear ? 4u : 0u);
        depth[i] = -surface[i].distance * (surface[i].distance < 0.0 ? face[i].share * face[i].against : 1.0);
        deepest[slot_of[i]] = std::max(deepest[slot_of[i]], depth[i]);
    }
    // Points nearly as deep as the deepest share the channel: were it one point's, the choice between two would chatter.
    struct Touch {
        double weight = 0.0, force = 0.0, stiffness = 0.0;
        Vec6 d{};
    };
    std::array<Touch, none> touch{};
    for (std::size_t i = 0; i < c.count; ++i) {
        if (slot_of[i] == none) continue;
        const double most = deepest[slot_of[i]];
        const double ahead = depth[i] - most + std::max(nearly, 0.5 * most);
        if (ahead <= 0.0) continue;
        Touch& t = touch[slot_of[i]];
        const double weight = ahead * ahead, against = face[i].against;
        const double stiffness = weight * face[i].share * against * against * c.stiffness[i];
        const Vec6 d = rate_at(c.point[i], c.normal[i]);
        t.weight += weight;
        t.stiffness += stiffness;
        t.force += stiffness * -surface[i].distance / against;
        for (std::size_t k = 0; k < 6; ++k) t.d[k] += stiffness * d[k];
    }
    // Where there are more than channels for them, those farthest from touching are left out.
    const bool rubs = shank_force > 0.0;
    const std::size_t room = KERF_MAX_CHANNELS - channels.count() - (rubs ? 1 : 0);
    std::size_t touching = 0;
    for (const Touch& t : touch) touching += t.weight > 0.0;
    for (; touching > room; --touching) {
        std::size_t farthest = none;
        for (std::size_t slot = 0; slot < none; ++slot)
            if (touch[slot].weight > 0.0 && (farthest == none || deepest[slot] < deepest[farthest])) farthest = slot;
        touch[farthest].weight = 0.0;
    }
    for (std::size_t slot = 0; slot < none; ++slot) {
        const Touch& t = touch[slot];
        if (t.weight <= 0.0) continue;
        kerf_channel* channel = channels.add(KERF_CONTACT, id_contact + static_cast<std::uint32_t>(slot));
        for (std::size_t k = 0; k < 6; ++k) channel->d[k] = t.d[k] / t.stiffness;
        channel->k = t.stiffness / t.weight;
        channel->delta = t.force / t.stiffness;  // so that what it carries lies between what its points would
        if (turning.removes()) channel->follow[5] = -tick.force[force_friction] * drill.radius();  // rubbing against the turn
    }

    // While the drill turns, nearly all of the rubbing goes into the turn and little into the feed.
    if (!rubs) return;
    if (kerf_channel* rub = channels.add(KERF_FRICTION, id_rub)) {
        rub->d[2] = 1.0;
        rub->tau = tick.force[force_friction] * shank_force;
        rub->w = std::max(1e-6, 2.0 * pi * turning.speed * drill.radius());
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
