// SPDX-License-Identifier: Apache-2.0
#pragma once

/// How bone resists a cutting edge. Physics as plain functions of plain values; all SI.
namespace kerf::drilling {

/// How one tissue resists one unit of cutting edge, in one direction.
struct EdgeCoefficients {
    double edge;        ///< [N/m]  ploughing under the rounded edge, per width of cut
    double edge_depth;  ///< [m]    chip thickness at which ploughing has built up, > 0
    double chip;        ///< [N/m²] force per chip area
};

/// Force per width of cut [N/m] on an edge that takes a chip of thickness `t` [m].
///
///     f(t) = K_e (1 − e^(−t/t_e)) + K_c t
///
/// with K_e = edge, t_e = edge_depth, K_c = chip. Rises monotonically; zero for t ≤ 0 (withdrawing).
/// Leaves out the heel behind the edge: that is a channel of its own.   [any] pure.
///
/// Source: edge + chip form after [altintas-2012], fitted in docs/models/drilling.md; the build-up term is ours: the
/// papers' laws jump at zero feed, which no hand can balance.
[[nodiscard]] double force_per_width(double t, const EdgeCoefficients& bone) noexcept;

/// The share of the edge force that has built up at chip thickness `t`, 1 − e^(−t/t_e): the same for every direction,
/// so worked out once.   [any] pure.
[[nodiscard]] double built_up_at(double t, double edge_depth) noexcept;
/// The force with that share known.   [any] pure.
[[nodiscard]] inline double force_per_width(double t, const EdgeCoefficients& bone, double built_up) noexcept {
    return bone.edge * built_up + bone.chip * t;
}

/// The pressure [Pa] under which bone of density `rho` [kg/m³] is crushed.
///
///     S = 68 MPa (ρ / 1 g/cm³)²    at 1/s
///
/// [any] pure.   Source: [carter-hayes-1977].
[[nodiscard]] inline double crushing_pressure(double rho) noexcept {
    const double grams_per_cm3 = 1e-3 * rho;
    return 68e6 * grams_per_cm3 * grams_per_cm3;
}

/// How much less than the reference tissue a tissue of density `rho` [kg/m³] resists [–].
///
///     m(ρ) = (ρ / ρ_ref)²
///
/// Compressive strength of bone grows with the square of its apparent density.   [any] pure.
///
/// Source: exponent [carter-hayes-1977]; that cutting forces follow strength is assumed.
[[nodiscard]] inline double resistance_of_density(double rho, double reference) noexcept {
    const double share = rho / reference;
    return share * share;
}

}  // namespace kerf::drilling
