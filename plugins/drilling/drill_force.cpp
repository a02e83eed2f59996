// SPDX-License-Identifier: Apache-2.0
#include "drill_force.h"

#include <algorithm>
#include <cmath>

#include "kerf/exact_math.hpp"

namespace kerf::drilling {

namespace {

using namespace literals;

enum ChannelId : std::uint32_t { id_feed = 1, id_heel, id_rub, id_side = 8, id_contact = 16 };

constexpr double slowest_spindle = 10.0_rpm;  // below it nothing is cut: the tip only touches
constexpr double left_behind = 0.1_mm;        // edges farther from the front than the nearest by this wait (R2)
constexpr std::size_t most_chisel_points = 32;  // per half of the chisel edge
constexpr int ring_count = 8, ring_points = 8;        // of the shank, a diameter apart
constexpr double near_contact = 0.3_mm;       // surface points farther away get no channel

struct Coefficients {
    EdgeCoefficients thrust, cutting, chisel;
};

Coefficients coefficients(std::span<const double> f) noexcept {
    const double depth = f[force_edge_depth];
    return {{f[force_thrust_edge], depth, f[force_thrust_chip]},
            {f[force_cutting_edge], depth, f[force_cutting_chip]},
            {f[force_chisel_edge], depth, f[force_chisel_chip]}};
}

/// Share of the reference tissue's resistance at a sample, zero in air.
double resistance(const kerf_bone_sample& s, std::uint32_t tissues, double reference) noexcept {
    if (s.engagement <= 0.0) return 0.0;
    double m = 0.0;
    for (std::uint32_t i = 0; i < tissues; ++i) m += s.weight[i] * resistance_of_density(s.density[i], reference);
    return s.engagement * m;
}

/// Sum of edge elements into one cut channel. They share the width of their onset: the τ-weighted mean (R1).
struct CutSum {
    double tau = 0.0, eta = 0.0, tau_w = 0.0;

    void add(double edge_force, double slope, double w) noexcept {
        tau += edge_force;
        eta += slope;
        tau_w += edge_force * w;
    }
    [[nodiscard]] double w() const noexcept { return std::max(1e-6, tau > 0.0 ? tau_w / tau : 1e-6); }
};

void write(const CutSum& sum, const Vec6& d, double gap, kerf_channel* c) noexcept {
    if (c == nullptr) return;
    std::copy(d.begin(), d.end(), c->d);
    c->tau = sum.tau;
    c->eta = sum.eta;
    c->w = sum.w();
    c->gap = gap;
}

/// A unit rate at `point` along `n`, as a rate of the tool about its tip.
Vec6 rate_at(Vec3 point, Vec3 n) noexcept { return make_vec6(n, cross(point, n)); }

/// Everything that cuts, sampled once.
struct Edges {
    TwistDrill drill;
    Lip lip;
    double cos_angle, sin_angle;
    std::array<Vec3, lip_count * largest_element_count + 2 * most_chisel_points> point;
    std::array<kerf_bone_sample, lip_count * largest_element_count + 2 * most_chisel_points> sample;
    std::size_t lip_points = 0, chisel_points = 0, count = 0;

    [[nodiscard]] double chisel_width() const noexcept { return drill.chisel_radius() / static_cast<double>(chisel_points); }

    void ask(const Tick& tick, const BoneQuery& bone, double angle) noexcept {
        drill = drill_of(tick.tool);
        lip = make_lip(drill, tick.force[force_element_pitch]);
        const SinCos a = sin_cos_exact(angle);
        cos_angle = a.cos;
        sin_angle = a.sin;
        for (int k = 0; k < lip_count; ++k) {
            const double side = k == 0 ? 1.0 : -1.0;
            for (std::size_t i = 0; i < lip.count; ++i)
                point[lip_points++] = place_of(lip.element[i], drill.half_web(), side * a.cos, side * a.sin);
        }
        count = lip_points;
        const PointAngle p = half_point_angle(drill);
        const double pieces = std::ceil(drill.chisel_radius() / tick.force[force_element_pitch]);
        chisel_points = static_cast<std::size_t>(std::clamp(pieces, 2.0, static_cast<double>(most_chisel_points)));
        for (std::size_t i = 0; i < chisel_points; ++i) {
            const double r = (static_cast<double>(i) + 0.5) * chisel_width();
            for (const double side : {1.0, -1.0})
                point[count++] = {-side * r * a.sin, side * r * a.cos, -r * p.cos / p.sin};
        }
        bone.sample({point.data(), count}, {0, 0, 1}, {sample.data(), count});
    }
    [[nodiscard]] const LipElement& element(std::size_t i) const noexcept { return lip.element[i % lip.count]; }

    /// The least way to the front among edges in bone; 0 when none is.
    [[nodiscard]] double least_gap() const noexcept {
        double least = 1e300;
        for (std::size_t i = 0; i < count; ++i)
            if (sample[i].engagement > 0.0) least = std::min(least, sample[i].gap);
        return least < 1e299 ? least : 0.0;
    }
};

/// What the edges give at one feed rate: forces that do not work against the feed, per newton of thrust.
struct Side {
    double thrust = 0.0, torque = 0.0;
    Vec3 lateral{}, moment{};
};

Side side_forces(const Edges& e, const Tick& tick, std::uint32_t tissues, double n, double feed_rate, double least) noexcept {
    const Coefficients k = coefficients(tick.force);
    const double reference = tick.force[force_reference_density];
    const double per_lip = std::max(feed_rate, 1e-6) / (lip_count * n);  // feed per lip [m]
    Side sum;
    for (std::size_t i = 0; i < e.count; ++i) {
        const double m = resistance(e.sample[i], tissues, reference);
        if (m <= 0.0 || e.sample[i].gap > least + left_behind) continue;
        if (i >= e.lip_points) {
            sum.thrust += m * e.chisel_width() * force_per_width(per_lip, k.chisel);
            continue;
        }
        const LipElement& el = e.element(i);
        const double t = per_lip * el.normal_axial;
        const double normal = m * el.width * force_per_width(t, k.thrust);
        const double cutting = m * el.width * force_per_width(t, k.cutting);
        const Vec3 outwards = normalized(Vec3{e.point[i].x, e.point[i].y, 0.0});
        const Vec3 running = cross(Vec3{0, 0, 1}, outwards);
        const Vec3 lateral = -cutting * running - normal * el.normal_radial * outwards;
        sum.thrust += normal * el.normal_axial;
        sum.torque += cutting * el.radius;
        sum.lateral = sum.lateral + lateral;
        sum.moment = sum.moment + cross(e.point[i], lateral - normal * el.normal_axial * Vec3{0, 0, 1});
    }
    return sum;
}

void add_cutting(const Edges& e, const Tick& tick, std::uint32_t tissues, double n, double last_feed_rate,
                 Channels& channels) noexcept {
    const Coefficients k = coefficients(tick.force);
    const double reference = tick.force[force_reference_density];
    const double least = e.least_gap();
    const double per_rate = 1.0 / (lip_count * n);  // feed per lip and feed rate [s]

    CutSum axial;
    double engaged_width = 0.0, full_width = 0.0;
    for (std::size_t i = 0; i < e.count; ++i) {
        const double m = resistance(e.sample[i], tissues, reference);
        if (i < e.lip_points) full_width += e.element(i).width;
        if (m <= 0.0 || e.sample[i].gap > least + left_behind) continue;
        if (i >= e.lip_points) {
            const double width = m * e.chisel_width();
            axial.add(width * k.chisel.edge, width * k.chisel.chip * per_rate, k.chisel.edge_depth / per_rate);
            continue;
        }
        const LipElement& el = e.element(i);
        const double width = m * el.width, nz = el.normal_axial;
        axial.add(width * k.thrust.edge * nz, width * k.thrust.chip * nz * nz * per_rate,
                  k.thrust.edge_depth / (per_rate * nz));
        engaged_width += width;
    }
    if (axial.tau <= 0.0 && axial.eta <= 0.0) return;

    kerf_channel* feed = channels.add(KERF_CUT, id_feed);
    write(axial, {0, 0, 1, 0, 0, 0}, least, feed);
    if (feed != nullptr) {
        const Side side = side_forces(e, tick, tissues, n, last_feed_rate, least);
        if (side.thrust > 0.0) {
            const Vec6 follow = make_vec6((1.0 / side.thrust) * side.lateral,
                                          (1.0 / side.thrust) * Vec3{side.moment.x, side.moment.y, -side.torque});
            std::copy(follow.begin(), follow.end(), feed->follow);
        }
    }
    // Faster than the relief behind the edge allows, the heel rides up: f_h = 2π r tan(relief) (R5).
    if (kerf_channel* heel = channels.add(KERF_CUT, id_heel)) {
        const SinCos relief = sin_cos_exact(tick.force[force_relief_angle]);
        heel->d[2] = 1.0;
        heel->eta = tick.force[force_heel_stiffness] * tick.dt * engaged_width / full_width;
        heel->gap = least + tick.dt * n * 2.0 * pi * e.drill.radius() * relief.sin / relief.cos;
    }
}

/// Cutting sideways: the cone's flank and the corner behind it, averaged over the turn.
///
/// Each lip passes every azimuth once a turn. At azimuth θ from the motion it takes t = s cos θ n_r/(n_lips n) and pushes
/// back along the motion with cos θ n_r of its force, so a ring of points, each standing for its share of the turn,
/// sums to the mean. Bone is asked for where the ring is, not where the lips are now.
void add_side_cutting(const TwistDrill& drill, const Tick& tick, const BoneQuery& bone, double n, Channels& channels) noexcept {
    struct Level {
        double radius, z, width, normal_radial;
    };
    const PointAngle p = half_point_angle(drill);
    const double r = drill.radius() - tick.force[force_clearance], flank = drill.radius() / 3.0, land = 0.5 * drill.corner * drill.diameter;
    const auto on_cone = [&](double share) {
        const double at = share * drill.radius();
        return Level{at, -at * p.cos / p.sin, flank / p.sin, p.cos};
    };
    const Level levels[] = {on_cone(0.5 / 3.0), on_cone(1.5 / 3.0), on_cone(2.5 / 3.0),
                            {r, -drill.point_depth() - 0.5 * land, land, 1.0}, {r, -drill.point_depth() - 1.5 * land, land, 1.0}};
    constexpr double c = 0.70710678118654752440;
    constexpr double azimuth[][2] = {{1, 0}, {c, c}, {c, -c}};  // along the motion, across it
    constexpr std::size_t count = std::size(levels) * std::size(azimuth);
    constexpr double share_of_turn = 1.0 / 8.0;

    const Coefficients k = coefficients(tick.force);
    std::uint32_t id = id_side;
    for (const Vec3 way : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}}) {
        const Vec3 across = cross(Vec3{0, 0, 1}, way);
        std::array<Vec3, count> point;
        std::array<kerf_bone_sample, count> sample;
        std::size_t i = 0;
        for (const Level& level : levels)
            for (const auto& at : azimuth) {
                const Vec3 radial = level.radius * (at[0] * way + at[1] * across);
                point[i++] = {radial.x, radial.y, level.z};
            }
        bone.sample(point, way, sample);
        double least = 1e300;
        for (const auto& one : sample)
            if (one.engagement > 0.0) least = std::min(least, one.gap);

        CutSum sum;
        double z = 0.0, total = 0.0;
        i = 0;
        for (const Level& level : levels)
            for (const auto& at : azimuth) {
                const kerf_bone_sample& here = sample[i++];
                const double m = resistance(here, bone.tissue_count(), tick.force[force_reference_density]);
                if (m <= 0.0 || here.gap > least + left_behind) continue;
                const double width = m * lip_count * level.width * share_of_turn;
                const double facing = at[0] * level.normal_radial, per_rate = facing / (lip_count * n);
                sum.add(width * k.thrust.edge * facing, width * k.thrust.chip * facing * per_rate, k.thrust.edge_depth / per_rate);
                z += width * level.z;
                total += width;
            }
        if (total > 0.0) write(sum, rate_at({0, 0, z / total}, way), least, channels.add(KERF_CUT, id));
        ++id;
    }
}

/// Points of the tool's own surface, with its outward normals and how stiff it is there [N/m]: what may touch.
struct ContactPoints {
    std::array<Vec3, static_cast<std::size_t>(ring_count* ring_points)> point, normal;
    std::array<double, static_cast<std::size_t>(ring_count* ring_points)> stiffness;
    std::size_t count = 0;

    void add(Vec3 p, Vec3 n, double k) noexcept {
        point[count] = p;
        normal[count] = n;
        stiffness[count++] = k;
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

/// The nearest point of each quadrant about the shaft and half along it becomes a contact channel.
///
/// The tool is smooth, so it pushes along its own normal: a ledge in the wall of a hole cannot hold a round shank back.
void add_contact(const ContactPoints& c, const Tick& tick, const BoneQuery& bone, bool is_running, double radius,
                 Channels& channels) noexcept {
    std::array<kerf_surface_point, static_cast<std::size_t>(ring_count* ring_points)> surface;
    bone.nearest({c.point.data(), c.count}, {surface.data(), c.count});
    constexpr double facing = 0.5;  // bone that does not face the tool is not touched from here
    struct Nearest {
        std::size_t point = 0;
        double distance = 1e300;  // along the tool's normal [m]
    };
    std::array<Nearest, 8> nearest;
    for (std::size_t i = 0; i < c.count; ++i) {
        const double against = -dot(surface[i].normal, c.normal[i]);
        if (surface[i].body < 0 || against < facing) continue;
        const double distance = surface[i].distance / against;
        if (distance > near_contact) continue;
        const std::size_t quadrant = (c.normal[i].x >= 0.0 ? 1u : 0u) + (c.normal[i].y >= 0.0 ? 2u : 0u);
        Nearest& slot = nearest[quadrant + (i >= c.count / 2 ? 4 : 0)];
        if (distance < slot.distance) slot = {i, distance};
    }
    for (std::size_t slot = 0; slot < nearest.size(); ++slot) {
        const Nearest& touch = nearest[slot];
        if (touch.distance > near_contact) continue;
        kerf_channel* channel = channels.add(KERF_CONTACT, id_contact + static_cast<std::uint32_t>(slot));
        if (channel == nullptr) return;
        const Vec6 d = rate_at(c.point[touch.point], c.normal[touch.point]);
        std::copy(d.begin(), d.end(), channel->d);
        channel->k = c.stiffness[touch.point];
        channel->delta = -touch.distance;
        if (is_running) channel->follow[5] = -tick.force[force_friction] * radius;  // rubbing against the turn
    }
}

void add_shank_contact(const Edges& e, const Tick& tick, const BoneQuery& bone, double contact_force, double n,
                       Channels& channels) noexcept {
    const double clearance = tick.force[force_clearance];
    const double corner = -e.drill.point_depth() - e.drill.corner * e.drill.diameter;
    const double r = e.drill.radius() - clearance;
    constexpr double c = 0.70710678118654752440;
    constexpr double ring[ring_points][2] = {{1, 0}, {c, c}, {0, 1}, {-c, c}, {-1, 0}, {-c, -c}, {0, -1}, {c, -c}};
    ContactPoints points;
    for (int level = 0; level < ring_count; ++level) {
        const double z = corner - e.drill.diameter * (0.25 + level);
        const double k = shank_stiffness(e.drill, z, tick.force[force_contact_stiffness]);
        for (const auto& at : ring) points.add({r * at[0], r * at[1], z}, {at[0], at[1], 0.0}, k);
    }
    add_contact(points, tick, bone, true, e.drill.radius(), channels);

    // While the drill turns, nearly all of the rubbing goes into the turn and little into the feed.
    if (contact_force > 0.0) {
        if (kerf_channel* rub = channels.add(KERF_FRICTION, id_rub)) {
            rub->d[2] = 1.0;
            rub->tau = tick.force[force_friction] * contact_force;
            rub->w = std::max(1e-6, 2.0 * pi * n * e.drill.radius());
        }
    }
}

void add_tip_contact(const Edges& e, const Tick& tick, const BoneQuery& bone, Channels& channels) noexcept {
    const PointAngle p = half_point_angle(e.drill);
    constexpr double c = 0.70710678118654752440;
    constexpr double ring[4][2] = {{c, c}, {-c, c}, {-c, -c}, {c, -c}};
    ContactPoints points;
    for (int level = 0; level < 4; ++level) {
        const double r = e.drill.radius() * (0.1 + 0.3 * level);
        for (const auto& at : ring)
            points.add({r * at[0], r * at[1], -r * p.cos / p.sin}, {p.cos * at[0], p.cos * at[1], p.sin},
                       tick.force[force_contact_stiffness]);
    }
    add_contact(points, tick, bone, false, e.drill.radius(), channels);
}

}  // namespace

TwistDrill drill_of(std::span<const double> p) noexcept {
    return {p[tool_diameter], p[tool_point_angle], p[tool_web], p[tool_length], p[tool_corner]};
}

void DrillCutting::resist(const Tick& tick, const BoneQuery& bone, const State& state, Channels& channels) noexcept {
    const double n = tick.drive[drive_spindle_speed];
    const bool is_running = n >= slowest_spindle;
    Edges edges;
    edges.ask(tick, bone, state.angle);
    if (!is_running) {
        add_tip_contact(edges, tick, bone, channels);
        return;
    }
    add_cutting(edges, tick, bone.tissue_count(), n, state.feed_rate, channels);
    add_side_cutting(edges.drill, tick, bone, n, channels);
    add_shank_contact(edges, tick, bone, state.contact_force, n, channels);
}

void DrillCutting::commit(const Tick& tick, const BoneQuery& bone, const Advance& advance, State& state,
                          std::span<double> signals, Actions& actions) noexcept {
    const double n = tick.drive[drive_spindle_speed];
    const bool is_running = n >= slowest_spindle;
    state.feed_rate = std::max(0.0, advance.rate[2]);

    // Signals, from the same edges the law was stated for.
    Edges edges;
    edges.ask(tick, bone, state.angle);
    double engaged = 0.0;
    for (std::size_t i = 0; i < edges.count; ++i) engaged += edges.sample[i].engagement;
    const double feed = is_running ? state.feed_rate / n : 0.0;
    const bool is_cutting = is_running && engaged > 0.0 && edges.least_gap() <= state.feed_rate * tick.dt;
    signals[signal_feed_per_revolution] = is_cutting ? feed : 0.0;
    signals[signal_chip_thickness] = is_cutting ? feed / lip_count * half_point_angle(edges.drill).sin : 0.0;
    signals[signal_engagement] = engaged / static_cast<double>(edges.count);
    signals[signal_drive_power] = 0.0;
    if (is_cutting) {
        const Side side = side_forces(edges, tick, bone.tissue_count(), n, state.feed_rate, edges.least_gap());
        signals[signal_drive_power] = 2.0 * pi * n * side.torque;
    }

    // What the shank carried sets the friction of the next tick.
    state.contact_force = is_running ? advance.carried_by(KERF_CONTACT) : 0.0;
    if (is_running) {
        actions.cut();
        state.angle += 2.0 * pi * n * tick.dt;
        if (state.angle >= 2.0 * pi) state.angle -= 2.0 * pi;
    }
}

}  // namespace kerf::drilling
