// SPDX-License-Identifier: Apache-2.0
#include "saw_teeth.h"

namespace kerf::sawing {

double resistance(const kerf_bone_sample& s, std::uint32_t tissues, double reference) noexcept {
    if (s.engagement <= 0.0) return 0.0;
    double m = 0.0;
    for (std::uint32_t i = 0; i < tissues; ++i) m += s.weight[i] * resistance_of_density(s.density[i], reference);
    return s.engagement * m;
}

void TeethInBone::ask(const Tick& tick, const BoneQuery& bone, const SawBlade& blade, const Going& going) noexcept {
    teeth = teeth_of(blade, going.swing(blade));
    const SinCos quarter = sin_cos_exact(going.is_averaged ? 0.25 * blade.pitch / blade.radius : 0.0);
    std::array<Vec3, 2 * most_teeth> point;
    std::array<kerf_bone_sample, 2 * most_teeth> sample;
    const Vec3 axis{0, 0, -blade.radius};
    for (std::size_t i = 0; i < teeth.count; ++i) {
        const Tooth& t = teeth.tooth[i];
        const Vec3 middle = axis + (blade.radius * quarter.cos) * t.normal + Vec3{0, t.tip.y, 0},
                   aside = (blade.radius * quarter.sin) * t.along;
        point[2 * i] = middle - aside;
        point[2 * i + 1] = middle + aside;
    }
    const std::size_t count = 2 * teeth.count;
    bone.sample({point.data(), count}, {0, 0, 1}, {sample.data(), count});
    for (std::size_t i = 0; i < count; ++i) {
        resisted[i] = resistance(sample[i], bone.tissue_count(), tick.force[force_reference_density]);
        gap[i] = sample[i].gap * teeth.tooth[i / 2].normal.z;
        engaged += 0.5 * sample[i].engagement;
    }
}

}  // namespace kerf::sawing
