// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "conformance/chart/pushed_awl.h"

#include <cmath>

#include "kerf/units.hpp"

namespace kerf::chart {

double push_of(const Awl& awl, const Scene& scene, double depth) {
    constexpr int rings = 96, around = 96;
    const double radius = 0.5 * awl.diameter, cot = 1.0 / std::tan(0.5 * awl.point_angle), wide = radius / rings;
    const Pose body_from_awl = scene.pose_at(depth);
    double force = 0.0;
    for (int ring = 0; ring < rings; ++ring) {
        const double r = (ring + 0.5) * wide, area = 2.0 * pi * r * wide / around;
        for (int n = 0; n < around; ++n) {
            const double angle = 2.0 * pi * (n + 0.5) / around;
            const int tissue = scene.bone.tissue_at(body_from_awl * Vec3{r * std::cos(angle), r * std::sin(angle), -r * cot});
            if (tissue < 0) continue;
            const double grams_per_cm3 = 1e-3 * scene.bone.tissues[static_cast<std::size_t>(tissue)].density;
            force += 68e6 * grams_per_cm3 * grams_per_cm3 * area;
        }
    }
    return force * (1.0 + awl.friction * cot);
}

}  // namespace kerf::chart
