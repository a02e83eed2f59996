// SPDX-License-Identifier: Apache-2.0
#include "crushing.h"

#include <algorithm>

#include "drill_channels.h"
#include "drill_edges.h"

namespace kerf::drilling {

namespace {

constexpr Vec3 ways[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};

/// [m/s] over which the force builds up, so that hand and bone can balance. Under less than what crushes it the tip creeps by that.
constexpr double creep = 1e-6;
constexpr double deepest_spring = 0.1e-3;  // [m] [judgement]
constexpr double let_go = 0.1;  // [–] of what crushes: so little that contact, which takes over, gives by next to nothing

/// [–] all of a place that lies on bone, whose surface goes through the middle of what engages it.
double in_bone(const kerf_bone_sample& here) noexcept { return std::min(1.0, 2.0 * here.engagement); }

}  // namespace

CrushingTip::CrushingTip(const TwistDrill& drill, const Tick& tick, const BoneQuery& bone) noexcept
    : play_(inside_of_hole(tick, bone, drill.widest_radius())) {
    const TwistDrill::Cones cones = drill.cones();
    double whole = 0.0;  // [m] height of all cones
    for (const Cone& cone : cones) whole += cone.z - cone.end();
    const double friction = tick.force[force_friction];
    for (const Cone& cone : cones) {
        const SinCos p = cone.half_angle;
        const auto rings = 1 + static_cast<std::size_t>(static_cast<double>(most_rings - cones.count) * (cone.z - cone.end()) / whole);
        const double cot = p.cos / p.sin, wide = (cone.outer - cone.inner) / static_cast<double>(rings);
        for (std::size_t n = 0; n < rings; ++n) {
            const double inner = cone.inner + static_cast<double>(n) * wide, outer = inner + wide, r = inner + 0.5 * wide;
            const double ahead = pi * (outer * outer - inner * inner) / static_cast<double>(azimuth_count);
            for (const auto& [x, y] : azimuths) {
                const Vec3 out{x, y, 0.0}, at = r * out + Vec3{0, 0, cone.z_at(r)};
                const Vec3 pressed{x * (p.cos - friction * p.sin), y * (p.cos - friction * p.sin), p.sin + friction * p.cos};
                place_[count_] = {out, wide * cot, ahead, ahead * cot, scaled(1.0 / pressed.z, rate_at(at, pressed)), 1.0 + friction * cot};
                at_[count_++] = at;
            }
        }
    }
    for (std::size_t i = 0; i < count_; ++i) {
        at_[count_ + i] = at_[i];
        direction_[i] = {0, 0, 1};
        direction_[count_ + i] = place_[i].out;
    }
}

CrushingTip::Ahead CrushingTip::ahead_of(std::span<const kerf_bone_sample> samples, std::uint32_t tissues) const noexcept {
    Ahead ahead;
    double least = 1e300;
    for (const kerf_bone_sample& here : samples)
        if (here.engagement > 0.0) least = std::min(least, here.gap);
    for (std::size_t i = 0; i < count_; ++i) {
        const kerf_bone_sample& here = samples[i];
        const Place& place = place_[i];
        const double share = in_bone(here) * std::clamp(1.0 - (here.gap - least) / place.height, 0.0, 1.0);
        ahead.force[i] = share > 0.0 ? share * place.ahead * place.rubs * crushing_pressure(here, tissues) : 0.0;
        ahead.sum += ahead.force[i];
    }
    ahead.gap = ahead.sum > 0.0 ? least : 0.0;
    return ahead;
}

double CrushingTip::force(const BoneQuery& bone) const noexcept {
    std::array<kerf_bone_sample, most> samples;
    bone.sample({at_.data(), count_}, Vec3{0, 0, 1}, {samples.data(), count_});
    return ahead_of({samples.data(), count_}, bone.tissue_count()).sum;
}

void CrushingTip::add_to(Channels& channels, const BoneQuery& bone) const noexcept {
    std::array<kerf_bone_sample, 2 * most> samples;
    bone.sample({at_.data(), 2 * count_}, {direction_.data(), 2 * count_}, {samples.data(), 2 * count_});
    const Ahead ahead = ahead_of({samples.data(), count_}, bone.tissue_count());
    if (ahead.sum <= 0.0) return;
    Vec6 along{};
    for (std::size_t i = 0; i < count_; ++i)
        for (std::size_t k = 0; k < 6; ++k) along[k] += ahead.force[i] / ahead.sum * place_[i].along[k];
    ChannelSum feed;
    feed.add(ahead.sum, 0.0, creep);
    feed.write(along, 1.0, ahead.gap, channels.add(KERF_CUT, id_crush));

    for (std::size_t n = 0; n < std::size(ways); ++n) {
        double least = 1e300;
        for (std::size_t i = 0; i < count_; ++i)
            if (const kerf_bone_sample& here = samples[count_ + i]; here.engagement > 0.0 && dot(place_[i].out, ways[n]) > 0.0) least = std::min(least, here.gap);
        double force = 0.0, z = 0.0;
        for (std::size_t i = 0; i < count_; ++i) {
            const kerf_bone_sample& here = samples[count_ + i];
            const double facing = dot(place_[i].out, ways[n]), share = in_bone(here) * (1.0 - (here.gap - least) / play_);
            if (facing <= 0.0 || share <= 0.0) continue;
            const double here_force = share * facing * place_[i].aside * crushing_pressure(here, bone.tissue_count());
            force += here_force;
            z += here_force * at_[i].z;
        }
        if (force <= 0.0) continue;
        ChannelSum side;
        side.add(force, 0.0, creep);
        side.write(rate_at({0, 0, z / force}, ways[n]), 1.0, least, channels.add(KERF_CUT, id_crush_side + static_cast<std::uint32_t>(n)));
    }
}

Standing::Standing(const Advance& advance) noexcept {
    for (std::size_t i = 0; i < advance.channel.size(); ++i) {
        const kerf_channel& channel = advance.channel[i];
        if (channel.id < id_contact || channel.id >= id_contact + tip_slots || advance.lambda[i] <= 0.0) continue;
        force += channel.d[2] * advance.lambda[i];
        depth = std::max(depth, channel.delta);
    }
}

bool begins_to_crush(const Standing& standing, const CrushingTip& tip, const BoneQuery& bone) noexcept {
    if (standing.force <= 0.0 && standing.depth <= deepest_spring) return false;
    const double bears = tip.force(bone);
    return bears > 0.0 && (standing.force >= bears || standing.depth > deepest_spring);
}

bool still_crushes(const Advance& advance) noexcept {
    for (std::size_t i = 0; i < advance.channel.size(); ++i)
        if (advance.channel[i].id == id_crush) return advance.lambda[i] >= let_go * advance.channel[i].tau;
    return false;
}

}  // namespace kerf::drilling
