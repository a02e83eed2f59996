// SPDX-License-Identifier: Apache-2.0
#include "bone_thread.h"

#include <cmath>
#include <cstddef>
#include <span>

#include "kerf/edge_law.hpp"
#include "thread_grip.h"

namespace kerf::implant {

ThreadPlaces::ThreadPlaces(const ScrewThread& thread) noexcept {
    ThreadPiece pieces[most_pieces];
    count = make_pieces(thread, pieces);
    for (int i = 0; i < count; ++i) {
        const auto n = static_cast<std::size_t>(i);
        const double z = pieces[i].place.z, length = pieces[i].length;
        place[n] = pieces[i].place;
        radius[n] = thread.mean_radius(z);
        outer[n] = 0.5 * thread.outer_at(z);
        core[n] = 0.5 * thread.core_at(z);
        on_flank[n] = thread.flank_contact(z) * length;
        on_core[n] = thread.core_contact(z) * length;
        sheared[n] = pi * thread.outer_at(z) * thread.shape_factor(z) * length;
        across[n] = pi * (outer[n] * outer[n] - core[n] * core[n]) * length / thread.pitch;
        grip[n] = length;
        // Just outside: what the core itself has removed ends there.
        constexpr double beside = 0.08e-3;  // [m]
        const double share = (core[n] + beside) / radius[n];
        place[static_cast<std::size_t>(count) + n] = {share * pieces[i].place.x, share * pieces[i].place.y, z};
    }
    piece = pieces[0].length;
}

double ThreadPlaces::moved_in(const ThreadTrack& track) const noexcept {
    if (!track.is_there()) return 0.0;
    const double at = track.depth_of({0, 0, place[0].z}) / piece;
    return (std::floor(at + 0.5) - at) * piece;
}

BoneThread::BoneThread(const ThreadPlaces& places, const ScrewThread& thread, const ThreadTrack& track,
                       const ScrewParameters& law, const BoneQuery& bone) noexcept {
    const auto count = static_cast<std::size_t>(places.count);
    const double moved = places.moved_in(track);
    const SinCos turned = sin_cos_exact(moved / thread.advance());
    std::array<Vec3, 2 * most_pieces> place;
    for (std::size_t i = 0; i < 2 * count; ++i) {
        const auto& [x, y, z] = places.place[i];
        place[i] = {turned.cos * x - turned.sin * y, turned.sin * x + turned.cos * y, z + moved};
    }
    std::array<kerf_bone_sample, 2 * most_pieces> found;
    bone.sample(std::span<const Vec3>(place.data(), 2 * count), Vec3{0, 0, 1}, {found.data(), 2 * count});
    leading = last = thread.first_crest();
    bool has_front = false;
    double flutes = 0.0, first_quarter = 0.0, whole = 0.0, square = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const double m = resistance(found[i], bone.tissue_count(), reference_density), z = place[i].z;
        // The first and the last place stand for what the others have been moved away from.
        const double part = i == 0 ? 1.0 - moved / places.piece : i + 1 == count ? 1.0 + moved / places.piece : 1.0;
        if (-z <= thread.cone() + thread.flute_length) {
            front += m;
            flutes += 1.0;
        }
        if (m > 0.0 && !has_front) {
            has_front = true;
            leading = i == 0 ? thread.first_crest() : z + 0.5 * places.piece;
        }
        if (m > 0.0) last = z - 0.5 * places.piece;
        if (has_front && z >= leading - 0.25 * thread.lead()) {
            front_in_bone += found[i].engagement;
            first_quarter += 1.0;
        }
        const double on_core = resistance(found[count + i], bone.tissue_count(), reference_density);
        const double depth = track.depth_of(place[i]);
        const bool is_cut = track.is_cut_at(depth);
        const double relieved = 1.0 - law.tapped_relief * track.share_tapped(depth, places.outer[i], places.core[i]);
        // All of it at the thread's radius, as the torque of foam goes with it [weidling-2022].
        rubbing += part * relieved * law.friction * law.compaction * places.radius[i] *
                   (m * places.on_flank[i] + on_core * places.on_core[i]);
        if (m <= 0.0) continue;
        engaged += part * found[i].engagement * places.grip[i];
        if (found[i].body >= 0) body = found[i].body;
        if (!is_cut) {
            blocked += part * law.crush * m * places.across[i];
            continue;
        }
        const double strong = part * law.shear * m * places.sheared[i],
                     stiff = part * 1e3 * law.grip_stiffness * m * places.grip[i];  // of 1 mm, for each metre
        whole += strong;
        strength += strong * strength_left(track.slip_at(depth), law.yield_share, law.yield_slip, law.strip_slip);
        stiffness += stiff;
        pressed += part * law.crush * m * 2.0 * places.outer[i] * places.grip[i];
        middle += stiff * z;
        square += stiff * z * z;
    }
    if (flutes > 0.0) front /= flutes;
    if (first_quarter > 0.0) front_in_bone /= first_quarter;
    if (whole > 0.0) left = strength / whole;
    if (stiffness > 0.0) {
        middle /= stiffness;
        spread = std::sqrt(std::max(0.0, square / stiffness - middle * middle));
    }
}

}  // namespace kerf::implant
