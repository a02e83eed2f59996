// SPDX-License-Identifier: Apache-2.0
#include "side_work.h"

#include <cstddef>

#include "kerf/edge_law.hpp"
#include "kerf/math.hpp"
#include "twist_drill.h"

namespace kerf::drilling {

namespace {

/// cos θ in the middle of each eighth of a quarter turn. Sums over them are within 0.2 % of the integrals.
constexpr double facing[] = {0.99518472667219693, 0.95694033573220882, 0.88192126434835505, 0.77301045336273699,
                             0.63439328416364549, 0.47139673682599764, 0.29028467725446233, 0.09801714032956083};
constexpr std::size_t nodes = sizeof facing / sizeof facing[0], nodes_ahead = 2;  // the sample ahead counts up to 22.5°

}  // namespace

SideWork side_work(const SideRing& ring, const EdgeCoefficients& cutting) noexcept {
    SideWork sum;
    if (ring.thickness <= 0.0 || ring.fed >= 1.0) return sum;
    const double fed = built_up_at(2.0 * ring.fed * ring.thickness, cutting.edge_depth);
    for (std::size_t i = 0; i < nodes && facing[i] > ring.fed; ++i) {
        const double thickness = ring.thickness * (facing[i] - ring.fed);
        const double built_up = built_up_at(ring.thickness * (facing[i] + ring.fed), cutting.edge_depth) - fed;
        const Resistance& met = i < nodes_ahead ? ring.ahead : ring.sideways;
        const double force = met.edge * cutting.edge * built_up + met.chip * cutting.chip * thickness;
        sum.across += facing[i] * force;
        sum.torque += force;
    }
    // Both quarters of the half turn: (lips/2π) b Δθ, Δθ = π/(2 nodes)
    const double per_node = 2.0 * lip_count * ring.width / (2.0 * pi) * (0.5 * pi / static_cast<double>(nodes));
    return {per_node * sum.across, per_node * ring.radius * sum.torque};
}

}  // namespace kerf::drilling
