// SPDX-License-Identifier: Apache-2.0
#include "edge_law.h"

#include "kerf/assert.hpp"
#include "kerf/exact_math.hpp"

namespace kerf::drilling {

double force_per_width(double t, const EdgeCoefficients& bone) noexcept {
    KERF_ASSERT(bone.edge_depth > 0.0, "a sharp onset cannot be solved; give the edge a small depth");

    if (t <= 0.0) return 0.0;
    const double built_up = 1.0 - exp_exact(-t / bone.edge_depth);  // [–] 0 … 1
    return bone.edge * built_up + bone.chip * t;
}

double resistance_of_density(double rho, double reference) noexcept {
    const double share = rho / reference;
    return share * share;
}

}  // namespace kerf::drilling
