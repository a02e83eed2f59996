// SPDX-License-Identifier: Apache-2.0
#include "crushing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include "drill_channels.h"
#include "drill_edges.h"
#include "kerf/assert.hpp"
#include "kerf/units.hpp"

namespace kerf::drilling {

namespace {

/// Rate [m/s] over which the force builds up, λ = τ (1 − e^(−s/w)), so that hand and bone can balance. Half of the
/// crushing force moves the tip by 0.7 w, and 95 % of it by 3 w.
constexpr double onset = 1e-6;
constexpr double deepest_spring = 0.1e-3;  // [m] [judgement]
constexpr double release_fraction = 0.1;   // [–] of the force at the beginning, or of the crushing force [judgement]
constexpr double nowhere = 1e300;          // [m]
constexpr double all_of_it = 0.95;         // [–] of the crushing force; the rest takes 3 w [judgement]

/// Returns the bone fraction at a point [–]. It is 1 on the surface, where engagement is one half.
double in_bone(const kerf_bone_sample& here) noexcept { return std::min(1.0, 2.0 * here.engagement); }

}  // namespace

TipLoad::TipLoad(const Advance& advance) noexcept {
    for (std::size_t i = 0; i < advance.channel.size(); ++i) {
        const kerf_channel& channel = advance.channel[i];
        if (channel.id < id_contact || channel.id >= id_contact + tip_slots || advance.lambda[i] <= 0.0) continue;
        force += channel.d[2] * advance.lambda[i];
        depth = std::max(depth, channel.delta);
    }
}

CrushingTip::CrushingTip(const TwistDrill& drill, const DrillParameters& law, const BoneQuery& bone) noexcept
    : play_(inside_of_hole(law, bone, drill.widest_radius())),
      step_(std::clamp(drill.widest_radius() / 12.0, 0.5 * bone.voxel(), 0.7 * bone.voxel())),
      friction_(law.friction) {
    const TwistDrill::Cones cones = drill.cones();
    double whole = 0.0;  // [m] height of all cones
    std::uint8_t part = 0;
    for (const Cone& cone : cones) whole += cone.z - cone.end();
    for (const Cone& cone : cones) {
        const double fraction = (cone.z - cone.end()) / whole;
        add_cone(cone, drill.runout,
                 1 + static_cast<std::size_t>(static_cast<double>(max_cone_rings - cones.count) * fraction), part);
        if (cone.straight > 0.0) ++part;
    }
    on_cones_ = count_;
    for (const Cone& cone : cones) {
        const double straight = &cone == &cones.last() ? drill.land() : cone.straight;  // the length that removes bone
        if (straight > 0.0) add_straight(cone.outer + drill.runout, cone.end(), straight);
    }
    for (std::size_t i = 0; i < on_cones_; ++i) {
        sample_point_[i] = point_[i].at;
        direction_[i] = {0, 0, 1};
    }
    for (std::size_t i = 0; i < count_; ++i) {
        sample_point_[on_cones_ + i] = point_[i].at;
        direction_[on_cones_ + i] = point_[i].out;
    }
}

void CrushingTip::add_cone(const Cone& cone, double runout, std::size_t rings, std::uint8_t part) noexcept {
    const SinCos p = cone.half_angle;
    const double cot = p.cos / p.sin, wide = (cone.outer - cone.inner) / static_cast<double>(rings);
    const double across = (p.cos - friction_ * p.sin) / (p.sin + friction_ * p.cos);
    const auto radius = [&](std::size_t ring) {  // runout gives the tip a flat end
        const double r = cone.inner + static_cast<double>(ring) * wide;
        return r > 0.0 ? r + runout : 0.0;
    };
    for (std::size_t ring = 0; ring < rings; ++ring) {
        if (ring % rings_of_piece == 0) {
            KERF_ASSERT(piece_rings_ < max_piece_rings, "few enough cones");
            part_[piece_rings_++] = part;
        }
        piece_ring_[count_ / azimuth_count] = static_cast<std::uint8_t>(piece_rings_ - 1);
        const double r = cone.inner + (static_cast<double>(ring) + 0.5) * wide, inner = radius(ring),
                     outer = radius(ring + 1);
        add_ring(r + runout, cone.z_at(r), p, wide * cot, pi * (outer * outer - inner * inner), across,
                 1.0 + friction_ * cot);
    }
}

void CrushingTip::add_straight(double radius, double from, double length) noexcept {
    const auto rings = static_cast<std::size_t>(std::clamp(std::ceil(length / (2.0 * radius)), 1.0, 4.0));
    const double height = length / static_cast<double>(rings);
    for (std::size_t ring = 0; ring < rings; ++ring)
        add_ring(radius, from - (static_cast<double>(ring) + 0.5) * height, {0.0, 1.0}, height, 0.0, 0.0, 0.0);
}

void CrushingTip::add_ring(double radius, double z, SinCos slope, double height, double ahead, double across,
                           double rubs) noexcept {
    constexpr double fraction = 1.0 / static_cast<double>(azimuth_count);
    for (const auto& [x, y] : azimuths) {
        const Vec3 out{x, y, 0.0}, at = radius * out + Vec3{0, 0, z};
        point_[count_++] = {at,
                            out,
                            slope,
                            height,
                            fraction * ahead,
                            fraction * 2.0 * pi * radius * height,
                            rate_at(at, across * out + Vec3{0, 0, 1}),
                            rubs};
    }
}

CrushingTip::Ahead CrushingTip::ahead_of(Samples samples, const WallAhead& wall, const BrokenWall& broken,
                                         std::uint32_t tissues) const noexcept {
    Ahead ahead;
    ahead.gap = nowhere;
    for (const kerf_bone_sample& here : samples)
        if (here.engagement > 0.0) ahead.gap = std::min(ahead.gap, here.gap);
    for (std::size_t i = 0; i < on_cones_; ++i) {
        const kerf_bone_sample& here = samples[i];
        const TipPoint& point = point_[i];
        const double fraction = in_bone(here) * std::clamp(1.0 - (here.gap - ahead.gap) / point.height, 0.0, 1.0);
        ahead.force[i] = fraction > 0.0 ? fraction * point.ahead * point.rubs * crushing_pressure(here, tissues) : 0.0;
    }
    limit_by_walls(ahead, wall, broken);
    return ahead;
}

void CrushingTip::limit_by_walls(Ahead& ahead, const WallAhead& wall, const BrokenWall& broken) const noexcept {
    std::array<double, WallAhead::max_pieces> crushes{};
    for (std::size_t i = 0; i < on_cones_; ++i) crushes[piece_of(i)] += ahead.force[i];
    const std::size_t count = piece_rings_ * azimuth_count;
    const PressedWall pressed({crushes.data(), count}, {part_.data(), piece_rings_}, wall, broken);
    for (std::size_t n = 0; n < count; ++n) ahead.fraction[n] = pressed.resisting_fraction(n);
    ahead.met = {pressed.breaks_on(), pressed.is_broken()};
    for (std::size_t i = 0; i < on_cones_; ++i) ahead.sum += ahead.force[i] *= ahead.fraction[piece_of(i)];
}

void CrushingTip::sample_side(WallAhead& wall, const BoneQuery& bone) const noexcept {
    // For each piece, the first point in bone, or its first point.
    std::array<Vec3, max_cone_rings> at{};
    std::array<kerf_bone_sample, max_cone_rings> here;
    const std::size_t rings = on_cones_ / azimuth_count;
    const auto on_ring = [&](std::size_t ring) -> const TipPoint& {
        return point_[ring * azimuth_count + wall.next_side()];
    };
    for (std::size_t ring = 0; ring < rings; ++ring) at[ring] = on_ring(ring).at;
    bone.sample({at.data(), rings}, Vec3{0, 0, 1}, {here.data(), rings});
    std::array<Piece, WallAhead::pieces_of_side> pieces{};
    std::array<bool, WallAhead::pieces_of_side> is_in_bone{};
    for (std::size_t ring = 0; ring < rings; ++ring) {
        const std::size_t n = piece_ring_[ring];
        const bool is_in = in_bone(here[ring]) > 0.0, is_first = ring == 0 || piece_ring_[ring - 1] != n;
        if (!is_first && (is_in_bone[n] || !is_in)) continue;
        const TipPoint& point = on_ring(ring);
        pieces[n] = {point.at, point.slope.cos * point.out + Vec3{0, 0, point.slope.sin}};
        is_in_bone[n] = is_in;
    }
    wall.sample_side({pieces.data(), piece_rings_}, step_, friction_, bone);
}

bool CrushingTip::begins(const TipLoad& tip_load, const WallAhead& wall, const BrokenWall& broken,
                         const BoneQuery& bone) const noexcept {
    if (tip_load.force <= 0.0 && tip_load.depth <= deepest_spring) return false;
    std::array<kerf_bone_sample, max_on_cones> samples;
    bone.sample({sample_point_.data(), on_cones_}, Vec3{0, 0, 1}, {samples.data(), on_cones_});
    const Ahead ahead = ahead_of({samples.data(), on_cones_}, wall, broken, bone.tissue_count());
    return (ahead.sum > 0.0 || ahead.met.is_broken) && (tip_load.force >= ahead.sum || tip_load.depth > deepest_spring);
}

CrushingTip::PressedWalls CrushingTip::add_to(Channels& channels, const WallAhead& wall, const BrokenWall& broken,
                                              const BoneQuery& bone) const noexcept {
    const std::size_t asked = on_cones_ + count_;
    std::array<kerf_bone_sample, max_on_cones + max_points> samples;
    bone.sample({sample_point_.data(), asked}, {direction_.data(), asked}, {samples.data(), asked});
    const Ahead ahead = ahead_of({samples.data(), on_cones_}, wall, broken, bone.tissue_count());
    if (ahead.sum <= 0.0 && !ahead.met.is_broken) return ahead.met;
    if (ahead.sum > 0.0) add_ahead(ahead, channels);
    for (std::size_t direction = 0; direction < std::size(transverse_directions); ++direction)
        add_aside({samples.data() + on_cones_, count_}, ahead, bone.tissue_count(), direction, channels);
    return ahead.met;
}

void CrushingTip::add_ahead(const Ahead& ahead, Channels& channels) const noexcept {
    Vec6 along{};
    for (std::size_t i = 0; i < on_cones_; ++i)
        for (std::size_t k = 0; k < 6; ++k) along[k] += ahead.force[i] / ahead.sum * point_[i].along[k];
    ChannelSum sum;
    sum.add(ahead.sum, 0.0, onset);
    sum.write(along, 1.0, ahead.gap, channels.add(KERF_CUT, id_crush));
}

void CrushingTip::add_aside(Samples samples, const Ahead& ahead, std::uint32_t tissues, std::size_t direction,
                            Channels& channels) const noexcept {
    const auto facing = [&](std::size_t i) { return dot(point_[i].out, transverse_directions[direction]); };
    double smallest = nowhere;
    for (std::size_t i = 0; i < count_; ++i)
        if (samples[i].engagement > 0.0 && facing(i) > 0.0) smallest = std::min(smallest, samples[i].gap);
    if (smallest == nowhere) return;
    double force = 0.0, moment = 0.0;
    for (std::size_t i = 0; i < count_; ++i) {
        const double fraction = in_bone(samples[i]) * (1.0 - (samples[i].gap - smallest) / play_);
        if (facing(i) <= 0.0 || fraction <= 0.0) continue;
        const double whole = i < on_cones_ ? ahead.fraction[piece_of(i)] : 1.0;
        const double here = whole * fraction * facing(i) * point_[i].aside * crushing_pressure(samples[i], tissues);
        force += here;
        moment += here * point_[i].at.z;
    }
    if (force <= 0.0) return;
    ChannelSum sum;
    sum.add(force, 0.0, onset);
    sum.write(rate_at({0, 0, moment / force}, transverse_directions[direction]), 1.0, smallest,
              channels.add(KERF_CUT, id_crush_side + static_cast<std::uint32_t>(direction)));
}

bool is_crushed(const Advance& advance) noexcept {
    for (std::size_t i = 0; i < advance.channel.size(); ++i)
        if (advance.channel[i].id == id_crush) return advance.lambda[i] > all_of_it * advance.channel[i].tau;
    return false;
}

bool continues_crushing(const Advance& advance, double begun) noexcept {
    for (std::size_t i = 0; i < advance.channel.size(); ++i) {
        const kerf_channel& channel = advance.channel[i];
        const bool crushes = channel.id == id_crush || (channel.id >= id_crush_side &&
                                                        channel.id < id_crush_side + std::size(transverse_directions));
        if (crushes && advance.lambda[i] > release_fraction * std::min(channel.tau, begun)) return true;
    }
    return false;
}

}  // namespace kerf::drilling
