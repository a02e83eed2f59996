// SPDX-License-Identifier: Apache-2.0
#include "burr_cutting.h"

#include <algorithm>
#include <array>
#include <limits>

namespace kerf::burring {

namespace {

constexpr double min_rate = 1e-6;  // [m/s] of a negligible chip

/// Sums over the points of a sector that are at the front.
struct Sector {
    double min_gap = std::numeric_limits<double>::infinity();  ///< [m]
    double width = 0.0;                                        ///< [m] of blade times relative resistance
    Vec6 normal{};                                             ///< Σ of width times the rate along the normal
    Vec6 against{};                                            ///< Σ of the force against the turn [N, N·m]
    double pressed = 0.0;                                      ///< [N] Σ of the force along the normals
};

bool is_cut_channel(const kerf_channel& channel) noexcept {
    return channel.id >= id_cut && channel.id < id_cut + sector_count;
}

}  // namespace

void add_cutting(const EdgePoints& points, const EdgesInBone& in_bone, const BurrParameters& law,
                 const Turning& turning, Channels& channels) noexcept {
    const EdgeCoefficients thrust = law.thrust(), cutting = law.cutting();
    std::array<Sector, sector_count> sectors{};
    // While the cut fades, contact takes over and needs the channels.
    const bool is_fading = !turning.cutting.removes_bone();
    const auto sector_of = [&](std::size_t i) { return is_fading ? wide_sector(points[i].sector) : points[i].sector; };
    for (std::size_t i = 0; i < points.count(); ++i)
        if (in_bone.resisted[i] > 0.0) {
            double& smallest = sectors[sector_of(i)].min_gap;
            smallest = std::min(smallest, in_bone.gap[i]);
        }
    for (std::size_t i = 0; i < points.count(); ++i) {
        const EdgePoint& point = points[i];
        Sector& sector = sectors[sector_of(i)];
        if (in_bone.resisted[i] <= 0.0 || in_bone.gap[i] > sector.min_gap + max_cutting_gap) continue;
        const double width = in_bone.resisted[i] * point.width;
        const Vec6 into = rate_at(point.at, points.outwards(i)),
                   back = rate_at(point.at, -turning.sense * point.turning);
        const double chip = std::max(min_rate, dot(into, turning.rate)) / turning.blade_rate;
        const double built_up = built_up_at(chip, law.edge_depth),
                     force = width * force_per_width(chip, cutting, built_up);
        for (std::size_t c = 0; c < 6; ++c) {
            sector.normal[c] += width * into[c];
            sector.against[c] += force * back[c];
        }
        sector.width += width;
        sector.pressed += width * force_per_width(chip, thrust, built_up);
    }
    for (std::size_t s = 0; s < sector_count; ++s) {
        const Sector& sector = sectors[s];
        if (sector.width <= 0.0) continue;
        kerf_channel* channel = channels.add(KERF_CUT, id_cut + static_cast<std::uint32_t>(s));
        if (channel == nullptr) continue;
        const Vec6 d = scaled(1.0 / sector.width, sector.normal);
        ChannelSum sum;
        sum.add(sector.width * thrust.edge, sector.width * thrust.chip / turning.blade_rate,
                thrust.edge_depth * turning.blade_rate);
        sum.write(d, turning.cutting.fraction, sector.min_gap, channel);

        // Force against the turn per newton of normal force at the same points. So `follow` never exceeds the blades'
        // force, even if the burr jerks.
        if (sector.pressed <= 0.0) continue;
        const Vec6 follow = scaled(1.0 / sector.pressed, sector.against);
        std::copy(follow.begin(), follow.end(), channel->follow);
    }
}

double cutting_torque(const Advance& advance, double sense) noexcept {
    double torque = 0.0;
    for (std::size_t c = 0; c < advance.channel.size(); ++c)
        if (is_cut_channel(advance.channel[c])) torque -= sense * advance.channel[c].follow[5] * advance.lambda[c];
    return torque;
}

}  // namespace kerf::burring
