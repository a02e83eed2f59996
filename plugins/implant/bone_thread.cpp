// SPDX-License-Identifier: Apache-2.0
#include "bone_thread.h"

#include <cstddef>
#include <span>

#include "kerf/edge_law.hpp"

namespace kerf::implant {

ThreadPlaces::ThreadPlaces(const ScrewThread& thread) noexcept {
    ThreadPiece pieces[most_pieces];
    count = make_pieces(thread, pieces);
    for (int i = 0; i < count; ++i) {
        const auto n = static_cast<std::size_t>(i);
        const double z = pieces[i].place.z, length = pieces[i].length;
        place[n] = pieces[i].place;
        radius[n] = thread.mean_radius(z);
        on_flank[n] = thread.flank_contact(z) * length;
        on_core[n] = thread.core_contact(z) * length;
        sheared[n] = pi * thread.outer * thread.shape_factor(z) * length;
        grip[n] = length;
        // Just outside: what the core itself has removed ends there.
        constexpr double beside = 0.2e-3;  // [m]
        const double share = (0.5 * thread.core_at(z) + beside) / radius[n];
        place[static_cast<std::size_t>(count) + n] = {share * pieces[i].place.x, share * pieces[i].place.y, z};
    }
}

BoneThread::BoneThread(const ThreadPlaces& places, const ScrewThread& thread, const ScrewParameters& law,
                       const BoneQuery& bone) noexcept {
    const auto count = static_cast<std::size_t>(places.count);
    std::array<kerf_bone_sample, 2 * most_pieces> found;
    bone.sample(std::span<const Vec3>(places.place.data(), 2 * count), Vec3{0, 0, 1}, {found.data(), 2 * count});
    double flutes = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const double m = resistance(found[i], bone.tissue_count(), reference_density);
        if (-places.place[i].z <= thread.cone() + thread.flute_length) {
            front += m;
            flutes += 1.0;
        }
        const double on_core = resistance(found[count + i], bone.tissue_count(), reference_density);
        // All of it at the thread's radius, as the torque of foam goes with it [weidling-2022].
        rubbing +=
            law.friction * law.compaction * places.radius[i] * (m * places.on_flank[i] + on_core * places.on_core[i]);
        if (m <= 0.0) continue;
        strength += law.shear * m * places.sheared[i];
        stiffness += 1e3 * law.grip_stiffness * m * places.grip[i];  // of 1 mm, for each metre
        engaged += found[i].engagement * places.grip[i];
    }
    if (flutes > 0.0) front /= flutes;
}

}  // namespace kerf::implant
