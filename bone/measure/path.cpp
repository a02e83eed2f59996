// SPDX-License-Identifier: Apache-2.0
#include "bone/measure/path.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace kerf::bone {

double distance_to(const Path& path, Vec3 p) noexcept {
    double smallest = HUGE_VAL;
    for (std::size_t i = 0; i + 1 < path.along.size(); ++i) {
        const Vec3 from = path.along[i], way = path.along[i + 1] - from;
        const double squared = dot(way, way);
        const double t = squared > 0.0 ? std::clamp(dot(p - from, way) / squared, 0.0, 1.0) : 0.0;
        smallest = std::min(smallest, length(p - (from + t * way)));
    }
    return smallest;
}

Box bounds_of(const Path& path, double margin) noexcept {
    const double reach = path.within + margin;
    Box box{{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    for (const Vec3 p : path.along) {
        box.low = {std::min(box.low.x, p.x - reach), std::min(box.low.y, p.y - reach),
                   std::min(box.low.z, p.z - reach)};
        box.high = {std::max(box.high.x, p.x + reach), std::max(box.high.y, p.y + reach),
                    std::max(box.high.z, p.z + reach)};
    }
    return box;
}

}  // namespace kerf::bone
