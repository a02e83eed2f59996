// SPDX-License-Identifier: Apache-2.0
#include "saw_teeth.h"

namespace kerf::sawing {

void TeethInBone::sample(const SawParameters& law, const BoneQuery& bone, const SawBlade& blade,
                         const Oscillation& motion) noexcept {
    teeth = teeth_of(blade, motion.swing(blade));
    const SinCos quarter = sin_cos_exact(motion.is_averaged ? 0.25 * blade.pitch / blade.radius : 0.0);
    std::array<Vec3, 2 * most_teeth> point;
    std::array<kerf_bone_sample, 2 * most_teeth> found;
    const Vec3 axis{0, 0, -blade.radius};
    for (std::size_t i = 0; i < teeth.count; ++i) {
        const Tooth& t = teeth.tooth[i];
        const Vec3 middle = axis + (blade.radius * quarter.cos) * t.normal + Vec3{0, t.tip.y, 0},
                   aside = (blade.radius * quarter.sin) * t.along;
        point[2 * i] = middle - aside;
        point[2 * i + 1] = middle + aside;
    }
    const std::size_t count = 2 * teeth.count;
    bone.sample({point.data(), count}, {0, 0, 1}, {found.data(), count});
    for (std::size_t i = 0; i < count; ++i) {
        resisted[i] = resistance(found[i], bone.tissue_count(), law.reference_density);
        gap[i] = found[i].gap * teeth.tooth[i / 2].normal.z;
        engaged += 0.5 * found[i].engagement;
    }
}

}  // namespace kerf::sawing
