// SPDX-License-Identifier: Apache-2.0
#include "saw_cutting.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <span>

#include "straight_blade.h"

namespace kerf::sawing {

namespace {

/// The parts of the oscillation in the law: averaged, two parts; otherwise one, at the present phase.
struct Parts {
    std::array<StrokePart, part_count> part;
    std::size_t count;
};
Parts parts_now(const Oscillation& motion) noexcept {
    if (motion.is_averaged) return {parts_of(motion.stroke), part_count};
    return {{{{1.0, chip_per_feed(motion.stroke, sin_cos_exact(motion.phase).cos)}, {}}}, 1};
}

/// Returns the direction of the teeth's motion, without a jump at the turning points [–].
double sense_of(const Oscillation& motion) noexcept {
    constexpr double turning = 0.1;  // [–] of the highest speed [assumed]
    return std::clamp(sin_cos_exact(motion.phase).cos / turning, -1.0, 1.0);
}

/// A short row of sample points for one channel.
struct Row {
    static constexpr std::size_t count = 5;
    /// Returns the position of a point in the row: −1 … 1.
    [[nodiscard]] static constexpr double position(std::size_t i) noexcept {
        return 0.5 * static_cast<double>(i) - 1.0;
    }
    std::array<Vec3, count> point;
    std::array<kerf_bone_sample, count> sample;
};

}  // namespace

double mean_cutting_force(double kerf, const SawParameters& law, const Stroke& stroke, double feed_rate) noexcept {
    const EdgeCoefficients cutting = law.cutting();
    double sum = 0.0;
    for (const StrokePart& part : parts_of(stroke))
        sum += part.time_fraction * force_per_width(part.chip_per_feed * feed_rate, cutting);
    return kerf * sum;
}

void add_feed_cutting(const TeethInBone& in_bone, double kerf, const SawParameters& law, const Oscillation& motion,
                      double last_feed_rate, Channels& channels) noexcept {
    const struct { EdgeCoefficients thrust, cutting; } k{law.thrust(), law.cutting()};
    const Parts parts = parts_now(motion);
    const std::size_t n = in_bone.teeth.count;
    for (std::size_t sector = 0; sector < sector_count; ++sector) {
        const std::size_t first = sector * n / sector_count, last = (sector + 1) * n / sector_count;
        const double smallest = in_bone.min_gap(first, last);

        // Teeth that meet bone at the same average time have one common direction, and one common `follow`.
        double total = 0.0;
        Vec6 d{}, aside{}, along{};
        for (std::size_t i = 2 * first; i < 2 * last; ++i) {
            const double m = 0.5 * in_bone.resisted[i];
            if (m <= 0.0 || in_bone.gap[i] > smallest + max_cutting_gap) continue;
            const Tooth& tooth = in_bone.teeth.tooth[i / 2];
            const Vec6 into = rate_at(tooth.tip, tooth.normal), by = rate_at(tooth.tip, {0, -tooth.side, 0}),
                       with = rate_at(tooth.tip, tooth.along);
            for (std::size_t c = 0; c < 6; ++c) {
                d[c] += m * into[c];
                aside[c] += m * by[c];
                along[c] += m * with[c];
            }
            total += m;
        }
        if (total <= 0.0) continue;
        for (std::size_t c = 0; c < 6; ++c) {
            d[c] /= total;
            aside[c] /= total;
            along[c] /= total;
        }
        for (std::size_t p = 0; p < parts.count; ++p) {
            const StrokePart& part = parts.part[p];
            const double width = part.time_fraction * total * kerf;
            ChannelSum sum;
            sum.add(width * k.thrust.edge, width * k.thrust.chip * part.chip_per_feed,
                    k.thrust.edge_depth / part.chip_per_feed);
            kerf_channel* feed = channels.add(KERF_CUT, id_feed + static_cast<std::uint32_t>(sector * part_count + p));
            sum.write(d, motion.cutting.fraction, smallest, feed);
            if (feed == nullptr) continue;
            for (std::size_t c = 0; c < 6; ++c) feed->follow[c] = law.set_share * aside[c];
            if (motion.is_averaged) continue;  // alternating forces cancel and go into `vibration`
            const double t = part.chip_per_feed * std::max(last_feed_rate, 1e-6), thrust = force_per_width(t, k.thrust);
            const double against = thrust > 0.0 ? -sense_of(motion) * force_per_width(t, k.cutting) / thrust : 0.0;
            for (std::size_t c = 0; c < 6; ++c) feed->follow[c] += against * along[c];
        }
    }
}

template <class Blade>
void add_side_cutting(const TeethInBone& in_bone, const Blade& blade, const SawParameters& law, const BoneQuery& bone,
                      const Oscillation& motion, Channels& channels) noexcept {
    if (in_bone.min_gap(0, in_bone.teeth.count) > max_cutting_gap)
        return;  // behind the front, the flanks run free in their slot
    const struct { EdgeCoefficients thrust, cutting; } k{law.thrust(), law.cutting()};
    const double reference = law.reference_density;
    // Samples lie at the front: farther back the slot would be bone during the lag of the committed cut, which depends
    // on the grid. They also lie a little inside the blade's sweep, so that they are free in a slot as wide as the
    // kerf. The position of a wall is accurate to an eighth of a voxel.
    const double inside = std::max(0.125 * 0.25 * bone.reach(), 0.02e-3);
    constexpr double play = 1e-8;  // [m] so that rounding across the blade does not count as a cut
    const auto add = [&](Row& row, Vec3 direction, double edge_length, double chip_per_feed, std::uint32_t id) {
        bone.sample(row.point, direction, row.sample);
        double smallest = 1e300, total = 0.0;
        Vec3 at{0, 0, 0};
        for (auto& one : row.sample) {
            one.gap = std::max(0.0, one.gap - inside) + play;
            if (one.engagement > 0.0) smallest = std::min(smallest, one.gap);
        }
        for (std::size_t i = 0; i < Row::count; ++i) {
            const double m = resistance(row.sample[i], bone.tissue_count(), reference);
            if (m <= 0.0 || row.sample[i].gap > smallest + max_cutting_gap) continue;
            at = at + m * row.point[i];
            total += m;
        }
        if (total <= 0.0) return;
        const double width = total / static_cast<double>(Row::count) * edge_length;
        ChannelSum sum;
        sum.add(width * k.thrust.edge, width * k.thrust.chip * chip_per_feed, k.thrust.edge_depth / chip_per_feed);
        sum.write(rate_at((1.0 / total) * at, direction), motion.cutting.fraction, smallest,
                  channels.add(KERF_CUT, id));
    };

    // Every other tooth is set to one side, so its flank removes the advance over two pitches.
    Stroke by_twos = motion.stroke;
    by_twos.pitch *= 2.0;
    const double flank_chip = mean_chip_per_feed(by_twos);
    for (const double side : {1.0, -1.0}) {
        Row row;
        for (std::size_t i = 0; i < Row::count; ++i) {
            row.point[i] =
                blade.front(0.9 * Row::position(i)).at + Vec3{0.0, side * (0.5 * blade.kerf() - inside), 0.0};
        }
        add(row, {0, side, 0}, 0.5 * blade.tooth_count * blade.tooth_height, flank_chip,
            id_side + (side > 0.0 ? 0 : 1));
    }
    // At an end the last tooth passes once an oscillation.
    const Vec3 end = blade.end_of_sweep();
    for (const double side : {1.0, -1.0}) {
        Row row;
        for (std::size_t i = 0; i < Row::count; ++i) {
            row.point[i] = {side * (end.x - inside), 0.4 * Row::position(i) * blade.kerf(), end.z};
        }
        add(row, {side, 0, 0}, blade.tooth_height, 1.0 / motion.stroke.rate, id_end + (side > 0.0 ? 0 : 1));
    }
}

template void add_side_cutting(const TeethInBone&, const SawBlade&, const SawParameters&, const BoneQuery&,
                               const Oscillation&, Channels&) noexcept;
template void add_side_cutting(const TeethInBone&, const StraightBlade&, const SawParameters&, const BoneQuery&,
                               const Oscillation&, Channels&) noexcept;

}  // namespace kerf::sawing
