// SPDX-License-Identifier: Apache-2.0
#include "drill_cutting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include "kerf/edge_law.hpp"
#include "side_work.h"

namespace kerf::drilling {

namespace {

constexpr double azimuth[SideEdges::azimuths][2] = {
    {1, 0}, {cos_45, cos_45}, {cos_45, -cos_45}};  // components along the motion and across it
static_assert(std::size(transverse_directions) == SideEdges::directions);

/// Points of a land lie inside the hole that it has cut. There the land runs free, and the hole moves with it. This
/// subtracts the unused part of the play from a land's gap to the front. A cone at the front has no gap. Then the land
/// behind it has none either.
void take_up_play(const SideEdges& edges, Vec3 direction, const OwnHoles& holes,
                  kerf_bone_sample* of_direction) noexcept {
    double of_cones = 1e300;
    const kerf_bone_sample* at = of_direction;
    for (const SideEdges::Level& level : edges.levels())
        for (std::size_t a = 0; a < SideEdges::azimuths; ++a, ++at)
            if (!level.is_land && at->engagement > 0.0) of_cones = std::min(of_cones, at->gap);
    const OwnHole* hole_of_land = holes.data();
    for (const SideEdges::Level& level : edges.levels()) {
        const double used_play =
            level.is_land ? (hole_of_land++)->along(direction) / level.inside : 0.0;  // [–] used play
        for (const auto& [along, across] : azimuth) {
            kerf_bone_sample& here = *of_direction++;
            if (!level.is_land) continue;
            const double hole = level.radius + level.inside, aside = across * level.radius;
            const double play = std::sqrt(hole * hole - aside * aside) - along * level.radius;
            const double left = std::min(of_cones, play * std::clamp(1.0 - used_play, 0.0, 1.0));
            here.gap = std::max(0.0, here.gap - (play - left));
        }
    }
}

/// Returns a ring of edges that moves sideways at `rate` [m/s] and forwards at `feed` [m/s]. A land cuts all bone that
/// it meets, a cone only the bone that the lips' feed leaves.
SideRing ring_of(const SideEdges::Level& level, double rate, double n, double feed) noexcept {
    const double aside = level.normal_radial * rate;
    const double onwards = level.is_land ? 0.0 : level.normal_axial() * std::max(0.0, feed);
    return {.radius = level.radius,
            .width = level.width,
            .thickness = aside / (lip_count * n),
            .fed = aside > 0.0 ? onwards / aside : 0.0};
}

/// Returns the force of a side channel [N] at `rate` [m/s].
double force_at(const ChannelSum& sum, double rate) noexcept {
    return sum.tau > 0.0 ? sum.tau * built_up_at(rate, sum.tau_w / sum.tau) + sum.eta * rate : sum.eta * rate;
}

}  // namespace

/// A land is sampled where it begins, at the front. Farther back in its own hole it would meet bone during the lag of
/// the committed cut, which depends on the grid.
SideEdges::SideEdges(const TwistDrill& drill, const DrillParameters& law, const BoneQuery& bone) noexcept {
    const TwistDrill::Cones cones = drill.cones();
    const std::size_t rings = rings_on_each(cones.count, 6, 3);  // and one land for each cone that a wall follows
    for (const Cone& cone : cones) {
        const double wide = cone.outer - cone.inner;
        for (std::size_t ring = 0; ring < rings; ++ring) {
            const double at = cone.inner + (static_cast<double>(ring) + 0.5) / static_cast<double>(rings) * wide;
            level_[level_count_++] = {at + drill.runout, cone.z_at(at),
                                      wide / static_cast<double>(rings) / cone.half_angle.sin, cone.half_angle.cos};
        }
        const double land = &cone == &cones.last() ? drill.land() : cone.straight;  // the length that removes bone
        const double inside = inside_of_hole(law, bone, cone.outer);
        if (land > 0.0)
            level_[level_count_++] = {cone.outer - inside, cone.end(), land, 1.0, true, inside + drill.runout};
    }
    std::size_t i = 0;
    for (const Vec3 direction : transverse_directions) {
        const Vec3 across = cross(Vec3{0, 0, 1}, direction);
        for (const Level& level : levels())
            for (const auto& at : azimuth) {
                const Vec3 radial = level.radius * (at[0] * direction + at[1] * across);
                direction_[i] = direction;
                point_[i++] = {radial.x, radial.y, level.z};
            }
    }
}

void add_feed_cutting(Edges& e, const DrillParameters& law, const Turning& turning, const Travel& travel,
                      Channels& channels) noexcept {
    const EdgeSet k = law.edges();
    const double smallest = e.min_gap();
    const double per_rate = 1.0 / (lip_count * turning.n);  // feed per lip and feed rate [s]

    e.divide_feed(travel, turning.n, smallest, k.thrust.edge_depth);
    ChannelSum axial;
    double engaged_width = 0.0, full_width = 0.0;
    for (std::size_t i = 0; i < e.count; ++i) {
        const double m = e.resistance[i];
        if (i < e.lip_points) full_width += e.element(i).width;
        if (m <= 0.0) continue;  // `takes` is undefined without resistance
        const auto [chip, edge] = e.takes[i];
        if (chip <= 0.0) continue;
        if (i >= e.lip_points) {
            const double width = m * e.layout.chisel_width;
            axial.add(edge * width * k.chisel.edge, chip * width * k.chisel.chip * per_rate,
                      k.chisel.edge_depth / per_rate);
            continue;
        }
        const LipElement& el = e.element(i);
        const double width = e.layout.rake_factor[e.index_on_lip(i)] * m * el.width, nz = el.normal_axial;
        axial.add(edge * width * k.thrust.edge * nz, chip * width * k.thrust.chip * nz * nz * per_rate,
                  k.thrust.edge_depth / (per_rate * nz));
        engaged_width += m * el.width;
    }
    if (axial.tau <= 0.0 && axial.eta <= 0.0) return;

    // The channel acts against the mean normal of the cut surface. This normal pushes aside too, so a compliant tool is
    // pushed less. Forces along the cut surface follow.
    const EdgeForces forces = edge_forces(e, law, turning.n, travel.feed_rate);
    if (kerf_channel* feed = channels.add(KERF_CUT, id_feed)) {
        const double per_newton = 1.0 / forces.thrust();
        axial.write(scaled(per_newton, forces.normal), turning.cutting.fraction, smallest, feed);
        const Vec6 follow = scaled(per_newton, forces.cutting);
        std::copy(follow.begin(), follow.end(), feed->follow);
        if (!turning.cutting.removes_bone())
            feed->follow[5] = 0.0;  // then the motor's law contains the torque that
                                    // stops the drill
    }
    // Above the feed that the relief behind the edge allows, the heel rides on bone: f_h = 2π r tan(relief). Each heel
    // resists the part of its lip's feed beyond that.
    if (!turning.cutting.removes_bone()) return;
    if (kerf_channel* heel = channels.add(KERF_CUT, id_heel)) {
        const SinCos relief = sin_cos_exact(law.relief_angle);
        heel->d[2] = 1.0;
        heel->eta = law.heel_stiffness * per_rate * engaged_width / full_width;
        heel->gap = smallest + turning.turns * 2.0 * pi * e.drill.radius() * relief.sin / relief.cos;
    }
}

void add_side_cutting(const SideEdges& edges, const DrillParameters& law, const BoneQuery& bone, const Turning& turning,
                      const Travel& travel, const OwnHoles& holes, Channels& channels) noexcept {
    constexpr double fraction_of_turn = 1.0 / 8.0;
    std::array<kerf_bone_sample, SideEdges::max_points> sample;
    edges.ask(bone, sample);  // one query for all directions
    const std::size_t per_direction = edges.levels().size() * SideEdges::azimuths;

    const EdgeSet k = law.edges();
    const EvenChip even(travel.feed_rate / (lip_count * turning.n), k.thrust.edge_depth);
    kerf_bone_sample* next = sample.data();
    for (std::size_t n = 0; n < SideEdges::directions; ++n) {
        take_up_play(edges, transverse_directions[n], holes, next);
        double smallest = 1e300;
        for (const kerf_bone_sample* one = next; one < next + per_direction; ++one)
            if (one->engagement > 0.0) smallest = std::min(smallest, one->gap);

        ChannelSum sum;
        SideWork work;
        double z = 0.0, total = 0.0;
        const Vec6 along = rate_at({0, 0, edges.levels().back().z}, transverse_directions[n]);
        const double sideways = std::max(0.0, dot(along, travel.steady));  // [m/s]
        for (const SideEdges::Level& level : edges.levels()) {
            SideRing ring = ring_of(level, sideways, turning.n, travel.mean[2]);
            for (std::size_t a = 0; a < SideEdges::azimuths; ++a) {
                const kerf_bone_sample& here = *next++;
                const double m = resistance(here, bone.tissue_count(), law.reference_density);
                if (m <= 0.0) continue;
                const auto [chip, edge] = even.taken(1.0, here.gap - smallest);
                if (chip <= 0.0) continue;
                const double width = m * lip_count * level.width * fraction_of_turn;
                const double facing = azimuth[a][0] * level.normal_radial, per_rate = facing / (lip_count * turning.n);
                sum.add(edge * width * k.thrust.edge * facing, chip * width * k.thrust.chip * facing * per_rate,
                        k.thrust.edge_depth / per_rate);
                z += edge * width * level.z;
                total += edge * width;
                Resistance& met = a == 0 ? ring.ahead : ring.sideways;
                const double share = a == 0 ? m : 0.5 * m;
                met.chip += share * chip;
                met.edge += share * edge;
            }
            work += side_work(ring, k.cutting);
        }
        if (total <= 0.0) continue;
        kerf_channel* channel = channels.add(KERF_CUT, id_side + static_cast<std::uint32_t>(n));
        if (channel == nullptr) continue;
        const Vec3 at{0, 0, z / total};
        sum.write(rate_at(at, transverse_directions[n]), turning.cutting.fraction, smallest, channel);
        const double push = force_at(sum, std::max(sideways, dot(along, travel.last)));
        if (push <= 0.0) continue;
        const Vec3 pull = (-work.across / push) * cross(Vec3{0, 0, 1}, transverse_directions[n]);
        const Vec6 follow = make_vec6(pull, cross(at, pull) - Vec3{0, 0, work.torque / push});
        std::copy(follow.begin(), follow.end(), channel->follow);
    }
}

void SideEdges::move_in_holes(const Vec6& rate, double dt, double advance, OwnHoles& holes) const noexcept {
    OwnHole* hole = holes.data();
    for (const Level& level : levels())
        if (level.is_land) (hole++)->move(rate, dt, advance, level.z, level.width, level.inside);
}

}  // namespace kerf::drilling
