// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "kerf/abi.h"
#include "kerf/assert.hpp"
#include "kerf/exact_math.hpp"

/// Resistance of bone to a cutting edge: plain functions of plain values; all SI.
namespace kerf {

/// Resistance of one tissue to one unit of cutting edge, in one direction.
struct EdgeCoefficients {
    double edge;        ///< [N/m]  ploughing under the rounded edge, per width of cut
    double edge_depth;  ///< [m]    chip thickness at which ploughing has built up, > 0
    double chip;        ///< [N/m²] force per chip area
};

/// Returns the fraction of the edge force that has built up at chip thickness `t` [m], 1 − e^(−t/t_e); 0 for t ≤ 0. It
/// is equal for all directions of one edge.   [any] pure.
[[nodiscard]] inline double built_up_at(double t, double edge_depth) noexcept {
    KERF_ASSERT(edge_depth > 0.0, "a sharp onset cannot be solved; give the edge a small depth");
    return t <= 0.0 ? 0.0 : 1.0 - exp_exact(-t / edge_depth);
}

/// Returns the force per width of cut [N/m] with the built-up fraction known. Pre: t > 0.   [any] pure.
[[nodiscard]] constexpr double force_per_width(double t, const EdgeCoefficients& bone, double built_up) noexcept {
    return bone.edge * built_up + bone.chip * t;
}

/// Returns the force per width of cut [N/m] on an edge that takes a chip of thickness `t` [m].
///
///     f(t) = K_e (1 − e^(−t/t_e)) + K_c t
///
/// with K_e = edge, t_e = edge_depth, K_c = chip. Rises monotonically; zero for t ≤ 0 (withdrawing). Leaves out the
/// heel behind the edge, which is a channel of its own.   [any] pure.
///
/// Source: edge and chip form after [altintas-2012]. The build-up term is ours: the laws of the papers jump at zero
/// feed, and no hand can balance a jump.
[[nodiscard]] inline double force_per_width(double t, const EdgeCoefficients& bone) noexcept {
    return t > 0.0 ? force_per_width(t, bone, built_up_at(t, bone.edge_depth)) : 0.0;
}

/// Returns the resistance of a tissue of density `rho` [kg/m³] divided by that at the reference density [–].
///
///     m(ρ) = (ρ / ρ_ref)²
///
/// [any] pure.   Source: compressive strength grows with the square of apparent density [carter-hayes-1977].
/// Assumption: cutting forces are proportional to strength.
[[nodiscard]] constexpr double resistance_of_density(double rho, double reference) noexcept {
    const double ratio = rho / reference;
    return ratio * ratio;
}

/// Returns the resistance at a sample divided by that at the reference density [–]: the weighted sum over its tissues,
/// times its engagement; 0 in air.   [any] pure.
[[nodiscard]] inline double resistance(const kerf_bone_sample& sample, std::uint32_t tissues,
                                       double reference_density) noexcept {
    if (sample.engagement <= 0.0) return 0.0;
    double m = 0.0;
    for (std::uint32_t i = 0; i < tissues; ++i)
        if (sample.weight[i] > 0.0) m += sample.weight[i] * resistance_of_density(sample.density[i], reference_density);
    return sample.engagement * m;
}

}  // namespace kerf
