// SPDX-License-Identifier: Apache-2.0
#include "saw_teeth.h"

#include "straight_blade.h"

namespace kerf::sawing {

template <class Blade>
void TeethInBone::sample(const SawParameters& law, const BoneQuery& bone, const Blade& blade,
                         const Oscillation& motion) noexcept {
    teeth = teeth_of(blade, motion.swing(blade));
    const double quarter = motion.is_averaged ? 0.25 * blade.pitch : 0.0;
    std::array<Vec3, 2 * max_teeth> point{};
    std::array<kerf_bone_sample, 2 * max_teeth> found;
    for (std::size_t i = 0; i < teeth.count; ++i) {
        const std::array<Vec3, 2> pair = blade.points_around(teeth.tooth[i], quarter);
        point[2 * i] = pair[0];
        point[2 * i + 1] = pair[1];
    }
    const std::size_t count = 2 * teeth.count;
    bone.sample({point.data(), count}, {0, 0, 1}, {found.data(), count});
    for (std::size_t i = 0; i < count; ++i) {
        resisted[i] = resistance(found[i], bone.tissue_count(), law.reference_density);
        gap[i] = found[i].gap * teeth.tooth[i / 2].normal.z;
        engagement[i] = found[i].engagement;
        engaged += 0.5 * found[i].engagement;
    }
}

template void TeethInBone::sample(const SawParameters&, const BoneQuery&, const SawBlade&, const Oscillation&) noexcept;
template void TeethInBone::sample(const SawParameters&, const BoneQuery&, const StraightBlade&,
                                  const Oscillation&) noexcept;

}  // namespace kerf::sawing
