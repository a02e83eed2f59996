// SPDX-License-Identifier: Apache-2.0
#include "tooth_law.h"

#include "kerf/assert.hpp"
#include "kerf/exact_math.hpp"

namespace kerf::sawing {

double force_per_width(double t, const ToothCoefficients& bone) noexcept {
    KERF_ASSERT(bone.edge_depth > 0.0, "a sharp onset cannot be solved; give the edge a small depth");
    if (!(t > 0.0)) return 0.0;
    return bone.edge * (1.0 - exp_exact(-t / bone.edge_depth)) + bone.chip * t;
}

double resistance_of_density(double rho, double reference) noexcept {
    const double ratio = rho / reference;
    return ratio * ratio;
}

}  // namespace kerf::sawing
