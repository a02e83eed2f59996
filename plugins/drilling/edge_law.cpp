// SPDX-License-Identifier: Apache-2.0
#include "edge_law.h"

#include "kerf/assert.hpp"
#include "kerf/exact_math.hpp"

namespace kerf::drilling {

double built_up_at(double t, double edge_depth) noexcept {
    KERF_ASSERT(edge_depth > 0.0, "a sharp onset cannot be solved; give the edge a small depth");
    return t <= 0.0 ? 0.0 : 1.0 - exp_exact(-t / edge_depth);
}

double force_per_width(double t, const EdgeCoefficients& bone) noexcept {
    const double built_up = built_up_at(t, bone.edge_depth);
    return t <= 0.0 ? 0.0 : force_per_width(t, bone, built_up);
}

}  // namespace kerf::drilling
