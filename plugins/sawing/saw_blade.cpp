// SPDX-License-Identifier: Apache-2.0
#include "saw_blade.h"

#include <algorithm>

namespace kerf::sawing {

Teeth teeth_of(const SawBlade& blade, double swing) noexcept {
    Teeth teeth;
    teeth.count = std::min(blade.count(), max_teeth);
    // All teeth differ by the same angle, so one sine is enough.
    const double per_tooth = blade.pitch / blade.radius;
    const SinCos step = sin_cos_exact(per_tooth);
    SinCos at = sin_cos_exact(swing - 0.5 * static_cast<double>(teeth.count - 1) * per_tooth);
    for (std::size_t i = 0; i < teeth.count; ++i) {
        Tooth& t = teeth.tooth[i];
        t.side = i % 2 == 0 ? 1.0 : -1.0;
        t.tip = blade.on_front(at);
        t.tip.y = 0.25 * t.side * blade.kerf();
        t.normal = {at.sin, 0.0, at.cos};
        t.along = {at.cos, 0.0, -at.sin};
        at = {at.sin * step.cos + at.cos * step.sin, at.cos * step.cos - at.sin * step.sin};
    }
    return teeth;
}

}  // namespace kerf::sawing
