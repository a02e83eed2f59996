// SPDX-License-Identifier: Apache-2.0
#pragma once

/// How bone resists a saw's tooth. Physics as plain functions of plain values; all SI.
namespace kerf::sawing {

/// How one tissue resists one unit of a tooth's width, in one direction.
struct ToothCoefficients {
    double edge;        ///< [N/m]  ploughing under the rounded edge, per width of cut
    double edge_depth;  ///< [m]    chip thickness at which ploughing has built up, > 0
    double chip;        ///< [N/m²] force per chip area
};

/// Force per width of cut [N/m] on a tooth that takes a chip of thickness `t` [m].
///
///     f(t) = K_e (1 − e^(−t/t_e)) + K_c t
///
/// with K_e = edge, t_e = edge_depth, K_c = chip. Rises monotonically; zero for t ≤ 0 (withdrawing).   [any] pure.
///
/// Source: fitted to single teeth in cortical bone [james-2012, james-2013] in docs/models/oscillating-saw.md; the
/// build-up term is ours: nobody measured below 2 µm, and a jump at zero feed is what no hand can balance.
[[nodiscard]] double force_per_width(double t, const ToothCoefficients& bone) noexcept;

/// How much less than the reference tissue a tissue of density `rho` [kg/m³] resists [–].
///
///     m(ρ) = (ρ / ρ_ref)²
///
/// Compressive strength of bone grows with the square of its apparent density.   [any] pure.
///
/// Source: exponent [carter-hayes-1977]; that cutting forces follow strength is assumed.
[[nodiscard]] double resistance_of_density(double rho, double reference) noexcept;

}  // namespace kerf::sawing
