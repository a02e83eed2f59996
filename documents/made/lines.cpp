// SPDX-License-Identifier: Apache-2.0
#include "documents/made/lines.h"

#include <algorithm>
#include <cmath>

namespace kerf::documents {

double Lines::to_border(Vec3 from, Vec3 along) const {
    constexpr double farthest = 120e-3, finest = 5e-6;  // [m]
    const bool is_inside = distance_to(bone_, from) < 0.0;
    double far = 0.0;
    while (far < farthest) {
        const double d = distance_to(bone_, from + far * along);
        if ((d < 0.0) != is_inside) return far;
        far += std::max(0.9 * std::abs(d), finest);
    }
    return HUGE_VAL;
}

}  // namespace kerf::documents
